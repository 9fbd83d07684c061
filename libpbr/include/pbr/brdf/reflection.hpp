#pragma once
// The angles a reflection from wi to wo is made of. T is float or double.

#include <cmath>
#include <glm/geometric.hpp>

#include "pbr/numerics/vector.hpp"

namespace pbr {

/// A pair of directions in the frame of the surface (normal +z, tangent +x), both pointing away from it, and
/// what BRDFs take from them.
template <class T>
struct Reflection {
    Vec3<T> wo;  ///< towards the eye
    Vec3<T> wi;  ///< towards the light
    Vec3<T> wm;  ///< the half vector; the normal where wo = -wi leaves none
    T NoV;
    T NoL;
    T NoH;
    T LoV;
    T LoH;   ///< = VoH
    T sin2;  ///< 1 - NoH^2, from the tangential part: no cancellation beside the normal
};

/// The reflection of unit vectors wo and wi with wo.z, wi.z in [0, 1]. Antiparallel directions (both at
/// grazing incidence) have NoH = 1, LoH = 0. Absolute error of every member below 4 ulp of 1 while |wo + wi|
/// > .1; below, the half vector's direction loses 1 / |wo + wi|.
template <class T>
Reflection<T> reflection(const Vec3<T>& wo, const Vec3<T>& wi) {
    const Vec3<T> sum = wo + wi;
    const T length = glm::length(sum);
    const Vec3<T> wm = length > T(0) ? sum / length : Vec3<T>(0, 0, 1);
    return {wo, wi, wm, wo.z, wi.z, wm.z, glm::dot(wo, wi), length / T(2), wm.x * wm.x + wm.y * wm.y};
}

}  // namespace pbr
