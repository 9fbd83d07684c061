#pragma once
// EON, the energy-preserving Oren-Nayar diffuse BRDF (Portsmouth, Kutz & Hill 2025, "EON: a practical
// energy-preserving rough diffuse BRDF", JCGT 14(1)). T is float or double; Colour is T or a GLM vector of
// it.
//
// Fujii's single-scattering Oren-Nayar (FON) plus a multiple-scattering lobe that makes the albedo of a white
// surface 1 from every direction: with the exact albedo it is reciprocal and conserves energy, whatever the
// colour. diffuse_roughness in [0, 1] is the model's own parameter (OpenPBR's base_diffuse_roughness), not
// the specular lobe's; at 0 it is Lambert. The colour rho goes in, since multiple scattering saturates it;
// 1/pi is inside.

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pbr {

/// What a white FON surface loses, relative to its roughness: directional albedo E(NoV) = 1 - r A (C1 -
/// g(NoV)) with r = diffuse_roughness, A = 1 / (1 + C1 r), C1 = 1/2 - 2/(3 pi) (listing 1). Writing the loss
/// instead of E keeps r -> 0 exact, where the model itself is 0/0.
template <class T>
inline constexpr T kEonC1 = T(0.5) - T(2) / (T(3) * std::numbers::pi_v<T>);

/// The mean of g over a Lambertian hemisphere: 2/3 - 28/(15 pi) (listing 1).
template <class T>
inline constexpr T kEonC2 = T(2) / T(3) - T(28) / (T(15) * std::numbers::pi_v<T>);

/// g(cosine) of the exact albedo, G / pi with G = s (acos c - s c) + 2/3 ((s/c)(1 - s^3) - s) (listing 1; the
/// quotient here written without its 0/0 at c = 0). cosine in [0, 1]: C1 at 0, 0 at 1. Absolute error below 4
/// ulp of 1.
template <class T>
T eon_g_exact(T cosine) {
    const T c = std::clamp(cosine, T(0), T(1));
    const T s = std::sqrt((T(1) - c) * (T(1) + c));
    const T quotient = s * c * (T(1) + s + s * s) / (T(1) + s);  // (s/c)(1 - s^3), as 1 - s = c^2 / (1 + s)
    const T G = s * (std::acos(c) - s * c) + T(2) / T(3) * (quotient - s);
    return G * std::numbers::inv_pi_v<T>;
}

/// g(cosine) by the published fit of degree 4 in 1 - cosine (listing 1). cosine in [0, 1]. Absolute error
/// 6.1e-4 against eon_g_exact; 0 at 1, .28825 at 0.
template <class T>
constexpr T eon_g_approximate(T cosine) {
    const T m = T(1) - cosine;
    return m * (T(0.0571085289) + m * (T(0.491881867) + m * (T(-0.332181442) + m * T(0.0714429953))));
}

/// Directional albedo of white FON, the single-scattering part: E = (1 + r g) / (1 + C1 r) (listing 1). g
/// from eon_g_exact or eon_g_approximate, diffuse_roughness in [0, 1]. 1 at roughness 0. Relative error below
/// 4 ulp beside g's.
template <class T>
constexpr T albedo_fon(T g, T diffuse_roughness) {
    return (T(1) + diffuse_roughness * g) / (T(1) + kEonC1<T> * diffuse_roughness);
}

/// EON with the albedo's g given for both directions, which is all that separates exact from approximate
/// (listing 1). Domain and edges as f_eon.
template <class Colour, class T>
constexpr Colour f_eon_from_g(const Colour& rho, T diffuse_roughness, T NoL, T NoV, T LoV, T g_l, T g_v) {
    const T A = T(1) / (T(1) + kEonC1<T> * diffuse_roughness);
    const T s = LoV - NoL * NoV;
    const T larger = std::max(NoL, NoV);
    const T s_over_t = s > T(0) && larger > T(0) ? s / larger : s;
    const T single = A * (T(1) + diffuse_roughness * s_over_t);
    const T average = A * (T(1) + kEonC2<T> * diffuse_roughness);
    // (1 - E_l)(1 - E_v)/(1 - average), the roughness cancelled.
    const T multiple =
        A * diffuse_roughness * (kEonC1<T> - g_l) * (kEonC1<T> - g_v) / (kEonC1<T> - kEonC2<T>);
    const Colour gathered = rho * rho * average / (Colour(1) - rho * (T(1) - average));
    return (rho * single + gathered * multiple) * std::numbers::inv_pi_v<T>;
}

/// EON, 1/sr, with the exact albedo. rho in [0, 1] a channel, diffuse_roughness, NoL, NoV in [0, 1], LoV in
/// [-1, 1]. Lambert at roughness 0. Reciprocal; albedo 1 at rho 1, below 1 else; no bound on its value in
/// retroreflection at grazing angles, r / (pi max(NoL, NoV)), though times NoL it is at most .37. At NoL =
/// NoV = 0 the quotient's denominator is left out. Absolute error below 32 ulp of the larger of 1 and that
/// value.
template <class Colour, class T>
Colour f_eon(const Colour& rho, T diffuse_roughness, T NoL, T NoV, T LoV) {
    return f_eon_from_g(rho, diffuse_roughness, NoL, NoV, LoV, eon_g_exact(NoL), eon_g_exact(NoV));
}

/// EON, 1/sr, with the fitted albedo: no acos. Domain as f_eon. Reciprocal; the white albedo is
/// within 5.43e-4 of 1 and may exceed it, by 1.5e-4; absolute error 4e-4 against f_eon.
template <class Colour, class T>
constexpr Colour f_eon_approximate(const Colour& rho, T diffuse_roughness, T NoL, T NoV, T LoV) {
    return f_eon_from_g(rho, diffuse_roughness, NoL, NoV, LoV, eon_g_approximate(NoL),
                        eon_g_approximate(NoV));
}

}  // namespace pbr
