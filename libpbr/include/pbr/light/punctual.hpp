#pragma once
// Point and spot lights: falloff with distance and with angle, and the illuminance they give. T is float or
// double.
//
// Nothing here holds 1/pi: a matte surface of albedo rho under E lux has the luminance rho E / pi
// (light/emissive.hpp says where that is), a BRDF is multiplied by E as it is.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "pbr/light/photometric_units.hpp"
#include "pbr/numerics/vector.hpp"

namespace pbr {

/// Nearer than this a punctual light grows no brighter (Lagarde & de Rousiers 2014, 4.4, the listing of the
/// distance attenuation): 1 cm, about a bulb's filament, so that no light is infinite.
inline constexpr double kPunctualSize_m = 0.01;

/// Brings the inverse square smoothly to 0 at a radius so that far lights can be culled: sat(1 - (d/R)^4)^2
/// (Karis 2013, "Real shading in Unreal Engine 4", eq. 9; Lagarde & de Rousiers 2014, 4.4). distance finite,
/// >= 0; radius in [0, +Inf]. 1 at d = 0 or R = +Inf (no window), 0 with no slope from R on; R = 0: 0. It
/// takes light: 12 % at R/2. Absolute error below 2 ulp of 1.
template <class T>
T distance_window(T distance_m, T radius_m) {
    if (!(distance_m < radius_m)) return T(0);
    const T ratio = distance_m / radius_m, ratio2 = ratio * ratio;
    const T left = (T(1) - ratio2) * (T(1) + ratio2);
    return left * left;
}

/// Windowed inverse square, 1/m^2: distance_window / max(d^2, kPunctualSize_m^2). Domain as distance_window;
/// at d = 0 it is 10^4, unless R = 0.
template <class T>
T distance_attenuation(T distance_m, T radius_m) {
    const T nearest = std::max(distance_m, T(kPunctualSize_m));
    return distance_window(distance_m, radius_m) / nearest / nearest;
}

/// A spot's penumbra: what a shader takes, attenuation sat(cosine * scale + offset)^2, and `on_axis` = scale +
/// offset kept beside them, since that sum has lost its digits where the cone is narrow.
template <class T>
struct SpotCone {
    T scale;
    T offset;
    T on_axis;  ///< >= 0; the value before sat on the axis: below 1 the light is dimmed even there
};

/// The smallest step of the cosine over which a spot goes dark (Lagarde & de Rousiers 2014, 4.4, the listing
/// of the angle attenuation).
inline constexpr double kSpotCosineStep = 0.001;

/// scale = 1 / max(cos inner - cos outer, 0.001), offset = -scale cos outer (Lagarde & de Rousiers
/// 2014, 4.4). Half-angles in rad, 0 <= outer <= pi; an inner angle that isn't below the outer one makes the
/// hardest edge there is. Known to be poor: the 0.001 widens the penumbra of narrow cones inwards, and below
/// an outer half-angle of 2.56 degrees it reaches the axis: there a cone of 1 degree has but 2.3 % of its
/// intensity.
template <class T>
SpotCone<T> spot_cone(T inner_rad, T outer_rad) {
    // cos a - cos b as a product keeps its digits where both are near 1.
    const T step = T(2) * std::sin((outer_rad + inner_rad) / T(2)) * std::sin((outer_rad - inner_rad) / T(2));
    const T scale = T(1) / std::max(step, T(kSpotCosineStep)), half = std::sin(outer_rad / T(2));
    return {scale, -scale * std::cos(outer_rad), scale * (T(2) * half * half)};
}

/// The share of a spot's intensity left at an angle from its axis, by the angle's cosine in [-1, 1]: 0
/// outside the outer cone, 1 inside the inner one, a square between; no slope at the outer edge, a kink at
/// the inner one.
template <class T>
T spot_attenuation(T cosine, const SpotCone<T>& cone) {
    const T linear = std::clamp(cosine * cone.scale + cone.offset, T(0), T(1));
    return linear * linear;
}

/// The solid angle that a spot's penumbra leaves of its cone, 2 pi times the integral of spot_attenuation
/// over the cosine: with it intensity_from_power states the intensity on the axis of a spot that really emits
/// that power. Relative error below 16 ulp; 0 for an outer angle of 0.
template <class T>
Steradians<T> solid_angle_of_spot(const SpotCone<T>& cone) {
    // t = sat(cosine scale + offset) rises from 0 at the outer edge to its value on the axis, or to 1 before.
    const T ramp = std::min(cone.on_axis, T(1));
    const T penumbra = ramp * ramp * ramp / T(3), full = std::max(cone.on_axis - T(1), T(0));
    return Steradians<T>(T(2) * std::numbers::pi_v<T> * (penumbra + full) / cone.scale);
}

/// Illuminance of a point light on a surface: I attenuation NoL. `to_light_m` leads from the surface to the
/// light, `normal` is a unit vector. 0 below the horizon, and 0 where the light lies on the surface, as there
/// is no direction from which it could come.
template <class T>
Lux<T> illuminance_of_point(Candelas<T> intensity, const Vec3<T>& to_light_m, const Vec3<T>& normal,
                            T radius_m) {
    const T distance_m = glm::length(to_light_m);
    if (distance_m == T(0)) return Lux<T>();
    const T NoL = std::max(glm::dot(normal, to_light_m) / distance_m, T(0));
    return Lux<T>(intensity.value() * distance_attenuation(distance_m, radius_m) * NoL);
}

/// Illuminance of a spot: illuminance_of_point times spot_attenuation. `axis` is the unit vector along which
/// it shines, away from the light; intensity is the one on the axis.
template <class T>
Lux<T> illuminance_of_spot(Candelas<T> intensity, const Vec3<T>& axis, const SpotCone<T>& cone,
                           const Vec3<T>& to_light_m, const Vec3<T>& normal, T radius_m) {
    const T distance_m = glm::length(to_light_m);
    if (distance_m == T(0)) return Lux<T>();
    const T angular = spot_attenuation(-glm::dot(axis, to_light_m) / distance_m, cone);
    return illuminance_of_point(intensity, to_light_m, normal, radius_m) * angular;
}

}  // namespace pbr
