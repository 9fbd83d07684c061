#include "pbr/light/colour.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace pbr {

glm::dmat3 xyz_from_rgb(const Primaries& primaries) {
    const glm::dmat3 corners(xyz_of(primaries.red), xyz_of(primaries.green), xyz_of(primaries.blue));
    const glm::dvec3 luminances = glm::inverse(corners) * xyz_of(primaries.white);
    return glm::dmat3(corners[0] * luminances.r, corners[1] * luminances.g, corners[2] * luminances.b);
}

glm::dmat3 rgb_from_xyz(const Primaries& primaries) { return glm::inverse(xyz_from_rgb(primaries)); }

glm::dvec3 rgb_of(const Chromaticity& c) { return rgb_from_xyz(kRec709) * xyz_of(c); }

double luminance_of_rgb(const glm::dvec3& rgb) { return (xyz_from_rgb(kRec709) * rgb).y; }

glm::dvec3 rgb_into_gamut(const glm::dvec3& rgb) {
    const double lowest = std::min({rgb.r, rgb.g, rgb.b});
    if (lowest >= 0) return rgb;
    const glm::dvec3 mixed = glm::dvec3(1) + (rgb - glm::dvec3(1)) / (1 - lowest);
    return glm::max(mixed, glm::dvec3(0));  // the lowest is 0 but for a rounding
}

}  // namespace pbr
