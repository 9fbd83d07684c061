#pragma once
// What all area lights share. T is float or double.
//
// A light of uniform luminance L gives the illuminance E = L * projected solid angle, so every shape answers
// with its projected solid angle, sr: the integral of max(0, n.wi) over the directions wi in which point p
// sees the light. It lies in [0, pi] and is the radiosity form factor times pi: 1/pi is *not* inside, it
// belongs to the BRDF. Nothing but the light is in the way, and n is the unit normal of the receiver. One
// naming for all:
//   projected_solid_angle             exact, the part below the receiver's horizon cut off
//   projected_solid_angle_frostbite   closed form as published, where it isn't the exact one
//   projected_solid_angle_mrp         solid angle x cosine at the most representative point
//   projected_solid_angle_structured  solid angle x mean cosine of a few fixed points
// The last three are Lagarde & de Rousiers 2014, "Moving Frostbite to physically based rendering", 4.7.2;
// their errors, as stated with them, are measured against the first by the tests ...ErrsAsStated. Positions
// share one unit, any; results do not depend on it.

#include <cmath>
#include <glm/geometric.hpp>

#include "pbr/numerics/vector.hpp"

namespace pbr {

/// Whether a flat light shines from its front alone, the side its normal is on, or from both.
enum class Emission { one_sided, two_sided };

/// How far p lies in front of a flat light, in the light's length unit; > 0 where p is lit. A two-sided light
/// has no back. 0 in the light's plane, where nothing flat is seen.
template <class T>
T lit_height(const Vec3<T>& p, const Vec3<T>& centre, const Vec3<T>& normal, Emission emission) {
    const T height = glm::dot(p - centre, normal);
    return emission == Emission::two_sided ? std::abs(height) : height;
}

/// A right-handed orthonormal frame about a unit vector, which is its third axis.
template <class T>
struct AxisFrame {
    Vec3<T> x, y, z;

    /// The vector with coordinates v in this frame.
    Vec3<T> to_world(const Vec3<T>& v) const { return v.x * x + v.y * y + v.z * z; }
    /// The coordinates of v in this frame.
    Vec3<T> to_local(const Vec3<T>& v) const { return {glm::dot(v, x), glm::dot(v, y), glm::dot(v, z)}; }
};

/// A frame about a unit vector z, without a branch on where z points but for the sign of z.z (Duff et al.
/// 2017, "Building an orthonormal basis, revisited", listing 3). Orthonormal within 4 ulp.
template <class T>
AxisFrame<T> frame_about(const Vec3<T>& z) {
    const T sign = std::copysign(T(1), z.z);
    const T a = T(-1) / (sign + z.z), b = z.x * z.y * a;
    return {Vec3<T>(T(1) + sign * z.x * z.x * a, sign * b, -sign * z.x),
            Vec3<T>(b, sign + z.y * z.y * a, -z.y), z};
}

}  // namespace pbr
