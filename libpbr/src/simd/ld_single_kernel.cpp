// The exact LD sum of one direction. Lanes hold points, as many sums side by side at any vector width: the
// bits are the same on all machines.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/simd/ld_single_kernel.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <vector>

#include "src/simd/ld_kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace pbr {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Sums of r, g, b and the weights, in lanes.
template <class V>
struct Sums {
    V r, g, b, w;
};

/// Adds points a squared chord away from the direction: k = normalisation mu+ / f^2, f = alpha^2 +
/// (1 - alpha^2)/4 chord^2 and mu = 1 - chord^2 / 2 (see ibl/zonal_kernel.hpp), times `weight`, which has the
/// normalisation.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void add_points(D d, V chord2, V weight, float alpha2, V r, V g, V b, Sums<V>& sums) {
    const V mu = hn::Max(hn::Zero(d), hn::Sub(hn::Set(d, 1.0f), hn::Mul(hn::Set(d, 0.5f), chord2)));
    const V f = hn::Add(hn::Set(d, alpha2), hn::Mul(hn::Set(d, (1 - alpha2) / 4), chord2));
    const V k = hn::Div(hn::Mul(mu, weight), hn::Mul(f, f));
    sums.r = hn::Add(sums.r, hn::Mul(k, r));
    sums.g = hn::Add(sums.g, hn::Mul(k, g));
    sums.b = hn::Add(sums.b, hn::Mul(k, b));
    sums.w = hn::Add(sums.w, k);
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE void store(D d, const Sums<V>& sums, std::size_t begin, float (*all)[kLdGroup]) {
    hn::Store(sums.r, d, all[0] + begin);
    hn::Store(sums.g, d, all[1] + begin);
    hn::Store(sums.b, d, all[2] + begin);
    hn::Store(sums.w, d, all[3] + begin);
}

void add_all(const float (*all)[kLdGroup], LdSingle& single) {
    for (std::size_t c = 0; c < 4; ++c) {
        double sum = 0;
        for (int i = 0; i < kLdGroup; ++i) sum += static_cast<double>(all[c][i]);
        single.sum[c] += sum;
    }
}

void points_of_one(const PatchPoints& points, float alpha2, float normalisation, LdSingle& single) {
    const hn::CappedTag<float, kLdGroup> d;
    using V = hn::Vec<decltype(d)>;
    const std::size_t lanes = hn::Lanes(d);
    const V nx = hn::Set(d, static_cast<float>(single.n.x)), ny = hn::Set(d, static_cast<float>(single.n.y)),
            nz = hn::Set(d, static_cast<float>(single.n.z)), factor = hn::Set(d, normalisation);
    HWY_ALIGN_MAX float all[4][kLdGroup];
    for (std::size_t begin = 0; begin < kLdGroup; begin += lanes) {
        Sums<V> sums{hn::Zero(d), hn::Zero(d), hn::Zero(d), hn::Zero(d)};
        for (std::size_t i = begin; i < points.size(); i += kLdGroup) {
            const std::size_t left = std::min(lanes, points.size() - i);
            const auto load = [&](const std::vector<float>& array) HWY_ATTR {
                return left == lanes ? hn::LoadU(d, &array[i])
                                     : hn::MaskedLoad(hn::FirstN(d, left), d, &array[i]);
            };
            const V dx = hn::Sub(nx, load(points.x)), dy = hn::Sub(ny, load(points.y)),
                    dz = hn::Sub(nz, load(points.z));
            const V chord2 = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
            add_points(d, chord2, hn::Mul(factor, load(points.weight)), alpha2, load(points.r),
                       load(points.g), load(points.b), sums);
        }
        store(d, sums, begin, all);
    }
    add_all(all, single);
}

/// The radiance of a row of texels, `order` times each.
HWY_INLINE void spread_row(const LatLongPatch& patch, int y, float (*radiance)[kLatLongColumns]) {
    const float* rgb = patch.rgb + static_cast<std::size_t>(y) * patch.stride;
    for (int x = 0, at = 0; x < patch.width; ++x, rgb += 3)
        for (int a = 0; a < patch.order; ++a, ++at)
            for (int c = 0; c < 3; ++c) radiance[c][at] = rgb[c];
}

constexpr std::size_t kPatchSums = 8;  // as many side by side as doubles fill a vector

