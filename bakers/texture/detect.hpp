#pragma once
// What a set's statistics make doubtful. Nothing here changes what is baked: a doubt is a warning.

#include <optional>

#include "bakers/texture/maps.hpp"

namespace pbrbake::texture {

/// Correlations and medians of up to 65,536 texels, evenly spread. Empty where a map is absent or flat.
struct Doubts {
    std::optional<double> gloss_correlation;      ///< of gloss as taken with specular luminance, in [-1, 1]
    std::optional<double> occlusion_correlation;  ///< of diffuse luminance with occlusion, in [-1, 1]
    std::optional<double> exponent_median, exponent_max;  ///< where gloss holds exponents
    std::vector<std::string> warnings;
};

Doubts find_doubts(const Sources& sources);

}  // namespace pbrbake::texture
