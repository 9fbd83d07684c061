#pragma once
// Reading a grid of latitudes and longitudes.

#include <glm/vec2.hpp>
#include <span>

namespace pbr {

/// RGBA floats at azimuth 2 pi x / columns and colatitude pi (y + 1/2) / rows, with a border of three texels
/// on all sides that continues the field.
struct LatLongTexels {
    const float* rgba;  ///< of texel (0, 0)
    long stride;        ///< texels from row to row
    int rows, columns;
};

/// RGB at (u, v) in [0, 1)^2, v up to 1, by 6 x 6 Lagrange interpolation; `rgb_out` holds 3 floats a point.
void interpolate(const LatLongTexels& grid, std::span<const glm::dvec2> points, std::span<float> rgb_out);

}  // namespace pbr
