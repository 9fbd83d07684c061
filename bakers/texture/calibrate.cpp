#include "bakers/texture/calibrate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numeric>

#include "bakers/parse/materials.hpp"
#include "bakers/texture/names.hpp"
#include "bakers/texture/rules.hpp"

namespace pbrbake::texture {
namespace {

/// f0 of metals: Lagarde & de Rousiers 2014, table 5 and physicallybased.info; of dielectrics from their
/// index.
constexpr std::array<SurfaceWord, 44> kWords{{
    {"concrete", false, Colour(.04f)},
    {"plaster", false, Colour(.04f)},
    {"asphalt", false, Colour(.04f)},
    {"brick", false, Colour(.04f)},
    {"bricks", false, Colour(.04f)},
    {"wood", false, Colour(.04f)},
    {"plank", false, Colour(.04f)},
    {"planks", false, Colour(.04f)},
    {"stone", false, Colour(.04f)},
    {"rock", false, Colour(.04f)},
    {"rocks", false, Colour(.04f)},
    {"gravel", false, Colour(.04f)},
    {"dirt", false, Colour(.04f)},
    {"sand", false, Colour(.04f)},
    {"grass", false, Colour(.04f)},
    {"leaf", false, Colour(.04f)},
    {"leaves", false, Colour(.04f)},
    {"bark", false, Colour(.04f)},
    {"cloth", false, Colour(.04f)},
    {"fabric", false, Colour(.04f)},
    {"leather", false, Colour(.04f)},
    {"rubber", false, Colour(.04f)},
    {"plastic", false, Colour(.046f)},
    {"ceramic", false, Colour(.05f)},
    {"tile", false, Colour(.045f)},
    {"tiles", false, Colour(.045f)},
    {"marble", false, Colour(.045f)},
    {"glass", false, Colour(.043f)},
    {"skin", false, Colour(.028f)},
    {"snow", false, Colour(.018f)},
    {"ice", false, Colour(.018f)},
    {"steel", true, {.56f, .57f, .58f}},
    {"iron", true, {.56f, .57f, .58f}},
    {"metal", true, {.56f, .57f, .58f}},
    {"grate", true, {.56f, .57f, .58f}},
    {"chrome", true, {.55f, .556f, .554f}},
    {"titanium", true, {.542f, .497f, .449f}},
    {"zinc", true, {.664f, .824f, .85f}},
    {"aluminium", true, {.913f, .921f, .925f}},
    {"aluminum", true, {.913f, .921f, .925f}},
    {"silver", true, {.972f, .96f, .915f}},
    {"copper", true, {.955f, .638f, .538f}},
    {"brass", true, {.887f, .789f, .434f}},
    {"gold", true, {1.f, .766f, .336f}},
}};

constexpr double kDoubtful = .5;  ///< trust in what doubtful maps tell

/// Sums over a row; rows are added in order, so that results don't depend on threads.
struct RowSums {
    double diffuse = 0, f0 = 0;
};

/// In steps of 1/1024.
using Histogram = std::array<std::size_t, 1025>;

struct Statistics {
    double diffuse = 0, f0 = 0;  ///< means
    /// The median f0 of texels that have a diffuse colour, which metals haven't: in a library's maps those
    /// are dielectrics. 0 where there are too few of them.
    double dielectric_median = 0;
};

double median_of(const Histogram& histogram, std::size_t least_count) {
    const std::size_t count = std::accumulate(histogram.begin(), histogram.end(), std::size_t{0});
    if (count < least_count) return 0;
    std::size_t seen = 0, step = 0;
    while (seen + histogram[step] < (count + 1) / 2) seen += histogram[step++];
    return (static_cast<double>(step) + .5) / 1024;
}

Statistics statistics_of(const Sources& sources, Context& context) {
    const auto least_diffuse = static_cast<float>(sources.params().dielectric_f0);
    std::vector<RowSums> rows(static_cast<std::size_t>(sources.height()));
    Histogram histogram{};
    std::mutex mutex;
    context.parallel_for(sources.height(), 64, [&](std::int64_t begin, std::int64_t end) {
        Histogram own{};
        LegacyRow texels(sources.width());
        for (auto y = static_cast<int>(begin); y < end; ++y) {
            sources.read(0, y, texels);
            for (std::size_t i = 0; i < texels.texels(); ++i) {
                const float diffuse = pbr::mean_channel(texels.diffuse[i]),
                            f0 = pbr::mean_channel(texels.f0[i]);
                rows[static_cast<std::size_t>(y)].diffuse += static_cast<double>(diffuse);
                rows[static_cast<std::size_t>(y)].f0 += static_cast<double>(f0);
                if (diffuse >= least_diffuse)
                    ++own[static_cast<std::size_t>(std::clamp(f0, 0.f, 1.f) * 1024)];
            }
        }
        const std::lock_guard lock(mutex);
        for (std::size_t i = 0; i < own.size(); ++i) histogram[i] += own[i];
    });
    Statistics statistics;
    const auto texels = static_cast<double>(sources.width()) * sources.height();
    for (const RowSums& row : rows) {
        statistics.diffuse += row.diffuse / texels;
        statistics.f0 += row.f0 / texels;
    }
    statistics.dielectric_median = median_of(histogram, static_cast<std::size_t>(texels) / 20 + 1);
    return statistics;
}

/// Of texels evenly spread, the median f0 of those that have a diffuse colour (0 where they are few) and the
/// mean and the largest f0.
struct F0Sample {
    double dielectric_median = 0, mean = 0, largest = 0;
};

F0Sample sample_f0(const Sources& sources) {
    constexpr int kSide = 128;
    const int step_x = std::max(1, sources.width() / kSide), step_y = std::max(1, sources.height() / kSide);
    const auto least_diffuse = static_cast<float>(sources.params().dielectric_f0);
    Histogram histogram{};
    F0Sample sample;
    std::size_t count = 0;
    for (int y = step_y / 2; y < sources.height(); y += step_y)
        for (int x = step_x / 2; x < sources.width(); x += step_x, ++count) {
            const pbr::Reflected<float> texel = sources.texel(x, y).reflected;
            const float f0 = std::clamp(pbr::mean_channel(texel.f0), 0.f, 1.f);
            sample.mean += static_cast<double>(f0);
            sample.largest = std::max(sample.largest, static_cast<double>(pbr::max_channel(texel.f0)));
            if (pbr::mean_channel(texel.diffuse) >= least_diffuse)
                ++histogram[static_cast<std::size_t>(f0 * 1024)];
        }
    sample.mean /= static_cast<double>(count);
    sample.dielectric_median = median_of(histogram, count / 20 + 1);
    return sample;
}

/// What speaks against a specular-gloss set's f0: its name, or numbers that no surface has.
enum class Doubt { none, no_dielectric, no_metal, too_dim };

Doubt doubt_f0(const Sources& sources, const SurfaceWord* word) {
    // Frostbite's largest dielectric f0, beyond diamond's; water's; and a third of iron's.
    constexpr double kLargestDielectric = .16, kWater = .02, kLeastMetal = .2;
    const F0Sample sample = sample_f0(sources);
    if (word && !word->is_metal && sample.dielectric_median > kLargestDielectric) return Doubt::no_dielectric;
    if (word && word->is_metal && sample.mean < kLeastMetal) return Doubt::no_metal;
    if (sources.has_specular() && sample.largest > 0 && sample.largest < kWater) return Doubt::too_dim;
    return Doubt::none;
}

}  // namespace

const SurfaceWord* surface_word(const std::string& path) {
    for (const std::string& word : words_of(path))
        for (const SurfaceWord& known : kWords)
            if (known.word == word) return &known;
    return nullptr;
}

pbr::Reflected<float> Calibration::operator()(const pbr::Reflected<float>& texel) const {
    if (kind == Kind::none) return texel;
    if (kind != Kind::metal)
        return {texel.diffuse, glm::min(texel.f0 * static_cast<float>(scale), Colour(1))};
    const float brightness_here = pbr::mean_channel(texel.diffuse) + pbr::mean_channel(texel.f0);
    const float relative = brightness > 0 ? brightness_here / static_cast<float>(brightness) : 1.f;
    return {Colour(0), glm::min(metal * relative, Colour(1))};
}

std::string_view kind_name(Calibration::Kind kind) {
    constexpr std::array<std::string_view, 4> kNames{"none", "metal", "dielectric", "statistics"};
    return kNames[static_cast<std::size_t>(kind)];
}

Calibration find_calibration(const Sources& sources, Context& context) {
    const TextureParams& params = sources.params();
    Calibration result;
    if (params.model == Model::metallic_roughness) return result;
    const SurfaceWord* word = surface_word(params.material);
    if (!word) word = surface_word(name_of_set(params));
    const std::optional<Colour>& ruled = sources.rules().f0;
    const bool is_legacy = params.model != Model::specular_gloss,
               is_automatic = params.calibrate == Calibrate::automatic;
    bool wanted = params.calibrate == Calibrate::library || (is_automatic && (is_legacy || ruled));
    if (!wanted && is_automatic && params.surface == SurfaceIs::automatic) {
        // Materials of a glTF file are made as f0; maps beside each other needn't be.
        const bool is_painted = !parse::has_material_extension(params.source);
        const Doubt doubt = doubt_f0(sources, is_painted ? word : nullptr);
        if (doubt == Doubt::no_dielectric) {
            wanted = true;
            result.warning = "specular reflects more than a dielectric can, but the name says " +
                             std::string(word->word) +
                             ": it was scaled to that; state calibrate none if it is f0";
        } else if (doubt == Doubt::no_metal) {
            result.trust = kDoubtful;
            result.warning =
                "the name says " + std::string(word->word) +
                ", but specular reflects less than a metal does; state surface metal, or dielectric "
                "if it is painted or calibrate none if it is f0";
        } else if (doubt == Doubt::too_dim) {
            result.trust = kDoubtful;
            result.warning =
                "specular reflects less than water everywhere, which no surface does; state calibrate "
                "library if it was "
                "painted by eye, or surface";
        }
    }
    if (params.surface == SurfaceIs::any || (params.surface == SurfaceIs::automatic && !wanted))
        word = nullptr;
    bool is_metal = params.surface == SurfaceIs::metal;
    const bool is_told = is_metal || params.surface == SurfaceIs::dielectric || word != nullptr;
    if (params.surface == SurfaceIs::automatic && word) is_metal = word->is_metal;
    result.surface = !is_told ? "any" : is_metal ? "metal" : "dielectric";
    if (word) result.word = word->word;
    if (!wanted) return result;

    const Statistics statistics = statistics_of(sources, context);
    const bool word_fits = word && word->is_metal == is_metal;
    if (is_told && is_metal) {
        constexpr Colour kIron(.56f, .57f, .58f);
        result.kind = Calibration::Kind::metal;
        result.metal = ruled ? *ruled : word_fits ? word->f0 : kIron;
        result.brightness = statistics.diffuse + statistics.f0;
        if (statistics.f0 > 0)
            result.scale = static_cast<double>(pbr::mean_channel(result.metal)) / statistics.f0;
    } else if (is_told) {
        const double reference = ruled       ? static_cast<double>(pbr::mean_channel(*ruled))
                                 : word_fits ? static_cast<double>(word->f0.x)
                                             : params.dielectric_f0;
        result.kind = Calibration::Kind::dielectric;
        if (statistics.f0 > 0) result.scale = reference / statistics.f0;
    } else if (statistics.dielectric_median > params.dielectric_f0 + 2 * params.f0_tolerance) {
        result.kind = Calibration::Kind::statistics;
        result.scale = params.dielectric_f0 / statistics.dielectric_median;
        result.trust = kDoubtful;
        result.warning =
            "specular was scaled so that its median dielectric reflects the usual f0; state "
            "surface or calibrate none if it is f0 already";
    }
    return result;
}

double green_correlation(const Sources& sources, Context& context) {
    struct Sums {
        double product = 0, xx = 0, yy = 0;
    };
    constexpr int kMostPairs = 512;
    const int gaps = sources.height() - 1, pairs = std::min(gaps, kMostPairs);
    std::vector<Sums> rows(static_cast<std::size_t>(pairs));
    struct Slope {
        float x, y;
    };
    const auto slopes_of = [&](int y, Planes& normals, std::vector<Slope>& slopes) {
        sources.read_normals(y, 0, normals);
        for (std::size_t x = 0; x < slopes.size(); ++x) {
            const Colour n = normals[x];
            const float z = std::max(n.z, .1f);
            slopes[x] = {-n.x / z, -n.y / z};
        }
    };
    context.parallel_for(pairs, 16, [&](std::int64_t begin, std::int64_t end) {
        std::vector<Slope> upper(static_cast<std::size_t>(sources.width())), lower = upper;
        Planes normals;
        normals.resize(upper.size());
        for (std::int64_t i = begin; i < end; ++i) {
            const auto y = static_cast<int>(i * gaps / pairs);
            slopes_of(y, normals, upper);
            slopes_of(y + 1, normals, lower);
            Sums& sums = rows[static_cast<std::size_t>(i)];
            for (std::size_t x = 0; x + 1 < upper.size(); ++x) {
                // Rows go down, so d/dy of the upward axis is minus the difference of rows.
                const double a = upper[x].x - lower[x].x, b = upper[x + 1].y - upper[x].y;
                sums.product += a * b;
                sums.xx += a * a;
                sums.yy += b * b;
            }
        }
    });
    Sums all;
    for (const Sums& row : rows) {
        all.product += row.product;
        all.xx += row.xx;
        all.yy += row.yy;
    }
    return all.xx > 0 && all.yy > 0 ? all.product / std::sqrt(all.xx * all.yy) : 0;
}

}  // namespace pbrbake::texture
