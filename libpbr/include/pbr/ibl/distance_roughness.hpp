#pragma once
// Distance-based roughness of local probes. T is float or double.
//
// A lobe's footprint on the proxy grows with distance, but the probe was prefiltered at the distance of its
// capture point. The cone that holds a share s of D NoH has tan = alpha sqrt(s / (1 - s)) (from sampling it,
// Walter et al. 2007, eq. 35), so the footprint of radius d tan on a wall square to the ray is kept if alpha'
// d_capture = alpha d_point.

#include <algorithm>

namespace pbr {

/// alpha times distance_to_point / distance_to_capture, at most alpha: keeps the footprint of every share of
/// the lobe exactly, as far as the proxy is a wall square to the ray. Distances >= 0 in one unit; alpha in
/// [0, 1]. A capture point on the proxy (distance 0), or both infinite, leaves alpha. Never above alpha: a
/// probe cannot be sharper than its source, and blurring beyond the lobe shows seams.
template <class T>
T distance_based_alpha(T distance_to_point, T distance_to_capture, T alpha) {
    if (!(distance_to_point < distance_to_capture))
        return alpha;  // NaN-free: also Inf against Inf, 0 against 0
    return alpha * (distance_to_point / distance_to_capture);
}

/// Frostbite's: the same ratio on *perceptual* roughness p, mixed back to p by p itself: lerp(min(p, p
/// d_point / d_capture), p, p) (Lagarde & de Rousiers 2014, listing 25, computeDistanceBaseRoughness). Domain
/// and edges as above. Chosen for its look: the footprint asks for p sqrt(ratio), so near walls it is too
/// sharp on smooth surfaces (at p = .1, ratio .1: .019 for .032) and too blurred on rough ones (at p = .6,
/// ratio .1: .384 for .19).
template <class T>
T distance_based_perceptual_roughness(T distance_to_point, T distance_to_capture, T perceptual_roughness) {
    if (!(distance_to_point < distance_to_capture)) return perceptual_roughness;
    const T scaled = perceptual_roughness * (distance_to_point / distance_to_capture);
    return scaled + perceptual_roughness * (perceptual_roughness - scaled);
}

}  // namespace pbr
