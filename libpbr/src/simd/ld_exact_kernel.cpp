// The exact LD sum of groups of directions. Lanes hold directions, points are broadcast: any vector width
// gives the same bits.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/simd/ld_exact_kernel.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <array>
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

/// The monomials of the group's directions, in the order of kMonomials.
template <class V>
HWY_INLINE void monomials_of(V one, V nx, V ny, V nz, V* n) {
    const V xx = hn::Mul(nx, nx), yy = hn::Mul(ny, ny), zz = hn::Mul(nz, nz), xy = hn::Mul(nx, ny);
    const V all[kMonomials.size()] = {one,
                                      nx,
                                      ny,
                                      nz,
                                      xx,
                                      yy,
                                      zz,
                                      xy,
                                      hn::Mul(nx, nz),
                                      hn::Mul(ny, nz),
                                      hn::Mul(xx, nx),
                                      hn::Mul(yy, ny),
                                      hn::Mul(zz, nz),
                                      hn::Mul(xx, ny),
                                      hn::Mul(xx, nz),
                                      hn::Mul(yy, nx),
                                      hn::Mul(yy, nz),
                                      hn::Mul(zz, nx),
                                      hn::Mul(zz, ny),
                                      hn::Mul(xy, nz)};
    std::copy_n(all, kMonomials.size(), n);
}

/// Derivatives of k, 0th to 3rd, at x = n.c = 1 - versine, over j! as the moments are over a! b! c!, times
/// `share`, the node's solid angle and the normalisation.
template <class V>
struct Derivatives {
    V of_order[4];
};
template <class D, class V = hn::Vec<D>>
HWY_INLINE Derivatives<V> derivatives(D d, V versine, float alpha2, float share) {
    // k = N x / f^2 with f = alpha^2 + b (1 - x) and u = b / f; its derivatives are N (1 + 2 x u) / f^2,
    // N u (4 + 6 x u) / f^2 and N u^2 (18 + 24 x u) / f^2.
    const V one = hn::Set(d, 1.0f), b = hn::Set(d, (1 - alpha2) / 2);
    const auto linear = [&](float constant, float factor, V x) HWY_ATTR {
        return hn::Add(hn::Set(d, constant), hn::Mul(hn::Set(d, factor), x));
    };
    const V inverse = hn::Div(one, hn::Add(hn::Set(d, alpha2), hn::Mul(b, versine)));
    const V k = hn::Mul(hn::Mul(hn::Set(d, share), inverse), inverse);
    const V x = hn::Sub(one, versine), u = hn::Mul(b, inverse), xu = hn::Mul(x, u);
    const V ku = hn::Mul(k, u), kuu = hn::Mul(ku, u);
    return {{hn::Mul(k, x), hn::Mul(k, linear(1, 2, xu)), hn::Mul(ku, linear(4, 6, xu)),
             hn::Mul(kuu, linear(18, 24, xu))}};
}

/// A channel of a node: the sum over j of k^(j)(n.c)/j! times the integral of radiance times (n.(d - c))^j.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V expansion(D d, const Derivatives<V>& k, const V* n, const Moments& moments, std::size_t c) {
    const auto form = [&](std::size_t from, std::size_t to) HWY_ATTR {
        V sum = hn::Mul(n[from], hn::Set(d, moments.mean[from][c]));
        for (std::size_t i = from + 1; i < to; ++i)
            sum = hn::Add(sum, hn::Mul(n[i], hn::Set(d, moments.mean[i][c])));
        return sum;
    };
    const V low =
        hn::Add(hn::Mul(k.of_order[0], hn::Set(d, moments.mean[0][c])), hn::Mul(k.of_order[1], form(1, 4)));
    const V high = hn::Add(hn::Mul(k.of_order[2], form(4, 10)), hn::Mul(k.of_order[3], form(10, 20)));
    return hn::Add(low, high);
}

