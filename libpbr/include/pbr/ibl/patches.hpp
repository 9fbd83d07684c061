#pragma once
// An environment as blocks of small constant patches, for exact sums over it.

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "pbr/ibl/environment.hpp"

namespace pbr {

/// Points of a quadrature over a block, structure of arrays. Weights are solid angles in sr; radiance is not multiplied
/// in. For every texel of the block the weights of its points sum to its exact solid angle, up to rounding to float.
struct PatchPoints {
    std::vector<float> x, y, z;  ///< unit vectors in the world
    std::vector<float> weight;
    std::vector<float> r, g, b;  ///< radiance
    std::size_t size() const { return x.size(); }
    void clear();
    void add(const glm::dvec3& direction, double solid_angle, const float* rgb);
};

/// A cone that holds a block: unit axis, and the largest angle to it in radians.
struct Cone {
    glm::dvec3 axis;
    double half_angle;
};

/// A picture cut into blocks of up to 8 x 8 texels. Keeps a view: the picture must outlive it.
class PatchBlocks {
  public:
    explicit PatchBlocks(const EquirectView& source);
    explicit PatchBlocks(const CubeView& source);

    int count() const { return static_cast<int>(blocks_.size()); }
    const Cone& cone(int block) const { return blocks_[block].cone; }

    /// The largest angle a texel of the picture spans along either axis, radians.
    double texel_angle() const { return texel_angle_; }

    /// Gauss-Legendre points of a block, order x order a texel, in place of what `points` held.
    void points(int block, int order, PatchPoints& points) const;

  private:
    struct Block {
        int face, x, y;  ///< first texel
        int width, height;
        Cone cone;
    };
    void add_blocks(int face, int width, int height);
    glm::dvec3 direction(int face, double x, double y) const;  ///< of a continuous texel coordinate, unit, world

    EquirectView equirect_;
    CubeView cube_;
    double texel_angle_;
    std::vector<Block> blocks_;
};

}  // namespace pbr
