#pragma once
// Two probes as people see them: HDR-FLIP of spheres shaded with each.

#include <optional>
#include <utility>

#include "bakers/image.hpp"
#include "bakers/verify/flip.hpp"

namespace pbrbake::verify {

struct ShadedFlip {
    double mean = 0, max = 0;
    double start_exposure = 0, stop_exposure = 0;  ///< stops, as used
    LinearPicture a, b;                            ///< the spheres, values divided by scale
    FlipMap map;
};

/// HDR-FLIP of a row of white metal spheres before black, one for each level, of its
/// perceptual roughness, reflecting probe `a` and the reference `b` (both of b's scale, R G B, faces 6).
/// Exposures are pinned, or found from b. Smaller probes make smaller spheres.
ShadedFlip shaded_flip(const Image& a, const Image& b, double scale,
                       std::optional<std::pair<double, double>> exposures);

}  // namespace pbrbake::verify
