#pragma once
// What the near field's kernel of all targets shares with its caller.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "pbr/ibl/near_field.hpp"

namespace pbr {

/// Columns that are treated together, whatever the vector width.
inline constexpr int kNearLanes = 8;

/// The near kernel of chord^2: normalisation mu / (alpha2 + slope chord^2)^2 less a polynomial in chord^2 / 2
/// - limit, 0 from chord^2 = 2 limit on.
struct NearKernel {
    float alpha2, slope, normalisation, limit;
    std::array<float, 4> polynomial;
};

/// A picture and where a direction's sum goes over it.
struct NearWindow {
    std::span<const float* const> rows;
    int width;
    std::array<float, 3> constant;
    int top, bottom;      ///< rows [top, bottom)
    int left, blocks;     ///< columns from left in [0, width) on, kNearLanes a block
    double sine, cosine;  ///< of the direction's colatitude
    double x, z;          ///< and of its azimuth
    double beyond2;       ///< chord^2 beyond which texels don't count
};

}  // namespace pbr
