#pragma once
// Disney diffuse, as Burley published it and as Frostbite renormalised it. T is float or double.
//
// Both are BRDFs for a white surface (multiply by the diffuse colour); 1/pi is inside.

#include <cmath>
#include <numbers>

#include "pbr/brdf/fresnel.hpp"

namespace pbr {

/// Burley's diffuse BRDF, 1/sr: (1/pi)(1 + (f90-1)(1-NoL)^5)(1 + (f90-1)(1-NoV)^5), f90 = 1/2 + 2 r LoH^2
/// (Burley 2012, 5.3). NoL, NoV, LoH and perceptual_roughness in [0, 1]. Not energy conserving: its albedo
/// reaches 1.56 at grazing view and full roughness. Largest value 6.25 / pi, at LoH = 1 and grazing NoL, NoV.
/// Relative error below 16 ulp.
template <class T>
T f_disney_diffuse_original(T NoL, T NoV, T LoH, T perceptual_roughness) {
    const T f90 = T(0.5) + T(2) * perceptual_roughness * LoH * LoH;
    return F_schlick(T(1), f90, NoL) * F_schlick(T(1), f90, NoV) / std::numbers::pi_v<T>;
}

/// Frostbite's renormalisation, 1/sr: f90 = r/2 + 2 r LoH^2, all times lerp(1, 1/1.51, r) (Lagarde & de
/// Rousiers 2014, listing 1). Domain as above. Its albedo stays below 1 nearly everywhere, but is 1.0315 at
/// NoV = 0, r = 1. Its value is 0 at r = 0 where NoL or NoV is 0. Relative error below 16 ulp, apart from f90
/// - 1 near -1 (r = 0, grazing), where it is 16 ulp of 1 / pi.
template <class T>
T f_disney_diffuse(T NoL, T NoV, T LoH, T perceptual_roughness) {
    const T f90 = T(0.5) * perceptual_roughness + T(2) * perceptual_roughness * LoH * LoH;
    const T energy_factor = T(1) + perceptual_roughness * (T(1) / T(1.51) - T(1));
    return energy_factor * F_schlick(T(1), f90, NoL) * F_schlick(T(1), f90, NoV) / std::numbers::pi_v<T>;
}

/// Directional albedo of f_disney_diffuse: its integral times NoL over the hemisphere. NoV and
/// perceptual_roughness in [0, 1]. Exact to 1e-13: f90 is linear in the cosine of the azimuth and all else
/// polynomial in NoL, so that azimuth integrates in closed form and five Gauss points do the rest.
double albedo_disney_diffuse(double NoV, double perceptual_roughness);

/// Directional albedo of f_disney_diffuse_original; domain and error as above.
double albedo_disney_diffuse_original(double NoV, double perceptual_roughness);

}  // namespace pbr
