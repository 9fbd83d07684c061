// The exact LD sum over a tree: distant parts as one, near ones by their texels' points.

#include <hwy/cache_control.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <numbers>
#include <type_traits>
#include <vector>

#include "pbr/ibl/ld.hpp"
#include "pbr/ibl/zonal_kernel.hpp"
#include "pbr/numerics/elementary.hpp"
#include "src/simd/ld_kernels.hpp"

namespace pbr {
namespace {

/// Directions farther apart, in radians from their middle, walk the tree one by one: together they would find
/// too little of it far from all of them.
constexpr double kWidestGroup = 0.1;

constexpr float kBright = 4;  // times the mean

/// What a lamp that the horizon cuts may be off by, over the picture's mean; but no more than 128 points
/// along a leaf's side, 32 to 8 a texel.
constexpr double kCutError = 1e-4, kPointsAtHorizon = 128;

/// What nodes are allowed at first, in tolerances.
constexpr double kGenerous = 3;

constexpr std::size_t kBatch = 512;  // points that are summed at once: they stay in the nearest cache

/// Cosine and sine of an angle in [0, pi].
struct Angle {
    double cos, sin;
};

/// The angle between unit vectors, from the square of the chord between them, without cancellation.
Angle angle_of(double chord_squared) {
    const double square = std::min(4.0, chord_squared);
    return {1 - square / 2, std::sqrt(square * (1 - square / 4))};
}
Angle difference(Angle a, Angle b) {  // 0 if b is larger
    if (b.cos <= a.cos) return {1, 0};
    return {a.cos * b.cos + a.sin * b.sin, std::max(0.0, a.sin * b.cos - a.cos * b.sin)};
}
Angle sum(Angle a, Angle b) {  // pi if beyond it
    const double sine = a.sin * b.cos + a.cos * b.sin;
    if (sine < 0 || (a.cos < 0 && b.cos < 0)) return {-1, 0};
    return {a.cos * b.cos - a.sin * b.sin, sine};
}

/// How a node stands to a group of directions.
enum class Standing { below, far, near };
struct Verdict {
    Standing standing;
    double remainder;  ///< of a far one, or of one so little above the horizon that it counts as below: times
                       ///< flux
};

/// Bounds of the kernel's Taylor remainder over nodes.
class Judge {
  public:
    Judge(const GgxZonalKernel& kernel, double tolerance)
        : normalisation_(kernel.normalisation()),
          alpha2_(kernel.alpha() * kernel.alpha()),
          slope_(std::max((1 - alpha2_) / 2, 1e-12)),
          inverse_slope_(1 / slope_),
          allowed_(tolerance / (4 * std::numbers::pi)) {}

    /// `apart`: angle between the axes of node and group; `spread`: half angle of the group.
    Verdict operator()(const MomentCone& node, Angle apart, Angle spread) const {
        const Angle nearest = difference(apart, spread), farthest = sum(apart, spread);
        const double length = node.length, reach = node.reach;
        const double highest_centre = length * nearest.cos, lowest_centre = length * farthest.cos;
        // |n.(d - c)|: across the axis at most reach, along it at most reach^2 / 2.
        const bool crosses_square = nearest.cos > 0 && farthest.cos < 0;
        const double across = crosses_square ? 1 : std::max(nearest.sin, farthest.sin);
        const double along = std::max(std::abs(nearest.cos), std::abs(farthest.cos));
        const double swing = reach * across + reach * reach / 2 * along;
        const double highest = highest_centre + swing;
        if (highest <= 0) return {Standing::below, 0};
        // 1/f^2 has its pole where f(x) = alpha^2 + (1 - x) slope is 0.
        const double f = alpha2_ + slope_ * (1 - highest_centre), distance = f * inverse_slope_;
        const double inverse_f = 1 / f, q = swing * slope_ * inverse_f;
        if (q >= 0.5) return {Standing::near, 0};
        // k = N (x + D u) / f^2 / (1 - u)^2 with u = (n.d - x) / D: the series from u^4 on.
        const double tail = q * q * q * q / ((1 - q) * (1 - q));
        double remainder = normalisation_ * inverse_f * inverse_f *
                           (std::max(std::abs(highest_centre), std::abs(lowest_centre)) * tail * (5 - 4 * q) +
                            distance * tail * (4 - 3 * q));
        const double lowest = lowest_centre - swing;
        if (lowest < 0) {
            if (remainder > allowed_) return {Standing::near, 0};
            // Only a band as wide as its nodes crosses the horizon: of the nodes in it, each is allowed what
            // makes half the tolerance for all of them. The expansion goes on below, where k is 0 and f above
            // its value at the horizon.
            const double at_horizon = alpha2_ + slope_, f_highest = alpha2_ + slope_ * (1 - highest);
            const double allowed = allowed_ / (2 * (highest - lowest) * static_cast<double>(node.brightness));
            const double as_below = normalisation_ * highest / (f_highest * f_highest);
            if (as_below <= allowed) return {Standing::below, as_below};
            remainder += normalisation_ * -lowest / (at_horizon * at_horizon);
            return {remainder <= allowed ? Standing::far : Standing::near, remainder};
        }
        return {remainder <= allowed_ ? Standing::far : Standing::near, remainder};
    }

