// The exact LD sum. Lanes hold output directions, points are broadcast: any vector width gives the same bits.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/simd/ld_exact_kernel.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "pbr/ibl/ld.hpp"
#include "pbr/ibl/zonal_kernel.hpp"
#include "src/simd/ld_kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace pbr {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kFlush = 256;  // points summed in float before the sum moves on to double

/// Adds k(n.d) * weight * radiance of all points to the group's sums. With its `normalisation`, k * weight is
/// a share of the lobe: sums of radiances near the largest float don't overflow.
void add_block(const PatchPoints& points, float alpha2, float normalisation, LdGroup& group) {
    const hn::CappedTag<float, kLdGroup> d;
    using V = hn::Vec<decltype(d)>;
    const std::size_t lanes = hn::Lanes(d);
    // f = alpha^2 + (1 - alpha^2)/4 |n - d|^2 and mu = 1 - |n - d|^2 / 2 (see ibl/zonal_kernel.hpp).
    const V a2 = hn::Set(d, alpha2), slope = hn::Set(d, (1 - alpha2) / 4), one = hn::Set(d, 1.0f),
            half = hn::Set(d, 0.5f);
    const V factor = hn::Set(d, normalisation);
    for (std::size_t first = 0; first < points.size(); first += kFlush) {
        const std::size_t last = std::min(points.size(), first + kFlush);
        for (std::size_t begin = 0; begin < kLdGroup; begin += lanes) {
            const V nx = hn::Load(d, group.x + begin), ny = hn::Load(d, group.y + begin),
                    nz = hn::Load(d, group.z + begin);
            V r = hn::Zero(d), g = hn::Zero(d), b = hn::Zero(d), w = hn::Zero(d);
            for (std::size_t i = first; i < last; ++i) {
                const V dx = hn::Sub(nx, hn::Set(d, points.x[i])), dy = hn::Sub(ny, hn::Set(d, points.y[i]));
                const V dz = hn::Sub(nz, hn::Set(d, points.z[i]));
                const V chord2 = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
                const V mu = hn::Max(hn::Zero(d), hn::Sub(one, hn::Mul(half, chord2)));
                const V f = hn::Add(a2, hn::Mul(slope, chord2));
                const V k =
                    hn::Div(hn::Mul(hn::Mul(mu, factor), hn::Set(d, points.weight[i])), hn::Mul(f, f));
                r = hn::Add(r, hn::Mul(k, hn::Set(d, points.r[i])));
                g = hn::Add(g, hn::Mul(k, hn::Set(d, points.g[i])));
                b = hn::Add(b, hn::Mul(k, hn::Set(d, points.b[i])));
                w = hn::Add(w, k);
            }
            HWY_ALIGN_MAX float out[kLdGroup];
            for (const auto& [value, channel] :
                 {std::pair{r, 0}, std::pair{g, 1}, std::pair{b, 2}, std::pair{w, 3}}) {
                hn::Store(value, d, out);
                for (std::size_t lane = 0; lane < lanes; ++lane)
                    group.sum[channel][begin + lane] += static_cast<double>(out[lane]);
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

HWY_EXPORT(add_block);

/// Points a texel needs at an angle from the lobe's axis: Gauss-Legendre over a texel of angle h converges
/// once h is well below the distance of the kernel's poles, which is about hypot(2 alpha, angle).
int order_index(double texel_angle, double alpha, double nearest_angle) {
    const double reach = texel_angle / std::sqrt(4 * alpha * alpha + nearest_angle * nearest_angle);
    if (reach < 0.02) return 0;
    const double wanted = 1.5 + 4 * reach;
    int index = 1;
    while (index + 1 < static_cast<int>(std::size(PatchBlocks::kOrders)) &&
           PatchBlocks::kOrders[index] < wanted)
        ++index;
    return index;
}

/// The group's directions and a cone around them; the last direction fills unused places.
Cone fill_group(std::span<const glm::dvec3> directions, LdGroup& group) {
    const std::size_t last = directions.size() - 1;
    glm::dvec3 axis(0);
    for (const glm::dvec3& n : directions) axis += n;
    axis = glm::normalize(axis + directions[0] * 1e-9);
    double farthest = 0;
    for (int i = 0; i < kLdGroup; ++i) {
        const glm::dvec3& n = directions[std::min(static_cast<std::size_t>(i), last)];
        group.x[i] = static_cast<float>(n.x);
        group.y[i] = static_cast<float>(n.y);
        group.z[i] = static_cast<float>(n.z);
        farthest = std::max(farthest, glm::length(n - axis));
        for (auto& channel : group.sum) channel[i] = 0;
    }
    return {axis, angle_of_chord(farthest)};
}

}  // namespace

namespace {

/// The sums of all directions, kLdGroup of them a group.
std::vector<LdGroup> sums_of(const PatchBlocks& source, double alpha, std::span<const glm::dvec3> directions,
                             std::uint64_t& evaluations) {
    const GgxZonalKernel kernel(alpha);
    const std::size_t group_count = (directions.size() + kLdGroup - 1) / kLdGroup;
    std::vector<LdGroup> groups(group_count);
    std::vector<Cone> cones(group_count);
    const auto of_group = [&](std::size_t g) {
        return directions.subspan(g * kLdGroup,
                                  std::min<std::size_t>(kLdGroup, directions.size() - g * kLdGroup));
    };
    for (std::size_t g = 0; g < group_count; ++g) cones[g] = fill_group(of_group(g), groups[g]);

    std::vector<PatchPoints> by_order(std::size(PatchBlocks::kOrders));
    for (int block = 0; block < source.count(); ++block) {
        const Cone& cone = source.cone(block);
        for (PatchPoints& points : by_order) points.resize(0);
        for (std::size_t g = 0; g < group_count; ++g) {
            const double apart = angle_of_chord(glm::length(cones[g].axis - cone.axis));
            const double nearest = std::max(0.0, apart - cones[g].half_angle - cone.half_angle);
            if (nearest > std::numbers::pi / 2) continue;  // wholly below the horizon
            const int index = order_index(source.texel_angle(), alpha, nearest);
            PatchPoints& points = by_order[static_cast<std::size_t>(index)];
            if (points.size() == 0) source.points(block, index, points);
            HWY_DYNAMIC_DISPATCH(add_block)
            (points, static_cast<float>(alpha * alpha), static_cast<float>(kernel.normalisation()),
             groups[g]);
            evaluations += points.size() * kLdGroup;
        }
    }

    return groups;
}

}  // namespace

double ld_exact(const PatchBlocks& source, double alpha, std::span<const glm::dvec3> directions,
                std::span<double> rgb_out, std::uint64_t& evaluations) {
    const std::vector<LdGroup> groups = sums_of(source, alpha, directions, evaluations);
    double deviation = 0;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const LdGroup& group = groups[i / kLdGroup];
        const std::size_t lane = i % kLdGroup;
        deviation = std::max(deviation, std::abs(group.sum[3][lane] - 1));
        for (int c = 0; c < 3; ++c) rgb_out[i * 3 + c] = group.sum[c][lane] / group.sum[3][lane];
    }
    return deviation;
}

void ld_partial(const PatchBlocks& part, double alpha, std::span<const glm::dvec3> directions,
                std::span<double> rgb_out, std::uint64_t& evaluations) {
    const std::vector<LdGroup> groups = sums_of(part, alpha, directions, evaluations);
    for (std::size_t i = 0; i < directions.size(); ++i)
        for (int c = 0; c < 3; ++c) rgb_out[i * 3 + c] = groups[i / kLdGroup].sum[c][i % kLdGroup];
}

}  // namespace pbr
#endif
