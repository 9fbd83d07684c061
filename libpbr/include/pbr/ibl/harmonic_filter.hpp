#pragma once
// Zonal filtering of an environment by spherical harmonics.
//
// A zonal kernel multiplies every harmonic of degree l by one number k_l, so that prefiltering at any alpha
// is a transform, a product and a transform back (see ibl/zonal_kernel.hpp for why LD is such a filter):
//
//     HarmonicSpectrum spectrum(picture, 160, 1, each);              // E_lm
//     HarmonicGrid level(spectrum, zonal_ggx(kernel, 112), each);  // the field of k_l E_lm on a grid
//     level.sample(direction, rgb);
//
// The one error is that degrees above the band limit are missing; truncation_error tells it from the
// spectrum.

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/environment.hpp"
#include "pbr/numerics/for_each.hpp"

namespace pbr {

class FluxGrid;
class RingModes;

/// The coefficients E_lm of a picture's three channels for degrees 0 … bands and orders 0 … l, real and
/// imaginary parts, to orthonormal harmonics without the Condon-Shortley phase in the picture's own (u, v):
/// azimuth 2 pi u, colatitude pi v. Orders below 0 are their conjugates, the picture being real.
class HarmonicSpectrum {
  public:
    /// Transforms a picture that is constant over each texel: exactly in azimuth, in colatitude by
    /// `points_a_row` Gauss-Legendre points weighted by sine, which sum to the row's exact area. bands >= 0,
    /// points_a_row >= 1 (see points_a_row()). Texels listed in `without` (face 0, rows ascending) count as
    /// black. Relative error of a coefficient below 1e-12 apart from the points; but pictures of more than
    /// about 3 rows a degree are spread over a coarser grid first, by the transpose of 6 x 6 interpolation,
    /// in float: at degree l that moves coefficients by a share of (l / (2 bands))^6 at most, and by 3e-7 of
    /// the largest.
    HarmonicSpectrum(const EquirectView& source, int bands, int points_a_row, const ForEach& each,
                     std::span<const CubeTexel> without = {});

    /// Transforms a cube map: each texel as points_a_side^2 Gauss-Legendre points that sum to its exact solid
    /// angle, spread over a finer grid by the transpose of 6 x 6 interpolation, whose error at degree l is
    /// about (l / (2 bands))^6. The picture's frame is the cube's own, with u and v as of an equirect.
    HarmonicSpectrum(const CubeView& source, int bands, int points_a_side, const ForEach& each,
                     std::span<const CubeTexel> without = {});

    /// The highest degree.
    int bands() const { return bands_; }

    /// Coefficient of a degree in [order, bands()] and order >= 0: re, im of R, G, B.
    std::span<const double, 6> coefficient(int degree, int order) const;

    /// Of each degree the sum of |E_lm|^2 over its orders, negative ones too, and the channels.
    std::vector<double> powers() const;

    /// Coefficients of one order, those of a degree after the other.
    std::span<const double> of_order(int order) const;

    /// Takes world directions to the frame of the picture.
    const glm::dmat3& world_to_source() const { return world_to_source_; }

  private:
    HarmonicSpectrum(int bands, const glm::dmat3& world_to_source);
    void integrate(RingModes& modes, const std::vector<double>& colatitudes_rad,
                   const std::vector<double>& weights, int points_a_ring, const ForEach& each);
    void integrate_grid(const FluxGrid& grid, const std::vector<double>& factors, const ForEach& each);
    void add_constant(const glm::dvec3& value);
    std::size_t start(int order) const;
    int bands_;
    glm::dmat3 world_to_source_;
    std::vector<double> coefficients_;
};

/// Points a row of a picture of `height` rows needs for kernels of width alpha in (0, 1]: the fewest that
/// keep the error of a filtered value below about max_error / 10 of the picture's contrast.
int points_a_row(int height, double alpha, double max_error);

/// A band-limited field on a grid of latitudes and longitudes.
class HarmonicGrid {
  public:
    /// The field with coefficients kernel[l] E_lm, l up to kernel.size() - 1 <= spectrum.bands().
    HarmonicGrid(const HarmonicSpectrum& spectrum, std::span<const double> kernel, const ForEach& each);

    /// RGB in world directions (unit), interpolated from 6 x 6 grid points; `rgb_out` holds 3 floats each.
    /// Relative error below 3e-5 for fields whose highest degrees hold little, as filtered ones do.
    void sample(std::span<const glm::dvec3> directions, std::span<float> rgb_out) const;

  private:
    static constexpr int kBorder = 3;
    float* at(int row, int column) { return &texels_[((row + kBorder) * stride_ + column + kBorder) * 4]; }
    void fill_border();

    int rows_, columns_;
    long stride_;
    glm::dmat3 world_to_source_;
    std::vector<float> texels_;  ///< RGBA with a border that wraps
};

}  // namespace pbr
