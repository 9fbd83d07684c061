// Numbers by themselves, or added up in fixed places: any vector width gives the same bits.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/simd/spread_kernel.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>

#include "src/simd/spread_kernel.hpp"

HWY_BEFORE_NAMESPACE();
namespace pbr {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Channels of interleaved RGB repeat every three vectors.
constexpr long kPeriod = 3;

/// Adds four rows, so that sums are loaded and stored once for all of them.
void add_rows(const std::array<WeightedRow, 4>& rows, long texels, const std::array<float, 3>& constant,
              float* sums) {
    const hn::CappedTag<float, 16> d;
    using V = hn::Vec<decltype(d)>;
    const long lanes = static_cast<long>(hn::Lanes(d)), count = 3 * texels;
    HWY_ALIGN_MAX float repeated[kPeriod * 16];
    for (long i = 0; i < kPeriod * lanes; ++i) repeated[i] = constant[static_cast<std::size_t>(i % 3)];
    const float *r0 = rows[0].rgb, *r1 = rows[1].rgb, *r2 = rows[2].rgb, *r3 = rows[3].rgb;
    const V w0 = hn::Set(d, rows[0].weight), w1 = hn::Set(d, rows[1].weight), w2 = hn::Set(d, rows[2].weight),
            w3 = hn::Set(d, rows[3].weight);
    const auto add = [&](long at, V value) HWY_ATTR {
        V sum = hn::LoadU(d, sums + at);
        sum = hn::Add(sum, hn::Mul(w0, hn::Sub(hn::LoadU(d, r0 + at), value)));
        sum = hn::Add(sum, hn::Mul(w1, hn::Sub(hn::LoadU(d, r1 + at), value)));
        sum = hn::Add(sum, hn::Mul(w2, hn::Sub(hn::LoadU(d, r2 + at), value)));
        sum = hn::Add(sum, hn::Mul(w3, hn::Sub(hn::LoadU(d, r3 + at), value)));
        hn::StoreU(sum, d, sums + at);
    };
    const V c0 = hn::Load(d, repeated), c1 = hn::Load(d, repeated + lanes),
            c2 = hn::Load(d, repeated + 2 * lanes);
    long i = 0;
    for (; i + kPeriod * lanes <= count; i += kPeriod * lanes) {
        add(i, c0);
        add(i + lanes, c1);
        add(i + 2 * lanes, c2);
    }
    for (; i < count; ++i)
        for (const WeightedRow& row : rows)
            sums[i] += row.weight * (row.rgb[i] - constant[static_cast<std::size_t>(i % 3)]);
}

void sum_rows_of(std::span<const WeightedRow> rows, long texels, const std::array<float, 3>& constant,
                 float* sums) {
    std::fill_n(sums, 3 * texels, 0.0f);
    std::array<WeightedRow, 4> together;
    for (std::size_t first = 0; first < rows.size(); first += together.size()) {
        for (std::size_t i = 0; i < together.size(); ++i)
            together[i] = first + i < rows.size() ? rows[first + i] : WeightedRow{rows[first].rgb, 0};
        add_rows(together, texels, constant, sums);
    }
}

void sum_columns_of(const float* rgb, std::span<const ColumnSum> columns, double* rgb_out) {
    const hn::CappedTag<float, 4> d;
    for (const ColumnSum& column : columns) {
        const float* weights = column.weights.data();
        const long count = static_cast<long>(column.weights.size());
        HWY_ALIGN float out[4];
        for (std::size_t channel = 0; channel < 4; channel += hn::Lanes(d)) {
            const float* from = rgb + 3L * column.first + channel;
            auto even = hn::Zero(d), odd = hn::Zero(d);
            long k = 0;
            for (; k + 1 < count; k += 2) {
                even = hn::Add(even, hn::Mul(hn::Set(d, weights[k]), hn::LoadU(d, from + 3 * k)));
                odd = hn::Add(odd, hn::Mul(hn::Set(d, weights[k + 1]), hn::LoadU(d, from + 3 * k + 3)));
            }
            if (k < count) even = hn::Add(even, hn::Mul(hn::Set(d, weights[k]), hn::LoadU(d, from + 3 * k)));
            hn::Store(hn::Add(even, odd), d, out + channel);
        }
        for (int c = 0; c < 3; ++c) *rgb_out++ = static_cast<double>(out[c]);
    }
}

RowLight light_of_row(const float* rgb, long texels) {
    // 24 sums, each of every 24th number.
    constexpr std::size_t kPlaces = 24;
    const hn::CappedTag<double, 8> d;
    const hn::Rebind<float, decltype(d)> narrow;
    const std::size_t lanes = hn::Lanes(d);
    HWY_ALIGN_MAX double sums[kPlaces] = {};
    HWY_ALIGN_MAX float largest[kPlaces] = {};
    const long count = 3 * texels, whole = count / static_cast<long>(kPlaces) * static_cast<long>(kPlaces);
    for (std::size_t place = 0; place < kPlaces; place += 3 * lanes) {
        using V = hn::Vec<decltype(d)>;
        using N = hn::Vec<decltype(narrow)>;
        V sum[3] = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
        N high[3] = {hn::Zero(narrow), hn::Zero(narrow), hn::Zero(narrow)};
        for (long i = 0; i < whole; i += kPlaces)
            for (std::size_t k = 0; k < 3; ++k) {
                const auto value = hn::LoadU(narrow, rgb + i + place + k * lanes);
                sum[k] = hn::Add(sum[k], hn::PromoteTo(d, value));
                high[k] = hn::Max(high[k], value);
            }
        for (std::size_t k = 0; k < 3; ++k) {
            hn::Store(sum[k], d, sums + place + k * lanes);
            hn::Store(high[k], narrow, largest + place + k * lanes);
        }
    }
    RowLight light;
    for (std::size_t place = 0; place < kPlaces; ++place) {
        light.sum[place % 3] += sums[place];
        light.largest[place % 3] = std::max(light.largest[place % 3], largest[place]);
    }
    for (long i = whole; i < count; ++i) {
        light.sum[static_cast<std::size_t>(i % 3)] += static_cast<double>(rgb[i]);
        float& high = light.largest[static_cast<std::size_t>(i % 3)];
        high = std::max(high, rgb[i]);
    }
    return light;
}

}  // namespace HWY_NAMESPACE
}  // namespace pbr
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pbr {
namespace {

HWY_EXPORT(sum_rows_of);
HWY_EXPORT(sum_columns_of);
HWY_EXPORT(light_of_row);

}  // namespace

void sum_rows(std::span<const WeightedRow> rows, long texels, const std::array<float, 3>& constant,
              float* sums) {
    HWY_DYNAMIC_DISPATCH(sum_rows_of)(rows, texels, constant, sums);
}

void sum_columns(const float* rgb, std::span<const ColumnSum> columns, double* rgb_out) {
    HWY_DYNAMIC_DISPATCH(sum_columns_of)(rgb, columns, rgb_out);
}

RowLight row_light(const float* rgb, long texels) { return HWY_DYNAMIC_DISPATCH(light_of_row)(rgb, texels); }

}  // namespace pbr
#endif
