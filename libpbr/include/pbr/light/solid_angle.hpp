#pragma once
// Solid angles that lights are stated by. T is float or double.
//
// All are written without 1 - cos, which in float has lost every digit at 3e-4 rad.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pbr/light/photometric_units.hpp"

namespace pbr {

/// All directions, 4 pi sr.
template <class T>
constexpr Steradians<T> solid_angle_whole_sphere() {
    return Steradians<T>(T(4) * std::numbers::pi_v<T>);
}

/// A circular cone: 2 pi (1 - cos h) = 4 pi sin^2(h/2) for the half-angle h in [0, pi] (rad). 0 at 0, 4 pi at
/// pi. Relative error below 4 ulp.
template <class T>
Steradians<T> solid_angle_cone(T half_angle_rad) {
    const T s = std::sin(half_angle_rad / T(2));
    return Steradians<T>(T(4) * std::numbers::pi_v<T> * s * s);
}

/// A four-sided pyramid whose opposite faces are the given full angles apart, each in [0, pi] (rad):
/// 4 asin(sin(x/2) sin(y/2)) (Lagarde & de Rousiers 2014, 4.4, the frustum light). 2 pi if both are pi.
/// Relative error below 8 ulp where neither is above 3 rad.
template <class T>
Steradians<T> solid_angle_pyramid(T angle_x_rad, T angle_y_rad) {
    const T sx = std::sin(angle_x_rad / T(2)), sy = std::sin(angle_y_rad / T(2));
    return Steradians<T>(T(4) * std::asin(std::min(sx * sy, T(1))));
}

/// A sphere seen from a distance (to its centre), both in m, radius > 0: 2 pi (1 - sqrt(1 - q^2)), q = radius
/// / distance. On the surface 2 pi; inside 4 pi. Relative error below 8 ulp.
template <class T>
Steradians<T> solid_angle_of_sphere(T radius_m, T distance_m) {
    if (distance_m < radius_m) return solid_angle_whole_sphere<T>();
    const T q = radius_m / distance_m;
    return Steradians<T>(T(2) * std::numbers::pi_v<T> * q * q / (T(1) + std::sqrt((T(1) - q) * (T(1) + q))));
}

/// A disk that faces the viewer, on its axis: 2 pi (1 - d/h) = 2 pi r^2 / (h (h + d)), h^2 = d^2 + r^2.
/// radius > 0, distance >= 0, m; 2 pi at distance 0. Relative error below 8 ulp.
template <class T>
Steradians<T> solid_angle_of_disk(T radius_m, T distance_m) {
    const T h = std::hypot(radius_m, distance_m);
    return Steradians<T>(T(2) * std::numbers::pi_v<T> * (radius_m / h) * (radius_m / (h + distance_m)));
}

/// A rectangle that faces the viewer, on its axis: 4 atan(w h / (2 d sqrt(w^2 + h^2 + 4 d^2))). width, height
/// > 0, distance >= 0, m; 2 pi at distance 0 (Lagarde & de Rousiers 2014, 4.7.2.5, there with asin, which loses
/// digits at distance 0). Used off axis, as Frostbite considered for speed, it is wrong: it knows no tilt.
/// Relative error below 8 ulp.
template <class T>
Steradians<T> solid_angle_of_rectangle(T width_m, T height_m, T distance_m) {
    const T diagonal = std::hypot(width_m, height_m, T(2) * distance_m);
    return Steradians<T>(T(4) * std::atan2(width_m * height_m, T(2) * distance_m * diagonal));
}

}  // namespace pbr
