#include "bakers/texture/calibrate.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

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

/// Sums in double: the order of texels is fixed, so is the result.
double mean_of(const std::vector<Colour>& colours) {
    double sum = 0;
    for (const Colour& colour : colours) sum += static_cast<double>(pbr::mean_channel(colour));
    return colours.empty() ? 0 : sum / static_cast<double>(colours.size());
}

void scale_f0(MapLevel& level, double scale) {
    for (Colour& f0 : level.f0) f0 = glm::min(f0 * static_cast<float>(scale), Colour(1));
}

/// A metal has no diffuse colour: the picture's detail is in both maps, and its mean is the metal's.
void make_metal(MapLevel& level, const Colour& reference) {
    double sum = 0;
    for (std::size_t i = 0; i < level.texels(); ++i)
        sum += static_cast<double>(pbr::mean_channel(level.diffuse[i]) + pbr::mean_channel(level.f0[i]));
    const double mean = sum / static_cast<double>(level.texels());
    for (std::size_t i = 0; i < level.texels(); ++i) {
        const float relative =
            mean > 0 ? static_cast<float>(
                           (pbr::mean_channel(level.diffuse[i]) + pbr::mean_channel(level.f0[i])) / mean)
                     : 1.f;
        level.f0[i] = glm::min(reference * relative, Colour(1));
        level.diffuse[i] = Colour(0);
    }
}

/// The median f0 of texels that have a diffuse colour, which metals haven't: in a library's maps those are
/// dielectrics. In steps of 1/1024.
double dielectric_median(const MapLevel& level, float least_diffuse) {
    std::array<std::size_t, 1025> histogram{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < level.texels(); ++i) {
        if (pbr::mean_channel(level.diffuse[i]) < least_diffuse) continue;
        ++histogram[static_cast<std::size_t>(std::clamp(pbr::mean_channel(level.f0[i]), 0.f, 1.f) * 1024)];
        ++count;
    }
    if (count < level.texels() / 20 + 1) return 0;
    std::size_t seen = 0, step = 0;
    while (seen + histogram[step] < (count + 1) / 2) seen += histogram[step++];
    return (static_cast<double>(step) + .5) / 1024;
}

}  // namespace

const SurfaceWord* surface_word(const std::string& path) {
    std::string word;
    const std::size_t begin =
        path.find_last_of("/\\") == std::string::npos ? 0 : path.find_last_of("/\\") + 1;
    for (std::size_t i = begin; i <= path.size(); ++i) {
        const auto letter =
            i < path.size() ? static_cast<unsigned char>(path[i]) : static_cast<unsigned char>('_');
        if (std::isalpha(letter)) {
            word += static_cast<char>(std::tolower(letter));
            continue;
        }
        for (const SurfaceWord& known : kWords)
            if (known.word == word) return &known;
        word.clear();
    }
    return nullptr;
}

void calibrate(const TextureParams& params, MapLevel& level, Findings& findings) {
    const SurfaceWord* word = surface_word(params.diffuse.empty() ? params.specular : params.diffuse);
    const bool is_legacy = params.model != Model::specular_gloss;
    const bool wanted =
        params.calibrate == Calibrate::library || (params.calibrate == Calibrate::automatic && is_legacy);
    if (params.surface == SurfaceIs::any || (params.surface == SurfaceIs::automatic && !wanted))
        word = nullptr;
    bool is_metal = params.surface == SurfaceIs::metal;
    const bool is_told = is_metal || params.surface == SurfaceIs::dielectric || word != nullptr;
    if (params.surface == SurfaceIs::automatic && word) is_metal = word->is_metal;
    findings.surface = !is_told ? "any" : is_metal ? "metal" : "dielectric";
    if (word) findings.surface_word = word->word;
    if (!wanted) return;

    const double before = mean_of(level.f0);
    if (is_told && is_metal) {
        constexpr Colour kIron(.56f, .57f, .58f);
        make_metal(level, word && word->is_metal ? word->f0 : kIron);
        findings.calibration = "metal";
    } else if (is_told) {
        const double reference =
            word && !word->is_metal ? static_cast<double>(word->f0.x) : params.dielectric_f0;
        if (before > 0) scale_f0(level, reference / before);
        findings.calibration = "dielectric";
    } else {
        const double median = dielectric_median(level, static_cast<float>(params.dielectric_f0));
        if (median > params.dielectric_f0 + 2 * params.f0_tolerance) {
            scale_f0(level, params.dielectric_f0 / median);
            findings.calibration = "statistics";
        }
    }
    findings.specular_scale = before > 0 ? mean_of(level.f0) / before : 1;
}

double green_correlation(const MapLevel& level) {
    double product = 0, xx = 0, yy = 0;
    const auto slope = [&](int x, int y) {
        const Colour& n = level.normal[static_cast<std::size_t>(y) * level.width + x];
        const double z = std::max(static_cast<double>(n.z), .1);
        return std::pair(-static_cast<double>(n.x) / z, -static_cast<double>(n.y) / z);
    };
    for (int y = 0; y + 1 < level.height; ++y)
        for (int x = 0; x + 1 < level.width; ++x) {
            // Rows go down, so d/dy of the upward axis is minus the difference of rows.
            const double a = slope(x, y).first - slope(x, y + 1).first;
            const double b = slope(x + 1, y).second - slope(x, y).second;
            product += a * b;
            xx += a * a;
            yy += b * b;
        }
    return xx > 0 && yy > 0 ? product / std::sqrt(xx * yy) : 0;
}

}  // namespace pbrbake::texture
