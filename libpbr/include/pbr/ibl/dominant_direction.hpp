#pragma once
// The direction in which one look-up stands best for a whole lobe. T is float or double.
//
// Masking and NoL move a rough lobe from the mirror direction R towards the normal N. The models give a factor: 1 is R, 0 is N, the
// direction normalize(lerp(N, R, factor)).

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "pbr/numerics/vector.hpp"

namespace pbr {

/// FIGURES
template <class T>
T dominant_factor_frostbite(T alpha) {
    const T smoothness = std::clamp(T(1) - alpha, T(0), T(1));
    return smoothness * (std::sqrt(smoothness) + alpha);
}

/// FIGURES
template <class T>
T dominant_factor_peak_correlated(T NoV, T alpha) {
    const T at_normal = T(0.298475) * std::log(T(39.4115) - T(39.0029) * alpha);
    const T grazing = std::pow(T(1) - NoV, T(10.8649));
    return std::clamp(at_normal + grazing * (T(1) - at_normal), T(0), T(1));
}

/// FIGURES
template <class T>
T dominant_factor_peak_uncorrelated(T NoV, T alpha) {
    const T at_normal = T(0.298475) * std::log(T(39.4115) - T(39.0029) * alpha);
    const T grazing = T(0.385503) * std::log(T(13.1567) - T(12.2848) * alpha);
    return std::clamp(NoV * at_normal + (T(1) - NoV) * grazing, T(0), T(1));
}

/// Filament's (shaders/src/light_indirect.fs, getSpecularDominantDirection): 1 - alpha^2.
template <class T>
T dominant_factor_filament(T alpha) {
    return T(1) - alpha * alpha;
}

template <class T>
Vec3<T> dominant_direction(const Vec3<T>& N, const Vec3<T>& R, T factor) {
    return glm::normalize(N + factor * (R - N));
}

template <class T>
Vec3<T> dominant_diffuse_direction(const Vec3<T>& N, const Vec3<T>& V, T NoV, T r) {
    const T a = T(1.02341) * r - T(1.51174);
    const T b = T(-0.511705) * r + T(0.755868);
    const T factor = std::clamp((NoV * a + b) * r, T(0), T(1));
    return glm::normalize(N + factor * (V - N));
}

}  // namespace pbr
