#pragma once
// The copies of one pattern of texels that make up a cube map of an equirect, where the picture's axis is one
// of the cube's.
//
// Quarter turns about the axis then take columns to columns, if their number is a multiple of four, and the
// mirror image in the equator takes rows to rows. So all four faces beside the axis, north and south, are
// images of one half of a face, and the quadrants of both faces that the axis pierces of one quadrant: where
// a texel reads the picture is found once and used eight times.

#include <cmath>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "pbr/ibl/environment.hpp"

namespace pbr {

/// Where the pattern is used: texel (i, j) of the pattern is a texel of the cube, columns and rows
/// of the picture are counted from `column` on and from the north or the south pole.
struct CubeImage {
    int column;
    bool south;
    long origin, step_i, step_j;  ///< in the cube, texels
};
using CubeImages = std::vector<CubeImage>;
constexpr int kCubeImages = 8;

/// How the cube's faces lie about the picture's axis.
struct CubeFaces {
    CubeImages beside, pierced;
    double phase = 0;  ///< of a column's width, from its first edge to a face's middle

    /// Nothing if the axis isn't one of the cube's, or quarter turns don't take columns to columns.
    static std::optional<CubeFaces> of(const EquirectView& source, int size);

  private:
    int column_of(const EquirectView& source, const glm::dvec3& direction) {
        const double at = equirect_point(direction).x * source.width;
        if (beside.empty() && pierced.empty()) phase = at - std::floor(at);
        return static_cast<int>(std::lround(at - phase));
    }
    void add_beside(const EquirectView& source, int size, int face);
    void add_pierced(const EquirectView& source, int size, int face);
};

}  // namespace pbr
