#include "pbr/brdf/charlie.hpp"

#include <array>

#include "pbr/numerics/quadrature.hpp"

namespace pbr {
namespace {

constexpr int kNodes = 40;

/// A node of a rule over [0, 1], crowded at an end.
struct Node {
    double value;
    double weight;
};

/// Over NoL = u^3 (4 - 3u): crowded at the horizon, where the lobe is, and smooth at the zenith, where the
/// sine has a root.
std::array<Node, kNodes> height_rule() {
    const QuadratureRule rule = gauss_legendre(kNodes);
    std::array<Node, kNodes> nodes;
    for (int i = 0; i < kNodes; ++i) {
        const double u = rule.nodes[i];
        nodes[i] = {u * u * u * (4 - 3 * u), rule.weights[i] * 12 * u * u * (1 - u)};
    }
    return nodes;
}

/// Over the cosine of the azimuth from the antipode of wo, at pi t^2: crowded at the antipode, where the lobe
/// is sharpest.
std::array<Node, kNodes> azimuth_rule() {
    const QuadratureRule rule = gauss_legendre(kNodes);
    std::array<Node, kNodes> nodes;
    for (int i = 0; i < kNodes; ++i) {
        const double t = rule.nodes[i];
        nodes[i] = {sin_cos_pi(t * t).cos, rule.weights[i] * 2 * t * 2 * std::numbers::pi};
    }
    return nodes;
}

}  // namespace

double albedo_charlie(double NoV, double alpha, CharlieVisibility visibility) {
    static const std::array<Node, kNodes> heights = height_rule(), azimuths = azimuth_rule();
    const double sin_v = std::sqrt((1 - NoV) * (1 + NoV));
    double albedo = 0;
    for (const auto& [NoL, weight] : heights) {
        const double sines = sin_v * std::sqrt((1 - NoL) * (1 + NoL));
        double ring = 0;
        for (const auto& [from_antipode, azimuth_weight] : azimuths) {
            const double LoV = NoL * NoV - sines * from_antipode;
            const double NoH = std::min(1.0, (NoL + NoV) / std::sqrt(2 + 2 * LoV));
            ring += azimuth_weight * D_charlie(NoH, alpha);
        }
        const double V =
            visibility == CharlieVisibility::neubelt ? V_neubelt(NoL, NoV) : V_charlie(NoL, NoV, alpha);
        albedo += weight * ring * V * NoL;
    }
    return albedo;
}

}  // namespace pbr
