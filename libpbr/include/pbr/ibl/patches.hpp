#pragma once
// An environment as blocks of small constant patches, for exact sums over it.

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/environment.hpp"
#include "pbr/numerics/elementary.hpp"
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

struct LatLongPatch;  // see simd/patch_kernel.hpp

/// A picture cut into square blocks, 4 texels a side and up to 16 in large pictures, so that their number
/// stays bounded. Keeps a view: the picture must outlive it.
class PatchBlocks {
  public:
    /// Blocks of a picture of any size from 1 x 1.
    explicit PatchBlocks(const EquirectView& source);
    explicit PatchBlocks(const CubeView& source);
    /// Some texels of a picture (of face 0 of an equirect), each a block.
    PatchBlocks(const EquirectView& source, std::span<const CubeTexel> texels);
    PatchBlocks(const CubeView& source, std::span<const CubeTexel> texels);

    /// The picture, if it is an equirect; else its `rgb` is null.
    const EquirectView& equirect() const { return equirect_; }

    /// How many blocks.
    int count() const { return static_cast<int>(blocks_.size()); }
    /// Of block 0 … count() - 1.
    const Cone& cone(int block) const { return blocks_[block].cone; }

    /// How whole pictures are cut: blocks are numbered by faces, rows and columns. 0 faces where single
    /// texels were given.
    struct Grid {
        int faces = 0, columns = 0, rows = 0;
        int side = 1;  ///< texels a block, but for the last of a row or column
    };
    /// As cut.
    const Grid& grid() const { return grid_; }

    /// A rectangle of a grid's blocks: columns [left, right), rows [top, bottom).
    struct Cells {
        int face, left, top, right, bottom;
    };
    /// The largest chord from a unit vector in the middle column of some cells (of a cube map: anywhere in
    /// them) to a point of them; 2 where they go around more than a quarter of an equirect.
    double reach(const Cells& cells, const glm::dvec3& from) const;

    /// The largest angle a texel of the picture spans along either axis, radians.
    double texel_angle() const { return texel_angle_; }

    /// Points a texel and axis that points() offers, ascending.
    static constexpr int kOrders[] = {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128};

    /// Gauss-Legendre points of a block, kOrders[order_index] squared a texel, in place of what `points`
    /// held.
    void points(int block, int order_index, PatchPoints& points) const;

    /// The same of the texel in the middle of a block alone.
    void middle_points(int block, int order_index, PatchPoints& points) const;

    /// As points(), after what `points` held.
    void append_points(int block, int order_index, PatchPoints& points) const;

    /// A block of an equirect as its axes, for kernels that need no list of its points; `patch` is filled and
    /// points into this. False where the axes aren't tabulated: of cubes, and for high orders.
    bool tabulated_patch(int block, int order_index, LatLongPatch& patch) const;

  private:
    struct Block {
        int face, x, y;  ///< first texel
        int width, height;
        Cone cone;
    };
    /// Points along an axis of an equirect. The solid angle of a point is the product of its weights.
    struct AxisPoints {
        std::vector<double> sines, cosines, weights;
    };
    /// Of texels [first, first + count).
    AxisPoints longitudes(int first, int count, const QuadratureRule& rule) const;
    AxisPoints colatitudes(int first, int count, const QuadratureRule& rule) const;
    void add_blocks(int faces, int width, int height);
    void add_block(Block block);
    void tabulate_axes();
    void tabulate_halves();
    /// Unit vector in the world of a place in half texels.
    glm::dvec3 direction(int face, int half_x, int half_y) const;
    void append(const Block& block, int order_index, PatchPoints& points) const;
    bool is_tabulated(int order_index) const;
    LatLongPatch lat_long_patch(const Block& block, int order_index, const AxisPoints& columns,
                                const AxisPoints& rows) const;
    void equirect_points(const Block& block, int order_index, std::size_t at, PatchPoints& points) const;
    void cube_points(const Block& block, const QuadratureRule& rule, std::size_t at,
                     PatchPoints& points) const;

    EquirectView equirect_;
    CubeView cube_;
    double texel_angle_;
    std::vector<Block> blocks_;
    Grid grid_;
    std::vector<QuadratureRule> rules_;  ///< of kOrders
    /// Of whole equirects, for the orders that most points have; and their sines and cosines at all multiples
    /// of half a texel, where blocks have their corners and middles.
    static constexpr int kTabulated = 6;
    std::array<AxisPoints, kTabulated> longitudes_, colatitudes_;
    std::vector<SinCos> half_columns_, half_rows_;
};

}  // namespace pbr
