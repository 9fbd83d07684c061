#pragma once
// The rectangle light: projected solid angle three ways, and solid angle. T is float or double; evaluation is
// in double for both, since corners of a small light far away are lost to the rounding of float positions.

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "pbr/light/area_light.hpp"
#include "pbr/light/polygon.hpp"
#include "pbr/light/unit_conversions.hpp"

namespace pbr {

/// half_x and half_y go from the centre to the middles of two sides and are perpendicular; its front is the
/// side of half_x x half_y. A zero half axis has no area and shines nowhere.
template <class T>
struct RectangleLight {
    Vec3<T> centre;
    Vec3<T> half_x;
    Vec3<T> half_y;
    Emission emission = Emission::one_sided;
};

/// The same rectangle in double.
template <class T>
RectangleLight<double> in_double(const RectangleLight<T>& light) {
    return {Vec3<double>(light.centre), Vec3<double>(light.half_x), Vec3<double>(light.half_y),
            light.emission};
}

/// What conversions of units need to know of it (light/unit_conversions.hpp): both faces of a two-sided light
/// emit, one is seen. Positions in m.
template <class T>
Emitter<T> emitter_of(const RectangleLight<T>& light) {
    const Emitter<T> one_face = emitter_rectangle(T(2) * glm::length(light.half_x), T(2) * glm::length(light.half_y));
    return {T(face_count(light.emission)) * one_face.area_m2, one_face.facing_area_m2};
}

/// Area of one face: 4 |half_x| |half_y|.
template <class T>
T surface_area(const RectangleLight<T>& light) {
    return emitter_of(light).facing_area_m2;
}

/// Unit normal of the front; the zero vector for a rectangle of no area.
template <class T>
Vec3<T> front_normal(const RectangleLight<T>& light) {
    const Vec3<T> normal = glm::cross(light.half_x, light.half_y);
    const T length = glm::length(normal);
    return length > T(0) ? normal / length : Vec3<T>(0);
}

/// The corners, counterclockwise seen from the front.
template <class T>
std::array<Vec3<T>, 4> corners(const RectangleLight<T>& light) {
    return {light.centre - light.half_x - light.half_y, light.centre + light.half_x - light.half_y,
            light.centre + light.half_x + light.half_y, light.centre - light.half_x + light.half_y};
}

/// Whether the rectangle's lit side faces p. False in its plane and for a rectangle of no area.
template <class T>
bool is_lit(const RectangleLight<T>& light, const Vec3<T>& p) {
    return lit_height(p, light.centre, front_normal(light), light.emission) > T(0);
}

/// Solid angle, sr, in [0, 2 pi), as two triangles (solid_angle_triangle, its error). 0 in the plane, behind
/// a one-sided light, and for no area.
template <class T>
T solid_angle(const RectangleLight<T>& light, const Vec3<T>& p) {
    const RectangleLight<double> exact = in_double(light);
    const Vec3<double> from(p);
    if (!is_lit(exact, from)) return T(0);
    const auto [a, b, c, d] = corners(exact);
    return static_cast<T>(
        std::abs(solid_angle_triangle(a, b, c, from) + solid_angle_triangle(a, c, d, from)));
}

/// Exact, sr; error of projected_solid_angle_polygon. n is the unit normal. 0 where is_lit is false.
template <class T>
T projected_solid_angle(const RectangleLight<T>& light, const Vec3<T>& p, const Vec3<T>& n) {
    const RectangleLight<double> exact = in_double(light);
    const Vec3<double> from(p);
    if (!is_lit(exact, from)) return T(0);
    const std::array<Vec3<double>, 4> vertices = corners(exact);
    return static_cast<T>(std::abs(projected_solid_angle_polygon<double>(vertices, from, Vec3<double>(n))));
}

/// Mean of max(0, n.l) over the directions l from p to the corners and the centre of a rectangle.
template <class T>
T mean_corner_cosine(const RectangleLight<T>& light, const Vec3<T>& p, const Vec3<T>& n) {
    const auto cosine = [&](const Vec3<T>& x) { return std::max(glm::dot(n, glm::normalize(x - p)), T(0)); };
    T sum = cosine(light.centre);
    for (const Vec3<T>& corner : corners(light)) sum += cosine(corner);
    return sum / T(5);
}

/// Frostbite's choice for rectangles, sr: solid angle times the mean clamped cosine of the corners and the
/// centre (Lagarde & de Rousiers 2014, 4.7.2.5), with the solid angle exact. Low head-on, as corners count
/// too much: by 47, 20, 8.7 and 0.7 % on the axis of a square at 0.1, 0.5, 1 and 4 sides. Over all directions
/// and tilts the largest error is 0.52, 0.10, 0.037 and 0.019 of the solid angle at 0.5, 1, 2 and 4 sides.
template <class T>
T projected_solid_angle_structured(const RectangleLight<T>& light, const Vec3<T>& p, const Vec3<T>& n) {
    const T omega = solid_angle(light, p);
    return omega > T(0) ? omega * mean_corner_cosine(light, p, n) : T(0);
}

/// The point of the rectangle nearest to x, for x in its plane.
template <class T>
Vec3<T> closest_point(const RectangleLight<T>& light, const Vec3<T>& x) {
    const Vec3<T> offset = x - light.centre;
    const auto coordinate = [&](const Vec3<T>& half) {
        const T length2 = glm::dot(half, half);
        return length2 > T(0) ? std::clamp(glm::dot(offset, half) / length2, T(-1), T(1)) : T(0);
    };
    return light.centre + coordinate(light.half_x) * light.half_x + coordinate(light.half_y) * light.half_y;
}

/// Where the bisector of the receiver's normal and the way to a light's plane meets that plane (Drobot 2014,
/// "Physically based area lights", GPU Pro 5; Lagarde & de Rousiers 2014, 4.7.2.5): the point that counts
/// most for the cosine of the receiver times that of the light, before it is moved into the light's outline.
/// light_normal is the light's, on the side of p. A bisector that misses the plane, as where n looks away
/// from the light, gives the foot of p.
template <class T>
Vec3<T> most_representative_plane_point(const Vec3<T>& p, const Vec3<T>& n, const Vec3<T>& centre,
                                        const Vec3<T>& light_normal) {
    const T tilt = T(0.001) + std::clamp(glm::dot(n, light_normal), T(0), T(1));  // the published clamp
    const Vec3<T> towards_plane = glm::normalize(n * tilt - light_normal);
    const Vec3<T> along_normal = glm::normalize(n - light_normal * tilt);
    const Vec3<T> bisector =
        towards_plane + along_normal;  // 0 where the receiver turns its back to the light
    const T height = glm::dot(p - centre, light_normal);
    const T descent = -glm::dot(bisector, light_normal);
    return descent > T(1e-3) ? p + bisector * (height / descent) : p - height * light_normal;
}

/// Solid angle times the clamped cosine at the most representative point, sr (Drobot 2014; Lagarde & de
/// Rousiers 2014, 4.7.2.5). Known to be poor beside the light and blind to the horizon's cut: over all
/// directions and tilts the largest error is 0.58, 0.48, 0.30 and 0.15 of the solid angle at 0.5, 1, 2 and 4
/// sides of a square.
template <class T>
T projected_solid_angle_mrp(const RectangleLight<T>& light, const Vec3<T>& p, const Vec3<T>& n) {
    if (!is_lit(light, p)) return T(0);
    Vec3<T> normal = front_normal(light);
    if (glm::dot(p - light.centre, normal) < T(0)) normal = -normal;
    const Vec3<T> point = closest_point(light, most_representative_plane_point(p, n, light.centre, normal));
    return solid_angle(light, p) * std::max(glm::dot(n, glm::normalize(point - p)), T(0));
}

}  // namespace pbr
