#pragma once
// From a set's files to the maps of its largest level.

#include "bakers/texture/maps.hpp"

namespace pbrbake::texture {

/// The largest level, calibrated, with its metal mask.
struct Converted {
    MapLevel level;
    Findings findings;
    std::vector<float> confidence;
    /// What each texel's diffuse may be moved by: half its file's interval.
    std::vector<Colour> tolerance;
};

Converted convert(const Sources& sources, Context& context);

}  // namespace pbrbake::texture
