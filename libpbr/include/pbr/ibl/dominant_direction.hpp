#pragma once
// The direction in which one look-up stands best for a whole lobe. T is float or double.
//
// Masking and NoL move a rough lobe from the mirror direction R towards the normal N. The models give a
// factor: 1 is R, 0 is N, the direction normalize(lerp(N, R, factor)).

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "pbr/numerics/vector.hpp"

namespace pbr {

/// Frostbite's second formula, the one it ships (Lagarde & de Rousiers 2014, listing 22): (1 - alpha)(sqrt(1
/// - alpha) + alpha), for either form of Smith's G. alpha in [0, 1]; 1 at 0, 0 at 1. `roughness` in the
/// listing is alpha: with perceptual roughness listing 21 misses its peaks. Neither the lobe's peak nor its
/// mean but a compromise of the look-up: 26 degrees from the mean of the correlated lobe at worst (NoV = .1,
/// alpha = .5), where R is 58 away. In the split sum under a smooth sky it takes back half of the error and
/// more for alpha >= .5 (tests: .52 to .21 at alpha .5, NoV .3), a third at .25; for smooth surfaces seen
/// from above it does harm (.011 to .019 at alpha .1, NoV .9).
template <class T>
T dominant_factor_frostbite(T alpha) {
    const T smoothness = std::clamp(T(1) - alpha, T(0), T(1));
    return smoothness * (std::sqrt(smoothness) + alpha);
}

/// Frostbite's first formula, fitted to the off-specular peak with height-correlated G (listing 21,
/// GSMITH_CORRELATED), clamped to [0, 1], which the listing leaves to its caller (unclamped it overshoots R
/// by a tenth at alpha = 0). NoV, alpha in [0, 1]. Within 9 degrees of the brightest direction of D V NoL for
/// NoV >= .1, but up to 58 degrees from the mean, so in the split sum it is hardly better than R (.52 to .45
/// at alpha .5, NoV .3): as its authors say, precise and of little use there. In float within 2e-5 for alpha
/// < .99 and NoV > 1e-3; beyond, logarithm and power enlarge the arguments' own roundings.
template <class T>
T dominant_factor_peak_correlated(T NoV, T alpha) {
    const T at_normal = T(0.298475) * std::log(T(39.4115) - T(39.0029) * alpha);
    const T grazing = std::pow(T(1) - NoV, T(10.8649));
    return std::clamp(at_normal + grazing * (T(1) - at_normal), T(0), T(1));
}

/// The same for uncorrelated G (listing 21, the other branch). Within 3 degrees of the brightest direction
/// for NoV >= .1.
template <class T>
T dominant_factor_peak_uncorrelated(T NoV, T alpha) {
    const T at_normal = T(0.298475) * std::log(T(39.4115) - T(39.0029) * alpha);
    const T grazing = T(0.385503) * std::log(T(13.1567) - T(12.2848) * alpha);
    return std::clamp(NoV * at_normal + (T(1) - NoV) * grazing, T(0), T(1));
}

/// Filament's (shaders/src/light_indirect.fs, getSpecularDominantDirection): 1 - alpha^2, alpha in [0, 1]. Up
/// to 40 degrees from the mean (NoV = .1, alpha = .5), but never worse than R under a smooth sky.
template <class T>
T dominant_factor_filament(T alpha) {
    return T(1) - alpha * alpha;
}

/// The direction of a factor in [0, 1], unit (cube maps don't need that, harmonics do). N and R unit, N.R >=
/// 0.
template <class T>
Vec3<T> dominant_direction(const Vec3<T>& N, const Vec3<T>& R, T factor) {
    return glm::normalize(N + factor * (R - N));
}

/// The direction for Disney's diffuse lobe, which leans back to the viewer V: normalize(lerp(N, V, factor)),
/// factor = clamp((NoV (1.02341 alpha - 1.51174) - .511705 alpha + .755868) alpha) (listing 23; 15 for area
/// lights). N and V unit, NoV = N.V and alpha in [0, 1]; `roughness` in the listing is alpha, as listing 24
/// passes it (perceptual roughness would miss by 5.7 degrees). Within 4.7 degrees of the mean of the
/// renormalised lobe for NoV >= .1, which is itself at most 11.4 from N; for NoV >= .5 it returns N, off by
/// at most 2.2 degrees. Frostbite itself leaves it out for cost.
template <class T>
Vec3<T> dominant_diffuse_direction(const Vec3<T>& N, const Vec3<T>& V, T NoV, T alpha) {
    const T slope = T(1.02341) * alpha - T(1.51174);
    const T offset = T(-0.511705) * alpha + T(0.755868);
    const T factor = std::clamp((NoV * slope + offset) * alpha, T(0), T(1));
    return glm::normalize(N + factor * (V - N));
}

}  // namespace pbr
