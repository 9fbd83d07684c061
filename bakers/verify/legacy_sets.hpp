#pragma once
// Texture sets as old renderers had them, painted by formula, so that a study of the texture baker needs no
// files.

#include <array>
#include <filesystem>
#include <glm/vec3.hpp>

#include "bakers/baker.hpp"

namespace pbrbake::verify {

/// What the maps of a set say at a texel: linear colours, and gloss as stored.
struct LegacyTexel {
    glm::dvec3 diffuse, specular;
    double gloss;
};

/// A set: `painted` is what a painter meant at (u, v) of [0, 1)²; maps hold it rounded to 8 bits.
struct LegacySet {
    const char *name, *title, *about;
    bool is_blinn_phong;  ///< else specular is f0 and gloss 1 - perceptual roughness
    LegacyTexel (*painted)(double u, double v);
};

/// Plaster under a Blinn-Phong lobe, and rusting steel in specular and gloss.
const std::array<LegacySet, 2>& legacy_sets();

/// Writes NAME_d.tga, _s and _g of size x size texels, means of what was painted, and returns a texture
/// bake's properties that name them: a Blinn-Phong set's gloss stands for an exponent of 2^(10 gloss).
Json write_legacy_maps(const LegacySet& set, int size, const std::filesystem::path& folder);

}  // namespace pbrbake::verify
