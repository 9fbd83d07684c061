#pragma once
// Chromaticities, and the linear RGB of a set of primaries.

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace pbr {

/// CIE 1931 chromaticity: x = X/(X+Y+Z), y = Y/(X+Y+Z).
struct Chromaticity {
    double x;
    double y;
};

/// The corners and the white of an RGB colour space.
struct Primaries {
    Chromaticity red;
    Chromaticity green;
    Chromaticity blue;
    Chromaticity white;
};

/// Rec. 709, which is also sRGB's; white is D65 (ITU-R BT.709-6, 1.3 and 1.4).
inline constexpr Primaries kRec709{{.64, .33}, {.30, .60}, {.15, .06}, {.3127, .3290}};

/// Chromaticity of tristimulus values; their sum must not be 0.
constexpr Chromaticity chromaticity_of(const glm::dvec3& xyz) {
    const double sum = xyz.x + xyz.y + xyz.z;
    return {xyz.x / sum, xyz.y / sum};
}

/// Tristimulus values of luminance Y = 1; c.y must not be 0.
constexpr glm::dvec3 xyz_of(const Chromaticity& c) { return {c.x / c.y, 1, (1 - c.x - c.y) / c.y}; }

/// CIE 1960 (u, v), in which correlated colour temperature is defined: 4x, 6y over 12y - 2x + 3 (CIE
/// 15:2004, 9.4).
constexpr glm::dvec2 uv_1960(const Chromaticity& c) {
    const double d = 12 * c.y - 2 * c.x + 3;
    return {4 * c.x / d, 6 * c.y / d};
}

/// The inverse of uv_1960: 3u, 2v over 2u - 8v + 4.
constexpr Chromaticity chromaticity_from_uv(const glm::dvec2& uv) {
    const double d = 2 * uv.x - 8 * uv.y + 4;
    return {3 * uv.x / d, 2 * uv.y / d};
}

/// Linear RGB to XYZ, white (1, 1, 1) at Y = 1; its second row are the luminances of the primaries (SMPTE RP
/// 177-1993, 3.3). Primaries must not lie on one line. Error some roundings, 1e-15.
glm::dmat3 xyz_from_rgb(const Primaries& primaries);

/// The inverse of xyz_from_rgb.
glm::dmat3 rgb_from_xyz(const Primaries& primaries);

/// Linear RGB of luminance 1 in Rec. 709. Colours outside its triangle have a negative component. c.y must
/// not be 0.
glm::dvec3 rgb_of(const Chromaticity& c);

/// Luminance of linear Rec. 709: .2126 R + .7152 G + .0722 B, to the digits that follow from the primaries.
double luminance_of_rgb(const glm::dvec3& rgb);

/// Brings a colour of luminance 1 into the gamut: mixes it with white of luminance 1 until no component is
/// negative. So luminance and dominant wavelength stay, and purity goes. A colour inside is returned as it
/// is.
glm::dvec3 rgb_into_gamut(const glm::dvec3& rgb);

}  // namespace pbr
