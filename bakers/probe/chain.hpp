#pragma once
// The mip chain of a probe: how many levels, of what size and roughness.

#include <algorithm>
#include <bit>

#include "bakers/probe/params.hpp"
#include "pbr/brdf/roughness.hpp"

namespace pbrbake::probe {

/// Levels of a full chain, down to one texel a side.
inline int full_chain(int size) { return std::bit_width(static_cast<unsigned>(size)); }

/// The levels of a job; its 0 means one for each roughness listed, or down to 8 texels a side.
inline int level_count(const ProbeParams& params) {
    if (!params.perceptual_roughness.empty()) return static_cast<int>(params.perceptual_roughness.size());
    return params.levels > 0 ? params.levels : std::max(1, full_chain(params.size) - 3);
}

inline int size_of_level(const ProbeParams& params, int level) { return std::max(1, params.size >> level); }

inline double perceptual_roughness_of_level(const ProbeParams& params, int level) {
    if (!params.perceptual_roughness.empty())
        return params.perceptual_roughness[static_cast<std::size_t>(level)];
    return pbr::perceptual_roughness_from_level(level, level_count(params));
}

inline double alpha_of_level(const ProbeParams& params, int level) {
    return pbr::alpha_from_perceptual_roughness(perceptual_roughness_of_level(params, level));
}

}  // namespace pbrbake::probe
