#pragma once
// A cube map's mip chain for filtered lookups that keep energy and its place.
//
// A level's texels are spread by bilinear weights when they are looked up, so a level is made by the
// transpose of that: the flux of each finer texel is shared among the four coarser texels around it, about
// 9 : 3 : 3 : 1, across edges too. That is even on the face and not on the sphere: left so, footprints shrink
// towards a cube's corners, and centroids move towards the middles of faces. Hence two more rules:
//
//   - Texels then exchange flux with their neighbours, more of it away from the middle of a face, until
//     footprints are as wide and as round on the sphere as they are in the middle. Exchange keeps constants.
//   - The four get their shares at the place, near the finer texel's middle, from where flux ends up with its
//     centroid - shares, exchange and the lookup's bilinear weights together - where it was.
//
// A texel then holds its flux over the solid angle H under its bilinear weight, the integral over all places
// of lookup. What each texel has in its fourth channel is the same of a white environment, W / H, and a
// lookup is the quotient, so that white stays white. The integral of any level's lookups before the quotient
// is the picture's flux. After it a lamp of one texel keeps its own within 1.5 %, and its centroid within .02
// of the level's texels, wherever it is. No texel is negative.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace pbr {

/// A cube map with its mip chain down to 1 x 1, laid out for filtered lookups: four floats a texel, each face
/// with a border of one texel copied from its neighbours (at corners the mean of the three that meet), so
/// that no lookup branches at an edge. The coarsest level lies first in memory.
class CubePyramid {
  public:
    /// From RGB faces of a power-of-two size, at most 4096.
    CubePyramid(std::span<const float> rgb, int size);

    /// Texels a side of level 0.
    int size() const { return size_; }
    /// Levels down to 1 x 1.
    int levels() const { return levels_; }
    /// Padded face: rows of (size_of(level) + 2) texels of four floats. Colour is to be divided by the fourth
    /// after interpolation.
    const float* face(int level, int face) const;
    /// Texels a side of a level, without borders.
    int size_of(int level) const { return size_ >> level; }
    /// All levels; what offset() counts in.
    const std::vector<float>& texels() const { return texels_; }
    /// Where a level begins in texels(), its padded face 0. Of n texels a side it begins 2 n^2 + 48 n texels
    /// from an origin: 6 n^2 + 48 n before the next finer one, which is room enough for 6 (n + 2)^2.
    std::int32_t offset(int level) const {
        const int n = 1 << (levels_ - 1 - level);
        return 4 * (2 * n * n + 48 * n - 50);
    }

    /// Bilinear within a level, linear between; `lod` is clamped to the chain. Direction of any length but 0.
    /// The scalar twin of the kernel's fetch.
    glm::vec3 sample(const glm::vec3& direction, float lod) const;

  private:
    float* texel(int level, int face, int x, int y);
    void fill_border(int level);
    int size_, levels_;
    std::vector<float> texels_;
};

}  // namespace pbr
