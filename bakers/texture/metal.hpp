#pragma once
// The metal mask: an estimate a texel, then along the picture's regions where a texel alone can't tell.

#include "bakers/texture/maps.hpp"

namespace pbrbake::texture {

/// Fills level.metallic; returns the confidence of each texel. `quantisation` is a half interval a texel, on
/// f0 as calibrated.
std::vector<float> estimate_metal(const TextureParams& params,
                                  const std::vector<pbr::Quantisation<float>>& steps,
                                  pbr::DiffuseCoupling coupling, const Findings& findings, MapLevel& level,
                                  Context& context);

}  // namespace pbrbake::texture
