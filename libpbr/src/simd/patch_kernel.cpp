// Points of patches and their moments. Lanes hold points, 16 sums side by side whatever the vector width: the
// bits are the same on all machines.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/simd/patch_kernel.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <array>

#include "src/simd/patch_kernel.hpp"

HWY_BEFORE_NAMESPACE();
namespace pbr {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// One row of points: directions and weights, kLanes at once.
template <std::size_t kLanes>
HWY_INLINE void lat_long_row(const LatLongPatch& patch, std::size_t row, std::size_t at,
                             PatchPoints& points) {
    const hn::CappedTag<double, kLanes> d;
    const hn::Rebind<float, decltype(d)> to_float;
    const std::size_t lanes = hn::Lanes(d), count = static_cast<std::size_t>(patch.width) * patch.order;
    const double sine = patch.rows.sines[row];
    const glm::dvec3 up = patch.up * patch.rows.cosines[row], right = patch.right * sine,
                     ahead = patch.ahead * sine;
    const double weight = patch.rows.weights[row];
    float* const coordinates[3] = {points.x.data() + at, points.y.data() + at, points.z.data() + at};
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes) {
        const auto sines = hn::LoadU(d, patch.columns.sines + i),
                   cosines = hn::LoadU(d, patch.columns.cosines + i);
        for (int c = 0; c < 3; ++c) {
            const auto turned = hn::Add(hn::Add(hn::Set(d, up[c]), hn::Mul(hn::Set(d, right[c]), sines)),
                                        hn::Mul(hn::Set(d, ahead[c]), cosines));
            hn::StoreU(hn::DemoteTo(to_float, turned), to_float, coordinates[c] + i);
        }
        hn::StoreU(
            hn::DemoteTo(to_float, hn::Mul(hn::Set(d, weight), hn::LoadU(d, patch.columns.weights + i))),
            to_float, points.weight.data() + at + i);
    }
    for (; i < count; ++i) {
        for (int c = 0; c < 3; ++c)
            coordinates[c][i] = static_cast<float>(up[c] + right[c] * patch.columns.sines[i] +
                                                   ahead[c] * patch.columns.cosines[i]);
        points.weight[at + i] = static_cast<float>(weight * patch.columns.weights[i]);
    }
}

/// The radiance of a row of texels, a point each.
HWY_INLINE void radiance_row(const float* rgb, std::size_t count, std::size_t at, PatchPoints& points) {
    const hn::CappedTag<float, 8> d;
    const std::size_t lanes = hn::Lanes(d);
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes) {
        hn::Vec<decltype(d)> r, g, b;
        hn::LoadInterleaved3(d, rgb + 3 * i, r, g, b);
        hn::StoreU(r, d, points.r.data() + at + i);
        hn::StoreU(g, d, points.g.data() + at + i);
        hn::StoreU(b, d, points.b.data() + at + i);
    }
    for (; i < count; ++i) {
        points.r[at + i] = rgb[3 * i];
        points.g[at + i] = rgb[3 * i + 1];
        points.b[at + i] = rgb[3 * i + 2];
    }
}

void lat_long_points(const LatLongPatch& patch, std::size_t at, PatchPoints& points) {
    const std::size_t order = static_cast<std::size_t>(patch.order),
                      columns = static_cast<std::size_t>(patch.width) * order;
    if (order == 1) {
        for (int y = 0; y < patch.height; ++y, at += static_cast<std::size_t>(patch.width)) {
            lat_long_row<8>(patch, static_cast<std::size_t>(y), at, points);
            radiance_row(patch.rgb + y * patch.stride, static_cast<std::size_t>(patch.width), at, points);
        }
        return;
    }
    for (int y = 0; y < patch.height; ++y) {
        for (std::size_t b = 0; b < order; ++b) {
            lat_long_row<4>(patch, y * order + b, at, points);
            if (b > 0) {  // the texels of the row before
                for (std::vector<float>* channel : {&points.r, &points.g, &points.b})
                    std::copy_n(channel->data() + at - columns, columns, channel->data() + at);
                at += columns;
                continue;
            }
            const float* rgb = patch.rgb + y * patch.stride;
            for (int x = 0; x < patch.width; ++x, rgb += 3)
                for (std::size_t a = 0; a < order; ++a, ++at) {
                    points.r[at] = rgb[0];
                    points.g[at] = rgb[1];
                    points.b[at] = rgb[2];
                }
        }
    }
}

constexpr std::size_t kSums = 16;

