#pragma once
// What a picture's brightest texels add to LD: ld_partial (ibl/ld.hpp), fast for many texels.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "pbr/ibl/patches.hpp"

namespace pbr {

/// Single texels of a picture, with the few points that most directions need of each kept. The picture must
/// outlive this.
class BrightTexels {
  public:
    /// `texels` are blocks of one texel each.
    explicit BrightTexels(PatchBlocks texels);

    /// The integral of the kernel times radiance over the texels, in `directions` (unit vectors, world), for
    /// alpha in (0, 1]; `rgb_out` holds 3 doubles each. As ld_partial: relative error below 1e-5. Directions
    /// that lie together cost least. Returns its kernel evaluations. Thread-safe.
    std::uint64_t integrate(double alpha, std::span<const glm::dvec3> directions,
                            std::span<double> rgb_out) const;

  private:
    static constexpr int kKept = 4;  ///< orders

    PatchBlocks texels_;
    std::array<PatchPoints, kKept> kept_;  ///< of all texels, one after the other
};

}  // namespace pbr
