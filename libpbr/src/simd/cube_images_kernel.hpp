#pragma once
// Reading a picture for all images of a pattern at once.

#include <span>

#include "pbr/ibl/environment.hpp"
#include "src/ibl/cube_images.hpp"

namespace pbr {

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