void point_moments(const PatchPoints& points, const glm::dvec3& centre, PatchMoments& moments) {
    const hn::CappedTag<float, kSums> d;
    using V = hn::Vec<decltype(d)>;
    const std::size_t lanes = hn::Lanes(d);
    const V cx = hn::Set(d, static_cast<float>(centre.x)), cy = hn::Set(d, static_cast<float>(centre.y)),
            cz = hn::Set(d, static_cast<float>(centre.z));
    constexpr std::size_t kCount = kMonomials.size();
    HWY_ALIGN_MAX float all[kCount][4][kSums];
    for (std::size_t begin = 0; begin < kSums; begin += lanes) {
        V sums[kCount][4];
        for (auto& of_monomial : sums)
            for (V& sum : of_monomial) sum = hn::Zero(d);
        for (std::size_t i = begin; i < points.size(); i += kSums) {
            const std::size_t left = std::min(lanes, points.size() - i);
            const auto load = [&](const std::vector<float>& array) HWY_ATTR {
                return left == lanes ? hn::LoadU(d, &array[i])
                                     : hn::MaskedLoad(hn::FirstN(d, left), d, &array[i]);
            };
            const V x = hn::Sub(load(points.x), cx), y = hn::Sub(load(points.y), cy),
                    z = hn::Sub(load(points.z), cz);
            const V w = load(points.weight), r = hn::Mul(w, load(points.r)), g = hn::Mul(w, load(points.g)),
                    b = hn::Mul(w, load(points.b));
            const V xx = hn::Mul(x, x), yy = hn::Mul(y, y), zz = hn::Mul(z, z), xy = hn::Mul(x, y);
            const auto add = [&](std::size_t k, V power) HWY_ATTR {
                sums[k][0] = hn::Add(sums[k][0], hn::Mul(r, power));
                sums[k][1] = hn::Add(sums[k][1], hn::Mul(g, power));
                sums[k][2] = hn::Add(sums[k][2], hn::Mul(b, power));
                sums[k][3] = hn::Add(sums[k][3], hn::Mul(w, power));
            };
            add(0, hn::Set(d, 1.0f));
            add(1, x), add(2, y), add(3, z);
            add(4, xx), add(5, yy), add(6, zz);
            add(7, xy), add(8, hn::Mul(x, z)), add(9, hn::Mul(y, z));
            add(10, hn::Mul(xx, x)), add(11, hn::Mul(yy, y)), add(12, hn::Mul(zz, z));
            add(13, hn::Mul(xx, y)), add(14, hn::Mul(xx, z)), add(15, hn::Mul(yy, x));
            add(16, hn::Mul(yy, z)), add(17, hn::Mul(zz, x)), add(18, hn::Mul(zz, y));
            add(19, hn::Mul(xy, z));
        }
        for (std::size_t k = 0; k < kCount; ++k)
            for (std::size_t c = 0; c < 4; ++c) hn::Store(sums[k][c], d, all[k][c] + begin);
    }
    for (std::size_t k = 0; k < kCount; ++k)
        for (std::size_t c = 0; c < 4; ++c) {
            const float* const s = all[k][c];
            const auto quarter = [&](int i) HWY_ATTR { return (s[i] + s[i + 8]) + (s[i + 4] + s[i + 12]); };
            moments[k][c] = static_cast<double>((quarter(0) + quarter(2)) + (quarter(1) + quarter(3)));
        }
}

constexpr std::size_t kMostValues = 3 * kMostLatLongWidth, kPastValues = 4;
using RowSums = double[kRowIntegrals][kMostValues + kPastValues];

/// Sums over a block's rows, a channel of a column each. The picture's values lie as the sums do.
HWY_INLINE void sum_rows(const LatLongBlock& block, RowSums& sums) {
    const hn::CappedTag<double, 8> d;
    const hn::Rebind<float, decltype(d)> to_float;
    using V = hn::Vec<decltype(d)>;
    const std::size_t lanes = hn::Lanes(d), count = 3 * static_cast<std::size_t>(block.width);
    for (int y = 0; y < block.height; ++y)
        for (std::size_t i = 0; i < count; i += 16) hwy::Prefetch(block.rgb + y * block.stride + i);
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes) {
        V own[kRowIntegrals];
        for (V& sum : own) sum = hn::Zero(d);
        const float* values = block.rgb + i;
        const double* factors = block.rows;
        for (int y = 0; y < block.height; ++y, values += block.stride, factors += kRowIntegrals) {
            const V value = hn::PromoteTo(d, hn::LoadU(to_float, values));
            for (std::size_t k = 0; k < kRowIntegrals; ++k)
                own[k] = hn::Add(own[k], hn::Mul(value, hn::Set(d, factors[k])));
        }
        for (std::size_t k = 0; k < kRowIntegrals; ++k) hn::StoreU(own[k], d, sums[k] + i);
    }
    for (; i < count; ++i)
        for (std::size_t k = 0; k < kRowIntegrals; ++k) {
            sums[k][i] = 0;
            for (std::size_t y = 0; y < static_cast<std::size_t>(block.height); ++y)
                sums[k][i] +=
                    static_cast<double>(block.rgb[y * block.stride + i]) * block.rows[y * kRowIntegrals + k];
        }
    for (auto& of_power : sums) std::fill_n(of_power + count, kPastValues, 0.0);
}

