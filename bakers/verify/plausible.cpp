#include "bakers/verify/plausible.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "bakers/verify/product_file.hpp"

namespace pbrbake::verify {
namespace fs = std::filesystem;
namespace {

constexpr const char* kPainters = "a convention of texture painters";

/// A value of the set: a channel of one of its images.
struct Channel {
    const Image* image = nullptr;
    int index = 0;
    double scale = 1;
    double at(int x, int y) const { return static_cast<double>(image->texel(0, 0, y, x)[index]) / scale; }
};

/// IEC 61966-2-1, of 0 to 255.
double srgb_255(double linear) {
    const double clamped = std::clamp(linear, 0., 1.);
    return 255 * (clamped <= .0031308 ? 12.92 * clamped : 1.055 * std::pow(clamped, 1 / 2.4) - .055);
}

/// The images of a set, and which channel holds what by the record's names.
class Set {
  public:
    Set(const fs::path& file, const Json& record) : set_(record.at("set")) {
        std::size_t index = 0;
        for (const auto& [name, channels] : set_.at("images").items()) {
            const fs::path path =
                file.parent_path() / record.at("outputs").at(index++).at("path").get<std::string>();
            const ProductFile& product = products_.emplace_back(read_product_file(path, record));
            for (int c = 0; c < product.image.channel_count() && c < static_cast<int>(channels.size()); ++c)
                places_[channels[static_cast<std::size_t>(c)].get<std::string>()] = {products_.size() - 1, c};
        }
    }

    int width() const { return products_.front().image.levels.front().width; }
    int height() const { return products_.front().image.levels.front().height; }
    bool has(const std::string& name) const { return places_.contains(name); }
    Channel channel(const std::string& name) const {
        const auto& [product, index] = places_.at(name);
        return {&products_[product].image, index, products_[product].scale};
    }
    double unit() const { return set_.value("dielectric_f0_unit", 1.); }

  private:
    const Json& set_;
    std::vector<ProductFile> products_;
    std::map<std::string, std::pair<std::size_t, int>> places_;
};

struct Luminance {
    Channel r, g, b;
    double at(int x, int y) const { return .2126 * r.at(x, y) + .7152 * g.at(x, y) + .0722 * b.at(x, y); }
};

Luminance luminance(const Set& set, const std::string& name) {
    return {set.channel(name + ".r"), set.channel(name + ".g"), set.channel(name + ".b")};
}

void count(RangeCheck& check, double value, double slack) {
    ++check.texels;
    if (value < check.lowest - slack) ++check.below;
    if (value > check.highest + slack) ++check.above;
}

/// f0 of the dielectric part, by whichever channel holds it.
class DielectricF0 {
  public:
    explicit DielectricF0(const Set& set) : unit_(set.unit()) {
        for (std::size_t i = 0; i < kNames.size(); ++i)
            if (set.has(kNames[i])) {
                held_ = i;
                channel_ = set.channel(kNames[i]);
            }
        if (held_ == 0 && channel_.image) colour_ = luminance(set, "dielectric_f0");
        if (set.has("specular_factor")) factor_ = set.channel("specular_factor");
    }
    bool is_held() const { return channel_.image != nullptr; }
    double at(int x, int y) const {
        if (held_ == 0) return colour_.at(x, y) * unit_ * (factor_.image ? factor_.at(x, y) : 1);
        const double value = channel_.at(x, y);
        return held_ == 1 ? .16 * value * value : .08 * value;
    }

  private:
    static constexpr std::array<const char*, 3> kNames{"dielectric_f0.r", "reflectance", "specular"};
    std::size_t held_ = 0;
    Channel channel_, factor_;
    Luminance colour_;
    double unit_;
};

}  // namespace

std::vector<RangeCheck> check_ranges(const fs::path& file, const Json& record) {
    if (!record.is_object() || record.value("kind", "") != "texture") return {};
    try {
        const Set set(file, record);
        const Luminance base = luminance(set, "base_color");
        const Channel metallic = set.channel("metallic");
        const DielectricF0 dielectric_f0(set);
        RangeCheck dielectric{"dielectric base colour, sRGB", kPainters, 30, 240};
        RangeCheck metal{"metal f0, sRGB", kPainters, 180, 255};
        RangeCheck f0{"dielectric f0, linear", "Fresnel at index 1.33 (water) to 1.79", .02, .08};
        RangeCheck mask{"metallic, of neither", "a surface is a metal or not (Lagarde & de Rousiers 2014)",
                        .1, .9};
        constexpr double kCode = .5, kF0Code = 1e-3;  // what rounding may take
        for (int y = 0; y < set.height(); ++y)
            for (int x = 0; x < set.width(); ++x) {
                const double m = metallic.at(x, y), colour = srgb_255(base.at(x, y));
                if (m <= mask.lowest) {
                    count(dielectric, colour, kCode);
                    if (dielectric_f0.is_held()) count(f0, dielectric_f0.at(x, y), kF0Code);
                } else if (m >= mask.highest) {
                    count(metal, colour, kCode);
                } else {
                    ++mask.texels;
                }
            }
        std::vector<RangeCheck> checks{dielectric, metal, mask};
        if (dielectric_f0.is_held()) checks.insert(checks.begin() + 1, f0);
        const double texels = static_cast<double>(set.width()) * set.height();
        for (RangeCheck& check : checks)
            for (double* sum : {&check.texels, &check.below, &check.above}) *sum /= texels;
        return checks;
    } catch (const Json::exception&) {
        return {};
    } catch (const std::out_of_range&) {
        return {};
    }
}

}  // namespace pbrbake::verify
