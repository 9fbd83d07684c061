#pragma once
// The tube light, a capsule: a cylinder closed by two half spheres. Projected solid angle two ways, sampling
// of its area. T is float or double; what is exact is evaluated in double for both.

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

/// All points within radius of the segment from end0 to end1, shining outwards. Its length over all is
/// |end1 - end0| + 2 radius; equal ends make a sphere. A point inside is surrounded by its luminance, as in a
/// sphere.
template <class T>
struct TubeLight {
    Vec3<T> end0;
    Vec3<T> end1;
    T radius;
};

/// What conversions of units need to know of it (light/unit_conversions.hpp). Positions in m.
template <class T>
Emitter<T> emitter_of(const TubeLight<T>& light) {
    return emitter_tube(light.radius, glm::length(light.end1 - light.end0));
}

/// Area of the surface: 2 pi r (l + 2 r), l = |end1 - end0|.
template <class T>
T surface_area(const TubeLight<T>& light) {
    return emitter_of(light).area_m2;
}

/// Exact, sr, for the whole capsule with its caps: Lambert's contour integral around its outline, which is
/// made of two arcs of great circles and two of the end spheres' small circles, clipped to the horizon. n is
/// the unit normal. pi inside. radius 0 shines nowhere. Absolute error below 1e-13, and below 1e-15 length /
/// distance from the axis.
double projected_solid_angle(const TubeLight<double>& light, const Vec3<double>& p, const Vec3<double>& n);

/// The same, rounded to float.
inline float projected_solid_angle(const TubeLight<float>& light, const Vec3<float>& p,
                                   const Vec3<float>& n) {
    const TubeLight<double> exact{Vec3<double>(light.end0), Vec3<double>(light.end1),
                                  static_cast<double>(light.radius)};
    return static_cast<float>(projected_solid_angle(exact, Vec3<double>(p), Vec3<double>(n)));
}

/// The point of segment a b nearest to p.
template <class T>
Vec3<T> closest_point_on_segment(const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& p) {
    const Vec3<T> along = b - a;
    const T length2 = glm::dot(along, along);
    return length2 > T(0) ? a + std::clamp(glm::dot(p - a, along) / length2, T(0), T(1)) * along : a;
}

/// The rectangle of a tube's length (caps apart) and diameter about its axis, turned towards p. Of no area
/// for equal ends, and for p on the axis' line.
template <class T>
RectangleLight<T> rectangle_facing(const TubeLight<T>& light, const Vec3<T>& p) {
    const Vec3<T> half = T(0.5) * (light.end1 - light.end0), centre = light.end0 + half;
    const Vec3<T> across = glm::cross(half, p - centre);
    const T length = glm::length(across);
    // half x across points away from p: two-sided, so that this doesn't matter.
    return {centre, half, length > T(0) ? across * (light.radius / length) : Vec3<T>(0), Emission::two_sided};
}

/// Projected solid angle, sr, of a tube as Frostbite puts it together: of_rectangle of the rectangle that faces
/// p, plus a whole sphere at the point of the axis nearest to p, without horizon handling. pi inside.
template <class T, class OfRectangle>
T projected_solid_angle_by_parts(const TubeLight<T>& light, const Vec3<T>& p, const Vec3<T>& n,
                                 const OfRectangle& of_rectangle) {
    const Vec3<T> to_axis = closest_point_on_segment(light.end0, light.end1, p) - p;
    const T d2 = glm::dot(to_axis, to_axis), r2 = light.radius * light.radius;
    if (d2 < r2) return std::numbers::pi_v<T>;
    if (!(r2 > T(0))) return T(0);
    const T cosine = std::max(glm::dot(n, to_axis) / std::sqrt(d2), T(0));
    return of_rectangle(rectangle_facing(light, p)) +
           std::numbers::pi_v<T> * cosine * r2 / d2;
}

/// Frostbite's tube, sr: the rectangle that faces p by structured sampling, plus a whole sphere at the point
/// of the axis nearest to p without horizon handling (Lagarde & de Rousiers 2014, 4.7.2.6). The two overlap:
/// for a tube ten times as long as its radius it is high by 23 % at 0.2 radii from its side, and over pi at
/// its surface; right at half its length within 1 %. Over all directions and tilts the largest error is 0.25
/// and 0.14 of what a facing receiver gets at 0.75 and 4 lengths. p outside the tube (inside: pi).
template <class T>
T projected_solid_angle_structured(const TubeLight<T>& light, const Vec3<T>& p, const Vec3<T>& n) {
    return projected_solid_angle_by_parts(
        light, p, n, [&](const RectangleLight<T>& r) { return projected_solid_angle_structured(r, p, n); });
}

/// The same with the rectangle by its most representative point. Over all directions and tilts the largest
/// error is 0.47 and 0.14 of what a facing receiver gets at 0.75 and 4 lengths. p outside the tube (inside: pi).
template <class T>
T projected_solid_angle_mrp(const TubeLight<T>& light, const Vec3<T>& p, const Vec3<T>& n) {
    return projected_solid_angle_by_parts(
        light, p, n, [&](const RectangleLight<T>& r) { return projected_solid_angle_mrp(r, p, n); });
}

/// A point of the tube's surface, uniform in area. u1 chooses the height along the axis, u2 the azimuth; both
/// in [0, 1). Height is uniform over caps and cylinder alike (Archimedes: a sphere has the area of its
/// cylinder).
template <class T>
Vec3<T> sample_tube_area(const TubeLight<T>& light, T u1, T u2) {
    const Vec3<T> along = light.end1 - light.end0;
    const T length = glm::length(along);
    const AxisFrame<T> frame = frame_about(length > T(0) ? along / length : Vec3<T>(0, 0, 1));
    const T height = u1 * (length + T(2) * light.radius) - light.radius;
    const T in_cap = height - std::clamp(height, T(0), length);
    const T r = std::sqrt(std::max((light.radius - in_cap) * (light.radius + in_cap), T(0)));
    const SinCos azimuth = sin_cos_pi(2 * static_cast<double>(u2));
    return light.end0 +
           frame.to_world({r * static_cast<T>(azimuth.cos), r * static_cast<T>(azimuth.sin), height});
}

/// The density of sample_tube_area on the surface, 1/m^2 for positions in m; radius > 0.
template <class T>
T pdf_area(const TubeLight<T>& light) {
    return T(1) / surface_area(light);
}

/// The (u1, u2) that sample_tube_area turns into a point of the surface.
template <class T>
Sample2 inverse_tube_area(const TubeLight<T>& light, const Vec3<T>& point) {
    const Vec3<T> along = light.end1 - light.end0;
    const T length = glm::length(along);
    const Vec3<T> local =
        frame_about(length > T(0) ? along / length : Vec3<T>(0, 0, 1)).to_local(point - light.end0);
    const T u1 = (local.z + light.radius) / (length + T(2) * light.radius);
    return {static_cast<double>(std::clamp(u1, T(0), T(1))),
            static_cast<double>(azimuth_turns(local.x, local.y))};
}

}  // namespace pbr
