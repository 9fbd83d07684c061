#pragma once
// Drawing directions where a picture is bright: a triple sample / inverse / pdf of a picture's texels.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "pbr/ibl/environment.hpp"

namespace pbr {

/// A density over directions that follows a picture's light above its mean: a texel of mean radiance m (over
/// channels) has a share in proportion to max(0, m - mean over the sphere) times its solid angle. Beside a
/// second sampler that covers the rest, that leaves to it what it does better (Karlik et al. 2019, "MIS
/// compensation", eq. 13; here of the mean over directions, as pbrt-v4 has it). Reads the picture once and
/// keeps a copy of its texels, 24 bytes each beside the picture.
class EnvironmentSampler {
  public:
    /// Of a picture of any size, its radiance finite and not negative.
    explicit EnvironmentSampler(const EquirectView& source);
    explicit EnvironmentSampler(const CubeView& source);

    /// True if no texel is brighter than the mean, as in a constant or a black picture: nothing can be drawn,
    /// and all densities are 0.
    bool flat() const { return marginal_.back() <= 0; }

    /// A unit vector in the world with its texel and its density per steradian.
    struct Draw {
        glm::dvec3 direction;
        std::int64_t texel;
        double pdf;
    };

    /// Row by the marginal distribution from u1, texel by the row's own from u2, both in [0, 1), inverted by
    /// bisection; what is left of u1 and u2 places the direction within the texel: evenly in solid angle on
    /// an equirect, evenly over the face's area on a cube. Not to be called when flat().
    Draw sample(double u1, double u2) const;

    /// Density of sample() at a direction (any length but 0), 1/sr. Relative error below 1e-7: it is kept as
    /// a float.
    double pdf(const glm::dvec3& direction) const;

    /// The texel that a direction falls into, counted along rows, face after face.
    std::int64_t texel_at(const glm::dvec3& direction) const;

    /// Four floats a texel: radiance, and the density: per steradian on an equirect; on a cube to be
    /// multiplied by (1 + s^2 + t^2)^1.5, which is density per area of a face of half side 1.
    const std::vector<float>& texels() const { return texels_; }

    /// Texels along a row.
    int columns() const { return columns_; }
    /// Rows of all faces together.
    int rows() const { return rows_; }
    /// True of cube maps.
    bool is_cube() const { return is_cube_; }
    /// Takes world directions to the picture's own frame.
    const glm::dmat3& world_to_source() const { return world_to_source_; }

  private:
    EnvironmentSampler(const float* rgb, bool is_cube, int columns, int rows,
                       const glm::dmat3& world_to_source);
    double solid_angle(int row, int column) const;
    glm::dvec3 direction_in(int row, int column, double v1, double v2) const;

    bool is_cube_;
    int columns_, rows_;
    glm::dmat3 world_to_source_;
    std::vector<float> texels_;
    std::vector<double> conditional_;  ///< rows of columns + 1 sums from 0
    std::vector<double> marginal_;     ///< rows + 1 sums from 0
};

}  // namespace pbr
