#pragma once
// Parallax correction of local light probes by proxy shapes. T is float or double.
//
// A probe was captured at one point; seen from another, its picture is taken as painted on a proxy that
// stands for the surroundings. The ray from the shaded point is met with the proxy's inside, and the picture
// looked up towards that point (Lagarde & Zanuttini 2012, "Local image-based lighting with parallax-corrected
// cubemaps", SIGGRAPH; Lagarde & de Rousiers 2014, 4.9.3). Directions are unit vectors, lengths in metres, or
// any one unit.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>
#include <optional>

#include "pbr/numerics/vector.hpp"

namespace pbr {

/// A box in the world. `axes` has orthonormal columns, the box's own x, y, z; half extents are positive.
template <class T>
struct OrientedBox {
    Vec3<T> centre{T(0)};
    glm::mat<3, 3, T> axes{T(1)};
    Vec3<T> half_extent{T(1)};

    /// A world point in the box's own frame.
    Vec3<T> to_local(const Vec3<T>& point) const { return (point - centre) * axes; }
};

/// A ball in the world; radius > 0.
template <class T>
struct ProxySphere {
    Vec3<T> centre{T(0)};
    T radius = T(1);
};

/// Distance along a ray to where it leaves the box for good, nothing if it never touches the box in front of
/// its origin. From inside that is the wall that it sees; from outside, the far wall. Components of 0 in the
/// direction are allowed.
template <class T>
std::optional<T> exit_distance(const OrientedBox<T>& box, const Vec3<T>& origin, const Vec3<T>& direction) {
    const Vec3<T> o = box.to_local(origin), d = direction * box.axes;
    T enter = -std::numeric_limits<T>::infinity(), leave = std::numeric_limits<T>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        if (d[axis] == T(0)) {
            if (std::abs(o[axis]) > box.half_extent[axis]) return std::nullopt;
            continue;
        }
        const T far_wall = std::copysign(box.half_extent[axis], d[axis]);
        enter = std::max(enter, (-far_wall - o[axis]) / d[axis]);
        leave = std::min(leave, (far_wall - o[axis]) / d[axis]);
    }
    if (leave < T(0) || leave < enter) return std::nullopt;
    return leave;
}

/// The same for a ball. No cancellation for far origins beyond that of the inputs.
template <class T>
std::optional<T> exit_distance(const ProxySphere<T>& sphere, const Vec3<T>& origin,
                               const Vec3<T>& direction) {
    const Vec3<T> o = origin - sphere.centre;
    const T towards = glm::dot(o, direction);
    const Vec3<T> closest = o - towards * direction;
    const T half_chord2 = sphere.radius * sphere.radius - glm::dot(closest, closest);
    if (half_chord2 < T(0)) return std::nullopt;
    const T half_chord = std::sqrt(half_chord2);
    // -towards + half_chord; for an origin that has passed the centre, from the product of the two roots
    // instead.
    const T outside = (glm::length(o) - sphere.radius) * (glm::length(o) + sphere.radius);
    const T leave = towards > T(0) ? -outside / (towards + half_chord) : half_chord - towards;
    if (leave < T(0)) return std::nullopt;
    return leave;
}

/// A corrected look-up.
template <class T>
struct ParallaxLookup {
    Vec3<T> direction;      ///< unit, from the capture point: look the probe up here
    T distance_to_point;    ///< from the shaded point to the proxy; +Inf without a hit
    T distance_to_capture;  ///< from the capture point to the same place; +Inf without a hit
    bool hit;               ///< false: the ray misses the proxy, and `direction` is the one given
};

/// The probe's direction for a ray from `point` along `direction`. `capture` is where the probe was taken,
/// which need not be the proxy's centre. Without a hit (a point outside looking past the proxy) the direction
/// is left as it is: infinitely far surroundings. A place that coincides with the capture point also leaves
/// the direction. From the capture point itself the direction comes back within a few roundings. Seen from
/// inside, continuous in point and direction. In float the direction is within 2e-5 for points inside a box
/// of some metres, up to nine tenths of the way to its walls, and a capture point within half; beside a wall
/// the way to the capture point may shrink to nothing, and its direction's error grows with that.
template <class Proxy, class T>
ParallaxLookup<T> parallax_corrected(const Proxy& proxy, const Vec3<T>& capture, const Vec3<T>& point,
                                     const Vec3<T>& direction) {
    constexpr T kInfinity = std::numeric_limits<T>::infinity();
    const std::optional<T> distance = exit_distance(proxy, point, direction);
    if (!distance) return {direction, kInfinity, kInfinity, false};
    const Vec3<T> from_capture = point - capture + *distance * direction;
    const T length = glm::length(from_capture);
    if (!(length > T(0))) return {direction, *distance, T(0), true};
    return {from_capture / length, *distance, length, true};
}

/// Frostbite's softening of the correction: the corrected direction at perceptual roughness 0, the given one
/// at 1, between them the normalised mixture, since a wide lobe on a coarse proxy only shows the proxy's
/// seams (Lagarde & de Rousiers 2014, 4.9.3). Opposite directions mixed half and half give the given one.
template <class T>
Vec3<T> parallax_softened(const Vec3<T>& corrected, const Vec3<T>& given, T perceptual_roughness) {
    const Vec3<T> mixed = corrected + perceptual_roughness * (given - corrected);
    const T length = glm::length(mixed);
    return length > std::numeric_limits<T>::epsilon() ? mixed / length : given;
}

}  // namespace pbr
