#pragma once
// The LD term of the split sum: radiance prefiltered by the GGX lobe at N = V = R (see ibl/zonal_kernel.hpp),
// for the texels of a cube map level. One integral, three estimators:
//
//   LdEstimator::exact                         the sum over every texel of the source
//   LdEstimator::importance_sampling           the mean of samples with the density of the lobe
//   LdEstimator::filtered_importance_sampling  the same on a mip pyramid, each sample as wide as its share of
//   the lobe
//                                              (Krivanek & Colbert 2008, "Real-time shading with filtered
//                                              importance sampling"; GPU Gems 3, ch. 20)

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "pbr/ibl/cube_pyramid.hpp"
#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/environment.hpp"
#include "pbr/ibl/moment_tree.hpp"
#include "pbr/ibl/patches.hpp"

namespace pbr {

enum class LdEstimator { importance_sampling, filtered_importance_sampling, exact };

/// Sample directions of one level, shared by its texels and turned about each texel's normal by a hash, and
/// what each reads: two neighbouring levels of a pyramid. The arrays are padded to a multiple of 16 beyond
/// `count`.
struct LdSamples {
    int count = 0;
    std::vector<float> x, y, z;    ///< unit vectors about +z with the density of the lobe
    std::vector<float> half_size;  ///< half the texels a side of the finer level: those of the coarser
    std::vector<float> finer,
        coarser;  ///< weights of the levels; all samples' sum to 1, so huge texels don't overflow

    /// Adds a sample that reads level `lod` of a pyramid of `levels` >= 2, clamped to its chain, with
    /// `weight`.
    void add(const glm::dvec3& direction, double lod, int levels, double weight);
    /// Pads the arrays; after the last add().
    void pad();
};

/// The first `count` samples for alpha in (0, 1] on a pyramid whose level 0 has `base_size` >= 2 texels a
/// side. importance_sampling reads level 0, filtered_importance_sampling level log2(K Omega_s / Omega_p) / 2
/// with Omega_s = 1/(count k), and Omega_p = 4 pi / (6 base_size^2), the mean of level 0's texels: a level's
/// footprints are equally wide everywhere. K = `level_bias` > 0 trades bias (large) for noise (small).
///
/// The centroid of a lamp of one texel is then off by noise, and by bias of up to .04, .02 and .01 of a
/// level's texels at 16, 32 and 64 samples or more, in a probe of 256 texels a side and six levels; its flux
/// is within 1 %.
LdSamples make_ld_samples(LdEstimator estimator, double alpha, int count, int base_size, double level_bias);

/// Texels of a level of `size` by sampling: the unweighted mean over samples (their density is the whole
/// lobe, NoL included, so a constant environment has no variance). `rgb_out` holds 3 floats a texel. Bits do
/// not depend on the vector width, nor on which texels are asked for together: each turns the samples by a
/// hash of (seed, size, texel). The pyramid has at least two levels.
void ld_sampled(const CubePyramid& pyramid, const LdSamples& samples, std::uint64_t seed, int size,
                std::span<const CubeTexel> texels, std::span<float> rgb_out);

/// Exact prefiltered radiance in `directions` (unit vectors, world) for alpha in (0, 1]: `rgb_out` holds 3
/// doubles each.
///
/// Sums k over all texels of the source, each integrated by Gauss-Legendre points, more of them the closer
/// the texel is to the lobe against its own size. Divided by the sum of k's own weights, so that a constant
/// environment is returned to float's rounding. Returns the largest |1 - integral of k| found, the
/// quadrature's own check and about the relative error: below 3e-5 for pictures of 128 texels around and
/// more, 2e-4 at 32, for alpha >= .003. A lamp of one texel that the horizon cuts is off by up to its texel's
/// share: the trees below cut it finer. Adds its kernel evaluations to `evaluations`.
double ld_exact(const PatchBlocks& source, double alpha, std::span<const glm::dvec3> directions,
                std::span<double> rgb_out, std::uint64_t& evaluations);

/// How far ld_exact over a tree can be from the integral over constant texels.
struct LdTreeError {
    double deviation;  ///< largest |1 - integral of k|: the quadrature's, as ld_exact returns it
    double far_field;  ///< proven: what taking distant parts as one moved a result by, over result plus
                       ///< picture's mean
};

/// The same with distant parts taken as one: a node of the tree in place of its texels wherever the Taylor
/// remainder of the kernel over it is below tolerance / (4 pi) for all of a group of directions (or three
/// times that, if all nodes together stay below the tolerance) and across the horizon, in a band of nodes,
/// half the tolerance for all of the band. The error is then below about `tolerance` times the mean of the
/// picture plus the result: the figure returned adds up what was allowed where it was, and is usually half of
/// that. The error itself, of changing signs, is about a hundredth. `tolerance` in (0, 1]. Counts nodes and
/// points as evaluations, those of 16 directions that lie within .1 rad together as one.
LdTreeError ld_exact(const MomentTree& source, double alpha, double tolerance,
                     std::span<const glm::dvec3> directions, std::span<double> rgb_out,
                     std::uint64_t& evaluations);

/// The same sum over part of a sphere, not divided by anything: what the texels of `part` add to LD. Relative
/// error below 1e-5; of texels that the horizon cuts, by 32 x 32 points, below 1e-4 of what a whole texel
/// adds one texel higher.
void ld_partial(const PatchBlocks& part, double alpha, std::span<const glm::dvec3> directions,
                std::span<double> rgb_out, std::uint64_t& evaluations);

/// How LD is had.
struct LdMethod {
    LdEstimator estimator = LdEstimator::exact;
    int samples = 0;        ///< a texel; of the sampling estimators, as are those below
    double level_bias = 1;  ///< K of make_ld_samples
    std::uint64_t seed = 0;
};

/// LD at one alpha, by any estimator. Keeps references: sources must outlive it.
class LdIntegrator {
  public:
    /// `source` is read by the exact estimator, `pyramid` by the others; the other one may be null. alpha in
    /// (0, 1].
    LdIntegrator(const LdMethod& method, double alpha, const PatchBlocks* source, const CubePyramid* pyramid);

    /// Texels of a level of `size`; `rgb_out` holds 3 floats each. Texels that lie together cost the exact
    /// estimator least. Returns the kernel evaluations or samples it took. Thread-safe.
    std::uint64_t integrate(int size, std::span<const CubeTexel> texels, std::span<float> rgb_out) const;

  private:
    LdMethod method_;
    double alpha_;
    const PatchBlocks* source_;
    const CubePyramid* pyramid_;
    LdSamples samples_;
};

}  // namespace pbr