  private:
    double normalisation_, alpha2_, slope_, inverse_slope_, allowed_;
};

/// A block whose points a group needs.
struct Visit {
    int block, order_index;
};

/// What a group takes from the tree.
struct Walk {
    std::vector<MomentNode> far;
    std::vector<Visit> near;
    std::array<double, 4> remainder{};  ///< of r, g, b and the weights: proven bounds of their sums' errors
};

struct Place {
    int level, face, x, y;
};

/// Sorts the tree's nodes for a group.
class Walker {
  public:
    Walker(const MomentTree& tree, double alpha) : tree_(tree), alpha_(alpha) {}

    void operator()(const Cone& cone, const Judge& judge, Walk& walk) {
        const SinCos half_angle = sin_cos_pi(cone.half_angle / std::numbers::pi);
        const Angle spread{half_angle.cos, half_angle.sin};
        const int top = tree_.levels() - 1;
        const int faces = static_cast<int>(tree_.level(top).cones.size());
        for (int face = faces - 1; face >= 0; --face) stack_.push_back({top, face, 0, 0});
        while (!stack_.empty()) {
            const Place place = stack_.back();
            stack_.pop_back();
            const MomentTree::Level& level = tree_.level(place.level);
            const int index = (place.face * level.rows + place.y) * level.columns + place.x;
            const MomentCone& node = level.cones[static_cast<std::size_t>(index)];
            const glm::dvec3 between = cone.axis - glm::dvec3(node.axis[0], node.axis[1], node.axis[2]);
            const Angle apart = angle_of(glm::dot(between, between));
            const Verdict verdict = judge(node, apart, spread);
            if (verdict.standing == Standing::near) {
                if (place.level > 0) {
                    push_children(place);
                } else {
                    walk.near.push_back({index, order_index(node, apart, spread)});
                }
                continue;
            }
            const Moments& moments = level.moments[static_cast<std::size_t>(index)];
            if (verdict.standing == Standing::far) walk.far.push_back({&node, &moments});
            if (verdict.remainder == 0) continue;
            for (std::size_t c = 0; c < 4; ++c)
                walk.remainder[c] += verdict.remainder * static_cast<double>(node.solid_angle) *
                                     static_cast<double>(moments.mean[0][c]);
        }
    }

  private:
    /// The order of points of a leaf.
    int order_index(const MomentCone& node, Angle apart, Angle spread) const {
        const Angle reach = angle_of(double{node.reach} * double{node.reach}),
                    nearest = difference(difference(apart, spread), reach);
        // Its sine is not above the angle: rather too many points than too few.
        const int order =
            ld_order_index(tree_.blocks().texel_angle(), alpha_, nearest.cos > 0 ? nearest.sin : 1);
        if (node.brightness <= kBright) return order;
        // The errors of many texels cancel, but a sun's stands alone and gets a step more, or what a horizon
        // through it takes.
        constexpr int kLast = static_cast<int>(std::size(PatchBlocks::kOrders)) - 1;
        if (sum(sum(apart, spread), reach).cos > 0) return std::min(order + 1, kLast);
        return std::max(order, order_at_horizon(node.brightness));
    }

    /// n x n points take a texel that a horizon cuts to about .1 / n^2 of its light: what makes that
    /// kCutError of the picture's.
    int order_at_horizon(double brightness) const {
        const double angle = tree_.blocks().texel_angle();
        const double wanted = std::min(angle * std::sqrt(0.1 * brightness / (std::numbers::pi * kCutError)),
                                       kPointsAtHorizon / tree_.blocks().grid().side);
        int index = 0;
        while (PatchBlocks::kOrders[index] < wanted) ++index;
        return index;
    }

    void push_children(const Place& place) {
        const MomentTree::Level& below = tree_.level(place.level - 1);
        for (int k = 3; k >= 0; --k) {
            const int x = 2 * place.x + k % 2, y = 2 * place.y + k / 2;
            if (x >= below.columns || y >= below.rows) continue;
            hwy::Prefetch(
                &below.cones[(static_cast<std::size_t>(place.face) * below.rows + y) * below.columns + x]);
            stack_.push_back({place.level - 1, place.face, x, y});
        }
    }

    const MomentTree& tree_;
    double alpha_;
    std::vector<Place> stack_;
};

/// Sums of some directions over the tree, as they walk it.
class TreeSum {
  public:
    TreeSum(const MomentTree& tree, double alpha, double tolerance)
        : tree_(tree),
          alpha_(alpha),
          tolerance_(tolerance),
          kernel_(alpha),
          generous_(kernel_, kGenerous * tolerance),
          strict_(kernel_, tolerance),
          walker_(tree, alpha) {}

