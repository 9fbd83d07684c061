#pragma once
// Orthonormal frames. T is float or double.

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "pbr/numerics/vector.hpp"

namespace pbr {

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

/// A frame about the unit vector z whose x axis is turned towards `towards`; any, where that lies along z.
template <class T>
AxisFrame<T> frame_towards(const Vec3<T>& z, const Vec3<T>& towards) {
    const Vec3<T> flat = towards - glm::dot(towards, z) * z;
    const T length = glm::length(flat);
    if (!(length > T(8) * std::numeric_limits<T>::epsilon())) return frame_about(z);
    const Vec3<T> nearly = flat / length, x = glm::normalize(nearly - glm::dot(nearly, z) * z);
    return {x, glm::cross(z, x), z};
}

}  // namespace pbr
