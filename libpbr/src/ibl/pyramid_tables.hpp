#pragma once
// What the levels of a cube pyramid are made by. See ibl/cube_pyramid.hpp.

#include <algorithm>
#include <array>
#include <glm/vec3.hpp>
#include <vector>

namespace pbr {

/// Values of a face's n x n texels that are the same on every face and, mirrored, in each of its quarters.
template <class T>
class QuarterTable {
  public:
    /// From the values of texels (x, y), 2 x < n and 2 y < n.
    template <class F>
    QuarterTable(int n, const F& value) : n_(n), side_((n + 1) / 2) {
        values_.reserve(static_cast<std::size_t>(side_) * side_);
        for (int y = 0; y < side_; ++y)
            for (int x = 0; x < side_; ++x) values_.push_back(value(x, y));
    }
    int size() const { return n_; }
    /// Any texel's. Indices outside mean the neighbour across the edge, which has the value of the texel at
    /// it.
    const T& operator()(int x, int y) const {
        return values_[static_cast<std::size_t>(folded(y)) * side_ + folded(x)];
    }

  private:
    int folded(int index) const {
        const int inside = std::clamp(index, 0, n_ - 1);
        return std::min(inside, n_ - 1 - inside);
    }
    int n_, side_;
    std::vector<T> values_;
};

/// A texel's bilinear weight over the sphere, its shares of the neighbouring faces included.
struct Hat {
    double solid_angle;   ///< the weight's integral
    glm::dvec3 centroid;  ///< its mean direction, shorter than 1: s, t and the face's normal, in quarter 0
};

/// Hats of a level of n texels a side. Relative error below 1e-4.
QuarterTable<Hat> make_hats(int n);

/// Weights of the 3 x 3 texels around a texel, by rows: one pass of what rounds footprints. They exchange
/// flux: what a texel gives to a neighbour per unit of its value, it takes per unit of the neighbour's. So a
/// pass keeps flux, and constants.
using RoundingWeights = std::array<double, 9>;
/// After one pass some texels of a lamp would be negative. Of two, only a cube's corner gives a little more
/// than it has, down to -.09; its neighbours' gifts outweigh that.
inline constexpr int kRoundingPasses = 2;
QuarterTable<RoundingWeights> make_rounding_weights(const QuarterTable<Hat>& hats);

/// Hats after all passes of rounding: where a texel's flux then lies.
QuarterTable<Hat> rounded(const QuarterTable<Hat>& hats, const QuarterTable<RoundingWeights>& weights);

/// Weights of the 4 x 4 finer texels around a coarser one, by rows, that make it their mean. Flux of a finer
/// texel is shared among four coarser ones by bilinear weights, at the place that leaves its centroid where
/// it was: about at the finer texel's middle.
using SharingWeights = std::array<double, 16>;
QuarterTable<SharingWeights> make_sharing_weights(const QuarterTable<Hat>& finer,
                                                  const QuarterTable<Hat>& hats,
                                                  const QuarterTable<Hat>& rounded_hats);

}  // namespace pbr
