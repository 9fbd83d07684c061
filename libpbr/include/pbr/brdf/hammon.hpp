#pragma once
// Hammon's diffuse for GGX + Smith microsurfaces. T is float or double; Colour is T or a GLM vector of it.

#include <cmath>
#include <numbers>

#include "pbr/brdf/fresnel.hpp"

namespace pbr {

/// Hammon's fit to Lambertian microfacets under GGX, 1/sr, times the colour (Hammon 2017, "PBR diffuse
/// lighting for GGX+Smith microsurfaces", GDC, slide 113). rho in [0, 1] a channel goes in, since multiple
/// scattering squares it; 1/pi is inside the single scattering, and .1159 alpha is the multiple scattering's
/// BRDF, already 1/sr (its albedo is .1159 pi alpha = .364 alpha). NoL, NoV, NoH in [0, 1], LoV in [-1, 1],
/// alpha in [0, 1]. Reciprocal. Not energy conserving: for rho = 1 its albedo runs from 0 (smooth, grazing
/// view) to 1.181 (alpha 1, grazing view), and its mean over views from .952 (20/21, alpha 0) to 1.073 (alpha
/// 1). +Inf where NoH = 0 and alpha > 0, at opposite grazing directions, though times NoL it's finite.
/// Absolute error below 16 ulp of the larger of 1 and the value.
template <class Colour, class T>
Colour f_hammon(const Colour& rho, T NoL, T NoV, T NoH, T LoV, T alpha) {
    const T facing = T(0.5) + T(0.5) * LoV;
    const T rough = facing * (T(0.9) - T(0.4) * facing) * (T(0.5) + NoH) / NoH;
    const T smooth = T(1.05) * (T(1) - schlick_weight(NoL)) * (T(1) - schlick_weight(NoV));
    // Without the branch a mirror-smooth surface at NoH = 0 would be 0 times infinity.
    const T single = alpha > T(0) ? (smooth + (rough - smooth) * alpha) : smooth;
    return rho * (single * std::numbers::inv_pi_v<T> + rho * (T(0.1159) * alpha));
}

/// Albedo of the multiple scattering of a white surface, a unit of alpha: .1159 pi.
template <class T>
inline constexpr T kHammonMultipleAlbedo = T(0.1159) * std::numbers::pi_v<T>;

/// Directional albedo of the single scattering in f_hammon, of rho = 1; all of it is rho (this + rho
/// kHammonMultipleAlbedo alpha). NoV and alpha in [0, 1]. Absolute error below 2e-7 (a product rule of 24
/// heights by 16 azimuths; largest where NoV is about 1e-6 and alpha 1).
double albedo_hammon_single(double NoV, double alpha);

}  // namespace pbr
