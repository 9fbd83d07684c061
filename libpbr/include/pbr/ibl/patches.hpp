#pragma once
// An environment as blocks of small constant patches, for exact sums over it.

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/environment.hpp"
#include "pbr/numerics/quadrature.hpp"

namespace pbr {

/// Points of a quadrature over a block, structure of arrays. Weights are solid angles in sr; radiance is not
/// multiplied in. For every texel of the block the weights of its points sum to its exact solid angle, up to
/// rounding to float.
struct PatchPoints {
    std::vector<float> x, y, z;  ///< unit vectors in the world
    std::vector<float> weight;
    std::vector<float> r, g, b;  ///< radiance
    /// How many points.
    std::size_t size() const { return x.size(); }
    /// Makes all arrays `count` long.
    void resize(std::size_t count);
};

/// A cone that holds a block: unit axis, and the largest angle to it in radians.
struct Cone {
    glm::dvec3 axis;
    double half_angle;
};

/// The angle in [0, pi] between unit vectors that lie `chord` apart; chords a rounding above 2 count as 2.
double angle_of_chord(double chord);

/// A picture cut into blocks of up to 8 x 8 texels. Keeps a view: the picture must outlive it.
class PatchBlocks {
  public:
    /// Blocks of a picture of any size from 1 x 1.
    explicit PatchBlocks(const EquirectView& source);
    explicit PatchBlocks(const CubeView& source);
    /// Some texels of a picture (of face 0 of an equirect), each a block.
    PatchBlocks(const EquirectView& source, std::span<const CubeTexel> texels);
    PatchBlocks(const CubeView& source, std::span<const CubeTexel> texels);

    /// How many blocks.
    int count() const { return static_cast<int>(blocks_.size()); }
    /// Of block 0 … count() - 1.
    const Cone& cone(int block) const { return blocks_[block].cone; }

    /// The largest angle a texel of the picture spans along either axis, radians.
    double texel_angle() const { return texel_angle_; }

    /// Points a texel and axis that points() offers, ascending.
    static constexpr int kOrders[] = {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128};

    /// Gauss-Legendre points of a block, kOrders[order_index] squared a texel, in place of what `points`
    /// held.
    void points(int block, int order_index, PatchPoints& points) const;

  private:
    struct Block {
        int face, x, y;  ///< first texel
        int width, height;
        Cone cone;
    };
    void add_blocks(int face, int width, int height);
    void add_block(Block block);
    glm::dvec3 direction(int face, double x,
                         double y) const;  ///< of a continuous texel coordinate, unit, world
    void equirect_points(const Block& block, const QuadratureRule& rule, PatchPoints& points) const;
    void cube_points(const Block& block, const QuadratureRule& rule, PatchPoints& points) const;

    EquirectView equirect_;
    CubeView cube_;
    double texel_angle_;
    std::vector<Block> blocks_;
    std::vector<QuadratureRule> rules_;  ///< of kOrders
};

}  // namespace pbr
