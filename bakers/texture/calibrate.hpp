#pragma once
// Legacy specular maps are not f0: they are told by material names and statistics before they are believed.

#include <string>

#include "bakers/texture/maps.hpp"

namespace pbrbake::texture {

/// A word of file names and what surfaces called so reflect at normal incidence, linear Rec. 709.
struct SurfaceWord {
    std::string_view word;
    bool is_metal;
    Colour f0;
};

/// The surface that a path's file name speaks of, or null. Words stand alone or beside digits, '_' and '-'.
const SurfaceWord* surface_word(const std::string& path);

/// Brings diffuse and f0 of a set to scale, and says what was done.
void calibrate(const TextureParams& params, MapLevel& level, Findings& findings);

/// Which way green points: correlation of d(slope x)/dy with d(slope y)/dx over the map, as if y went up.
/// Slopes of a height field are free of curl, so it is > 0 where green is up, < 0 where it is down; 0 of a
/// flat map.
double green_correlation(const MapLevel& level);

}  // namespace pbrbake::texture
