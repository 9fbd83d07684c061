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
// All four shapes have the first and the last two; Frostbite has a closed form of its own for spheres and disks.
// The last three are Lagarde & de Rousiers 2014, "Moving Frostbite to physically based rendering", 4.7.2;
// their errors, as stated with them, are measured against the first by the tests ...ErrsAsStated. Positions
// share one unit, any; results do not depend on it.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "pbr/numerics/frame.hpp"
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

/// How many faces of a flat light shine, 1 or 2.
constexpr int face_count(Emission emission) { return emission == Emission::two_sided ? 2 : 1; }

/// Mean of max(0, n.l) over the five directions l from the receiver to a light's middle and to the ends of two
/// half axes from it: what structured sampling makes of a round light. The rays need not be unit vectors.
template <class T>
T mean_cross_cosine(const Vec3<T>& to_middle, const Vec3<T>& half_x, const Vec3<T>& half_y, const Vec3<T>& n) {
    const auto cosine = [&](const Vec3<T>& ray) { return std::max(glm::dot(n, glm::normalize(ray)), T(0)); };
    return (cosine(to_middle) + cosine(to_middle + half_x) + cosine(to_middle - half_x) +
            cosine(to_middle + half_y) + cosine(to_middle - half_y)) /
           T(5);
}

}  // namespace pbr
