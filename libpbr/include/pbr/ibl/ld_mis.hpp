#pragma once
// The LD term of the split sum by multiple importance sampling of lobe and environment: the fourth estimator
// beside those of ibl/ld.hpp.
//
// Half of a texel's N samples follow the lobe k, half the picture's light above its mean, p (see
// ibl/environment_sampler.hpp); the balance heuristic joins them (Veach 1997, eq. 9.8 and 9.11):
//
//     LD = sum over all samples of  k L / (N_k k + N_p p),
//
// N_k + N_p = N. Radiance L is that of the picture's own texel, so the expected value is ld_exact's, whatever
// N. A flat picture has no p: all samples follow the lobe, and a constant environment has no variance. Of any
// other the variance is at most LD^2 / N above the smaller of what N/2 samples of either density alone would
// have (theorem 9.2; independent samples, these are stratified).

#include <cstdint>
#include <span>
#include <vector>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/environment_sampler.hpp"

namespace pbr {

/// Samples that texels share: sets of them, each stratified and shifted by its own hashes, one after the
/// other. Each set's arrays are padded to a multiple of 16.
struct MisSamples {
    int lobe_count = 0;     ///< N_k, a set
    int picture_count = 0;  ///< N_p, a set; 0 for a flat picture
    int sets = 0;
    std::vector<float> x, y, z;            ///< of the lobe: unit vectors about +z
    std::vector<float> picture_over_lobe;  ///< N_p / k of each
    std::vector<float> px, py, pz;         ///< of the picture: unit vectors in the world
    std::vector<float> r, g, b;            ///< radiance of each; 0 in the padding
    std::vector<float> density;            ///< N_p p of each; 1 in the padding
};

/// LD at one alpha by multiple importance sampling. Keeps a reference to the sampler.
class LdMis {
  public:
    /// alpha in (0, 1]; samples >= 1 a texel; one sample alone follows the lobe.
    LdMis(const EnvironmentSampler& environment, double alpha, int samples, std::uint64_t seed);

    /// Texels of a level of `size`; `rgb_out` holds 3 floats each. Bits do not depend on the vector width,
    /// nor on which texels are asked for together: each takes its set and turns it by hashes of (seed, size,
    /// texel). Where a lobe's sample falls among the picture's texels is known to 3e-7 rad. Returns the
    /// samples it took. Thread-safe.
    std::uint64_t integrate(int size, std::span<const CubeTexel> texels, std::span<float> rgb_out) const;

  private:
    const EnvironmentSampler& environment_;
    double alpha_;
    std::uint64_t seed_;
    MisSamples samples_;
};

}  // namespace pbr
