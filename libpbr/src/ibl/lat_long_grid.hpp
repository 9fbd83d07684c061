#pragma once
// Grids of latitudes and longitudes that band-limited fields are read from and scattered points are spread
// over: points at azimuth 2 pi x / columns and colatitude pi (y + 1/2) / rows, no point on a pole.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/fourier.hpp"

namespace pbr {

/// Interpolation between points a step h apart errs by h^6 |Pi| / 720 times the sixth derivative, Pi the
/// product of the six distances: on harmonics of degree l by this times (l h)^6, root mean square over places
/// and over the directions in which waves run, both axes together.
inline constexpr double kInterpolationError = 0.00235;

/// The wider step whose interpolation error is `allowed` where (l h)^6 stands for h^6 times `sixth_power`.
inline double grid_step(double allowed, double sixth_power) {
    return exp_exact(log_exact(allowed / (kInterpolationError * sixth_power)) / 6);
}

/// Rows for a step, an even number, and enough to hold degrees up to `bands`.
inline int grid_rows(double step, int bands) {
    const int rows = std::max(bands + 2, static_cast<int>(std::ceil(std::numbers::pi / step)));
    return std::max(8, rows + rows % 2);
}

/// Columns that lie as close as so many rows, an even number that is fast to transform.
inline int grid_columns(int rows) { return 2 * fast_fourier_size(rows); }

/// Weights of Lagrange's polynomial through the points -2 ... 3, at t in [0, 1].
inline std::array<double, 6> lagrange_weights(double t) {
    const double a = t + 2, b = t + 1, c = t, d = t - 1, e = t - 2, f = t - 3;
    const double ab = a * b, cd = c * d, ef = e * f;
    return {-b * cd * ef / 120, a * cd * ef / 24,  -ab * d * ef / 12,
            ab * c * ef / 12,   -ab * cd * f / 24, ab * cd * e / 120};
}

}  // namespace pbr
