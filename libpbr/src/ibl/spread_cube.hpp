#pragma once
// A cube map's light, spread over a grid of latitudes and longitudes so that rings can be transformed.

#include <span>
#include <vector>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/environment.hpp"
#include "src/ibl/ring_modes.hpp"

namespace pbr {

/// Flux at grid points, by the transpose of Lagrange interpolation: the sum over grid points of flux times a
/// band-limited function is the integral of the picture times that function.
class SpreadCube {
  public:
    SpreadCube(const CubeView& source, int bands, int points_a_side, std::span<const CubeTexel> without,
               const ForEach& each);

    /// The rings, for orders 0 ... bands. Refers to this.
    RingSource rings(int bands) const;

    /// Of the northern rings.
    const std::vector<double>& colatitudes_rad() const { return colatitudes_rad_; }

  private:
    int rows_, columns_;
    std::vector<double> colatitudes_rad_;
    std::vector<double> flux_;  ///< RGB
};

}  // namespace pbr
