#pragma once
// What averaging normals takes from a surface's look, given back as alpha: a joint chain of normals and
// roughness. T is float or double.
//
// Two ways. Moments of the slopes (x, y) = -n.xy / n.z, as LEAN mapping has them (Olano & Baker 2010), are
// the default: facets of alpha^2 = 2 sigma^2 (Beckmann's slope variance, which GGX's alpha stands in for) on
// ground whose slopes vary by sigma_ground^2 have alpha^2 + 2 sigma_ground^2, whatever length the stored
// normals have. Toksvig's way reads the variance off the shortened mean normal; normals of 8 bits are up to
// .7 % too short or too long on their own, which it takes for alpha of up to .12.

#include <algorithm>
#include <cmath>

#include "pbr/numerics/vector.hpp"

namespace pbr {

/// Sums over the texels that a larger one covers. Add texels, then children's sums.
template <class T>
struct SlopeMoments {
    T x = 0, y = 0;  ///< of the slopes
    T squares = 0;   ///< of their squared lengths
    T alpha2 = 0;    ///< of the squared alphas
    T weight = 0;

    /// Adds one texel. normal.z is taken as at least .01 of the normal's length: steeper ones are bad data
    /// and would outweigh all others. A zero normal is level.
    void add(const Vec3<T>& normal, T alpha, T texel_weight = T(1)) {
        const T length = std::sqrt(normal.x * normal.x + normal.y * normal.y + normal.z * normal.z);
        const T z = std::max(normal.z, T(.01) * length);
        const T sx = z > T(0) ? -normal.x / z : T(0), sy = z > T(0) ? -normal.y / z : T(0);
        x += texel_weight * sx;
        y += texel_weight * sy;
        squares += texel_weight * (sx * sx + sy * sy);
        alpha2 += texel_weight * alpha * alpha;
        weight += texel_weight;
    }

    /// Adds a part's sums, times a weight.
    void add(const SlopeMoments& part, T part_weight = T(1)) {
        x += part_weight * part.x;
        y += part_weight * part.y;
        squares += part_weight * part.squares;
        alpha2 += part_weight * part.alpha2;
        weight += part_weight * part.weight;
    }

    /// The normal of the mean slope, unit length. Needs weight > 0. Error below 8 ulp of 1.
    Vec3<T> normal() const {
        const T sx = x / weight, sy = y / weight, scale = T(1) / std::sqrt(T(1) + sx * sx + sy * sy);
        return {-sx * scale, -sy * scale, scale};
    }

    /// Variance of the slopes, the mean of both axes, >= 0. Needs weight > 0. Absolute error 8 ulp of the
    /// mean squared slope.
    T variance() const {
        const T sx = x / weight, sy = y / weight;
        return std::max(T(0), squares / weight - sx * sx - sy * sy) / T(2);
    }

    /// alpha of the whole: sqrt(mean alpha^2 + 2 variance), at most 1 (Olano & Baker 2010, eq. 3, isotropic,
    /// with alpha^2 = 2 sigma^2). Needs weight > 0.
    T alpha() const { return std::min(T(1), std::sqrt(alpha2 / weight + T(2) * variance())); }
};

/// alpha widened by a mean of unit normals whose length is below 1: Toksvig's factor
/// length / (length + n (1 - length)) on the Blinn-Phong exponent n = 2 / alpha^2 - 2 (Toksvig 2005,
/// "Mipmapping normal maps", eq. 1). length in (0, 1]; lengths above 1 count as 1. alpha in (0, 1]; never
/// below alpha.
template <class T>
T alpha_toksvig(T alpha, T length) {
    const T L = std::min(length, T(1)), a2 = alpha * alpha;
    const T n = T(2) / a2 - T(2);
    const T widened = L > T(0) ? n * L / (L + n * (T(1) - L)) : T(0);
    return std::sqrt(T(2) / (widened + T(2)));
}

}  // namespace pbr
