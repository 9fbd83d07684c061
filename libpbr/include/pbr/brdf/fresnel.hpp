#pragma once
// Fresnel reflectance: Schlick's approximation, the exact equations it stands for, and what artists author.
//
// T is float or double, Colour is T or a GLM vector of it. Reflectances are in [0, 1]; an index of refraction
// (ior) is that of the far side over that of the near one, so 1.5 enters glass from air and 1 / 1.5 leaves
// it.

#include <algorithm>
#include <cmath>

#include "pbr/numerics/vector.hpp"

namespace pbr {

/// (1 - c)^5, Schlick's weight. c in [0, 1]; values a rounding outside are clamped, so the result is in [0,
/// 1]: exactly 1 at 0, exactly 0 at 1. Relative error below 5 ulp.
template <class T>
constexpr T schlick_weight(T cosine) {
    const T m = cosine < T(0) ? T(1) : cosine > T(1) ? T(0) : T(1) - cosine;
    const T m2 = m * m;
    return m2 * m2 * m;
}

/// Schlick's approximation with f90 at grazing incidence: f0 + (f90 - f0)(1 - LoH)^5 (Schlick 1994, "An
/// inexpensive BRDF model for physically-based rendering", eq. 24; f90 as in Lagarde & de Rousiers 2014,
/// listing 2). Reflectances in [0, 1]; exact at LoH = 1 (f0), within a rounding at LoH = 0 (f90). Largest
/// distance from F_dielectric over all angles, with f0 = f0_from_ior(ior) and f90 = 1: .060 at ior 1.33, .036
/// at 1.5, .035 at 1.8, .045 at 2, .083 at 2.5, .125 at 3; towards ior 1 it grows to 1, since f90 stays 1
/// where there is no boundary left (f90_from_f0 mends that). Leaving glass it knows no total reflection and
/// is off by up to .96. From F_conductor: gold .022, aluminium .117, chromium .198, each too bright before
/// grazing incidence.
template <class Colour, class T>
constexpr Colour F_schlick(const Colour& f0, const Colour& f90, T LoH) {
    return f0 + (f90 - f0) * schlick_weight(LoH);
}

/// Unpolarised reflectance of a smooth boundary between dielectrics (Fresnel 1823; Born & Wolf, Principles of
/// Optics, 1.5.2, eq. 21). cosine in [0, 1] of the angle of incidence, ior > 0. 1 at grazing incidence (even
/// at ior = 1, where it is 0 otherwise) and beyond the critical angle of ior < 1. Absolute error below 8 ulp
/// of 1 for ior >= 1; leaving the denser side, 8 + 4 / g ulp with g the root that vanishes at the critical
/// angle.
template <class T>
T F_dielectric(T cosine, T ior) {
    // ior times the cosine of refraction; factored, since ior^2 - 1 cancels near 1.
    const T g2 = (ior - T(1)) * (ior + T(1)) + cosine * cosine;
    if (g2 <= T(0) || cosine <= T(0)) return T(1);
    const T g = std::sqrt(g2), near = ior * ior * cosine;
    const T r_s = (cosine - g) / (cosine + g), r_p = (near - g) / (near + g);
    return (r_s * r_s + r_p * r_p) / T(2);
}

/// Unpolarised reflectance of a metal of complex index ior + i k, k >= 0 (Born & Wolf, 14.2, eq. 21 and 23; k
/// = 0 is F_dielectric). cosine in [0, 1]; 1 at 0. Absolute error below 16 ulp of 1.
template <class T>
T F_conductor(T cosine, T ior, T k) {
    // (a + i b)^2 = (ior + i k)^2 - sin^2; the smaller of a and b from their product ior k, which doesn't
    // cancel.
    const T c2 = cosine * cosine, s2 = (T(1) - cosine) * (T(1) + cosine);
    const T real = (ior - k) * (ior + k) - s2;
    const T modulus = std::hypot(real, T(2) * ior * k);
    const T larger = std::sqrt((modulus + std::abs(real)) / T(2));
    const T a = real >= T(0) ? larger : larger > T(0) ? ior * k / larger : T(0);
    const T sum_s = modulus + c2, twice_ac = T(2) * a * cosine;
    if (sum_s + twice_ac <= T(0)) return T(1);
    const T R_s = (sum_s - twice_ac) / (sum_s + twice_ac);
    const T sum_p = c2 * modulus + s2 * s2, cross = twice_ac * s2;
    const T ratio = sum_p + cross > T(0) ? (sum_p - cross) / (sum_p + cross) : T(1);
    return R_s * (T(1) + ratio) / T(2);
}

/// Reflectance at normal incidence of a dielectric, ((ior - 1)/(ior + 1))^2. ior > 0: 0 at 1, the same for
/// ior and 1 / ior, towards 1 at both ends. Relative error below 4 ulp.
template <class T>
constexpr T f0_from_ior(T ior) {
    const T r = (ior - T(1)) / (ior + T(1));
    return r * r;
}

/// The index of refraction >= 1 that f0_from_ior turns into f0. f0 in [0, 1): 1 at 0, +Inf at 1. Relative
/// error below 4 ulp / (1 - sqrt f0).
template <class T>
T ior_from_f0(T f0) {
    const T r = std::sqrt(f0);
    return (T(1) + r) / (T(1) - r);
}

/// Frostbite's f0 = .16 reflectance^2 (Lagarde & de Rousiers 2014, 3.2.2): the authored [0, 1] spans
/// dielectrics up to gems, with .5 the common .04. Relative error below 2 ulp.
template <class T>
constexpr T f0_from_reflectance(T reflectance) {
    return T(0.16) * reflectance * reflectance;
}

/// Inverse of f0_from_reflectance. f0 in [0, .16] gives [0, 1]; above .16 there's no dielectric and it
/// exceeds 1. Relative error below 2 ulp.
template <class T>
T reflectance_from_f0(T f0) {
    return std::sqrt(f0 / T(0.16));
}

/// Frostbite's specular micro-occlusion, f90 = saturate(50 dot(f0, .33)) (Lagarde & de Rousiers 2014, listing
/// 2): no dielectric reflects less than 2 %, so what is authored below that occludes. 0 at f0 = 0; 1 from a
/// grey f0 of .0202 up (three times .33 is not 1: the published constant is kept). Relative error below 4
/// ulp.
template <class T>
T f90_from_f0(const Vec3<T>& f0) {
    return std::clamp(T(50) * T(0.33) * (f0.x + f0.y + f0.z), T(0), T(1));
}

}  // namespace pbr
