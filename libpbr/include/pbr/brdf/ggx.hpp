#pragma once
// GGX microfacet distribution and Smith's visibility terms. T is float or double.
//
// Directions are in the frame of the surface, normal +z, and point away from it. alpha in (0, 1]. V is G / (4
// NoL NoV), so the specular BRDF is D V F, and it has no other factor; 1/pi lives in D.

#include <cmath>
#include <numbers>

namespace pbr {

/// The GGX distribution D(h) = alpha^2 / (pi (sin^2 + alpha^2 cos^2)^2), 1/sr (Walter et al. 2007,
/// "Microfacet models for refraction through rough surfaces", eq. 33, rewritten: the usual (alpha^2-1)cos^2+1
/// cancels when alpha -> 0). NoH in [0, 1]; sin2 = 1 - NoH^2, best had from the tangential part of the half
/// vector. Largest value 1/(pi alpha^2), at the normal. alpha = 0 is a delta: not a number here, so the
/// caller treats it as a mirror. Relative error below 8 ulp for alpha >= 1e-18 (float), 1e-150 (double), where
/// alpha^2 is still a normal number; below, the value at the normal overflows to +Inf.
template <class T>
T D_ggx(T NoH, T sin2, T alpha) {
    const T a2 = alpha * alpha;
    const T root = alpha / (sin2 + a2 * NoH * NoH);  // the denominator's square would underflow
    return root * root / std::numbers::pi_v<T>;
}

/// The same from NoH alone; loses relative accuracy like 2^-53 / alpha^2 (double), 2^-24 / alpha^2 (float)
/// beside the normal. NoH in [0, 1].
template <class T>
T D_ggx(T NoH, T alpha) {
    return D_ggx(NoH, (T(1) - NoH) * (T(1) + NoH), alpha);
}

/// sqrt(alpha^2 + (1 - alpha^2) c^2) = c (1 + 2 Lambda(c)): Smith's Lambda without its pole at grazing
/// angles. cosine in [0, 1], alpha in [0, 1]: alpha at 0, 1 at 1 within a rounding. Relative error below 4
/// ulp.
template <class T>
T smith_ggx_root(T cosine, T alpha) {
    const T a2 = alpha * alpha;
    return std::sqrt(a2 + (T(1) - a2) * cosine * cosine);
}

/// Height-correlated Smith visibility, 1 / (2 (NoL root(NoV) + NoV root(NoL))) (Heitz 2014, "Understanding
/// the masking-shadowing function in microfacet-based BRDFs", eq. 99; Lagarde & de Rousiers 2014, listing 2).
/// NoL, NoV in [0, 1]. Both 0: +Inf, as the limit is (ggx_specular is finite there); one 0: finite. Relative
/// error below 8 ulp.
template <class T>
T V_smith_ggx_correlated(T NoL, T NoV, T alpha) {
    return T(0.5) / (NoL * smith_ggx_root(NoV, alpha) + NoV * smith_ggx_root(NoL, alpha));
}

/// Uncorrelated (separable) Smith visibility, 1 / ((NoL + root(NoL)) (NoV + root(NoV))) (Walter et al. 2007,
/// eq. 34). Never above the correlated one. NoL, NoV in [0, 1]; at most 1 / alpha^2, where both are 0.
/// Relative error below 8 ulp.
template <class T>
T V_smith_ggx_uncorrelated(T NoL, T NoV, T alpha) {
    return T(1) / ((NoL + smith_ggx_root(NoL, alpha)) * (NoV + smith_ggx_root(NoV, alpha)));
}

/// Smith masking of one direction, G1 = 2c / (c + root(c)). cosine in [0, 1]; 0 at 0, 1 at 1. Relative error
/// below 8 ulp.
template <class T>
T G1_smith_ggx(T cosine, T alpha) {
    return cosine > T(0) ? T(2) * cosine / (cosine + smith_ggx_root(cosine, alpha)) : T(0);
}

/// D V NoL with the correlated visibility: the specular BRDF of a white mirror-like microsurface times the
/// cosine, which stays finite where V alone is not. NoL, NoV, NoH in [0, 1], sin2 as in D_ggx; 0 at NoL = 0
/// whatever NoV, D / (2 alpha) at NoV = 0. Relative error below 16 ulp.
template <class T>
T ggx_specular(T NoL, T NoV, T NoH, T sin2, T alpha) {
    if (NoL <= T(0)) return T(0);
    const T V_NoL = T(0.5) * NoL / (NoL * smith_ggx_root(NoV, alpha) + NoV * smith_ggx_root(NoL, alpha));
    return D_ggx(NoH, sin2, alpha) * V_NoL;
}

}  // namespace pbr
