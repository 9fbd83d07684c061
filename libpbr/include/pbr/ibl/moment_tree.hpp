#pragma once
// A picture as a tree of means and moments, so that sums over it can take distant parts as one.
//
// Over a part of the sphere about c, the integral of radiance times a smooth function g(n.d) of the direction
// d is
//     the sum over j of g^(j)(n.c)/j! times the integral of radiance times (n.(d - c))^j,
// whose powers are polynomials of n with the part's moments as coefficients: the multipoles of tree codes
// (Barnes & Hut 1986, "A hierarchical O(N log N) force-calculation algorithm"; Greengard & Rokhlin 1987).
// Moments up to the third leave a remainder of fourth order in the part's size.

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "pbr/ibl/patches.hpp"
#include "pbr/numerics/for_each.hpp"

namespace pbr {

/// Powers x^a y^b z^c of degree a + b + c up to the third, ascending.
struct Monomial {
    int a, b, c;
};
inline constexpr int kMomentCount = 20;
inline constexpr std::array<Monomial, kMomentCount> kMonomials{
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2},
     {1, 1, 0}, {1, 0, 1}, {0, 1, 1}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}, {2, 1, 0},
     {2, 0, 1}, {1, 2, 0}, {0, 2, 1}, {1, 0, 2}, {0, 1, 2}, {1, 1, 1}}};

/// Where a part of the picture lies: what decides whether it may be taken as one.
struct MomentCone {
    float axis[3], length;  ///< the mean direction is length times a unit vector: the centre
    float reach;            ///< the largest chord from the axis to a point of the part
    float solid_angle;      ///< sr
    float brightness;  ///< mean radiance over the whole picture's, of the channel where it is largest; at
                       ///< least 1

    /// The centre that moments are about.
    glm::dvec3 centre() const { return glm::dvec3(axis[0], axis[1], axis[2]) * static_cast<double>(length); }
};

/// Means over the part's solid angle, so that no radiance overflows, of radiance r, g, b, and of 1 in its
/// place, times a monomial of (x, y, z) = d - centre over a! b! c!.
struct Moments {
    float mean[kMomentCount][4];
};

/// Nodes over a picture's blocks: level 0 a node a block, each further level 2 x 2 of the one before, up to
/// one node a face. Keeps a reference: the blocks must outlive it.
class MomentTree {
  public:
    /// Of the blocks of a whole picture.
    MomentTree(const PatchBlocks& blocks, const ForEach& each);

    /// As given.
    const PatchBlocks& blocks() const { return *blocks_; }
    /// Levels up to one node a face.
    int levels() const { return static_cast<int>(levels_.size()); }

    /// The nodes of a level, by faces, rows and columns.
    struct Level {
        int columns, rows;
        std::vector<MomentCone> cones;
        std::vector<Moments> moments;
    };
    /// 0 … levels() - 1.
    const Level& level(int index) const { return levels_[static_cast<std::size_t>(index)]; }

    /// Mean radiance over the sphere.
    glm::dvec3 mean() const { return mean_; }

  private:
    void set_brightness();

    const PatchBlocks* blocks_;
    std::vector<Level> levels_;
    glm::dvec3 mean_;
};

/// Bands that moments up to the third determine: Y of l <= 3 are polynomials of as low a degree.
inline constexpr int kMomentBands = 4;

/// Integrals over the sphere of RGB radiance times kMonomials of the direction: sums, not means.
using SphereMoments = std::array<glm::dvec3, kMomentCount>;

/// Of a whole picture. Relative to the mean radiance within 1e-5 of the picture's points, whatever its size.
SphereMoments sphere_moments(const MomentTree& source);

/// Coefficients in spherical harmonics of what has these moments, in the order of sh_index: bands 1 to
/// kMomentBands. Exact but for rounding.
std::vector<glm::dvec3> sh_project(const SphereMoments& moments, int bands);

}  // namespace pbr
