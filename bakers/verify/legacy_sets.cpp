#include "bakers/verify/legacy_sets.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>

#include "bakers/run/atomic_file.hpp"
#include "bakers/verify/picture.hpp"
#include "pbr/numerics/sequence.hpp"

namespace pbrbake::verify {
namespace {

constexpr double kExponentBits = 10;  // gloss 1 is an exponent of 2^10
constexpr int kFinest = 512;          // texels along a side that maps are means over

/// Smooth noise in [0, 1] that repeats at 1, `cells` of it along a side.
double noise(double u, double v, int cells, std::uint64_t seed) {
    const double x = u * cells, y = v * cells;
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    const auto value = [&](int di, int dj) {
        return pbr::random_unit(seed, static_cast<std::uint64_t>((i + di) % cells),
                                static_cast<std::uint64_t>((j + dj) % cells));
    };
    const double tx = glm::smoothstep(0., 1., x - i), ty = glm::smoothstep(0., 1., y - j);
    return glm::mix(glm::mix(value(0, 0), value(1, 0), tx), glm::mix(value(0, 1), value(1, 1), tx), ty);
}

/// Plaster with bands of glossy paint.
LegacyTexel painted_plaster(double u, double v) {
    const double grain = noise(u, v, 32, 1), stain = noise(u, v, 6, 2);
    if (std::fmod(v * 4, 1.0) < 0.35)
        return {glm::dvec3(0.08, 0.2, 0.34) * (0.9 + 0.2 * stain), glm::dvec3(0.05), 0.72 - 0.1 * stain};
    return {glm::dvec3(0.62, 0.52, 0.4) * (0.6 + 0.25 * grain + 0.25 * stain),
            glm::dvec3(0.02 + 0.03 * grain), 0.3 + 0.1 * grain};
}

/// Steel, and rust where it has eaten in.
LegacyTexel painted_steel(double u, double v) {
    const double patch = noise(u, v, 5, 3), grain = noise(u, v, 48, 4), scratch = noise(u, v, 64, 5);
    const double rust = glm::smoothstep(0.52, 0.6, patch + 0.1 * (grain - 0.5));
    return {glm::dvec3(0.3, 0.1, 0.04) * (0.7 + 0.6 * grain) * rust,
            glm::mix(glm::dvec3(0.56, 0.57, 0.58), glm::dvec3(0.04), rust),
            glm::mix(0.72 - 0.15 * scratch, 0.25 + 0.1 * grain, rust)};
}

/// An uncompressed TGA of 24 bits, row 0 at the top.
std::string tga(int size, const std::function<std::array<std::uint8_t, 3>(int x, int y)>& rgb) {
    const auto low = static_cast<char>(size & 255), high = static_cast<char>(size >> 8);
    std::string file{0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, low, high, low, high, 24, 0x20};
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const auto [r, g, b] = rgb(x, y);
            for (const std::uint8_t value : {b, g, r}) file += static_cast<char>(value);
        }
    return file;
}

LegacyTexel mean_texel(const LegacySet& set, int size, int x, int y) {
    const int parts = std::clamp(kFinest / size, 1, 4);
    LegacyTexel mean{};
    for (int k = 0; k < parts * parts; ++k) {
        const LegacyTexel part =
            set.painted((x + (k % parts + 0.5) / parts) / size, (y + (k / parts + 0.5) / parts) / size);
        mean.diffuse += part.diffuse / static_cast<double>(parts * parts);
        mean.specular += part.specular / static_cast<double>(parts * parts);
        mean.gloss += part.gloss / (parts * parts);
    }
    return mean;
}

}  // namespace

const std::array<LegacySet, 2>& legacy_sets() {
    static const std::array<LegacySet, 2> sets{
        {{"plaster", "Plaster, Blinn-Phong",
          "Plaster with bands of paint; exponents 8 to 150 by gloss map, ks 2 to 5 %, normalised to energy.",
          true, painted_plaster},
         {"steel", "Rusting steel, specular and gloss",
          "A metal that the maps don't name: the metal mask has to be solved for.", false, painted_steel}}};
    return sets;
}

Json write_legacy_maps(const LegacySet& set, int size, const std::filesystem::path& folder) {
    std::vector<LegacyTexel> texels;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) texels.push_back(mean_texel(set, size, x, y));
    const auto write = [&](const char* suffix, const auto& bytes_of) {
        const std::filesystem::path file =
            folder / (std::string(set.name) + "_" + std::to_string(size) + suffix + ".tga");
        run::write_atomically(file, tga(size, [&](int x, int y) {
                                  return bytes_of(texels[static_cast<std::size_t>(y) * size + x]);
                              }));
        return std::filesystem::absolute(file).string();
    };
    const auto srgb = [](const glm::dvec3& c) {
        return std::array{srgb_byte(c.x), srgb_byte(c.y), srgb_byte(c.z)};
    };
    Json bake{{"kind", "texture"},
              {"diffuse", write("_d", [&](const LegacyTexel& texel) { return srgb(texel.diffuse); })},
              {"specular", write("_s", [&](const LegacyTexel& texel) { return srgb(texel.specular); })},
              {"gloss", write("_g",
                              [](const LegacyTexel& texel) {
                                  const auto code = static_cast<std::uint8_t>(std::lround(255 * texel.gloss));
                                  return std::array{code, code, code};
                              })},
              {"model", set.is_blinn_phong ? "blinn_phong" : "specular_gloss"}};
    if (set.is_blinn_phong) {
        bake["gloss_is"] = "power_log2";
        bake["power_scale"] = kExponentBits;
    }
    return bake;
}

}  // namespace pbrbake::verify