    /// Adds what `cone` takes from the tree to `sums`, an LdGroup or LdSingle. Returns the proven bounds of
    /// the errors of r, g, b and the weights.
    template <class Sums>
    std::array<double, 4> add(const Cone& cone, Sums& sums) {
        const Walk walk = walk_of(cone);
        ld_add_nodes(walk.far, alpha_, kernel_.normalisation(), sums);
        evaluations_ += walk.far.size();
        for (std::size_t i = 0; i < walk.near.size(); ++i) {
            if (i + 1 < walk.near.size()) prefetch(walk.near[i + 1]);
            add_near(walk.near[i], sums);
        }
        add_points(sums);
        return walk.remainder;
    }

    /// Nodes and points so far.
    std::uint64_t evaluations() const { return evaluations_; }

  private:
    /// All nodes together mostly stay within the tolerance where each is allowed more: fewer are opened.
    Walk walk_of(const Cone& cone) {
        Walk walk;
        walker_(cone, generous_, walk);
        const glm::dvec3 mean = tree_.mean();
        const double allowed = tolerance_ * (mean.x + mean.y + mean.z) / 3;
        const auto& [r, g, b, weights] = walk.remainder;
        if (std::max({r, g, b}) > allowed || weights > tolerance_) {
            walk = {};
            walker_(cone, strict_, walk);
        }
        return walk;
    }

    /// A large picture's rows lie pages apart, where the processor doesn't guess what comes next.
    void prefetch(const Visit& visit) const {
        const PatchBlocks& blocks = tree_.blocks();
        const EquirectView& picture = blocks.equirect();
        if (!picture.rgb) return;
        constexpr int kLine = 16;  // floats
        const auto [faces, columns, rows, side] = blocks.grid();
        const int x = visit.block % columns * side, y = visit.block / columns * side;
        const int width = 3 * std::min(side, picture.width - x), bottom = std::min(y + side, picture.height);
        for (int row = y; row < bottom; ++row)
            for (int i = 0; i < width; i += kLine) hwy::Prefetch(picture.texel(x, row) + i);
    }

    template <class Sums>
    void add_near(const Visit& visit, Sums& sums) {
        if constexpr (std::is_same_v<Sums, LdSingle>) {
            LatLongPatch patch;
            if (tree_.blocks().tabulated_patch(visit.block, visit.order_index, patch)) {
                ld_add_points(patch, alpha_, kernel_.normalisation(), sums);
                evaluations_ +=
                    static_cast<std::uint64_t>(patch.width) * patch.height * patch.order * patch.order;
                return;
            }
        }
        tree_.blocks().append_points(visit.block, visit.order_index, points_);
        if (points_.size() >= kBatch) add_points(sums);
    }

    template <class Sums>
    void add_points(Sums& sums) {
        ld_add_points(points_, alpha_, kernel_.normalisation(), sums);
        evaluations_ += points_.size();
        points_.resize(0);
    }

    const MomentTree& tree_;
    double alpha_;
    double tolerance_;
    GgxZonalKernel kernel_;
    Judge generous_, strict_;
    Walker walker_;
    PatchPoints points_;
    std::uint64_t evaluations_ = 0;
};

}  // namespace

LdTreeError ld_exact(const MomentTree& source, double alpha, double tolerance,
                     std::span<const glm::dvec3> directions, std::span<double> rgb_out,
                     std::uint64_t& evaluations) {
    assert(tolerance > 0 && tolerance <= 1);
    TreeSum tree_sum(source, alpha, tolerance);
    const glm::dvec3 mean = source.mean();
    const double mean_of_channels = (mean.x + mean.y + mean.z) / 3;
    LdTreeError error{0, 0};
    const auto finish = [&](std::size_t i, const std::array<double, 4>& sum,
                            const std::array<double, 4>& remainder) {
        error.deviation = std::max(error.deviation, std::abs(sum[3] - 1));
        for (std::size_t c = 0; c < 3; ++c) {
            const double value = rgb_out[i * 3 + c] = sum[c] / sum[3];
            const double moved = remainder[c] + remainder[3] * value;
            if (moved > 0) error.far_field = std::max(error.far_field, moved / (mean_of_channels + value));
        }
    };
    for (std::size_t first = 0; first < directions.size(); first += kLdGroup) {
        const auto members =
            directions.subspan(first, std::min<std::size_t>(kLdGroup, directions.size() - first));
        LdGroup group;
        const Cone cone = ld_fill_group(members, group);
        if (members.size() > 1 && cone.half_angle <= kWidestGroup) {
            const std::array<double, 4> remainder = tree_sum.add(cone, group);
            for (std::size_t lane = 0; lane < members.size(); ++lane)
                finish(first + lane,
                       {group.sum[0][lane], group.sum[1][lane], group.sum[2][lane], group.sum[3][lane]},
                       remainder);
            continue;
        }
        for (std::size_t lane = 0; lane < members.size(); ++lane) {
            LdSingle single{members[lane], {}};
            const std::array<double, 4> remainder = tree_sum.add({members[lane], 0}, single);
            finish(first + lane, std::to_array(single.sum), remainder);
        }
    }
    evaluations += tree_sum.evaluations();
    return error;
}

}  // namespace pbr
