#pragma once
// Reading a picture for all images of a pattern at once.

#include <span>

#include "pbr/ibl/environment.hpp"
#include "src/ibl/cube_images.hpp"

namespace pbr {

/// Texels of one column of the picture that a texel of the pattern is the sum of: `count` of them from `row`
/// on, both counted as the images' are.
struct ColumnPiece {
    int column, row, count, texel;
};

/// Doubles of a texel's sums: four an image, RGB and one that means nothing.
constexpr long kImageSums = 4 * kCubeImages;

/// sums[kImageSums texel + 4 image] ... += the weighted sums of the pieces, whose weights follow one another.
void add_pieces(const EquirectView& source, const CubeImages& images, std::span<const ColumnPiece> pieces,
                const double* weights, double* sums);

/// Where a texel of the pattern reads the picture: between columns and rows `column`, `row` and the next
/// ones, as far on as `across` and `down` in [0, 1] say. Row -1 is the first one, half a turn away.
struct BilinearPoint {
    int column, row;
    double across, down;
};

/// Row j of the pattern, interpolated at `points`, one for each i.
void interpolate_images(const EquirectView& source, const CubeImages& images,
                        std::span<const BilinearPoint> points, int j, std::span<float> rgb_out);

}  // namespace pbr
