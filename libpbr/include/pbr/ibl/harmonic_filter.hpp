#pragma once
// Zonal filtering of an environment by spherical harmonics.
//
// A zonal kernel multiplies every harmonic of degree l by one number k_l, so that prefiltering at any alpha
// is a transform, a product and a transform back (see ibl/zonal_kernel.hpp for why LD is such a filter):
//
//     HarmonicSpectrum spectrum(picture, {160, 1}, each);                      // E_lm
//     HarmonicGrid level({{{&spectrum, zonal_ggx(kernel, 112)}}}, error, each);  // the field of k_l E_lm
//     level.sample(direction, rgb);

#include <array>
#include <complex>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/environment.hpp"
#include "pbr/ibl/equirect_rows.hpp"
#include "pbr/numerics/for_each.hpp"

namespace pbr {

class FluxGrid;
class RingModes;

/// How a picture is transformed.
struct HarmonicRule {
    int bands;         ///< highest degree, >= 0
    int points_a_row;  ///< Gauss-Legendre points a row of texels, >= 1
    /// Of the grid that finer pictures are spread over, even; cube maps need one, which has half as many rows
    /// as columns.
    int grid_rows = 1 << 30, grid_columns = 1 << 30;
};

/// The rule for pictures of `height` rows and kernels of width alpha in (0, 1]: the fewest points and the
/// coarsest grid that move a filtered value by less than about max_error / 10 of the picture's contrast,
/// each; by 5e-6 in azimuth, so that a turned picture has the same values, turned.
HarmonicRule harmonic_rule(int height, int bands, double alpha, double max_error);

/// The coefficients E_lm of a picture's three channels for degrees 0 … bands and orders 0 … l, real and
/// imaginary parts, to orthonormal harmonics without the Condon-Shortley phase in the picture's own (u, v):
/// azimuth 2 pi u, colatitude pi v. Orders below 0 are their conjugates, the picture being real.
class HarmonicSpectrum {
  public:
    /// Transforms a picture that is constant over each texel: exactly in azimuth, in colatitude by
    /// Gauss-Legendre points weighted by sine, which sum to the row's exact area. Relative error of a
    /// coefficient below 1e-12 apart from the points; but pictures of more rows than the rule's grid are
    /// spread over that first, by the transpose of 6 x 6 interpolation, in float: at degree l that moves
    /// coefficients by a share of .0024 (pi l / grid_rows)^6, and by 3e-7 of the largest.
    HarmonicSpectrum(const EquirectView& source, const HarmonicRule& rule, const ForEach& each,
                     const PicturePart& part = {});

    /// Transforms a cube map: each texel as points_a_row^2 Gauss-Legendre points that sum to its exact solid
    /// angle, spread over the rule's grid. The picture's frame is the cube's own, with u and v as of an
    /// equirect.
    HarmonicSpectrum(const CubeView& source, const HarmonicRule& rule, const ForEach& each,
                     const PicturePart& part = {});

    /// Transforms what such a part lacks of an equirect: what the texels left out differ from the constant,
    /// all others being black. Rows are never spread over a grid. Time grows with the number of texels and
    /// with that of the rows they lie in.
    HarmonicSpectrum(const EquirectView& source, const PicturePart& part, const HarmonicRule& rule,
                     const ForEach& each);

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

    /// What was taken out and put back.
    const std::array<float, 3>& constant() const { return constant_; }

  private:
    HarmonicSpectrum(int bands, const glm::dmat3& world_to_source, const std::array<float, 3>& constant);
    void integrate(RingModes& modes, const std::vector<double>& colatitudes_rad,
                   const std::vector<double>& weights, int points_a_ring, const ForEach& each);
    void integrate_grid(const FluxGrid& grid, std::vector<std::complex<double>> factors, const ForEach& each);
    void add_constant();
    std::size_t start(int order) const;
    int bands_;
    std::array<float, 3> constant_;
    glm::dmat3 world_to_source_;
    std::vector<double> coefficients_;
};

/// A band-limited field on a grid of latitudes and longitudes.
class HarmonicGrid {
  public:
    /// A spectrum, and what each degree l of it is multiplied by; kernel.size() - 1 <= spectrum->bands().
    struct Term {
        const HarmonicSpectrum* spectrum;
        std::span<const double> kernel;
    };

    /// Root mean square over the sphere of what interpolation between rows and columns may err by, > 0.
    struct Error {
        double of_rows, of_columns;
    };

    /// The sum of fields with coefficients kernel[l] E_lm, at least one, all in one frame, on the coarsest
    /// grid that errs by no more than is allowed.
    HarmonicGrid(std::span<const Term> terms, const Error& allowed, const ForEach& each);

    /// RGB in world directions (unit), interpolated from 6 x 6 grid points; `rgb_out` holds 3 floats each.
    /// Rounding to float adds about 2e-7 of what the field varies by; a constant has no error but its own.
    void sample(std::span<const glm::dvec3> directions, std::span<float> rgb_out) const;

  private:
    static constexpr int kBorder = 3;
    float* at(int row, int column) { return &texels_[((row + kBorder) * stride_ + column + kBorder) * 4]; }
    void fill_border();

    int rows_, columns_;
    long stride_;
    glm::dmat3 world_to_source_;
    std::array<float, 3> constant_;  ///< not on the grid
    std::vector<float> texels_;      ///< RGBA with a border that wraps
};

}  // namespace pbr
