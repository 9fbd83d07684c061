#pragma once
// The near part of a split kernel (ibl/split_kernel.hpp) against an equirect, texel by texel.

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/environment.hpp"
#include "pbr/ibl/equirect_rows.hpp"
#include "pbr/ibl/split_kernel.hpp"

namespace pbr {

/// An equirect less a constant, ready for sums with one near kernel. The picture must outlive this.
class NearField {
  public:
    /// Of a part of a picture, less its constant.
    NearField(const EquirectView& source, const PicturePart& part, const SplitKernel& split);

    /// The integral of near times (radiance - constant) over the part, constant over its texels, added to
    /// rgb[0] ... rgb[2] for each of `directions` (unit vectors, world). By Gauss-Legendre points, about four
    /// for each width of a texel over its distance from the kernel's poles: the error, as a share of the
    /// picture's contrast times the near part's own share of the lobe, is below 5e-4 (root mean square).
    /// Returns its kernel evaluations. Thread-safe; bits depend neither on the vector width nor on the
    /// company of directions.
    std::uint64_t add(std::span<const glm::dvec3> directions, std::span<double> rgb) const;

    /// Of the near part, radians.
    double radius() const { return radius_; }

    /// Of one rule: points within all rows, and within all columns twice over so that none wraps.
    struct Points {
        int order;
        double from2;                                    ///< chord^2 from which it is good enough
        std::vector<double> row_sine, row_cosine;        ///< [row * order + i]
        std::vector<float> row_weight;                   ///< solid angle of a texel's share
        std::vector<double> column_sine, column_cosine;  ///< [i * 2 width + column]
        std::vector<float> column_weight;                ///< [i]; they sum to 1
    };

  private:
    EquirectView source_;
    std::array<float, 3> constant_;
    SplitKernel split_;
    double radius_, texel_angle_;
    EquirectRows rows_;
    std::vector<Points> rules_;
};

}  // namespace pbr
