#pragma once
// The demo page's pictures.

#include <string>
#include <vector>

#include "bakers/verify/baked_image.hpp"
#include "bakers/verify/picture.hpp"

namespace pbrbake::verify {

/// A table's first three channels at (NoV, perceptual roughness), bilinear, both ends clamped: a table of the
/// default layout (sqrt(NoV) and perceptual roughness, the first and last texels at 0 and 1).
glm::dvec3 look_up(const BakedImage& table, double NoV, double perceptual_roughness);

/// How a built-in environment is shown.
struct EnvironmentLook {
    std::string name, title, description;
    double ev100;
    glm::dvec3 camera;  ///< where the camera looks
    glm::dvec3 metal_f0;
};
const std::vector<EnvironmentLook>& environment_looks();

/// Metal balls of perceptual roughness 0 to 1 by the split sum, before the environment.
Picture hero_picture(const EnvironmentLook& look, const BakedImage& probe, const BakedImage& table);

Picture level_ball(const EnvironmentLook& look, const BakedImage& probe, int level);
Picture level_0_cross(const EnvironmentLook& look, const BakedImage& probe);

/// Shares of a level's mean luminance at which difference_ball's colours end.
inline constexpr double kLeastDifferenceShown = 1e-3, kMostDifferenceShown = 1;
/// |a - b| in luminance over b's mean luminance, in false colour on a logarithmic scale.
Picture difference_ball(const EnvironmentLook& look, const BakedImage& a, const BakedImage& b, int level);

/// A channel of a table in false colour, from 0 to its highest value.
Picture channel_picture(const BakedImage& table, int channel, double& highest);
Picture rgb_picture(const BakedImage& table);

/// The scale of false_colour with what its ends stand for, as HTML.
std::string false_colour_scale(const std::string& low, const std::string& high);

/// "1", or "2^-14 = 6.10e-5".
std::string scale_text(double scale);

}  // namespace pbrbake::verify
