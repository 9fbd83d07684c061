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

/// Lazarov's fit (2013), which Karis's started from. Its gloss is that of Blinn-Phong's power 8192^gloss,
/// here 2 / alpha^2 - 2: alpha from .0156 up has a gloss in [0, 1], where it is clamped. Domain as above,
/// largest error .50 of the scale and of the bias (smooth, grazing), .46 and .45 from perceptual roughness
/// .05 up: it was made for another lobe.
inline ScaleBias lazarov_fit(double NoV, double perceptual_roughness) {
    const double alpha2 = std::pow(perceptual_roughness, 4);
    const double gloss = alpha2 > 0 ? std::clamp(std::log2(std::max(2 / alpha2 - 2, 1.0)) / 13, 0.0, 1.0) : 1;
    const double x = gloss / 0.96, y = 0.475 * gloss, z = (0.0175 * gloss - 0.015) / 0.96;
    const double at_0 = x * std::min(y, std::exp2(-9.28 * NoV)) + z, at_1 = 0.25 * gloss + 0.75;
    return {at_1 - at_0, at_0};
}

}  // namespace pbrbake::dfg