/// Adds the expansions of all nodes.
void add_nodes(std::span<const MomentNode> nodes, float alpha2, float normalisation, LdGroup& group) {
    const hn::CappedTag<float, kLdGroup> d;
    using V = hn::Vec<decltype(d)>;
    const std::size_t lanes = hn::Lanes(d);
    for (std::size_t begin = 0; begin < kLdGroup; begin += lanes) {
        const V nx = hn::Load(d, group.x + begin), ny = hn::Load(d, group.y + begin),
                nz = hn::Load(d, group.z + begin);
        V n[kMonomials.size()];
        monomials_of(hn::Set(d, 1.0f), nx, ny, nz, n);
        for (std::size_t first = 0; first < nodes.size(); first += kFlush) {
            V sums[4] = {hn::Zero(d), hn::Zero(d), hn::Zero(d), hn::Zero(d)};
            for (std::size_t i = first; i < std::min(nodes.size(), first + kFlush); ++i) {
                const MomentCone& node = *nodes[i].cone;
                const float length = node.length;
                const V dx = hn::Sub(nx, hn::Set(d, node.axis[0] * length)),
                        dy = hn::Sub(ny, hn::Set(d, node.axis[1] * length)),
                        dz = hn::Sub(nz, hn::Set(d, node.axis[2] * length));
                // 1 - n.c = (|n - c|^2 + 1 - |c|^2) / 2
                const V chord2 = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
                const V versine =
                    hn::Mul(hn::Set(d, 0.5f), hn::Add(chord2, hn::Set(d, (1 - length) * (1 + length))));
                const Derivatives<V> k = derivatives(d, versine, alpha2, normalisation * node.solid_angle);
                for (std::size_t c = 0; c < 4; ++c)
                    sums[c] = hn::Add(sums[c], expansion(d, k, n, *nodes[i].moments, c));
            }
            HWY_ALIGN_MAX float out[kLdGroup];
            for (int c = 0; c < 4; ++c) {
                hn::Store(sums[c], d, out);
                for (std::size_t lane = 0; lane < lanes; ++lane)
                    group.sum[c][begin + lane] += static_cast<double>(out[lane]);
            }
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace pbr
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pbr {

HWY_EXPORT(add_block);
HWY_EXPORT(add_nodes);

// Gauss-Legendre over a texel of angle h converges once h is well below the distance of the kernel's poles,
// which is about hypot(2 alpha, angle).
int ld_order_index(double texel_angle, double alpha, double nearest_angle) {
    const double reach = texel_angle / std::sqrt(4 * alpha * alpha + nearest_angle * nearest_angle);
    if (reach < 0.02) return 0;
    const double wanted = 1.5 + 4 * reach;
    int index = 1;
    while (index + 1 < static_cast<int>(std::size(PatchBlocks::kOrders)) &&
           PatchBlocks::kOrders[index] < wanted)
        ++index;
    return index;
}

Cone ld_fill_group(std::span<const glm::dvec3> directions, LdGroup& group) {
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

void ld_add_points(const PatchPoints& points, double alpha, double normalisation, LdGroup& group) {
    HWY_DYNAMIC_DISPATCH(add_block)
    (points, static_cast<float>(alpha * alpha), static_cast<float>(normalisation), group);
}

void ld_add_nodes(std::span<const MomentNode> nodes, double alpha, double normalisation, LdGroup& group) {
    HWY_DYNAMIC_DISPATCH(add_nodes)
    (nodes, static_cast<float>(alpha * alpha), static_cast<float>(normalisation), group);
}

namespace {

/// The sums of all directions, kLdGroup of them a group.
std::vector<LdGroup> sums_of(const PatchBlocks& source, double alpha, bool is_part,
                             std::span<const glm::dvec3> directions, std::uint64_t& evaluations) {
    const GgxZonalKernel kernel(alpha);
    const std::size_t group_count = (directions.size() + kLdGroup - 1) / kLdGroup;
    std::vector<LdGroup> groups(group_count);
    std::vector<Cone> cones(group_count);
    const auto of_group = [&](std::size_t g) {
        return directions.subspan(g * kLdGroup,
                                  std::min<std::size_t>(kLdGroup, directions.size() - g * kLdGroup));
    };
    for (std::size_t g = 0; g < group_count; ++g) cones[g] = ld_fill_group(of_group(g), groups[g]);

    constexpr int kLast = static_cast<int>(std::size(PatchBlocks::kOrders)) - 1, kAtHorizon = 9;
    static_assert(PatchBlocks::kOrders[kAtHorizon] == 32);
    std::vector<PatchPoints> by_order(std::size(PatchBlocks::kOrders));
    for (int block = 0; block < source.count(); ++block) {
        const Cone& cone = source.cone(block);
        for (PatchPoints& points : by_order) points.resize(0);
        for (std::size_t g = 0; g < group_count; ++g) {
            const double apart = angle_of_chord(glm::length(cones[g].axis - cone.axis));
            const double nearest = std::max(0.0, apart - cones[g].half_angle - cone.half_angle);
            if (nearest > std::numbers::pi / 2) continue;  // wholly below the horizon
            // The errors of a whole picture's texels cancel; those of a few bright ones don't, and get a step
            // more, or as many points as show where a horizon cuts them.
            const bool above = apart + cones[g].half_angle + cone.half_angle < std::numbers::pi / 2;
            int index = ld_order_index(source.texel_angle(), alpha, nearest);
            if (is_part) index = above ? std::min(kLast, index + 1) : std::max(index, kAtHorizon);
            PatchPoints& points = by_order[static_cast<std::size_t>(index)];
            if (points.size() == 0) source.points(block, index, points);
            ld_add_points(points, alpha, kernel.normalisation(), groups[g]);
            evaluations += points.size() * kLdGroup;
        }
    }

    return groups;
}

}  // namespace

double ld_exact(const PatchBlocks& source, double alpha, std::span<const glm::dvec3> directions,
                std::span<double> rgb_out, std::uint64_t& evaluations) {
    const std::vector<LdGroup> groups = sums_of(source, alpha, false, directions, evaluations);
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
    const std::vector<LdGroup> groups = sums_of(part, alpha, true, directions, evaluations);
    for (std::size_t i = 0; i < directions.size(); ++i)
        for (int c = 0; c < 3; ++c) rgb_out[i * 3 + c] = groups[i / kLdGroup].sum[c][i % kLdGroup];
}

}  // namespace pbr
#endif
