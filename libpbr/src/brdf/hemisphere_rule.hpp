#pragma once
// A product rule over directions of light for lobes without a peak of their own: nodes crowd at the horizon
// and towards the antipode of the view, where such lobes bend.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/quadrature.hpp"

namespace pbr {

struct HemisphereNode {
    double value;
    double weight;
};

/// Over NoL = u^3 (4 - 3u): crowded at the horizon, and smooth at the zenith, where the sine has a root.
inline std::vector<HemisphereNode> height_rule(int count) {
    const QuadratureRule rule = gauss_legendre(count);
    std::vector<HemisphereNode> nodes;
    for (int i = 0; i < count; ++i) {
        const double u = rule.nodes[i];
        nodes.push_back({u * u * u * (4 - 3 * u), rule.weights[i] * 12 * u * u * (1 - u)});
    }
    return nodes;
}

/// Over the cosine of the azimuth from the antipode of wo, at pi t^2: crowded at the antipode.
inline std::vector<HemisphereNode> azimuth_rule(int count) {
    const QuadratureRule rule = gauss_legendre(count);
    std::vector<HemisphereNode> nodes;
    for (int i = 0; i < count; ++i) {
        const double t = rule.nodes[i];
        nodes.push_back({sin_cos_pi(t * t).cos, rule.weights[i] * 2 * t * 2 * std::numbers::pi});
    }
    return nodes;
}

/// The integral over the hemisphere of f(NoL, NoH, LoV) NoL, seen at NoV.
template <class F>
double integrate_lobe(const F& f, double NoV, const std::vector<HemisphereNode>& heights,
                      const std::vector<HemisphereNode>& azimuths) {
    const double sin_v = std::sqrt((1 - NoV) * (1 + NoV));
    double sum = 0;
    for (const auto& [NoL, weight] : heights) {
        const double sines = sin_v * std::sqrt((1 - NoL) * (1 + NoL));
        double ring = 0;
        for (const auto& [from_antipode, azimuth_weight] : azimuths) {
            const double LoV = NoL * NoV - sines * from_antipode;
            const double NoH = std::min(1.0, (NoL + NoV) / std::sqrt(2 + 2 * LoV));
            ring += azimuth_weight * f(NoL, NoH, LoV);
        }
        sum += weight * ring * NoL;
    }
    return sum;
}

}  // namespace pbr
