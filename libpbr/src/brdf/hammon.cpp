#include "pbr/brdf/hammon.hpp"

#include "src/brdf/hemisphere_rule.hpp"

namespace pbr {

double albedo_hammon_single(double NoV, double alpha) {
    static const std::vector<HemisphereNode> heights = height_rule(24), azimuths = azimuth_rule(16);
    const auto lobe = [&](double NoL, double NoH, double LoV) {
        return f_hammon(1.0, NoL, NoV, NoH, LoV, alpha);
    };
    // 0 at NoV = alpha = 0, but for rounding
    return std::max(0.0,
                    integrate_lobe(lobe, NoV, heights, azimuths) - kHammonMultipleAlbedo<double> * alpha);
}

}  // namespace pbr
