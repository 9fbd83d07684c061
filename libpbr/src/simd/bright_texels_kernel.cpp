// Sums over single texels. Lanes hold output directions, points are broadcast: any vector width gives the
// same bits.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/simd/bright_texels_kernel.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "pbr/ibl/bright_texels.hpp"
#include "pbr/ibl/zonal_kernel.hpp"
#include "src/simd/ld_kernels.hpp"

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

/// Adds points [first, last) to a group. With its `normalisation`, k * weight is a share of the lobe, so that
/// radiances near the largest float don't overflow.
void add_points(const PatchPoints& points, std::size_t first, std::size_t last, float alpha2,
                float normalisation, BrightGroup& group) {
    constexpr std::size_t kFlush = 256;  // points summed in float before the sum moves on to double
    const hn::CappedTag<float, BrightGroup::kSize> d;
    const hn::Repartition<double, decltype(d)> wide;
    const hn::Rebind<float, decltype(wide)> narrow;
    using V = hn::Vec<decltype(d)>;
    const std::size_t lanes = hn::Lanes(d);
    // f = alpha^2 + (1 - alpha^2)/4 |n - d|^2 and mu = 1 - |n - d|^2 / 2 (see ibl/zonal_kernel.hpp).
    const V a2 = hn::Set(d, alpha2), slope = hn::Set(d, (1 - alpha2) / 4), one = hn::Set(d, 1.0f),
            half = hn::Set(d, 0.5f), factor = hn::Set(d, normalisation);
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
                const V mu = hn::Max(hn::Zero(d), hn::Sub(one, hn::Mul(half, chord2)));
                const V f = hn::Add(a2, hn::Mul(slope, chord2));
                const V k =
                    hn::Div(hn::Mul(hn::Mul(mu, factor), hn::Set(d, points.weight[i])), hn::Mul(f, f));
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
        for (const glm::dvec3& n : directions) reach = std::max(reach, glm::length(n - axis));
    }
    /// At most the angle between the bundle and a cone. Chords are shorter than angles.
    double nearest(const Cone& cone) const {
        return std::max(0.0, glm::length(axis - cone.axis) - kArc * reach - cone.half_angle);
    }
    /// True only if a cone lies wholly below the horizon of all directions: sines are less than angles.
    bool is_above(const Cone& cone) const {
        return glm::dot(axis, cone.axis) < -(kArc * reach + cone.half_angle);
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

BrightTexels::BrightTexels(PatchBlocks texels) : texels_(std::move(texels)) {
    PatchPoints points;
    for (std::size_t order = 0; order < kKept; ++order)
        for (int texel = 0; texel < texels_.count(); ++texel) {
            texels_.points(texel, static_cast<int>(order), points);
            PatchPoints& all = kept_[order];
            for (const auto& [to, from] : {std::pair{&all.x, &points.x},
                                           {&all.y, &points.y},
                                           {&all.z, &points.z},
                                           {&all.weight, &points.weight},
                                           {&all.r, &points.r},
                                           {&all.g, &points.g},
                                           {&all.b, &points.b}})
                to->insert(to->end(), from->begin(), from->end());
        }
}

std::uint64_t BrightTexels::integrate(double alpha, std::span<const glm::dvec3> directions,
                                      std::span<double> rgb_out) const {
    constexpr std::size_t kGroup = BrightGroup::kSize, kTogether = 4 * kGroup;
    const float alpha2 = static_cast<float>(alpha * alpha),
                normalisation = static_cast<float>(GgxZonalKernel(alpha).normalisation());
    std::uint64_t evaluations = 0;
    PatchPoints fresh;
    for (std::size_t begin = 0; begin < directions.size(); begin += kTogether) {
        const std::size_t end = std::min(directions.size(), begin + kTogether);
        const Bundle together(directions.subspan(begin, end - begin));
        std::vector<BrightGroup> groups;
        std::vector<Bundle> bundles;
        for (std::size_t i = begin; i < end; i += kGroup) {
            const std::span<const glm::dvec3> own = directions.subspan(i, std::min(kGroup, end - i));
            groups.push_back(group_of(own));
            bundles.emplace_back(own);
        }
        const auto add = [&](const PatchPoints& points, std::size_t first, std::size_t last,
                             BrightGroup& group) {
            HWY_DYNAMIC_DISPATCH(add_points)(points, first, last, alpha2, normalisation, group);
            evaluations += (last - first) * kGroup;
        };
        // Texels far from all groups need one point, and runs of them go together.
        std::size_t run = 0;
        const auto finish_run = [&](int texel) {
            for (BrightGroup& group : groups)
                if (run > 0) add(kept_[0], static_cast<std::size_t>(texel) - run, texel, group);
            run = 0;
        };
        for (int texel = 0; texel < texels_.count(); ++texel) {
            const Cone& cone = texels_.cone(texel);
            const bool unseen = together.is_above(cone);
            if (!unseen && ld_order_index(texels_.texel_angle(), alpha, together.nearest(cone)) == 0) {
                ++run;
                continue;
            }
            finish_run(texel);
            for (std::size_t g = 0; g < groups.size() && !unseen; ++g) {
                const int index = ld_order_index(texels_.texel_angle(), alpha, bundles[g].nearest(cone));
                if (index < kKept) {
                    const auto count = static_cast<std::size_t>(PatchBlocks::kOrders[index]) *
                                       static_cast<std::size_t>(PatchBlocks::kOrders[index]);
                    add(kept_[static_cast<std::size_t>(index)], texel * count, (texel + 1) * count,
                        groups[g]);
                } else {
                    texels_.points(texel, index, fresh);
                    add(fresh, 0, fresh.size(), groups[g]);
                }
            }
        }
        finish_run(texels_.count());
        for (std::size_t i = begin; i < end; ++i)
            for (std::size_t c = 0; c < 3; ++c)
                rgb_out[i * 3 + c] = groups[(i - begin) / kGroup].sum[c][(i - begin) % kGroup];
    }
    return evaluations;
}

}  // namespace pbr
#endif
