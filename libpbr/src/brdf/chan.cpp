#include "pbr/brdf/chan.hpp"

#include "src/brdf/hemisphere_rule.hpp"

namespace pbr {

double albedo_chan(double NoV, double alpha) {
    static const std::vector<HemisphereNode> heights = height_rule(24), azimuths = azimuth_rule(16);
    const auto lobe = [&](double NoL, double NoH, double LoV) {
        return f_chan(NoL, NoV, NoH, std::sqrt((1 + LoV) / 2), alpha);
    };
    return integrate_lobe(lobe, NoV, heights, azimuths);
}

}  // namespace pbr
