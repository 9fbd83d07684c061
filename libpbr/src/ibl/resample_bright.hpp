#pragma once
// Bright texels of a cube map that was resampled by few points, once more and exactly.

#include <span>

#include "pbr/ibl/environment.hpp"

namespace pbr {

/// Replaces the texels of a whole cube map that are more than 20 times as bright as the mean, and those
/// around them, by their exact means: a share of contrast that is nothing in a room is several means beside a
/// sun. At most one texel in 256 counts as bright, the brightest ones. rgb_out as in resample_area.
void resample_bright_texels(const EquirectView& source, int size, const ForEach& each,
                            std::span<float> rgb_out);

}  // namespace pbr
