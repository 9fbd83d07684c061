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

    /// A whole lobe: no polynomial, up to the horizon.
    explicit NearKernel(const GgxZonalKernel& kernel)
        : alpha2(static_cast<float>(kernel.alpha() * kernel.alpha())),
          slope(static_cast<float>((1 - kernel.alpha() * kernel.alpha()) / 4)),
          normalisation(static_cast<float>(kernel.normalisation())),
          limit(1),
          polynomial{} {}

    /// The near part of a split one.
    explicit NearKernel(const SplitKernel& split) : NearKernel(split.kernel()) {
        limit = static_cast<float>(split.limit());
        for (std::size_t n = 0; n < polynomial.size(); ++n)
            polynomial[n] = static_cast<float>(split.polynomial()[n]);
    }
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
