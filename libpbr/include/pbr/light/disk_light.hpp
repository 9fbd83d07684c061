#pragma once
// The disk light: projected solid angle three ways, solid angle, sampling of its area. T is float or double;
// what is exact is evaluated in double for both.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "pbr/brdf/ggx_sampling.hpp"
#include "pbr/light/area_light.hpp"
#include "pbr/light/rectangle_light.hpp"
#include "pbr/light/sphere_light.hpp"
#include "pbr/light/unit_conversions.hpp"
#include "pbr/numerics/sequence.hpp"

namespace pbr {

/// normal is a unit vector on the front's side; radius > 0 (0: shines nowhere).
template <class T>
struct DiskLight {
    Vec3<T> centre;
    Vec3<T> normal;
    T radius;
    Emission emission = Emission::one_sided;
};

/// The same disk in double.
template <class T>
DiskLight<double> in_double(const DiskLight<T>& light) {
    return {Vec3<double>(light.centre), Vec3<double>(light.normal), static_cast<double>(light.radius),
            light.emission};
}

/// What conversions of units need to know of it (light/unit_conversions.hpp): both faces of a two-sided light
/// emit, one is seen. Positions in m.
template <class T>
Emitter<T> emitter_of(const DiskLight<T>& light) {
    const Emitter<T> one_face = emitter_disk(light.radius);
    return {T(face_count(light.emission)) * one_face.area_m2, one_face.facing_area_m2};
}

/// Area of one face: pi r^2.
template <class T>
T surface_area(const DiskLight<T>& light) {
    return emitter_of(light).facing_area_m2;
}

/// Whether the disk's lit side faces p. False in its plane.
template <class T>
bool is_lit(const DiskLight<T>& light, const Vec3<T>& p) {
    return lit_height(p, light.centre, light.normal, light.emission) > T(0);
}

/// Solid angle, sr, of a disk seen from `height` above its plane and `offset` beside its axis, by Bulirsch's
/// complete elliptic integral (Paxton 1959, "Solid angle calculation for a circular disk"; on the axis 2 pi
/// (1 - cos s)); below radius / distance 0.1 by its expansion in multipoles, which does not cancel. Relative
/// error below 1e-12, but absolute error 1e-14 in the plane's vicinity. offset, radius >= 0; height <= 0
/// gives 0.
double solid_angle_disk(double height, double offset, double radius);

/// Solid angle, sr, in [0, 2 pi); error of solid_angle_disk. 0 where is_lit is false.
template <class T>
T solid_angle(const DiskLight<T>& light, const Vec3<T>& p) {
    const DiskLight<double> exact = in_double(light);
    const Vec3<double> to_p = Vec3<double>(p) - exact.centre;
    const double height = lit_height(Vec3<double>(p), exact.centre, exact.normal, exact.emission);
    return static_cast<T>(
        solid_angle_disk(height, glm::length(glm::cross(to_p, exact.normal)), exact.radius));
}

/// Exact, sr: the contour integral 1/2 n . closed integral of (r x dr)/r^2 (Lambert; Sparrow 1963, "A new and
/// simpler formulation for radiative angle factors"), which for a circle is elementary: the whole circle
/// clear of the horizon, else its arc above and the chord along the horizon. Any orientation. n is the unit
/// normal. 0 where is_lit is false. Relative error below 1e-13 clear of the horizon; across it absolute error
/// below 1e-14.
double projected_solid_angle(const DiskLight<double>& light, const Vec3<double>& p, const Vec3<double>& n);

/// The same, rounded to float.
inline float projected_solid_angle(const DiskLight<float>& light, const Vec3<float>& p,
                                   const Vec3<float>& n) {
    return static_cast<float>(projected_solid_angle(in_double(light), Vec3<double>(p), Vec3<double>(n)));
}

/// Frostbite's evaluation, sr: the cap of a disk turned towards p, sin^2 s = r^2/(r^2 + max(r^2, d^2)), times
/// the cosine at the light (Lagarde & de Rousiers 2014, 4.7.2.3-4; two-sided: its magnitude). Exact for a
/// light that faces p head-on from at least its radius; nearer it is low, by 48 % at 0.2 radii. Over all
/// directions and tilts the largest error is 0.69, 0.38, 0.116 and 0.031 of the solid angle at 1, 2, 4 and 8
/// radii.
template <class T>
T projected_solid_angle_frostbite(const DiskLight<T>& light, const Vec3<T>& p, const Vec3<T>& n) {
    const T height = lit_height(p, light.centre, light.normal, light.emission);
    if (!(height > T(0))) return T(0);
    const Vec3<T> c = light.centre - p;
    const T d2 = glm::dot(c, c), r2 = light.radius * light.radius, distance = std::sqrt(d2);
    const T sin2 = r2 / (r2 + std::max(r2, d2));
    return projected_solid_angle_cap(glm::dot(n, c) / distance, sin2) * std::min(height / distance, T(1));
}

/// Solid angle times the clamped cosine at the most representative point, sr (Drobot 2014, "Physically based
/// area lights", GPU Pro 5; Lagarde & de Rousiers 2014, 4.7.2.5), for the disk. Poor: over all directions and
/// tilts the largest error is 0.59, 0.40, 0.23 and 0.12 of the solid angle at 1, 2, 4 and 8 radii.
template <class T>
T projected_solid_angle_mrp(const DiskLight<T>& light, const Vec3<T>& p, const Vec3<T>& n) {
    if (!is_lit(light, p)) return T(0);
    const Vec3<T> facing = glm::dot(p - light.centre, light.normal) < T(0) ? -light.normal : light.normal;
    const Vec3<T> offset = most_representative_plane_point(p, n, light.centre, facing) - light.centre;
    const T length = glm::length(offset);
    const Vec3<T> point = light.centre + (length > light.radius ? offset * (light.radius / length) : offset);
    return solid_angle(light, p) * std::max(glm::dot(n, glm::normalize(point - p)), T(0));
}

/// The same for a sphere: of the disk that p sees in its place, as large and facing p. Over all tilts the largest
/// error is 0.50, 0.44, 0.24 and 0.12 of the solid angle at 1.1, 2, 4 and 8 radii. pi inside.
template <class T>
T projected_solid_angle_mrp(const SphereLight<T>& light, const Vec3<T>& p, const Vec3<T>& n) {
    if (is_inside(light, p)) return std::numbers::pi_v<T>;
    if (!(light.radius > T(0))) return T(0);
    const T scale2 = rim_scale2(light, p);
    const Vec3<T> c = light.centre - p;
    return projected_solid_angle_mrp(
        DiskLight<T>{p + scale2 * c, -glm::normalize(c), light.radius * std::sqrt(scale2)}, p, n);
}

/// Solid angle times the mean clamped cosine of structured sampling, sr: the centre and four points of the rim,
/// on the axis towards the receiver's normal and across it (the pattern of Lagarde & de Rousiers 2014, 4.7.2.5,
/// who have it for rectangles alone). Over all directions and tilts the largest error is 0.47, 0.076, 0.024 and 0.0048
/// of the solid angle at 1, 2, 4 and 8 radii.
template <class T>
T projected_solid_angle_structured(const DiskLight<T>& light, const Vec3<T>& p, const Vec3<T>& n) {
    if (!is_lit(light, p)) return T(0);
    const AxisFrame<T> frame = frame_towards(light.normal, n);
    return solid_angle(light, p) *
           mean_cross_cosine(light.centre - p, light.radius * frame.x, light.radius * frame.y, n);
}

/// A point of the disk, uniform in area. u1 chooses the radius, u2 the azimuth; both in [0, 1).
template <class T>
Vec3<T> sample_disk_area(const DiskLight<T>& light, T u1, T u2) {
    const SinCos azimuth = sin_cos_pi(2 * static_cast<double>(u2));
    const T r = light.radius * std::sqrt(u1);
    const AxisFrame<T> frame = frame_about(light.normal);
    return light.centre + r * static_cast<T>(azimuth.cos) * frame.x +
           r * static_cast<T>(azimuth.sin) * frame.y;
}

/// The density of sample_disk_area on the disk, 1/m^2 for positions in m; radius > 0.
template <class T>
T pdf_area(const DiskLight<T>& light) {
    return T(1) / surface_area(light);
}

/// The (u1, u2) that sample_disk_area turns into a point of the disk.
template <class T>
Sample2 inverse_disk_area(const DiskLight<T>& light, const Vec3<T>& point) {
    const Vec3<T> local = frame_about(light.normal).to_local(point - light.centre);
    const T u1 = (local.x * local.x + local.y * local.y) / (light.radius * light.radius);
    return {static_cast<double>(std::min(u1, T(1))), static_cast<double>(azimuth_turns(local.x, local.y))};
}

}  // namespace pbr
