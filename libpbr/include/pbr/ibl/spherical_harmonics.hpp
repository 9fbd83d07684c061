#pragma once
// Real orthonormal spherical harmonics. T is float or double.
//
// Convention: no Condon-Shortley phase, so Y_1 = sqrt(3/4pi) (y, z, x) for m = -1, 0, 1, all with a plus
// sign, as in Ramamoorthi & Hanrahan (2001, "An efficient representation for irradiance environment maps",
// eq. 3) and engines that follow them. DirectX's D3DXSH and Sloan (2013, "Efficient spherical harmonic
// evaluation") have the phase: multiply the coefficient (l, m) by (-1)^m to go from one to the other.
// Orthonormal: the integral of Y_i Y_j over the sphere is 1 for i = j, else 0.
//
//     Y_l0  = K_l0 P_l(z)        Y_lm = sqrt2 K_lm P_l^m(z) cos(m phi)       Y_l,-m = the same with sin
//
// `bands` counts bands, l = 0 … bands - 1; coefficients lie in the order of sh_index, bands^2 of them.

#include <array>
#include <cmath>
#include <glm/vec3.hpp>
#include <numbers>
#include <span>
#include <vector>

#include "pbr/numerics/vector.hpp"

namespace pbr {

/// Place of (l, m), -l <= m <= l, among the coefficients: l^2 + l + m.
constexpr int sh_index(int l, int m) { return l * l + l + m; }

/// Number of coefficients of `bands` bands.
constexpr int sh_count(int bands) { return bands * bands; }

/// Y of the first three bands in closed form, `direction` a unit vector. Within 4 ulp of the largest
/// coefficient.
template <class T>
std::array<T, 9> sh_evaluate3(const Vec3<T>& direction) {
    const T x = direction.x, y = direction.y, z = direction.z;
    constexpr double kRoot5 = 2 * std::numbers::phi - 1;
    constexpr T k0 = static_cast<T>(std::numbers::inv_sqrtpi / 2);                        // sqrt(1/4pi)
    constexpr T k1 = static_cast<T>(std::numbers::inv_sqrtpi / 2 * std::numbers::sqrt3);  // sqrt(3/4pi)
    constexpr T k2 =
        static_cast<T>(std::numbers::inv_sqrtpi / 2 * std::numbers::sqrt3 * kRoot5);  // sqrt(15/4pi)
    constexpr T k20 = static_cast<T>(std::numbers::inv_sqrtpi / 4 * kRoot5);          // sqrt(5/16pi)
    return {k0,
            k1 * y,
            k1 * z,
            k1 * x,
            k2 * x * y,
            k2 * y * z,
            k20 * (T(3) * z * z - T(1)),
            k2 * x * z,
            k2 / T(2) * (x - y) * (x + y)};
}

/// Y of any number of bands >= 1 into `out` (bands^2 values), `direction` a unit vector.
///
/// sin^m(theta) cos(m phi) and sin(m phi) come from powers of x + iy, the rest of P_l^m from the normalised
/// three-term recurrence in l (Press et al., Numerical Recipes, 3rd ed., 6.7, eq. 6.7.9), which neither
/// overflows nor cancels. Absolute error below 5e-14 for 32 bands in double, 2e-6 for 8 bands in float.
template <class T>
void sh_evaluate(int bands, const Vec3<T>& direction, std::span<T> out) {
    const T z = direction.z;
    T q_mm = static_cast<T>(std::sqrt(1 / (4 * std::numbers::pi)));  // K_mm P_m^m / sin^m, without sqrt2
    T re = T(1), im = T(0);                                          // (x + iy)^m
    for (int m = 0; m < bands; ++m) {
        if (m > 0) {
            const T previous = re;
            re = previous * direction.x - im * direction.y;
            im = previous * direction.y + im * direction.x;
            q_mm *= std::sqrt(T(2 * m + 1) / T(2 * m));
        }
        T q = q_mm, q_below = T(0), step_below = T(1);  // step(l) = sqrt((4 l^2 - 1) / (l^2 - m^2))
        for (int l = m; l < bands; ++l) {
            if (l > m) {
                const T step = std::sqrt(T((2 * l - 1) * (2 * l + 1)) / T((l - m) * (l + m)));
                const T next = step * (z * q - q_below / step_below);
                q_below = q;
                q = next;
                step_below = step;
            }
            if (m == 0) {
                out[sh_index(l, 0)] = q;
            } else {
                out[sh_index(l, m)] = std::numbers::sqrt2_v<T> * q * re;
                out[sh_index(l, -m)] = std::numbers::sqrt2_v<T> * q * im;
            }
        }
    }
}

/// The value of a function with coefficients `coefficients` (bands^2 of them; T or a GLM vector of T) in a
/// direction.
template <class T, class Value>
Value sh_reconstruct(int bands, std::span<const Value> coefficients, const Vec3<T>& direction) {
    std::vector<T> basis(sh_count(bands));
    sh_evaluate<T>(bands, direction, basis);
    Value sum(T(0));
    for (int i = 0; i < sh_count(bands); ++i) sum += coefficients[i] * basis[i];
    return sum;
}

/// Multiplies band l by factors[l], for all factors.size() bands: convolution with a zonal kernel whose
/// coefficients are `factors` (ibl/zonal_harmonics.hpp), or a window.
template <class T, class Value>
void sh_scale_bands(std::span<const T> factors, std::span<Value> coefficients) {
    for (int l = 0; l < static_cast<int>(factors.size()); ++l)
        for (int m = -l; m <= l; ++m) coefficients[sh_index(l, m)] *= factors[l];
}

class PatchBlocks;

/// Coefficients of a picture's RGB radiance: the integral of radiance times Y over the sphere, texel by texel
/// with exact solid angles (a picture is constant over each texel), Y by Gauss-Legendre points within the
/// texel. World directions. bands >= 1. Relative to the mean radiance, absolute error below 3e-7, of which
/// most is the float rounding of points.
std::vector<glm::dvec3> sh_project(const PatchBlocks& source, int bands);

}  // namespace pbr
