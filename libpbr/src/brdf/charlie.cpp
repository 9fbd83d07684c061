#include "pbr/brdf/charlie.hpp"

#include "src/brdf/hemisphere_rule.hpp"

namespace pbr {

double albedo_charlie(double NoV, double alpha, CharlieVisibility visibility) {
    constexpr int kNodes = 40;
    static const std::vector<HemisphereNode> heights = height_rule(kNodes), azimuths = azimuth_rule(kNodes);
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
