#pragma once
// The lowest harmonics of a whole level, against what a zonal kernel makes of the source's.

#include "bakers/image.hpp"
#include "pbr/ibl/moment_tree.hpp"
#include "pbr/numerics/for_each.hpp"

namespace pbrbake::probe {

/// The largest |LD_lm - k_l E_lm| of l to 3 and of all channels: LD the radiance of a level of an image of
/// six faces, its values divided by `scale`, E of the moments `source`, k the kernel of GGX at N = V = R for
/// alpha in (0, 1]. What the source foretells is taken off each texel, so that the sums over texels have to
/// integrate only the rest: they leave up to 1 / size^2 of what is in higher bands.
double low_band_difference(const Image& image, int level, double scale, const pbr::SphereMoments& source,
                           double alpha, const pbr::ForEach& each);

}  // namespace pbrbake::probe
