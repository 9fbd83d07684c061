#pragma once
// The sun as a disk of the sky with a solid angle. T is float or double.
//
// Artists state the sun by the illuminance of a surface that faces it; what is seen, mirrored and baked into
// probes is its luminance. The disk is uniform; the real one falls to some 40 % at its limb.

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "pbr/light/photometric_units.hpp"
#include "pbr/light/solid_angle.hpp"
#include "pbr/numerics/vector.hpp"

namespace pbr {

/// The sun's half-angle from the earth's mean distance, rad: sine = 695,700 km / 149,597,870.7 km (IAU 2015
/// resolution B3, IAU 2012 resolution B2). .0046505, 0.2665 degrees; over a year it varies by 1.7 %.
inline constexpr double kSunHalfAngle_rad = [] {
    constexpr double s = 695'700.0 / 149'597'870.7;
    return s + s * s * s / 6;  // asin but for s^5, 2e-13
}();

/// The sun's solid angle, 6.794e-5 sr.
template <class T>
Steradians<T> solid_angle_of_sun() {
    return solid_angle_cone(T(kSunHalfAngle_rad));
}

/// Illuminance of a surface that faces a uniform disk of the sky: E = pi sin^2(s) L. Half-angle s in [0,
/// pi/2], rad; 0 at s = 0, pi L for the whole sky. Frostbite's E = L Omega (Lagarde & de Rousiers 2014, 4.6)
/// leaves the cosine within the disk away and is larger by s^2/4, for the sun 5e-6. Relative error below 6
/// ulp.
template <class T>
Lux<T> illuminance_from_disk_luminance(Nits<T> luminance, T half_angle_rad) {
    const T s = std::sin(half_angle_rad);
    return Lux<T>(luminance.value() * std::numbers::pi_v<T> * s * s);
}

/// The inverse: L = E / (pi sin^2 s); 100,000 lx of sun are 1.472e9 nit. Half-angle in (0, pi/2]; 0 gives
/// +Inf for E > 0. Relative error below 6 ulp.
template <class T>
Nits<T> disk_luminance_from_illuminance(Lux<T> perpendicular_illuminance, T half_angle_rad) {
    const T s = std::sin(half_angle_rad);
    return Nits<T>(perpendicular_illuminance.value() / (std::numbers::pi_v<T> * s * s));
}

/// The direction of the disk that is nearest to the mirror direction R: R itself inside the disk, else the
/// point of its rim on the arc from R to its centre (Lagarde & de Rousiers 2014, 4.6, the listing). R and
/// centre unit vectors, half-angle in [0, pi/2]. Against the centre (R = -centre) every point of the rim is
/// nearest: some one is taken. Specular light is then BRDF(V, L) E NoL with NoL of the centre.
///
/// Known to be poor: the whole sun shines as if from that point. At the mirror direction of GGX that is too
/// bright by 1 + (s / (2 alpha))^2, the mean of D over a small disk in closed form: 5 % at alpha .01, 6.4
/// times at .001.
template <class T>
Vec3<T> nearest_direction_of_disk(const Vec3<T>& R, const Vec3<T>& centre, T half_angle_rad) {
    const T along = glm::dot(R, centre);
    const Vec3<T> across = R - along * centre;
    const T sine = glm::length(across), rim = std::sin(half_angle_rad);
    // By the sine: near the centre the cosine has lost half its digits.
    if (along > T(0) && sine <= rim) return R;
    Vec3<T> outward;
    if (sine > T(8) * std::numeric_limits<T>::epsilon()) {
        outward = across / sine;  // beside -centre mostly rounding, so not yet normal to the centre
    } else {
        outward = std::abs(centre.x) < T(0.5) ? Vec3<T>(1, 0, 0) : Vec3<T>(0, 1, 0);
    }
    outward = glm::normalize(outward - glm::dot(outward, centre) * centre);
    return glm::normalize(std::cos(half_angle_rad) * centre + rim * outward);
}

}  // namespace pbr
