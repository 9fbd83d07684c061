#pragma once
// One chain of levels for a whole set, so that what one map loses another can take over.

#include "bakers/texture/maps.hpp"

namespace pbrbake::texture {

/// The next smaller level: sides halve, rounding down, and every texel is the mean over the area it covers,
/// of what is reflected (diffuse albedo, f0), metallic, occlusion and opacity. Normals and perceptual
/// roughness go together by moments of slope (pbr/legacy/normal_variance.hpp).
MapLevel next_level(const MapLevel& level, Context& context);

}  // namespace pbrbake::texture
