#pragma once
// The sphere light: projected solid angle, solid angle, sampling. T is float or double.
//
// It shines outwards. A point inside is defined as surrounded by its luminance: projected solid angle pi
// whatever n, solid angle 4 pi. On the surface both are those of the hemisphere that the sphere fills.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "pbr/brdf/ggx_sampling.hpp"
#include "pbr/light/area_light.hpp"
#include "pbr/light/unit_conversions.hpp"
#include "pbr/numerics/sequence.hpp"

namespace pbr {

/// radius > 0 (0: shines nowhere).
template <class T>
struct SphereLight {
    Vec3<T> centre;
    T radius;
};

/// What conversions of units need to know of it (light/unit_conversions.hpp). Positions in m.
template <class T>
Emitter<T> emitter_of(const SphereLight<T>& light) {
    return emitter_sphere(light.radius);
}

/// Area of the surface: 4 pi r^2.
template <class T>
T surface_area(const SphereLight<T>& light) {
    return emitter_of(light).area_m2;
}

/// atan(q) - q without cancellation, q >= 0 (series below 0.1, where 8 terms leave 1e-17 of it). Relative
/// error below 150 ulp.
template <class T>
T atan_minus_argument(T q) {
    if (q > T(0.1)) return std::atan(q) - q;
    const T q2 = q * q;
    T sum = T(0);
    for (int k = 17; k >= 3; k -= 2) sum = T(1) / T(k) - q2 * sum;
    return -q * q2 * sum;
}

/// Projected solid angle, sr, of a cap of the sphere of directions: sin2 = sin^2 of its half-angle s in [0,
/// 1] (so s <= 90 deg), cosine = that of the angle from the normal to its centre, in [-1, 1]; both are
/// clamped. Clear of the horizon it is pi sin^2 s cos w (Lambert); across it Snyder's (1996, "Area light
/// sources for real-time graphics") closed form, as in Lagarde & de Rousiers 2014, 4.7.2.4, here with atan2
/// in place of acos and free of the cancellation at small s: sin^2 s cos w atan2(g, -k cos w) + atan(g/k) - g
/// k, g^2 = sin^2 s - cos^2 w, k = cos s. Continuous across the branches. Absolute error below 30 ulp of
/// sin^2 s.
template <class T>
T projected_solid_angle_cap(T cosine, T sin2) {
    const T c = std::clamp(cosine, T(-1), T(1)), s2 = std::clamp(sin2, T(0), T(1));
    if (c * c >= s2) return std::numbers::pi_v<T> * s2 * std::max(c, T(0));
    const T g = std::sqrt(s2 - c * c), k = std::sqrt(T(1) - s2);
    const T wrapped = s2 * c * std::atan2(g, -c * k);
    // atan(q) - g k with q = g/k: both are O(s) and differ by O(s^3), so q is taken out of them at small q.
    const T rest = g < k ? atan_minus_argument(g / k) + (g / k) * s2 : std::atan2(g, k) - g * k;
    return std::max(wrapped + rest, T(0));
}

/// sin^2 of the half-angle under which p sees the sphere; 1 on its surface and inside.
template <class T>
T sin2_half_angle(const SphereLight<T>& light, const Vec3<T>& p) {
    const Vec3<T> c = light.centre - p;
    const T r2 = light.radius * light.radius, d2 = glm::dot(c, c);
    return d2 > r2 ? r2 / d2 : T(1);
}

/// Whether p is inside the sphere, its surface apart.
template <class T>
bool is_inside(const SphereLight<T>& light, const Vec3<T>& p) {
    const Vec3<T> c = light.centre - p;
    return glm::dot(c, c) < light.radius * light.radius;
}

/// Exact, sr; error of projected_solid_angle_cap. n is the unit normal. pi inside the sphere.
template <class T>
T projected_solid_angle(const SphereLight<T>& light, const Vec3<T>& p, const Vec3<T>& n) {
    if (is_inside(light, p)) return std::numbers::pi_v<T>;
    const Vec3<T> c = light.centre - p;
    const T distance = glm::length(c);
    if (!(distance > T(0))) return T(0);  // a sphere of no radius at p
    return projected_solid_angle_cap(glm::dot(n, c) / distance, sin2_half_angle(light, p));
}

/// Frostbite's evaluation, sr: the exact form with the cosine clamped to +-0.999 and sin^2 to 0.9999 (Lagarde
/// & de Rousiers 2014, 4.7.2.4). The first clamp costs 0.1 % right below the light, the second up to 0.02 sr
/// at the surface; a point inside gets what one on the surface gets, not pi. p is not the centre.
template <class T>
T projected_solid_angle_frostbite(const SphereLight<T>& light, const Vec3<T>& p, const Vec3<T>& n) {
    const Vec3<T> c = light.centre - p;
    const T cosine = std::clamp(glm::dot(n, glm::normalize(c)), T(-0.999), T(0.999));
    return projected_solid_angle_cap(cosine, std::min(sin2_half_angle(light, p), T(0.9999)));
}

/// 1 - cos of the half-angle under which p sees the sphere, without cancellation; 2 inside.
template <class T>
T one_minus_cos_half_angle(const SphereLight<T>& light, const Vec3<T>& p) {
    if (is_inside(light, p)) return T(2);
    const T sin2 = sin2_half_angle(light, p);
    return sin2 / (T(1) + std::sqrt(T(1) - sin2));
}

/// Solid angle, sr: 2 pi (1 - cos s); 2 pi on the surface, 4 pi inside. Relative error below 8 ulp where the
/// sphere subtends less than 60 deg; growing like 1/cos s near its surface.
/// That is of light.centre - p and light.radius as rounded: positions that share many digits lose them
/// before.
template <class T>
T solid_angle(const SphereLight<T>& light, const Vec3<T>& p) {
    return T(2) * std::numbers::pi_v<T> * one_minus_cos_half_angle(light, p);
}

/// cos^2 s of the half-angle: the disk that p sees in the sphere's place has its middle at this share of the
/// way to the centre, and its radius is r cos s. p outside the sphere.
template <class T>
T rim_scale2(const SphereLight<T>& light, const Vec3<T>& p) {
    return T(1) - sin2_half_angle(light, p);
}

/// Solid angle times the mean clamped cosine of structured sampling, sr: the middle and four points of the
/// rim, two of them highest and lowest over the receiver's horizon (the pattern of Lagarde & de Rousiers
/// 2014, 4.7.2.5, who have it for rectangles alone; the closed form above is as cheap). Over all tilts the
/// largest error is 0.175, 0.040, 0.013 and 0.0024 of the solid angle at 1.1, 2, 4 and 8 radii. pi inside.
template <class T>
T projected_solid_angle_structured(const SphereLight<T>& light, const Vec3<T>& p, const Vec3<T>& n) {
    if (is_inside(light, p)) return std::numbers::pi_v<T>;
    if (!(light.radius > T(0))) return T(0);
    const T scale2 = rim_scale2(light, p), rim = light.radius * std::sqrt(scale2);
    const Vec3<T> c = light.centre - p;
    const AxisFrame<T> frame = frame_towards(glm::normalize(c), n);
    return solid_angle(light, p) * mean_cross_cosine(scale2 * c, rim * frame.x, rim * frame.y, n);
}

/// The axis of the cone in which p sees the sphere; +z at the very centre.
template <class T>
AxisFrame<T> cone_frame(const SphereLight<T>& light, const Vec3<T>& p) {
    const Vec3<T> c = light.centre - p;
    const T distance = glm::length(c);
    return frame_about(distance > T(0) ? c / distance : Vec3<T>(0, 0, 1));
}

/// A unit vector from p to the sphere, uniform in solid angle (Shirley et al. 1996, "Monte Carlo techniques
/// for direct lighting calculations", 3.2). u1 chooses the angle to the axis, u2 the azimuth; both in [0, 1).
template <class T>
Vec3<T> sample_sphere_light(const SphereLight<T>& light, const Vec3<T>& p, T u1, T u2) {
    const T v = u1 * one_minus_cos_half_angle(light, p);  // 1 - cos of the angle to the axis
    const T sine = std::sqrt(v * (T(2) - v));
    const SinCos azimuth = sin_cos_pi(2 * static_cast<double>(u2));
    return cone_frame(light, p).to_world(
        {sine * static_cast<T>(azimuth.cos), sine * static_cast<T>(azimuth.sin), T(1) - v});
}

/// The density of sample_sphere_light, 1/sr: 1 / solid angle where the ray from p along the unit vector wi
/// meets the sphere, else 0. A direction within 4 ulp of the cone's rim counts as inside.
template <class T>
T pdf_solid_angle(const SphereLight<T>& light, const Vec3<T>& p, const Vec3<T>& wi) {
    const T rim = one_minus_cos_half_angle(light, p);
    const Vec3<T> off_axis = wi - cone_frame(light, p).z;
    const T slack =
        T(4) * std::numeric_limits<T>::epsilon() * std::sqrt(rim);  // |off_axis| is good to an ulp of 1
    return rim > T(0) && T(0.5) * glm::dot(off_axis, off_axis) <= rim + slack ? T(1) / solid_angle(light, p)
                                                                              : T(0);
}

/// The (u1, u2) that sample_sphere_light turns into wi. radius > 0.
template <class T>
Sample2 inverse_sphere_light(const SphereLight<T>& light, const Vec3<T>& p, const Vec3<T>& wi) {
    const AxisFrame<T> frame = cone_frame(light, p);
    const Vec3<T> off_axis = wi - frame.z, local = frame.to_local(wi);
    const T u1 = T(0.5) * glm::dot(off_axis, off_axis) / one_minus_cos_half_angle(light, p);
    return {static_cast<double>(std::min(u1, T(1))), static_cast<double>(azimuth_turns(local.x, local.y))};
}

}  // namespace pbr
