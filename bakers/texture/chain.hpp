#pragma once
// One chain of levels for a whole set, so that what one map loses another can take over.

#include "bakers/texture/maps.hpp"

namespace pbrbake::texture {

/// The next smaller level: sides halve, rounding down, and every texel is the mean over the area it covers,
/// of what is reflected (diffuse albedo, f0), metallic, occlusion and opacity. Normals and perceptual
/// roughness go together by moments of slope (pbr/legacy/normal_variance.hpp).
MapLevel next_level(const MapLevel& level, Context& context);

/// The same a row at a time, from some rows of the larger level. An empty level below one of that height,
/// with the maps that `level` has:
MapLevel level_below(const MapLevel& level, int height);

/// The rows of a level of that height that a row of the next covers. Of next.height, the first is `height`.
int first_row_under(int row, int height, const MapLevel& next);
int last_row_under(int row, int height, const MapLevel& next);

/// Fills row y of `next` from `level`, which holds the rows it covers and starts at row `first` of `height`.
void fill_row(const MapLevel& level, int first, int height, int y, MapLevel& next);

}  // namespace pbrbake::texture
