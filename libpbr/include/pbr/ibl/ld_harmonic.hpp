#pragma once
// LD by spherical harmonics, with the brightest texels apart.
//
// A picture's few texels that hold much of its light - suns, lamps - would need high degrees, and ring where
// these are cut off. They are taken out, down to the mean of all others since holes would ring as well, and
// added to each output texel by the exact sum; what is left is filtered by ibl/harmonic_filter.hpp. Of lobes
// so narrow that this would take more than 600 degrees, an equirect's part near the axis is summed texel by
// texel instead (ibl/near_field.hpp). All parts are the integral of the kernel over constant texels, so the
// estimator converges to LdEstimator::exact.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "pbr/ibl/bright_texels.hpp"
#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/environment.hpp"
#include "pbr/ibl/harmonic_filter.hpp"
#include "pbr/ibl/near_field.hpp"
#include "pbr/ibl/split_kernel.hpp"

namespace pbr {

/// A picture ready to be filtered at any alpha from a smallest one up.
class LdHarmonic {
  public:
    /// Transforms a picture for lobes of alpha >= smallest_alpha, in (0, 1], so that the root mean square
    /// error of a level over its mean stays below max_error > 0 (measured: a third of it, .8 at most). The
    /// picture must outlive this.
    LdHarmonic(const EquirectView& source, double smallest_alpha, double max_error, const ForEach& each);
    LdHarmonic(const CubeView& source, double smallest_alpha, double max_error, const ForEach& each);

    /// One roughness. Must not outlive the LdHarmonic it came from.
    class Level {
      public:
        /// RGB in `directions` (unit vectors, world), never negative; `rgb_out` holds 3 floats each.
        /// Directions that lie together cost least. Returns the kernel evaluations that bright texels took.
        /// Thread-safe.
        std::uint64_t integrate(std::span<const glm::dvec3> directions, std::span<float> rgb_out) const;

        /// The highest degree kept.
        int bands() const { return bands_; }

        /// Radius in radians within which texels are summed one by one; 0 if harmonics do all.
        double near_radius() const { return near_ ? near_->radius() : 0; }

        /// Root mean square, over the mean, of what the degrees above bands() held, by Parseval's theorem on
        /// the degrees that were analysed.
        double truncation_error() const { return truncation_error_; }

      private:
        friend class LdHarmonic;
        Level(const LdHarmonic& of, double alpha, const ForEach& each);
        std::vector<double> split_bright(const LdHarmonic& of, const GgxZonalKernel& lobe,
                                         const std::vector<double>& whole);
        int band_limit(const LdHarmonic& of, std::span<const double> kernel,
                       std::span<const double> kernel_of_bright);

        double alpha_;
        double truncation_error_ = 0;
        int bands_;
        std::optional<HarmonicGrid> grid_;
        const BrightTexels* bright_;
        std::optional<SplitKernel> bright_split_;  ///< whose near part alone bright_ adds
        std::optional<NearField> near_;
        glm::dvec3 near_constant_{0};  ///< what the near part makes of the constant taken out of it
    };

    /// Prepares a level. alpha in [smallest_alpha, 1].
    Level level(double alpha, const ForEach& each) const { return {*this, alpha, each}; }

    /// Degrees that lobes of alpha in (0, 1] need for an error: beyond them the tail of k_l, which falls like
    /// x K1(x) at x = 2 alpha l and after that, by the kink at the horizon, like l^-5/2, leaves a quarter of
    /// it to a picture of a thousand equal lamps.
    static int bands_for(double alpha, double max_error);

    /// The highest degree analysed.
    int bands() const { return spectrum_->bands(); }

    /// Texels that are taken apart: those that hold more than 1e-3 of a channel's light and are more than 20
    /// times its mean.
    int bright_texels() const { return static_cast<int>(bright_.size()); }

  private:
    template <class View>
    HarmonicRule prepare(const View& source, int height, double smallest_alpha, int most_bands,
                         const ForEach& each);
    PicturePart rest() const { return {bright_, ground_}; }  ///< what is left
    glm::dvec3 mean() const;                                 ///< of what is left
    double sphere_mean2() const;  ///< its square, of all channels together, times their spheres

    double max_error_;
    std::vector<CubeTexel> bright_;
    std::array<float, 3> ground_;  ///< the mean of all others
    std::optional<BrightTexels> bright_texels_;
    std::optional<HarmonicSpectrum> spectrum_;
    std::vector<double> powers_;                       ///< of its degrees
    std::optional<HarmonicSpectrum> bright_spectrum_;  ///< above the ground, of bright texels, if many
    std::vector<double> bright_powers_;
    EquirectView equirect_;  ///< if it is one
};

}  // namespace pbr
