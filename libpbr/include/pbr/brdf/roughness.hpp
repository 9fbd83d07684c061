#pragma once
// The one place where roughness changes its scale.
//
// smoothness            what Frostbite's artists author, 1 - perceptual_roughness
// perceptual_roughness  what most engines author; the Frostbite notes call it linear roughness
// alpha                 its square, the width parameter of GGX (Burley 2012, "Physically-based shading at
// Disney", 5.4)

namespace pbr {

/// perceptual_roughness^2. Domain [0, 1], range [0, 1], ends kept; exact to one rounding.
template <class T>
constexpr T alpha_from_perceptual_roughness(T perceptual_roughness) {
    return perceptual_roughness * perceptual_roughness;
}

/// 1 - smoothness, its own inverse. Domain [0, 1], range [0, 1], ends swapped; exact to one rounding.
template <class T>
constexpr T perceptual_roughness_from_smoothness(T smoothness) {
    return T(1) - smoothness;
}

/// Inverse of alpha_from_perceptual_roughness, sqrt(alpha). Domain [0, 1], range [0, 1], ends kept; exact to
/// one rounding.
template <class T>
T perceptual_roughness_from_alpha(T alpha);

/// Perceptual roughness of a probe's mip level with the linear mapping level = (levels - 1) *
/// perceptual_roughness. level in [0, levels - 1]; a chain of one level is the mirror, 0. Exact to one
/// rounding.
constexpr double perceptual_roughness_from_level(double level, int levels) {
    return levels > 1 ? level / (levels - 1) : 0.0;
}

/// Mip level to sample for a perceptual roughness in [0, 1]; the inverse of perceptual_roughness_from_level
/// for levels >= 2, else 0. Exact to one rounding.
constexpr double level_from_perceptual_roughness(double perceptual_roughness, int levels) {
    return perceptual_roughness * (levels - 1);
}

}  // namespace pbr

#include <cmath>

template <class T>
T pbr::perceptual_roughness_from_alpha(T alpha) {
    return std::sqrt(alpha);
}
