// Sums over single texels. Lanes hold output directions, points are broadcast: any vector width gives the
// same bits.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/simd/bright_texels_kernel.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <vector>

#include "pbr/ibl/bright_texels.hpp"
#include "pbr/ibl/zonal_kernel.hpp"
#include "src/simd/ld_kernels.hpp"
#include "src/simd/near_field_kernel.hpp"

namespace pbr {
#ifndef PBR_BRIGHT_TEXELS_GROUP_
#define PBR_BRIGHT_TEXELS_GROUP_
/// Directions that share their points, and their sums.
struct BrightGroup {
    static constexpr std::size_t kSize = 16;
    HWY_ALIGN_MAX float x[kSize], y[kSize], z[kSize];
    HWY_ALIGN_MAX double sum[3][kSize];
};
#endif
}  // namespace pbr

HWY_BEFORE_NAMESPACE();
namespace pbr {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// What a split kernel's far part takes off the lobe; 0 where it is all.
template <bool is_near, class D, class V = hn::Vec<D>>
HWY_INLINE V near_part(D d, const NearKernel& kernel, V whole, V one_minus_mu) {
    if constexpr (!is_near) return whole;
    const V t = hn::Sub(one_minus_mu, hn::Set(d, kernel.limit));
    V far = hn::Set(d, kernel.polynomial[3]);
    for (int n = 2; n >= 0; --n)
        far = hn::Add(hn::Mul(far, t), hn::Set(d, kernel.polynomial[static_cast<std::size_t>(n)]));
    return hn::IfThenElseZero(hn::Lt(t, hn::Zero(d)), hn::Sub(whole, far));
}

/// Adds points [first, last) to a group. With its normalisation, k * weight is a share of the lobe, so that
/// radiances near the largest float don't overflow.
template <bool is_near>
void add_points_of(const PatchPoints& points, std::size_t first, std::size_t last, const NearKernel& kernel,
                   BrightGroup& group) {
    constexpr std::size_t kFlush = 256;  // points summed in float before the sum moves on to double
    const hn::CappedTag<float, BrightGroup::kSize> d;
    const hn::Repartition<double, decltype(d)> wide;
    const hn::Rebind<float, decltype(wide)> narrow;
    using V = hn::Vec<decltype(d)>;
    const std::size_t lanes = hn::Lanes(d);
    // f = alpha^2 + (1 - alpha^2)/4 |n - d|^2 and mu = 1 - |n - d|^2 / 2 (see ibl/zonal_kernel.hpp).
    const V a2 = hn::Set(d, kernel.alpha2), slope = hn::Set(d, kernel.slope), one = hn::Set(d, 1.0f),
            half = hn::Set(d, 0.5f), factor = hn::Set(d, kernel.normalisation);
    for (; first < last; first += kFlush) {
        const std::size_t end = std::min(last, first + kFlush);
        for (std::size_t begin = 0; begin < BrightGroup::kSize; begin += lanes) {
            const V nx = hn::Load(d, group.x + begin), ny = hn::Load(d, group.y + begin),
                    nz = hn::Load(d, group.z + begin);
            V sum[3] = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
            for (std::size_t i = first; i < end; ++i) {
                const V dx = hn::Sub(nx, hn::Set(d, points.x[i])), dy = hn::Sub(ny, hn::Set(d, points.y[i])),
                        dz = hn::Sub(nz, hn::Set(d, points.z[i]));
                const V chord2 = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
                const V one_minus_mu = hn::Mul(half, chord2);
                const V mu = hn::Max(hn::Zero(d), hn::Sub(one, one_minus_mu));
                const V f = hn::Add(a2, hn::Mul(slope, chord2));
                const V whole = hn::Div(hn::Mul(mu, factor), hn::Mul(f, f));
                const V k =
                    hn::Mul(near_part<is_near>(d, kernel, whole, one_minus_mu), hn::Set(d, points.weight[i]));
                sum[0] = hn::Add(sum[0], hn::Mul(k, hn::Set(d, points.r[i])));
                sum[1] = hn::Add(sum[1], hn::Mul(k, hn::Set(d, points.g[i])));
                sum[2] = hn::Add(sum[2], hn::Mul(k, hn::Set(d, points.b[i])));
            }
            HWY_ALIGN_MAX float out[BrightGroup::kSize];
            for (std::size_t c = 0; c < 3; ++c) {
                hn::Store(sum[c], d, out);
                for (std::size_t lane = 0; lane < lanes; lane += hn::Lanes(wide)) {
                    double* sum_of = &group.sum[c][begin + lane];
                    const auto more = hn::PromoteTo(wide, hn::Load(narrow, out + lane));
                    hn::Store(hn::Add(hn::Load(wide, sum_of), more), wide, sum_of);
                }
            }
        }
    }
}

void add_points(const PatchPoints& points, std::size_t first, std::size_t last, const NearKernel& kernel,
                BrightGroup& group) {
    if (kernel.limit < 1)
        add_points_of<true>(points, first, last, kernel, group);
    else
        add_points_of<false>(points, first, last, kernel, group);
}

}  // namespace HWY_NAMESPACE
}  // namespace pbr
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pbr {
namespace {

HWY_EXPORT(add_points);

/// A mean direction, and the largest distance from it.
struct Bundle {
    explicit Bundle(std::span<const glm::dvec3> directions) : axis(0), reach(0) {
        for (const glm::dvec3& n : directions) axis += n;
        axis = glm::normalize(axis + directions[0] * 1e-9);
        for (const glm::dvec3& n : directions) reach = std::max(reach, glm::dot(n - axis, n - axis));
        reach = std::sqrt(reach);
    }
    /// At most the angle between the bundle and a cone. Chords are shorter than angles.
    double nearest(const Cone& cone) const {
        return std::max(0.0, glm::length(axis - cone.axis) - kArc * reach - cone.half_angle);
    }
    /// True only if a cone lies wholly below the horizon of all directions: sines are less than angles.
    bool is_above(const Cone& cone) const {
        return glm::dot(axis, cone.axis) < -(kArc * reach + cone.half_angle);
    }

    /// True if the horizon of some direction may cut a cone.
    bool is_cut(const Cone& cone) const {
        return std::abs(glm::dot(axis, cone.axis)) <= kArc * reach + cone.half_angle;
    }

    static constexpr double kArc = 1.5707963267948966;  ///< angle over chord, at most
    glm::dvec3 axis;
    double reach;
};

BrightGroup group_of(std::span<const glm::dvec3> directions) {
    BrightGroup group{};
    for (std::size_t i = 0; i < BrightGroup::kSize; ++i) {
        const glm::dvec3& n = directions[std::min(i, directions.size() - 1)];
        group.x[i] = static_cast<float>(n.x);
        group.y[i] = static_cast<float>(n.y);
        group.z[i] = static_cast<float>(n.z);
    }
    return group;
}

}  // namespace

BrightTexels::BrightTexels(PatchBlocks texels, const std::array<float, 3>& constant, double horizon_error,
                           bool is_fine)
    : texels_(std::move(texels)), constant_(constant), horizon_error_(horizon_error), finer_(is_fine) {
    PatchPoints own;
    for (std::size_t order = 0; order < kKept; ++order)
        for (int texel = 0; texel < texels_.count(); ++texel) {
            points(texel, static_cast<int>(order), own);
            PatchPoints& all = kept_[order];
            for (const auto& [to, from] : {std::pair{&all.x, &own.x},
                                           {&all.y, &own.y},
                                           {&all.z, &own.z},
                                           {&all.weight, &own.weight},
                                           {&all.r, &own.r},
                                           {&all.g, &own.g},
                                           {&all.b, &own.b}})
                to->insert(to->end(), from->begin(), from->end());
        }
    by_height_.resize(static_cast<std::size_t>(texels_.count()));
    std::iota(by_height_.begin(), by_height_.end(), 0);
    std::ranges::stable_sort(by_height_, {}, [&](int texel) { return texels_.cone(texel).axis.y; });
}

void BrightTexels::points(int texel, int order_index, PatchPoints& points) const {
    texels_.points(texel, order_index, points);
    const auto take = [](float constant, std::vector<float>& values) {
        for (float& value : values) value -= constant;
    };
    take(constant_[0], points.r);
    take(constant_[1], points.g);
    take(constant_[2], points.b);
}

/// Directions in up to four groups that lie together, and their sums of one kernel.
class BrightTexels::Sum {
  public:
    static constexpr std::size_t kTogether = 4 * BrightGroup::kSize;

    Sum(const BrightTexels& of, const NearKernel& kernel, double alpha,
        std::span<const glm::dvec3> directions)
        : of_(of), kernel_(kernel), alpha_(alpha), together_(directions) {
        const double f = (1 + alpha * alpha) / 2;  // at the horizon
        rise_ = GgxZonalKernel(alpha).normalisation() / (f * f);
        for (std::size_t i = 0; i < directions.size(); i += BrightGroup::kSize) {
            const std::span<const glm::dvec3> own =
                directions.subspan(i, std::min(BrightGroup::kSize, directions.size() - i));
            groups_.push_back(group_of(own));
            bundles_.emplace_back(own);
        }
    }

    void add_all() {
        // Texels far from all groups need one point, and runs of them go together.
        const int count = of_.texels_.count();
        int run = 0;
        const auto finish_run = [&](int texel) {
            for (BrightGroup& group : groups_)
                if (run > 0) add(of_.kept_[0], texel - run, static_cast<std::size_t>(texel), group);
            run = 0;
        };
        for (int texel = 0; texel < count; ++texel) {
            const Cone& cone = of_.texels_.cone(texel);
            const bool unseen = together_.is_above(cone);
            if (!unseen && order_index(texel, together_) == 0) {
                ++run;
                continue;
            }
            finish_run(texel);
            if (!unseen) add_texel(texel, std::numbers::pi);
        }
        finish_run(count);
    }

    /// Texels within an angle of any direction alone.
    void add_near(double radius) {
        // Of two directions an angle apart, heights differ by no more.
        const auto height = [&](int texel) { return of_.texels_.cone(texel).axis.y; };
        const double apart = radius + Bundle::kArc * together_.reach + of_.texels_.texel_angle();
        const auto first = std::ranges::lower_bound(of_.by_height_, together_.axis.y - apart, {}, height);
        const auto last = std::ranges::upper_bound(of_.by_height_, together_.axis.y + apart, {}, height);
        for (auto texel = first; texel != last; ++texel)
            if (together_.nearest(of_.texels_.cone(*texel)) < radius) add_texel(*texel, radius);
    }

    /// The sum in one of the directions.
    double sum(std::size_t direction, std::size_t channel) const {
        return groups_[direction / BrightGroup::kSize].sum[channel][direction % BrightGroup::kSize];
    }
    std::uint64_t evaluations() const { return evaluations_; }

  private:
    /// The order of points of a texel for some directions.
    int order_index(int texel, const Bundle& bundle) const {
        const Cone& cone = of_.texels_.cone(texel);
        constexpr int kLast = static_cast<int>(std::size(PatchBlocks::kOrders)) - 1;
        const int order = std::min(
            kLast, ld_order_index(of_.texels_.texel_angle(), alpha_, bundle.nearest(cone)) + of_.finer_);
        return bundle.is_cut(cone) ? std::max(order, order_at_horizon(texel)) : order;
    }

    /// Where the kernel rises from 0 with the sine over the horizon, n x n points of a texel of angle h err
    /// by h / (8 n^2) of the rise times its light, in a band h wide.
    int order_at_horizon(int texel) const {
        const PatchPoints& middles = of_.kept_[0];
        const auto i = static_cast<std::size_t>(texel);
        const double light = static_cast<double>(middles.weight[i]) *
                             static_cast<double>(std::max({middles.r[i], middles.g[i], middles.b[i]}));
        const double h = of_.texels_.texel_angle();
        const double error = h / 8 * rise_ * light * std::sqrt(h / 2);
        int index = 0;
        while (PatchBlocks::kOrders[index] < kMostAtHorizon &&
               error > PatchBlocks::kOrders[index] * PatchBlocks::kOrders[index] * of_.horizon_error_)
            ++index;
        return index;
    }

    void add_texel(int texel, double radius) {
        for (std::size_t g = 0; g < groups_.size(); ++g) {
            if (bundles_[g].nearest(of_.texels_.cone(texel)) > radius) continue;
            const int index = order_index(texel, bundles_[g]);
            if (index < kKept) {
                const auto count = static_cast<std::size_t>(PatchBlocks::kOrders[index]) *
                                   static_cast<std::size_t>(PatchBlocks::kOrders[index]);
                const std::size_t at = static_cast<std::size_t>(texel) * count;
                add(of_.kept_[static_cast<std::size_t>(index)], at, at + count, groups_[g]);
            } else {
                of_.points(texel, index, fresh_);
                add(fresh_, 0, fresh_.size(), groups_[g]);
            }
        }
    }

    void add(const PatchPoints& points, std::size_t first, std::size_t last, BrightGroup& group) {
        HWY_DYNAMIC_DISPATCH(add_points)(points, first, last, kernel_, group);
        evaluations_ += (last - first) * BrightGroup::kSize;
    }

    static constexpr int kMostAtHorizon = 32;  // points a side

    const BrightTexels& of_;
    const NearKernel& kernel_;
    double alpha_;
    double rise_;  ///< of the kernel above the horizon
    Bundle together_;
    std::vector<BrightGroup> groups_;
    std::vector<Bundle> bundles_;
    PatchPoints fresh_;
    std::uint64_t evaluations_ = 0;
};

std::uint64_t BrightTexels::integrate(double alpha, std::span<const glm::dvec3> directions,
                                      std::span<double> rgb_out) const {
    return add_up(NearKernel(GgxZonalKernel(alpha)), alpha, std::numbers::pi, directions, rgb_out);
}

std::uint64_t BrightTexels::integrate(const SplitKernel& split, std::span<const glm::dvec3> directions,
                                      std::span<double> rgb_out) const {
    return add_up(NearKernel(split), split.kernel().alpha(), split.radius(), directions, rgb_out);
}

std::uint64_t BrightTexels::add_up(const NearKernel& kernel, double alpha, double radius,
                                   std::span<const glm::dvec3> directions, std::span<double> rgb_out) const {
    std::uint64_t evaluations = 0;
    for (std::size_t begin = 0; begin < directions.size(); begin += Sum::kTogether) {
        const std::size_t count = std::min(Sum::kTogether, directions.size() - begin);
        Sum sum(*this, kernel, alpha, directions.subspan(begin, count));
        if (kernel.limit < 1)
            sum.add_near(radius);
        else
            sum.add_all();
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t c = 0; c < 3; ++c) rgb_out[(begin + i) * 3 + c] = sum.sum(i, c);
        evaluations += sum.evaluations();
    }
    return evaluations;
}

}  // namespace pbr
#endif
