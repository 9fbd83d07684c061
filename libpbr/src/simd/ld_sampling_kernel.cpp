// Prefiltering by sampling a cube pyramid. Two stages a chunk of samples: addresses and weights, vectorised
// over samples; then the fetches, vectorised over two neighbouring RGBA texels. Each lane of the first stage
// stands alone and the second sums in the order of the samples, so the bits do not depend on the vector
// width.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/simd/ld_sampling_kernel.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/ld.hpp"
#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/sequence.hpp"
#include "src/simd/cube_face.hpp"
#include "src/simd/ld_kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace pbr {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kChunk =
    256;  // samples addressed before they are fetched: the arrays below stay in the first cache

/// Where the samples of a chunk lie: two pyramid levels each, and there a 2 x 2 block of texels.
struct Fetches {
    HWY_ALIGN_MAX std::int32_t upper[2][kChunk];  ///< the left texel of the block's upper row, in floats
    HWY_ALIGN_MAX std::int32_t lower[2][kChunk];  ///< and of its lower row
    HWY_ALIGN_MAX float weights[2][kChunk * 4];   ///< upper left, upper right, lower left, lower right
};

/// What a vector of samples reads: see LdSamples.
template <class V>
struct Levels {
    V half_size, finer, coarser;
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE void address(D d, V x, V y, V z, const Levels<V>& levels, int at, Fetches& out) {
    const hn::Rebind<std::int32_t, D> di;
    const V one = hn::Set(d, 1.0f), half = hn::Set(d, 0.5f);
    const auto [face, s, t, inverse_major] = face_point(d, x, y, z);
    V half_n = levels.half_size, weight = levels.finer;
    V px = hn::Add(hn::Mul(hn::Add(s, one), half_n), half),
      py = hn::Add(hn::Mul(hn::Add(t, one), half_n), half);
    for (int k = 0; k < 2; ++k) {
        const auto ix = hn::ConvertTo(di, px), iy = hn::ConvertTo(di, py);
        const V row = hn::ConvertTo(d, iy), fx = hn::Sub(px, hn::ConvertTo(d, ix)), fy = hn::Sub(py, row);
        const V of_lower = hn::Mul(fy, weight), of_upper = hn::Sub(weight, of_lower);
        const V lower_right = hn::Mul(fx, of_lower), upper_right = hn::Mul(fx, of_upper);
        hn::StoreInterleaved4(hn::Sub(of_upper, upper_right), upper_right, hn::Sub(of_lower, lower_right),
                              lower_right, d, out.weights[k] + 4 * at);
        // CubePyramid::offset and the place in the level: ((face + 2) side + row + 40) side + column - 138
        // texels. The bracket is below 2^24: exact in float.
        const V side = hn::Add(hn::Add(half_n, half_n), hn::Set(d, 2.0f));
        const V rows =
            hn::Add(hn::Mul(hn::Add(face, hn::Set(d, 2.0f)), side), hn::Add(row, hn::Set(d, 40.0f)));
        const auto side_i = hn::ConvertTo(di, side);
        const auto upper = hn::Add(hn::Mul(hn::ConvertTo(di, rows), side_i), hn::Sub(ix, hn::Set(di, 138)));
        hn::Store(hn::ShiftLeft<2>(upper), di, out.upper[k] + at);
        hn::Store(hn::ShiftLeft<2>(hn::Add(upper, side_i)), di, out.lower[k] + at);
        // The next level has half the texels.
        half_n = hn::Mul(half_n, half);
        px = hn::Add(hn::Mul(px, half), hn::Set(d, 0.25f));
        py = hn::Add(hn::Mul(py, half), hn::Set(d, 0.25f));
        weight = levels.coarser;
    }
}

/// Two neighbouring RGBA texels side by side, or one after the other on narrow machines.
using Texels = hn::CappedTag<float, 8>;

/// Of a sample's four weights, those of the lanes from `half` on: the left texel's in lanes 0-3, the right
/// one's in 4-7.
template <class V>
struct RowWeights {
    V upper, lower;
};
template <class D, class V = hn::Vec<D>>
HWY_INLINE RowWeights<V> row_weights(D d, const float* weights, int half) {
    if constexpr (hn::MaxLanes(d) == 8) {
        const hn::Repartition<std::uint8_t, D> bytes;
        HWY_ALIGN_MAX static constexpr std::int32_t kUpper[8] = {
            0x03020100, 0x03020100, 0x03020100, 0x03020100, 0x07060504, 0x07060504, 0x07060504, 0x07060504};
        const hn::RebindToSigned<D> words;
        const auto upper = hn::BitCast(bytes, hn::Load(words, kUpper));
        const auto lower = hn::Or(upper, hn::Set(bytes, std::uint8_t{8}));
        const auto pair = hn::BitCast(bytes, hn::LoadDup128(d, weights));
        return {hn::BitCast(d, hn::TableLookupBytes(pair, upper)),
                hn::BitCast(d, hn::TableLookupBytes(pair, lower))};
    } else {
        const int right = half >= 4;
        return {hn::Set(d, weights[right]), hn::Set(d, weights[2 + right])};
    }
}

/// Adds `count` trilinear lookups to sum[4].
void fetch(const float* texels, const Fetches& f, int count, float* sum) {
    const Texels d;
    using V = hn::Vec<Texels>;
    const int lanes = static_cast<int>(hn::Lanes(d));
    HWY_ALIGN_MAX float total[8];
    for (int half = 0; half < 8; half += lanes) {
        V upper[2] = {hn::Zero(d), hn::Zero(d)},
          lower[2] = {hn::Zero(d), hn::Zero(d)};  // no addition waits for another
        for (int i = 0; i < count; ++i)
            for (int k = 0; k < 2; ++k) {
                const RowWeights<V> weights = row_weights(d, f.weights[k] + 4 * i, half);
                upper[k] =
                    hn::Add(upper[k], hn::Mul(hn::LoadU(d, texels + f.upper[k][i] + half), weights.upper));
                lower[k] =
                    hn::Add(lower[k], hn::Mul(hn::LoadU(d, texels + f.lower[k][i] + half), weights.lower));
            }
        hn::Store(hn::Add(hn::Add(upper[0], lower[0]), hn::Add(upper[1], lower[1])), d, total + half);
    }
    for (int c = 0; c < 4; ++c) sum[c] += total[c] + total[c + 4];
}

void sampled_texel(const CubePyramid& pyramid, const LdSamples& samples, const TexelFrame& m, float* rgb) {
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    const int lanes = static_cast<int>(hn::Lanes(d));
    Fetches fetches;
    float sum[4] = {0, 0, 0, 0};
    const auto combine = [&](V x, V y, V z, float cx, float cy, float cz) {
        return hn::Add(hn::Add(hn::Mul(x, hn::Set(d, cx)), hn::Mul(y, hn::Set(d, cy))),
                       hn::Mul(z, hn::Set(d, cz)));
    };
    for (int begin = 0; begin < samples.count; begin += kChunk) {
        const int count = std::min(kChunk, samples.count - begin);
        for (int i = 0; i < count; i += lanes) {  // the arrays are padded: whole vectors always
            const V x = hn::LoadU(d, &samples.x[begin + i]), y = hn::LoadU(d, &samples.y[begin + i]);
            const V z = hn::LoadU(d, &samples.z[begin + i]);
            const Levels<V> levels{hn::LoadU(d, &samples.half_size[begin + i]),
                                   hn::LoadU(d, &samples.finer[begin + i]),
                                   hn::LoadU(d, &samples.coarser[begin + i])};
            address(d, combine(x, y, z, m.tx, m.bx, m.nx), combine(x, y, z, m.ty, m.by, m.ny),
                    combine(x, y, z, m.tz, m.bz, m.nz), levels, i, fetches);
        }
        fetch(pyramid.texels().data(), fetches, count, sum);
    }
    constexpr float kLargest = std::numeric_limits<float>::max();
    for (int c = 0; c < 3; ++c) rgb[c] = std::min(sum[c] / sum[3], kLargest);  // see ibl/cube_pyramid.hpp
}

}  // namespace HWY_NAMESPACE
}  // namespace pbr
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pbr {
namespace {

HWY_EXPORT(sampled_texel);

}  // namespace

void ld_sampled(const CubePyramid& pyramid, const LdSamples& samples, std::uint64_t seed, int size,
                std::span<const CubeTexel> texels, std::span<float> rgb_out) {
    assert(pyramid.levels() >= 2);
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const auto& [face, x, y] = texels[i];
        const double turns = random_unit(seed, size, face, x, y);
        const TexelFrame frame = turned_frame(cubemap_texel_direction(texels[i], size), turns);
        HWY_DYNAMIC_DISPATCH(sampled_texel)(pyramid, samples, frame, &rgb_out[i * 3]);
    }
}

}  // namespace pbr
#endif
