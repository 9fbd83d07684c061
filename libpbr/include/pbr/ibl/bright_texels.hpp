#pragma once
// What a picture's brightest texels add to LD: ld_partial (ibl/ld.hpp), fast for many texels.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "pbr/ibl/patches.hpp"
#include "pbr/ibl/split_kernel.hpp"

namespace pbr {

struct NearKernel;

/// Single texels of a picture, with the few points that most directions need of each kept. The picture must
/// outlive this.
class BrightTexels {
  public:
    /// `texels` are blocks of one texel each, of whose radiance `constant` is taken. The horizon of a
    /// direction may cut one, where the kernel has a kink: this may err by `horizon_error` >= 0, root mean
    /// square over the sphere, in the unit of radiance. By 32 x 32 points at most. `is_fine` takes more
    /// points everywhere.
    BrightTexels(PatchBlocks texels, const std::array<float, 3>& constant, double horizon_error,
                 bool is_fine);

    /// The integral of the kernel times (radiance - constant) over the texels, in `directions` (unit vectors,
    /// world), for alpha in (0, 1]; `rgb_out` holds 3 doubles each. As ld_partial: relative error below 3e-5,
    /// 1e-5 if fine, but for what a horizon cuts. Directions that lie together cost least. Returns its kernel
    /// evaluations. Thread-safe.
    std::uint64_t integrate(double alpha, std::span<const glm::dvec3> directions,
                            std::span<double> rgb_out) const;

    /// The same of the near part of a split kernel. Time grows with the texels near the directions.
    std::uint64_t integrate(const SplitKernel& split, std::span<const glm::dvec3> directions,
                            std::span<double> rgb_out) const;

  private:
    static constexpr int kKept = 4;  ///< orders

    class Sum;
    void points(int texel, int order_index, PatchPoints& points) const;
    std::uint64_t add_up(const NearKernel& kernel, double alpha, double radius,
                         std::span<const glm::dvec3> directions, std::span<double> rgb_out) const;

    PatchBlocks texels_;
    std::array<float, 3> constant_;
    double horizon_error_;
    int finer_;                            ///< orders
    std::vector<int> by_height_;           ///< texels by the y of their axes
    std::array<PatchPoints, kKept> kept_;  ///< of all texels, one after the other
};

}  // namespace pbr