/// `kWhole`: rows have a point a texel and end with a vector, so that radiance is read where it lies.
template <bool kWhole>
HWY_INLINE void patch_sums(const LatLongPatch& patch, float alpha2, float normalisation, LdSingle& single) {
    const hn::CappedTag<double, kPatchSums> dd;
    const hn::Rebind<float, decltype(dd)> d;
    using V = hn::Vec<decltype(d)>;
    const std::size_t lanes = hn::Lanes(d), columns = static_cast<std::size_t>(patch.width) * patch.order;
    const double x = glm::dot(single.n, patch.right), y = glm::dot(single.n, patch.up),
                 z = glm::dot(single.n, patch.ahead);
    HWY_ALIGN_MAX float radiance[3][kLatLongColumns];
    if (!kWhole) std::fill_n(radiance[0], 3 * kLatLongColumns, 0.0f);
    HWY_ALIGN_MAX float all[4][kLdGroup] = {};
    for (std::size_t begin = 0; begin < kPatchSums; begin += lanes) {
        Sums<V> sums{hn::Zero(d), hn::Zero(d), hn::Zero(d), hn::Zero(d)};
        for (int row = 0; row < patch.height * patch.order; ++row) {
            if (!kWhole && row % patch.order == 0) spread_row(patch, row / patch.order, radiance);
            const auto sine = hn::Set(dd, patch.rows.sines[row]);
            const float up = static_cast<float>(y - patch.rows.cosines[row]);
            const V up2 = hn::Set(d, up * up),
                    weight = hn::Set(d, static_cast<float>(patch.rows.weights[row]) * normalisation);
            for (std::size_t i = begin; i < columns; i += kPatchSums) {
                const auto apart = [&](double from, const double* table) HWY_ATTR {
                    return hn::DemoteTo(d,
                                        hn::Sub(hn::Set(dd, from), hn::Mul(sine, hn::LoadU(dd, table + i))));
                };
                const V right = apart(x, patch.columns.sines), ahead = apart(z, patch.columns.cosines);
                const V chord2 = hn::Add(hn::Add(hn::Mul(right, right), hn::Mul(ahead, ahead)), up2);
                if constexpr (kWhole) {
                    V r, g, b;
                    hn::LoadInterleaved3(d, patch.rgb + row * patch.stride + 3 * i, r, g, b);
                    add_points(d, chord2, weight, alpha2, r, g, b, sums);
                } else {
                    const V share =
                        hn::Mul(weight, hn::DemoteTo(d, hn::LoadU(dd, patch.columns.weights + i)));
                    const auto inside = hn::FirstN(d, std::min(lanes, columns - i));
                    add_points(d, chord2, hn::IfThenElseZero(inside, share), alpha2,
                               hn::Load(d, radiance[0] + i), hn::Load(d, radiance[1] + i),
                               hn::Load(d, radiance[2] + i), sums);
                }
            }
        }
        store(d, sums, begin, all);
    }
    add_all(all, single);
}

void patch_of_one(const LatLongPatch& patch, float alpha2, float normalisation, LdSingle& single) {
    if (patch.order == 1 && patch.width % kPatchSums == 0)
        patch_sums<true>(patch, alpha2, normalisation, single);
    else
        patch_sums<false>(patch, alpha2, normalisation, single);
}

/// Lanes hold r, g, b and the weights of one node.
void nodes_of_one(std::span<const MomentNode> nodes, double alpha2, double normalisation, LdSingle& single) {
    const hn::CappedTag<float, 4> d;
    const std::size_t lanes = hn::Lanes(d);
    const double b = (1 - alpha2) / 2;
    const glm::dvec3& n = single.n;
    float powers[kMonomials.size()];
    for (std::size_t k = 0; k < kMonomials.size(); ++k) {
        double power = 1;
        for (int i = 0; i < kMonomials[k].a; ++i) power *= n.x;
        for (int i = 0; i < kMonomials[k].b; ++i) power *= n.y;
        for (int i = 0; i < kMonomials[k].c; ++i) power *= n.z;
        powers[k] = static_cast<float>(power);
    }
    for (const MomentNode& node : nodes) {
        const double length = node.cone->length;
        const glm::dvec3 apart = n - node.cone->centre();
        const double versine = (glm::dot(apart, apart) + (1 - length) * (1 + length)) / 2, x = 1 - versine;
        const double inverse = 1 / (alpha2 + b * versine), u = b * inverse;
        const double share = normalisation * static_cast<double>(node.cone->solid_angle) * inverse * inverse;
        const double derivatives[4] = {share * x, share * (1 + 2 * x * u), share * u * (4 + 6 * x * u),
                                       share * u * u * (18 + 24 * x * u)};
        constexpr std::size_t kDegrees[5] = {0, 1, 4, 10, 20};
        HWY_ALIGN_MAX float out[4];
        for (std::size_t c = 0; c < 4; c += lanes) {
            auto sum = hn::Zero(d);
            for (std::size_t j = 0; j < 4; ++j) {
                auto form = hn::Zero(d);
                for (std::size_t k = kDegrees[j]; k < kDegrees[j + 1]; ++k)
                    form = hn::Add(form,
                                   hn::Mul(hn::Set(d, powers[k]), hn::LoadU(d, node.moments->mean[k] + c)));
                sum = hn::Add(sum, hn::Mul(hn::Set(d, static_cast<float>(derivatives[j])), form));
            }
            hn::Store(sum, d, out + c);
        }
        for (std::size_t c = 0; c < 4; ++c) single.sum[c] += static_cast<double>(out[c]);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace pbr
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pbr {

HWY_EXPORT(points_of_one);
HWY_EXPORT(patch_of_one);
HWY_EXPORT(nodes_of_one);

void ld_add_points(const PatchPoints& points, double alpha, double normalisation, LdSingle& single) {
    HWY_DYNAMIC_DISPATCH(points_of_one)
    (points, static_cast<float>(alpha * alpha), static_cast<float>(normalisation), single);
}

void ld_add_points(const LatLongPatch& patch, double alpha, double normalisation, LdSingle& single) {
    HWY_DYNAMIC_DISPATCH(patch_of_one)
    (patch, static_cast<float>(alpha * alpha), static_cast<float>(normalisation), single);
}

void ld_add_nodes(std::span<const MomentNode> nodes, double alpha, double normalisation, LdSingle& single) {
    HWY_DYNAMIC_DISPATCH(nodes_of_one)(nodes, alpha * alpha, normalisation, single);
}

}  // namespace pbr
#endif
