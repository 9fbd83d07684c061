#pragma once
// Surfaces that shine, in the units of the lights. T is float or double.
//
// An emissive surface is the visible part of a light (Lagarde & de Rousiers 2014, 4.8): a lamp's shade has
// the luminance that luminance_from_power gives for its lumens and area, a screen the nits or the exposure
// value that it is sold by (luminance_from_ev100). Here is what is left.

#include <cmath>
#include <numbers>

#include "pbr/light/photometric_units.hpp"
#include "pbr/light/unit_conversions.hpp"
#include "pbr/numerics/vector.hpp"

namespace pbr {

/// The luminance of a surface that keeps its brightness in the picture whatever the exposure: `above` stops
/// over what a meter takes for the camera's mean, 2^(EV + above) K/100. camera of -Inf: 0.
template <class T>
Nits<T> emissive_luminance(Ev100<T> camera, Stops<T> above) {
    return luminance_from_ev100(camera + above);
}

/// Luminous exitance: what a square metre of a matte emitter sends out, pi L lm/m^2.
template <class T>
constexpr Lux<T> exitance_from_luminance(Nits<T> luminance) {
    return Lux<T>(std::numbers::pi_v<T> * luminance.value());
}

/// The luminance of a matte emitter by its exitance, M / pi. Also that of a lit matte surface, which sends
/// out albedo times its illuminance: L = rho E / pi.
template <class T>
constexpr Nits<T> luminance_from_exitance(Lux<T> exitance) {
    return Nits<T>(exitance.value() / std::numbers::pi_v<T>);
}

/// Area of a triangle of an emissive mesh, m^2; corners in m. Sums of it make the Emitter{area, ...} whose
/// power_from_luminance are the mesh's lumens. 0 for a degenerate one.
template <class T>
T triangle_area(const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& c) {
    const Vec3<T> u = b - a, v = c - a;
    const T x = u.y * v.z - u.z * v.y, y = u.z * v.x - u.x * v.z, z = u.x * v.y - u.y * v.x;
    return T(0.5) * std::hypot(x, y, z);
}

}  // namespace pbr
