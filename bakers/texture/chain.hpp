#pragma once
// One chain of levels for a whole set, so that what one map loses another can take over.

#include "bakers/texture/maps.hpp"

namespace pbrbake::texture {

/// A side some levels further down: halves, rounding down.
inline int side_below(int side, int levels = 1) { return std::max(1, side >> levels); }

/// The level so many further down, with the maps that `level` has, and room for `rows` rows.
MapLevel level_below(const MapLevel& level, int levels, int rows);

/// The rows of a level of `height` rows that some rows of the next cover, from the first that row `begin`
/// covers to before the first that row `end` covers.
struct RowRange {
    int begin = 0, end = 0;
};
RowRange rows_under(RowRange next, int height);
/// The end of the rows that a texel of row `row` of the next level takes part of: of odd heights, rows are
/// shared.
int reach_under(int row, int height);

/// Fills row y of `next` from the larger level, which holds the rows it covers. Every texel is the mean over
/// the area it covers: of opacity, and, weighted by opacity, of what is reflected (diffuse albedo, f0),
/// metallic, occlusion and emission. Normals and perceptual roughness go together by moments of slope
/// (pbr/legacy/normal_variance.hpp).
void fill_row(const MapLevel& level, int y, MapLevel& next);

}  // namespace pbrbake::texture
