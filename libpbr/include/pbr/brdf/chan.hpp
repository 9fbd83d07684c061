#pragma once
// Chan's diffuse, a fit to the multiple-scattering GGX diffuse of Call of Duty: WWII. T is float or double.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pbr/brdf/fresnel.hpp"

namespace pbr {

/// The diffuse BRDF of a white base under a rough dielectric surface, 1/sr; multiply by the diffuse colour,
/// 1/pi is inside (Chan 2018, "Material advances in Call of Duty: WWII", the fit of its diffuse chapter;
/// constants agree with Unreal's Diffuse_Chan). NoL, NoV, NoH, LoH in [0, 1]; alpha in [0, 1] is the specular
/// lobe's, turned into the game's gloss by alpha^2 = 2 / (1 + 2^(18 gloss)), so that alpha below .00276 is
/// alpha .00276. Reciprocal. Not energy conserving: its albedo runs from .241 (smooth, grazing view) to 1.158
/// (alpha 1, grazing view), and its mean over views from .890 (alpha .084) to .955 (alpha 1); above 1 at
/// grazing views from alpha .49 up. alpha = 0 is allowed. Absolute error below 16 ulp of 1.
template <class T>
T f_chan(T NoL, T NoV, T NoH, T LoH, T alpha) {
    const T gloss = std::clamp(std::log2(T(2) / (alpha * alpha) - T(1)) / T(18), T(0), T(1));
    const T rough = LoH + schlick_weight(LoH);
    const T smooth = (T(1) - T(0.75) * schlick_weight(NoL)) * (T(1) - T(0.75) * schlick_weight(NoV));
    const T base = rough + (smooth - rough) * std::clamp(T(2.2) * gloss - T(0.5), T(0), T(1));
    const T bump = ((T(34.5) * gloss - T(59)) * gloss + T(24.5)) * LoH *
                   std::exp2(-std::max(T(73.2) * gloss - T(21.2), T(8.9)) * std::sqrt(NoH));
    return (base + bump) * std::numbers::inv_pi_v<T>;
}

/// Directional albedo of f_chan: its integral times NoL over the hemisphere. NoV and alpha in [0, 1].
/// Absolute error below 1e-11 (a product rule of 24 heights by 16 azimuths).
double albedo_chan(double NoV, double alpha);

}  // namespace pbr
