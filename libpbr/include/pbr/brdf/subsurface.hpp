#pragma once
// Subsurface scattering: Burley's normalised diffusion profile, skin pre-integrated over it, and wrapped
// diffuse.
//
// T is float or double. Lengths share one unit, the caller's. d is the profile's shape length, had from a
// mean free path and the surface albedo A by one of the fits below; a profile integrates to A over the plane.

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pbr {

/// Burley's profile R(r) = A (e^(-r/d) + e^(-r/3d)) / (8 pi d r), per area: radiant exitance at distance r of
/// flux 1 entering at one point (Burley 2015, "Extending the Disney BRDF to a BSDF with integrated subsurface
/// scattering"; Christensen & Burley 2015, "Approximate reflectance profiles for efficient subsurface
/// scattering", eq. 3). r >= 0, d > 0, albedo A in [0, 1]. +Inf at r = 0, where r R(r) is finite; its
/// integral over the plane is A exactly. Relative error below (4 + r/d) ulp.
template <class T>
T burley_profile(T r, T d, T albedo) {
    return albedo * (std::exp(-r / d) + std::exp(-r / (T(3) * d))) / (T(8) * std::numbers::pi_v<T> * d * r);
}

/// Share of the profile within distance r: 1 - e^(-r/d)/4 - 3 e^(-r/3d)/4 (Christensen & Burley 2015, 5). r
/// >= 0, d > 0: 0 at 0, 1 at infinity. Relative error below 8 ulp, also for r -> 0.
template <class T>
T burley_cdf(T r, T d) {
    return -std::expm1(-r / d) / T(4) - T(3) * std::expm1(-r / (T(3) * d)) / T(4);
}

/// Density of sample_burley_radius per length, 2 pi r R(r) / A = (e^(-r/d) + e^(-r/3d)) / (4 d). r >= 0, d >
/// 0. Divide by 2 pi r for the density per area. Relative error below (4 + r/d) ulp.
template <class T>
T pdf_burley_radius(T r, T d) {
    return (std::exp(-r / d) + std::exp(-r / (T(3) * d))) / (T(4) * d);
}

/// The distance at which burley_cdf is u: with x = e^(-r/3d) the cdf is the cubic x^3 + 3x = 4 (1 - u), whose
/// one real root is 2 sinh(asinh(2 (1 - u)) / 3). u in [0, 1), d > 0; 0 at 0. Relative error below 16 ulp in
/// r for u -> 0, 16 ulp of d else: the exact inverse, where the paper offers a table or two exponentials with
/// a weight.
template <class T>
T sample_burley_radius(T u, T d) {
    const T x = T(2) * std::sinh(std::asinh(T(2) * (T(1) - u)) / T(3));
    // One step of Newton on the cubic in y = 1 - x, which does not cancel as u -> 0.
    T y = T(1) - x;
    y -= (y * (T(6) + y * (y - T(3))) - T(4) * u) / (T(6) + y * (T(3) * y - T(6)));
    return u > T(0) ? T(-3) * d * std::log1p(-y) : T(0);
}

/// The u that sample_burley_radius turns into r: burley_cdf.
template <class T>
T inverse_burley_radius(T r, T d) {
    return burley_cdf(r, d);
}

/// s(A) = l / d for a beam entering perpendicularly, l the volume's mean free path: 1.85 - A + 7 |A - .8|^3
/// (Christensen & Burley 2015, eq. 5). albedo A in [0, 1]. The paper's own average error against Monte Carlo
/// is 5.5 %; a random walk in the tests differs by 5.5 % of the energy at most for A in [.05, .75], and .028
/// in the cdf.
template <class T>
T burley_scale_perpendicular(T albedo) {
    const T x = std::abs(albedo - T(0.8));
    return T(1.85) - albedo + T(7) * x * x * x;
}

/// s(A) = l / d for light that a rough surface lets in diffusely, l the volume's mean free path: 1.9 - A +
/// 3.5 (A - .8)^2 (Christensen & Burley 2015, the fit for diffuse transmission). albedo A in [0, 1]. The
/// paper's own average error is 3.9 %; a random walk in the tests differs by 4.5 % of the energy at most for
/// A in [.07, .8], and .024 in the cdf.
template <class T>
constexpr T burley_scale_diffuse(T albedo) {
    const T x = albedo - T(0.8);
    return T(1.9) - albedo + T(3.5) * x * x;
}

/// s(A) = l_d / d with l_d the diffuse mean free path on the surface, for a perpendicular beam: 3.5 + 100 (A
/// - .33)^4 (Christensen & Burley 2015, the fit for diffuse mean free paths). albedo A in [0, 1]. The paper's
/// own average error is 7.7 %.
template <class T>
constexpr T burley_scale_diffuse_mean_free_path(T albedo) {
    const T x = albedo - T(0.33), x2 = x * x;
    return T(3.5) + T(100) * x2 * x2;
}

/// Irradiance that reaches the skin from below at a point of a sphere under a directional light, over that of
/// a light at the zenith on a flat surface: for Penner's tables over (NoL, curvature) (Penner 2011,
/// "Pre-integrated skin shading"). NoL in [-1, 1]; curvature_d >= 0, finite, is d over the sphere's radius, d
/// Burley's. max(NoL, 0) at 0; its mean over the sphere is 1/4, as light only moves. Absolute error below
/// 1e-7.
///
/// Penner integrates the profile along a ring; Burley's, like 1/r, has no such integral. Here it is spread
/// over the sphere itself, by chord length: the area within chord p is pi p^2, as on the plane, so that the
/// weights are the profile's own, cut at the diameter and normalised. Colour channels differ by d only: one
/// table serves all.
double preintegrated_diffusion(double NoL, double curvature_d);

/// Wrapped Lambert times the cosine, max(0, NoL + wrap) / (pi (1 + wrap)^2), 1/sr, normalised so that the
/// integral over the sphere is 1 (McAuley 2011, "Energy-conserving wrapped diffuse"). Replaces f NoL: no
/// further cosine. NoL in [-1, 1], wrap in [0, 1]; wrap 0 is Lambert. Relative error below 8 ulp.
template <class T>
constexpr T wrapped_diffuse(T NoL, T wrap) {
    const T lit = NoL + wrap;
    return lit > T(0) ? lit / (std::numbers::pi_v<T> * (T(1) + wrap) * (T(1) + wrap)) : T(0);
}

}  // namespace pbr
