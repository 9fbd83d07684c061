#include "bakers/verify/plausible.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "bakers/io/io.hpp"
#include "bakers/verify/product_file.hpp"

namespace pbrbake::verify {
namespace fs = std::filesystem;
namespace {

constexpr const char* kPainters = "a convention of texture painters";

/// IEC 61966-2-1, of 0 to 255.
double srgb_255(double linear) {
    const double clamped = std::clamp(linear, 0., 1.);
    return 255 * (clamped <= .0031308 ? 12.92 * clamped : 1.055 * std::pow(clamped, 1 / 2.4) - .055);
}

/// A value of the set: a channel of one of its images, at (x, y) of the set's texels.
struct Channel {
    const Image* image = nullptr;
    int index = 0;
    double scale = 1;
    int width = 1, height = 1;  ///< of the set

    double at(int x, int y) const {
        const Level& level = image->levels.front();
        return static_cast<double>(
                   image->texel(0, 0, static_cast<int>(std::int64_t{y} * level.height / height),
                                static_cast<int>(std::int64_t{x} * level.width / width))[index]) /
               scale;
    }
};

/// The images of a set, and which channel holds what, by the names that records use.
class Set {
  public:
    /// Of the record of a bake, beside `file`.
    Set(const fs::path& file, const Json& record) {
        const Json& set = record.at("set");
        unit_ = set.value("dielectric_f0_unit", 1.);
        std::size_t output = 0;  // images come first, in the same order
        for (const auto& [name, channels] : set.at("images").items()) {
            const fs::path path =
                file.parent_path() / record.at("outputs").at(output++).at("path").get<std::string>();
            ProductFile product = read_product_file(path, record);
            std::vector<std::string> names;
            for (const Json& channel : channels) names.push_back(channel.get<std::string>());
            add(std::move(product.image), product.scale, names);
        }
    }

    explicit Set(const SetFiles& files) {
        const auto read = [&](const fs::path& path, const char* space,
                              const std::vector<std::string>& names) {
            if (path.empty()) return;
            SourceImage source = io::read_source({.path = path, .colour_space = space});
            if (source.image.faces != 1)
                throw Error(ExitCode::unreadable_input, path.string(),
                            "is a cube map; a texture set is of flat pictures");
            add(std::move(source.image), 1, names);
        };
        read(files.base_color, "auto", {"base_color.r", "base_color.g", "base_color.b"});
        read(files.metallic_roughness, "raw", {"occlusion", "perceptual_roughness", "metallic"});
        read(files.metallic, "raw", {"metallic"});
        read(files.diffuse, "auto", {"diffuse.r", "diffuse.g", "diffuse.b"});
        read(files.specular, "auto", {"f0.r", "f0.g", "f0.b"});
    }

    int width() const { return width_; }
    int height() const { return height_; }
    bool is_empty() const { return images_.empty(); }
    bool has(const std::string& name) const { return places_.contains(name); }
    Channel channel(const std::string& name) const {
        const Place& place = places_.at(name);
        return {&images_[place.image], place.channel, place.scale, width_, height_};
    }
    double unit() const { return unit_; }

  private:
    struct Place {
        std::size_t image;
        int channel;
        double scale;
    };

    void add(Image image, double scale, const std::vector<std::string>& names) {
        width_ = std::max(width_, image.levels.front().width);
        height_ = std::max(height_, image.levels.front().height);
        for (int c = 0; c < image.channel_count() && c < static_cast<int>(names.size()); ++c)
            places_[names[static_cast<std::size_t>(c)]] = {images_.size(), c, scale};
        images_.push_back(std::move(image));
    }

    std::vector<Image> images_;
    std::map<std::string, Place> places_;
    int width_ = 1, height_ = 1;
    double unit_ = 1;
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

constexpr double kCode = .5, kF0Code = 1e-3;  // what rounding may take

const RangeCheck kDielectricF0{"dielectric f0, linear", "Fresnel at index 1.33 (water) to 1.79", .02, .08};
const RangeCheck kMetalF0{"metal f0, sRGB", kPainters, 180, 255};

/// Of base colours and a mask.
std::vector<RangeCheck> check_metallic(const Set& set) {
    const Luminance base = luminance(set, "base_color");
    const Channel metallic = set.channel("metallic");
    const DielectricF0 dielectric_f0(set);
    RangeCheck dielectric{"dielectric base colour, sRGB", kPainters, 30, 240};
    RangeCheck metal = kMetalF0, f0 = kDielectricF0;
    RangeCheck mask{"metallic, of neither", "a surface is a metal or not (Lagarde & de Rousiers 2014)", .1,
                    .9};
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
    if (dielectric_f0.is_held()) return {dielectric, f0, metal, mask};
    return {dielectric, metal, mask};
}

/// Of diffuse colours and f0, which has to tell what is a metal: gems end at .17 (diamond), metals begin
/// above .4.
std::vector<RangeCheck> check_specular_gloss(const Set& set) {
    constexpr double kMetalFrom = .2;
    const Luminance diffuse = luminance(set, "diffuse"), specular = luminance(set, "f0");
    RangeCheck dielectric{"dielectric diffuse, sRGB", kPainters, 30, 240};
    RangeCheck metal_diffuse{"metal diffuse, sRGB", "a metal returns no light from below its surface", 0, 30};
    RangeCheck metal = kMetalF0, f0 = kDielectricF0;
    for (int y = 0; y < set.height(); ++y)
        for (int x = 0; x < set.width(); ++x) {
            const double reflected = specular.at(x, y), colour = srgb_255(diffuse.at(x, y));
            if (reflected < kMetalFrom) {
                count(dielectric, colour, kCode);
                count(f0, reflected, kF0Code);
            } else {
                count(metal_diffuse, colour, kCode);
                count(metal, srgb_255(reflected), kCode);
            }
        }
    return {dielectric, f0, metal_diffuse, metal};
}

/// In shares of all texels.
std::vector<RangeCheck> check(const Set& set) {
    std::vector<RangeCheck> checks = set.has("f0.r") ? check_specular_gloss(set) : check_metallic(set);
    const double texels = static_cast<double>(set.width()) * set.height();
    for (RangeCheck& one : checks)
        for (double* sum : {&one.texels, &one.below, &one.above}) *sum /= texels;
    return checks;
}

}  // namespace

std::vector<RangeCheck> check_ranges(const fs::path& file, const Json& record) {
    if (!record.is_object() || record.value("kind", "") != "texture") return {};
    try {
        const Set set(file, record);
        return set.is_empty() ? std::vector<RangeCheck>{} : check(set);
    } catch (const Json::exception&) {
        return {};
    } catch (const std::out_of_range&) {
        return {};
    }
}

std::vector<RangeCheck> check_ranges(const SetFiles& files) { return check(Set(files)); }

}  // namespace pbrbake::verify
