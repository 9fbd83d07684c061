#pragma once
// Weights by which reflections are put together: planar or screen-space first, then local probes, then the
// distant probe. T is float or double.

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "pbr/ibl/parallax.hpp"

namespace pbr {

/// Front-to-back weights. Give the layers in order, nearest information first; `coverage` is a layer's share
/// of the lobe for which it knows the radiance (a screen-space reflection's confidence, a local probe's
/// prefiltered visibility times its influence). Each call returns the layer's weight; the distant probe takes
/// remaining(). Weights lie in [0, 1] and, with remaining(), sum to 1 within rounding, so nothing is counted
/// twice.
///
/// A weight multiplies the layer's mean radiance *where it is known*. A prefiltered probe with black in place
/// of sky holds that mean times its coverage: multiply it by weight / coverage, or use visible_fallback for
/// the case of one probe.
template <class T>
class FrontToBackWeights {
  public:
    /// The layer's coverage falls on the uncovered rest as on the whole: weight = rest coverage. For layers
    /// that know nothing of each other; rest shrinks as a product (Porter & Duff 1984, "Compositing digital
    /// images", over).
    T add_independent(T coverage) {
        const T weight = rest_ * std::clamp(coverage, T(0), T(1));
        rest_ -= weight;
        return weight;
    }

    /// The layer covers what those before it covered, and possibly more: weight = what it covers beyond. Ten
    /// probes of visibility .1 cover .1, not .65 (Lagarde & de Rousiers 2014, 4.9.5). For probes of the same
    /// place. Depends on the order.
    T add_nested(T coverage) {
        const T weight = std::max(T(0), std::clamp(coverage, T(0), T(1)) - (T(1) - rest_));
        rest_ = std::max(T(0), rest_ - weight);
        return weight;
    }

    /// The share that no layer covers: the distant probe's weight.
    T remaining() const { return rest_; }

  private:
    T rest_ = T(1);
};

/// Local probe over distant probe: local + (1 - visibility) distant. `local` is prefiltered with black where
/// the capture saw the sky, `visibility` prefiltered with the same kernel from 1 (geometry) and 0 (sky), so
/// that `local` holds its weight already; both probes at the same level. In [0, 1] for any visibility
/// (clamped). Exact if the distant radiance is constant over the lobe, or visibility is 0 or 1 over it; else
/// the error is the covariance of sky visibility and distant radiance under the lobe (Lagarde & de Rousiers
/// 2014, 4.9.5, admit it without a figure: black walls before the half of the sky that is three times as
/// bright as the other give twice the true radiance).
template <class Colour, class T>
Colour visible_fallback(const Colour& local, T visibility, const Colour& distant) {
    return local + distant * (T(1) - std::clamp(visibility, T(0), T(1)));
}

/// A box probe's influence: 1 deeper than `fade` inside all walls, falling linearly in the distance to the
/// nearest wall to 0 on it, 0 outside. fade >= 0 (0: a step), in the box's unit; at most the smallest half
/// extent, lest 1 is reached nowhere.
template <class T>
T influence_of_box(const OrientedBox<T>& box, const Vec3<T>& point, T fade) {
    const Vec3<T> local = box.to_local(point);
    T depth = box.half_extent.x - std::abs(local.x);
    for (int axis = 1; axis < 3; ++axis)
        depth = std::min(depth, box.half_extent[axis] - std::abs(local[axis]));
    if (!(depth > T(0))) return T(0);
    return depth < fade ? depth / fade : T(1);
}

/// A sphere probe's influence, as influence_of_box.
template <class T>
T influence_of_sphere(const ProxySphere<T>& sphere, const Vec3<T>& point, T fade) {
    const T depth = sphere.radius - glm::length(point - sphere.centre);
    if (!(depth > T(0))) return T(0);
    return depth < fade ? depth / fade : T(1);
}

/// Weights of overlapping probes that know the same surroundings, from their influences f in [0, 1]: in
/// proportion to f / (1 - f), where some are 1 those alone and equally. They sum to 1, or are all 0 where no
/// probe has influence. So a probe fades in from 0 at its boundary, alone at full influence it has
/// everything, and one without influence changes nothing. For two probes this is the blend of Lagarde &
/// Zanuttini (2012, GetBlendMapFactor); for more theirs lets a probe's mere presence at weight 0 shift the
/// others' (.5 and .25 weigh .75 : .25, but .7 : .3 once a third starts), which pops, and this does not. What
/// both keep is a jump where probes at full influence overlap: there the limits differ.
template <class T>
void blend_influences(std::span<const T> influences, std::span<T> weights) {
    assert(influences.size() == weights.size());
    const bool any_full = std::any_of(influences.begin(), influences.end(), [](T f) { return f >= T(1); });
    T sum = T(0);
    for (std::size_t i = 0; i < influences.size(); ++i) {
        const T f = influences[i];
        weights[i] = any_full ? T(f >= T(1)) : f / (T(1) - f);
        sum += weights[i];
    }
    if (!(sum > T(0))) return;
    for (T& weight : weights) weight /= sum;
}

}  // namespace pbr
