#pragma once
// Vectors. T is float or double.

#include <glm/vec3.hpp>

namespace pbr {

/// A direction, position or colour of T.
template <class T>
using Vec3 = glm::vec<3, T, glm::defaultp>;

}  // namespace pbr
