#pragma once
// What engines use in place of a table, so that a certificate can say what the table buys.

#include <algorithm>
#include <cmath>

namespace pbrbake::dfg {

struct ScaleBias {
    double scale, bias;
};

/// Karis's fit for phones, after Lazarov (Karis 2014, "Physically based shading on mobile"; Lazarov 2013,
/// "Getting more physical in Call of Duty: Black Ops II"). NoV and perceptual roughness in [0, 1]. Largest
/// error against the GGX integrals .50 of the scale (rough, grazing: it has no rise towards E = 1 there) and
/// .085 of the bias.
inline ScaleBias karis_fit(double NoV, double perceptual_roughness) {
    const double x = 1 - perceptual_roughness, y = 0.0425 - 0.0275 * perceptual_roughness;
    const double z = 1.04 - 0.572 * perceptual_roughness, w = -0.04 + 0.022 * perceptual_roughness;
    const double a = std::min(x * x, std::exp2(-9.28 * NoV)) * x + y;
    return {z - 1.04 * a, w + 1.04 * a};
}

}  // namespace pbrbake::dfg
