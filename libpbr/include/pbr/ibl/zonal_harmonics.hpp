#pragma once
// Zonal kernels in spherical harmonics, and windows.
//
// By the theorem of Funk and Hecke, convolving with a kernel k(n.l) multiplies band l by k_l = 2 pi times the
// integral of k(mu) P_l(mu) over [-1, 1] (Ramamoorthi & Hanrahan 2001, "On the relationship between radiance
// and irradiance", eq. 22, where sqrt(4 pi/(2l+1)) is split off the kernel's own coefficients).

#include <array>
#include <cmath>
#include <glm/vec3.hpp>
#include <numbers>
#include <span>
#include <vector>

#include "pbr/numerics/vector.hpp"

namespace pbr {

class GgxZonalKernel;

/// k_l of the clamped cosine max(0, mu): pi, 2 pi/3, pi/4, 0, -pi/24 … Radiance becomes irradiance; over pi,
/// it becomes the radiance of a white Lambert surface. Closed form (Ramamoorthi & Hanrahan 2001, eq. 8);
/// absolute error below 1e-13. l >= 0.
double zonal_cosine(int l);

/// k_0 … k_{bands-1} of the GGX lobe: LD_lm = k_l E_lm. k_0 = 1; k_l falls to 0 with growing alpha l.
/// Gauss-Legendre over panels of the polar angle; time grows like bands^2. Absolute error below 1e-12 for
/// alpha in [1e-4, 1], bands <= 256.
std::vector<double> zonal_ggx(const GgxZonalKernel& kernel, int bands);

/// Hann's window, (1 + cos(pi l / width)) / 2 up to l = width, then 0; width > 0 in bands, not necessarily
/// whole.
template <class T>
T window_hann(int l, T width) {
    const T x = static_cast<T>(l) / width;
    return x < T(1) ? (T(1) + std::cos(std::numbers::pi_v<T> * x)) / T(2) : T(0);
}

/// Lanczos' window, sin(pi l / width) / (pi l / width) up to l = width, then 0; 1 at l = 0. width > 0.
template <class T>
T window_lanczos(int l, T width) {
    const T x = std::numbers::pi_v<T> * static_cast<T>(l) / width;
    if (l == 0) return T(1);
    return x < std::numbers::pi_v<T> ? std::sin(x) / x : T(0);
}

/// The Gauss-Weierstrass window exp(-t l (l+1)), t >= 0: heat spread on the sphere for a time t. Its kernel
/// is positive, so it never lowers a function's minimum, which is why dering_time can bisect on it; the two
/// windows above have kernels with negative lobes.
template <class T>
T window_gauss(int l, T t) {
    return std::exp(-t * static_cast<T>(l * (l + 1)));
}

/// The smallest t (within 1e-4 of itself) for which window_gauss lifts a function of `bands` <= 8 bands to at
/// least 0 everywhere (tested to 1e-6 of its mean): 0 if it is not negative. Deringing in the sense of Sloan
/// (2008, "Stupid spherical harmonics tricks", windowing), with this window in place of his. A mean of 0 or
/// below cannot be lifted: the answer is +Inf, which leaves the mean alone. For RGB take the largest of the
/// three, lest colours shift.
double dering_time(int bands, std::span<const double> coefficients);

/// Irradiance as shaders evaluate it: nine numbers c so that
///     E(n) = c0 + c1 y + c2 z + c3 x + c4 xy + c5 yz + c6 (3z^2 - 1) + c7 xz + c8 (x^2 - y^2),
/// from nine coefficients of *radiance* (T or GLM vectors). E has no 1/pi: multiply by albedo/pi. The numbers
/// fold zonal_cosine into the basis; Ramamoorthi & Hanrahan (2001, eq. 12) have the same as c1 … c5 = .429043
/// .511664 .743125 .886227 .247708, Filament's iblSH the same over pi.
template <class Value>
std::array<Value, 9> irradiance_polynomial(std::span<const Value, 9> radiance) {
    constexpr double kPi = std::numbers::pi;
    const double band0 = kPi * std::sqrt(1 / (4 * kPi)), band1 = 2 * kPi / 3 * std::sqrt(3 / (4 * kPi));
    const double band2 = kPi / 4 * std::sqrt(15 / (4 * kPi)), band20 = kPi / 4 * std::sqrt(5 / (16 * kPi));
    const double factors[9] = {band0, band1, band1, band1, band2, band2, band20, band2, band2 / 2};
    std::array<Value, 9> polynomial;
    for (int i = 0; i < 9; ++i) polynomial[i] = radiance[i] * Value(factors[i]);
    return polynomial;
}

/// The polynomial of irradiance_polynomial at a unit normal.
template <class Value, class T>
Value evaluate_irradiance(const std::array<Value, 9>& c, const Vec3<T>& n) {
    return c[0] + c[1] * n.y + c[2] * n.z + c[3] * n.x + c[4] * (n.x * n.y) + c[5] * (n.y * n.z) +
           c[6] * (T(3) * n.z * n.z - T(1)) + c[7] * (n.x * n.z) + c[8] * ((n.x - n.y) * (n.x + n.y));
}

}  // namespace pbr