/// Places of sin^i cos^j in the order of LatLongBlock.
constexpr std::size_t place_of(int i, int j) { return static_cast<std::size_t>(i * 4 - i * (i - 1) / 2 + j); }

/// x^a y^b z^c is sin^(a+c) cos^b of the colatitude times sin^a cos^c of the longitude.
struct Factors {
    std::size_t row, column;
};
constexpr std::array<Factors, kMonomials.size()> factors_of_monomials() {
    std::array<Factors, kMonomials.size()> factors{};
    for (std::size_t k = 0; k < factors.size(); ++k) {
        const Monomial& m = kMonomials[k];
        factors[k] = {place_of(m.a + m.c, m.b), place_of(m.a, m.c)};
    }
    return factors;
}
constexpr std::array<Factors, kMonomials.size()> kFactors = factors_of_monomials();

void block_moments(const LatLongBlock& block, PatchMoments& moments) {
    RowSums sums;
    sum_rows(block, sums);
    double weights[kRowIntegrals] = {};
    for (std::size_t y = 0; y < static_cast<std::size_t>(block.height); ++y)
        for (std::size_t k = 0; k < kRowIntegrals; ++k) weights[k] += block.rows[y * kRowIntegrals + k];
    // Lanes hold r, g, b and the weights.
    const hn::CappedTag<double, 4> d;
    using V = hn::Vec<decltype(d)>;
    const std::size_t lanes = hn::Lanes(d), width = static_cast<std::size_t>(block.width);
    HWY_ALIGN double of_column[kColumnMeans][kMostLatLongWidth][4];
    for (std::size_t c = 0; c < 4; c += lanes) {
        const auto is_radiance = hn::FirstN(d, 3 - c);
        for (std::size_t x = 0; x < width; ++x) {
            V own[kColumnMeans];
            for (std::size_t k = 0; k < kRowIntegrals; ++k)
                own[k] =
                    hn::IfThenElse(is_radiance, hn::LoadU(d, sums[k] + 3 * x + c), hn::Set(d, weights[k]));
            own[place_of(2, 0)] = hn::Sub(own[place_of(0, 0)], own[place_of(0, 2)]);
            own[place_of(2, 1)] = hn::Sub(own[place_of(0, 1)], own[place_of(0, 3)]);
            own[place_of(3, 0)] = hn::Sub(own[place_of(1, 0)], own[place_of(1, 2)]);
            for (std::size_t k = 0; k < kColumnMeans; ++k) hn::Store(own[k], d, of_column[k][x] + c);
        }
        for (std::size_t k = 0; k < kMonomials.size(); ++k) {
            const auto& values = of_column[kFactors[k].row];
            const double* means = block.columns + kFactors[k].column;
            V sum = hn::Zero(d);
            for (std::size_t x = 0; x < width; ++x)
                sum = hn::Add(sum, hn::Mul(hn::Set(d, means[x * kColumnMeans]), hn::Load(d, values[x] + c)));
            hn::StoreU(sum, d, moments[k].data() + c);
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace pbr
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pbr {

HWY_EXPORT(lat_long_points);
HWY_EXPORT(point_moments);
HWY_EXPORT(block_moments);

void fill_lat_long_points(const LatLongPatch& patch, std::size_t at, PatchPoints& points) {
    HWY_DYNAMIC_DISPATCH(lat_long_points)(patch, at, points);
}

PatchMoments moments_of_points(const PatchPoints& points, const glm::dvec3& centre) {
    PatchMoments moments{};
    HWY_DYNAMIC_DISPATCH(point_moments)(points, centre, moments);
    return moments;
}

PatchMoments moments_of_block(const LatLongBlock& block) {
    PatchMoments moments{};
    HWY_DYNAMIC_DISPATCH(block_moments)(block, moments);
    return moments;
}

}  // namespace pbr
#endif
