#pragma once
// A picture's light, spread over a grid of latitudes and longitudes so that rings can be transformed.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/environment.hpp"
#include "src/ibl/ring_modes.hpp"

namespace pbr {

/// Flux of a picture less a constant at grid points, by the transpose of Lagrange interpolation: the sum over
/// grid points of flux times a band-limited function is the integral of the picture times that function.
class FluxGrid {
  public:
    /// A dark grid; even numbers.
    FluxGrid(int rows, int columns);

    int rows() const { return rows_; }
    int columns() const { return columns_; }

    /// RGB of grid point (x, y).
    double* rgb(int x, int y) { return &flux_[(static_cast<std::size_t>(y) * columns_ + x) * 3]; }

    /// The rings, for orders 0 ... factors.size() - 1. Refers to this.
    RingSource rings(std::vector<std::complex<double>> factors) const;

    /// Of the northern rings.
    std::vector<double> colatitudes_rad() const;

  private:
    int rows_, columns_;
    std::vector<double> flux_;
};

/// A cube map, each texel as points_a_side^2 Gauss-Legendre points that sum to its solid angle.
FluxGrid spread_cube(const CubeView& source, const PicturePart& part, int columns, int points_a_side,
                     const ForEach& each);

/// An equirect, each row as some Gauss-Legendre points of colatitude that sum to its area, each texel without
/// its width in azimuth: 2 pi / width sinc(m / width) is left to the rings' factors. As many columns as the
/// picture has are its own, half a column on. Sums in float.
FluxGrid spread_equirect(const EquirectView& source, const PicturePart& part, int rows, int columns,
                         int points_a_row, const ForEach& each);

}  // namespace pbr
