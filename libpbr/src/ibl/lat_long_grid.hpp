#pragma once
// Grids of latitudes and longitudes that band-limited fields are read from and scattered points are spread
// over: points at azimuth 2 pi x / columns and colatitude pi (y + 1/2) / rows, no point on a pole.

#include <algorithm>
#include <array>

namespace pbr {

/// Rows for a field of degrees up to `bands`: two a degree while that is cheap, so that interpolation errs by
/// less than 3e-5 where filtered fields hold something, and 1.25 at least.
inline int grid_rows(int bands) {
    const int rows = std::max(8, 5 * (bands + 2) / 4 + std::min(3 * bands / 4, 400));
    return rows + rows % 2;
}

/// Weights of Lagrange's polynomial through the points -2 ... 3, at t in [0, 1].
inline std::array<double, 6> lagrange_weights(double t) {
    const double a = t + 2, b = t + 1, c = t, d = t - 1, e = t - 2, f = t - 3;
    const double ab = a * b, cd = c * d, ef = e * f;
    return {-b * cd * ef / 120, a * cd * ef / 24,  -ab * d * ef / 12,
            ab * c * ef / 12,   -ab * cd * f / 24, ab * cd * e / 120};
}

}  // namespace pbr
