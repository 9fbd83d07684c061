#pragma once
// Points of patches, and their moments.

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>

#include "pbr/ibl/moment_tree.hpp"
#include "pbr/ibl/patches.hpp"

namespace pbr {

/// Points along a row of a tabulated block at most: 16 texels of 8 points. Tables may be read this far beyond
/// a row's end.
inline constexpr int kMostLatLongWidth = 16, kLatLongColumns = 8 * kMostLatLongWidth, kLatLongPadding = 16;

/// A block of an equirect's texels and its points: d = right sin(b) sin(a) + up cos(b) + ahead sin(b) cos(a)
/// for longitudes a and colatitudes b, order x order a texel.
struct LatLongPatch {
    struct Axis {
        const double *sines, *cosines, *weights;
    };
    Axis columns, rows;
    glm::dvec3 right, up, ahead;
    const float* rgb;    ///< first texel
    std::size_t stride;  ///< floats from a row of texels to the next
    int width, height;   ///< texels
    int order;
};

/// Writes a block's points from `at` on; the arrays are long enough.
void fill_lat_long_points(const LatLongPatch& patch, std::size_t at, PatchPoints& points);

/// Sums over points of weight times radiance r, g, b, and of weight alone, each times kMonomials of point -
/// centre.
using PatchMoments = std::array<std::array<double, 4>, kMonomials.size()>;

/// Moments of points about a centre. Bits do not depend on the vector width.
PatchMoments moments_of_points(const PatchPoints& points, const glm::dvec3& centre);

/// Powers sin^i cos^j of colatitudes that others of i + j <= 3 follow from, as sin^2 = 1 - cos^2: i up to 1.
/// And all of longitudes. Each in the order of j within that of i.
inline constexpr std::size_t kRowIntegrals = 7, kColumnMeans = 10;

/// A block of an equirect's texels, kMostLatLongWidth wide at most, and what its rows and columns know of
/// their directions (sin b sin a, cos b, sin b cos a): kRowIntegrals of colatitudes b a row, over a texel's
/// solid angle, and kColumnMeans of longitudes a a column.
struct LatLongBlock {
    const float* rgb;    ///< first texel
    std::size_t stride;  ///< floats from a row of texels to the next
    int width, height;   ///< texels
    const double *rows, *columns;
};

/// Moments of a block in the picture's own frame, about the sphere's centre: each row's texels take the same
/// factors, and each column's sums. Bits do not depend on the vector width.
PatchMoments moments_of_block(const LatLongBlock& block);

}  // namespace pbr
