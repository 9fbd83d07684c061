#pragma once
// Moments of a picture's blocks: the leaves of a tree.

#include <cstddef>
#include <vector>

#include "pbr/ibl/patches.hpp"
#include "src/simd/patch_kernel.hpp"

namespace pbr {

/// Sums over a whole picture's blocks, one at a time. Keeps a reference: the blocks must outlive it.
class BlockMoments {
  public:
    explicit BlockMoments(const PatchBlocks& blocks);

    /// Integrals over a block, in the world, about the sphere's centre: of equirects to double's rounding, of
    /// cubes from points in float with each texel's spread about its own. `scratch` is overwritten.
    PatchMoments operator()(int block, PatchPoints& scratch) const;

  private:
    PatchMoments of_equirect(int block) const;
    PatchMoments of_cube(int block, PatchPoints& scratch) const;

    /// A moment in the world takes `factor` times one in the picture's own frame.
    struct Term {
        std::size_t to, from;
        double factor;
    };
    const PatchBlocks& blocks_;
    std::vector<double> rows_, columns_;  ///< of LatLongBlock, all of the picture's
    std::vector<Term> turn_;              ///< empty if the frames are the same
};

/// Moves the point that moments are about to one that lies at -shift from it.
void shift_moments(const glm::dvec3& shift, PatchMoments& moments);

}  // namespace pbr
