#pragma once
// Charlie, the lobe of cloth: fibres stand up, so that the distribution is empty at the normal and full at
// grazing angles (Estevez & Kulla 2017, "Production friendly microfacet sheen BRDF"). T is float or double.
//
// Directions point away from the surface, normal +z. alpha in (0, 1], the square of perceptual roughness as
// KHR_materials_sheen has it. The sheen BRDF is D V times the sheen colour (no Fresnel); 1/pi lives in D.
//
// Two visibilities go with D. V_charlie is Smith's, with the published fit of Lambda: no more comes back than
// arrived for alpha >= .07; below, where the fit doesn't reach, up to 2.1 times at alpha .01. V_neubelt is a
// softener without derivation, cheaper, and what Filament and glTF viewers take: at grazing views it returns
// .64 (alpha 1), .94 (.25), 1.35 (.1), 4.0 (.01) of what arrived.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pbr/brdf/ggx_sampling.hpp"
#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/sequence.hpp"
#include "pbr/numerics/vector.hpp"

namespace pbr {

/// ln(sin) of a half vector's cosine, without cancellation at either end. NoH in [0, 1]: 0 at 0, -Inf at 1.
/// Absolute error below 2 ulp of 1 near the normal, relative error below 4 ulp where NoH^2 < 1/2.
template <class T>
T log_sine_from_cosine(T NoH) {
    const T cos2 = NoH * NoH;
    if (cos2 < T(0.5)) return std::log1p(-cos2) / T(2);
    return std::log(std::max((T(1) - NoH) * (T(1) + NoH), T(0))) / T(2);
}

/// (2 + 1/alpha) sin^(1/alpha) / (2 pi), 1/sr (Estevez & Kulla 2017, 2). NoH in [0, 1], alpha in (0, 1]. 0 at
/// the normal; largest value (2 + 1/alpha) / (2 pi), at NoH = 0. The power is taken in logarithms, from
/// cos^2: as alpha -> 0 the lobe becomes a band of width sqrt(alpha) around grazing and this stays exact in
/// it. alpha = 0 is a delta on the horizon: not a number here. Relative error below 8 + (4 |ln sin| + 2) /
/// alpha ulp.
template <class T>
T D_charlie(T NoH, T alpha) {
    const T exponent = T(1) / alpha;
    return (T(2) + exponent) * std::exp(exponent * log_sine_from_cosine(NoH)) /
           (T(2) * std::numbers::pi_v<T>);
}

/// 1 / (4 (NoL + NoV - NoL NoV)) (Neubelt & Pettineo 2013, "Crafting a next-gen material pipeline for The
/// Order: 1886"; the denominator is Ashikhmin's). NoL, NoV in [0, 1]; both 0: +Inf; one 0: 1 / (4 times the
/// other). Relative error below 4 ulp.
template <class T>
T V_neubelt(T NoL, T NoV) {
    return T(1) / (T(4) * (NoL + NoV - NoL * NoV));
}

/// Exponent of Charlie's Lambda, a / (1 + b x^c) + d x + e with coefficients mixed by (1 - alpha)^2 (Estevez
/// & Kulla 2017, table 1). x in [0, 1/2], alpha in [0, 1]. Absolute error below 16 ulp of 32.
template <class T>
T lambda_exponent_charlie(T x, T alpha) {
    const T t = (T(1) - alpha) * (T(1) - alpha);
    const auto mix = [t](double smooth, double rough) { return t * T(smooth) + (T(1) - t) * T(rough); };
    const T a = mix(25.3245, 21.5473), b = mix(3.32435, 3.82987), c = mix(0.16801, 0.19823);
    const T d = mix(-1.27393, -1.97760), e = mix(-4.85967, -4.32054);
    return a / (T(1) + b * std::pow(x, c)) + d * x + e;
}

/// Smith's Lambda of Charlie by the published fit (Estevez & Kulla 2017, 3): e^L(c) below c = 1/2, its mirror
/// image e^(2 L(1/2) - L(1 - c)) above. cosine in [0, 1], alpha in (0, 1]. Finite at 0 (8e8 at most), below
/// 5e-8 at 1. Against Smith's integral over D, G1 = 1 / (1 + Lambda) is off by at most .045 for alpha in [.1,
/// 1], .092 at .05, .34 at .01.
template <class T>
T lambda_charlie(T cosine, T alpha) {
    const T half = T(0.5);
    if (cosine < half) return std::exp(lambda_exponent_charlie(cosine, alpha));
    return std::exp(T(2) * lambda_exponent_charlie(half, alpha) -
                    lambda_exponent_charlie(std::max(T(1) - cosine, T(0)), alpha));
}

/// Where the fit of Lambda ends: from here down it lacks the pole 1 / cosine that Smith's function has.
template <class T>
inline constexpr T kCharlieSmallestCosine = T(1e-5);

/// Smith's visibility with lambda_charlie, G / (4 NoL NoV), G = 1 / (1 + Lambda(NoV) + Lambda(NoL)) (Estevez
/// & Kulla 2017, 3). NoL, NoV in [0, 1], alpha in (0, 1]; cosines below kCharlieSmallestCosine count as that,
/// so that it's finite (as published it returns more than arrived from 1e-8 down, and +Inf at 0). Without the
/// paper's softened terminator, which isn't reciprocal. Relative error below 64 ulp.
template <class T>
T V_charlie(T NoL, T NoV, T alpha) {
    const T l = std::max(NoL, kCharlieSmallestCosine<T>), v = std::max(NoV, kCharlieSmallestCosine<T>);
    return T(1) / ((T(1) + lambda_charlie(v, alpha) + lambda_charlie(l, alpha)) * T(4) * l * v);
}

/// A half vector with density D wm.z: sin = u1^(alpha / (2 alpha + 1)). u1, u2 in [0, 1); u1 = 0 is the
/// normal. A unit vector within 4 ulp, z >= 0. Good for the distribution itself; for lighting, a uniform
/// hemisphere is no worse (Estevez & Kulla 2017, 4), since visibility is what shapes the lobe.
template <class T>
Vec3<T> sample_charlie_ndf(T alpha, T u1, T u2) {
    const T log_sine = std::log(u1) * (alpha / (T(2) * alpha + T(1)));  // -Inf at u1 = 0
    const T sine = std::exp(log_sine), cosine = std::sqrt(-std::expm1(T(2) * log_sine));
    const SinCos azimuth = sin_cos_pi(2 * static_cast<double>(u2));
    return {sine * static_cast<T>(azimuth.cos), sine * static_cast<T>(azimuth.sin), cosine};
}

/// D wm.z, 1/sr, the density of sample_charlie_ndf; 0 below the surface. Error as D_charlie.
template <class T>
T pdf_charlie_ndf(T alpha, const Vec3<T>& wm) {
    return wm.z > T(0) ? D_charlie(wm.z, alpha) * wm.z : T(0);
}

/// The (u1, u2) that sample_charlie_ndf turns into wm; wm.z >= 0. At the normal both are 0. Round trip within
/// 1e-9 for alpha >= .001 (double).
template <class T>
Sample2 inverse_charlie_ndf(T alpha, const Vec3<T>& wm) {
    return {static_cast<double>(std::exp(log_sine_from_cosine(wm.z) * (T(2) + T(1) / alpha))),
            static_cast<double>(azimuth_turns(wm.x, wm.y))};
}

/// The visibility that goes with D_charlie.
enum class CharlieVisibility {
    charlie,  ///< V_charlie
    neubelt,  ///< V_neubelt
};

/// Directional albedo of the sheen lobe of white colour, the integral of D V NoL over the hemisphere. NoV in
/// [0, 1], alpha in [.01, 1]. Absolute error below 8e-6 (quadrature, 1,600 evaluations). Largest values are
/// at grazing view and listed at the head of this file; at alpha 1 charlie reaches .942 at NoV .008.
double albedo_charlie(double NoV, double alpha, CharlieVisibility visibility);

}  // namespace pbr
