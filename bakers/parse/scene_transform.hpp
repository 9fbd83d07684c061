#pragma once
// Places of nodes in a scene: products of the transformations above them.

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "bakers/parse/lights.hpp"
#include "pbr/numerics/elementary.hpp"

namespace pbrbake::parse {

/// Sixteen numbers, column after column, as glTF and three.js have them; rows if `by_rows` (COLLADA).
inline glm::dmat4 matrix_of(const std::vector<double>& numbers, bool by_rows = false) {
    glm::dmat4 matrix(1);
    for (int i = 0; i < 16; ++i) {
        const double value = numbers[static_cast<std::size_t>(i)];
        (by_rows ? matrix[i % 4][i / 4] : matrix[i / 4][i % 4]) = value;
    }
    return matrix;
}

/// Translation times rotation (x, y, z, w) times scale.
inline glm::dmat4 matrix_of(const glm::dvec3& translation, const std::vector<double>& rotation,
                            const glm::dvec3& scale) {
    glm::dmat4 matrix = glm::mat4_cast(glm::dquat(rotation[3], rotation[0], rotation[1], rotation[2]));
    for (int i = 0; i < 3; ++i) matrix[i] *= scale[i];
    matrix[3] = glm::dvec4(translation, 1);
    return matrix;
}

/// Turns by an angle, in half turns, about an axis of any length; one of length 0 turns nothing.
inline glm::dmat4 turn_about(const glm::dvec3& axis, double half_turns) {
    const double length = std::sqrt(axis.x * axis.x + axis.y * axis.y + axis.z * axis.z);
    if (!(length > 0)) return glm::dmat4(1);
    const pbr::SinCos half = pbr::sin_cos_pi(std::fmod(half_turns, 4.) / 2);
    const glm::dvec3 v = axis / length * half.sin;
    return matrix_of(glm::dvec3(0), {v.x, v.y, v.z, half.cos}, glm::dvec3(1));
}

/// Puts a light where a node is: at its origin, shining along its -Z.
inline void place(LegacyLight& light, const glm::dmat4& node) {
    light.position = glm::dvec3(node[3]);
    light.direction = -glm::dvec3(node[2]);
}

}  // namespace pbrbake::parse
