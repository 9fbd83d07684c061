// Prefiltering by sampling a cube pyramid. Two stages a chunk of samples: addresses and weights, vectorised
// over samples; then the fetches, vectorised over two neighbouring RGBA texels. Each lane of the first stage
// stands alone and the second sums in the order of the samples, so the bits do not depend on the vector
// width.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/simd/ld_sampling_kernel.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/ld.hpp"
#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/sequence.hpp"
#include "src/simd/ld_kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace pbr {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kChunk =
    256;  // samples addressed before they are fetched: the arrays below stay in the first cache

/// Where the samples of a chunk lie: two pyramid levels each.
struct Fetches {
    HWY_ALIGN_MAX std::int32_t offset[2][kChunk];  ///< of the upper left texel, in floats
    HWY_ALIGN_MAX std::int32_t stride[2][kChunk];  ///< of a row, in floats
    HWY_ALIGN_MAX float fx[2][kChunk];
    HWY_ALIGN_MAX float fy[2][kChunk];
    HWY_ALIGN_MAX float share[2][kChunk];  ///< weights of the two levels; all samples' sum to 1, so huge
                                           ///< texels don't overflow
};

template <class D, class V = hn::Vec<D>>
void address(D d, const CubePyramid& pyramid, const std::int32_t* level_offsets, V x, V y, V z, V lod,
             float share, int at, Fetches& out) {
    const hn::Rebind<std::int32_t, D> di;
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    const V ax = hn::Abs(x), ay = hn::Abs(y), az = hn::Abs(z);
    const auto x_major = hn::And(hn::Ge(ax, ay), hn::Ge(ax, az));
    const auto y_major = hn::AndNot(x_major, hn::Ge(ay, az));
    const V major = hn::IfThenElse(x_major, x, hn::IfThenElse(y_major, y, z));
    const auto negative = hn::Lt(major, zero);
    const V inverse = hn::Div(one, hn::Abs(major));
    // s, t of ibl/cubemap.hpp: X (-+z, -y), Y (x, +-z), Z (+-x, -y).
    const V s_up = hn::IfThenElse(x_major, hn::Neg(z), x);
    const V s_flipped = hn::IfThenElse(negative, hn::Neg(s_up), s_up);
    const V s = hn::Mul(hn::IfThenElse(y_major, x, s_flipped), inverse);
    const V t =
        hn::Mul(hn::IfThenElse(y_major, hn::IfThenElse(negative, hn::Neg(z), z), hn::Neg(y)), inverse);
    const V face_pair =
        hn::IfThenElse(x_major, zero, hn::IfThenElse(y_major, hn::Set(d, 2.0f), hn::Set(d, 4.0f)));
    const auto face = hn::ConvertTo(di, hn::Add(face_pair, hn::IfThenElse(negative, one, zero)));

    // Texels shrink towards the corners like q^-3/2, q = 1 + s^2 + t^2: lod += 3/4 log2(q). The series of
    // log2(q) = (2/ln 2) atanh((q-1)/(q+1)) is off by at most 1.7e-4 on [1, 3]; it only chooses a filter.
    const V q_minus_one = hn::Add(hn::Mul(s, s), hn::Mul(t, t));
    const V w = hn::Div(q_minus_one, hn::Add(q_minus_one, hn::Set(d, 2.0f)));
    const V w2 = hn::Mul(w, w);
    V series = hn::Set(d, 1.0f / 9);
    for (const float c : {1.0f / 7, 1.0f / 5, 1.0f / 3, 1.0f})
        series = hn::Add(hn::Mul(series, w2), hn::Set(d, c));
    const V log2_q = hn::Mul(hn::Mul(w, series), hn::Set(d, static_cast<float>(2 * std::numbers::log2e)));
    const float top = static_cast<float>(pyramid.levels() - 1);
    const V level = hn::Min(hn::Max(hn::Add(lod, hn::Mul(log2_q, hn::Set(d, 0.75f))), zero), hn::Set(d, top));
    const auto first = hn::ConvertTo(di, level);
    const V blend = hn::Sub(level, hn::ConvertTo(d, first));
    hn::Store(hn::Mul(hn::Sub(one, blend), hn::Set(d, share)), d, out.share[0] + at);
    hn::Store(hn::Mul(blend, hn::Set(d, share)), d, out.share[1] + at);

    const int log2_size = std::countr_zero(static_cast<unsigned>(pyramid.size()));
    const V s01 = hn::Mul(hn::Add(s, one), hn::Set(d, 0.5f)),
            t01 = hn::Mul(hn::Add(t, one), hn::Set(d, 0.5f));
    for (int k = 0; k < 2; ++k) {
        const auto l = hn::Min(hn::Add(first, hn::Set(di, k)), hn::Set(di, pyramid.levels() - 1));
        // 2^(log2_size - l) from its exponent bits
        const V n = hn::BitCast(d, hn::ShiftLeft<23>(hn::Sub(hn::Set(di, 127 + log2_size), l)));
        const V px = hn::Add(hn::Mul(s01, n), hn::Set(d, 0.5f)),
                py = hn::Add(hn::Mul(t01, n), hn::Set(d, 0.5f));
        const auto ni = hn::ConvertTo(di, n);
        const auto ix = hn::Min(hn::ConvertTo(di, px), ni), iy = hn::Min(hn::ConvertTo(di, py), ni);
        hn::Store(hn::Sub(px, hn::ConvertTo(d, ix)), d, out.fx[k] + at);
        hn::Store(hn::Sub(py, hn::ConvertTo(d, iy)), d, out.fy[k] + at);
        const auto side = hn::Add(ni, hn::Set(di, 2));
        const auto rows = hn::Add(hn::Mul(hn::Mul(face, side), side), hn::Mul(iy, side));
        hn::Store(hn::Add(hn::GatherIndex(di, level_offsets, l), hn::ShiftLeft<2>(hn::Add(rows, ix))), di,
                  out.offset[k] + at);
        hn::Store(hn::ShiftLeft<2>(side), di, out.stride[k] + at);
    }
}

/// Adds `count` trilinear lookups to sum[4].
void fetch(const float* texels, const Fetches& f, int count, float* sum) {
    const hn::CappedTag<float, 8> d;  // two RGBA texels, or one at a time on narrow machines
    using V = hn::Vec<decltype(d)>;
    const int lanes = static_cast<int>(hn::Lanes(d));
    HWY_ALIGN_MAX float total[8] = {0, 0, 0, 0, 0, 0, 0, 0};
    for (int half = 0; half < 8; half += lanes) {
        // Lanes 0-3 belong to the left texel, 4-7 to the right one.
        const auto right = hn::Ge(hn::Iota(d, static_cast<float>(half)), hn::Set(d, 4.0f));
        V acc = hn::Zero(d);
        for (int i = 0; i < count; ++i) {
            for (int k = 0; k < 2; ++k) {
                const float* p = texels + f.offset[k][i] + half;
                const V fy = hn::Set(d, f.fy[k][i]), one = hn::Set(d, 1.0f), fx = hn::Set(d, f.fx[k][i]);
                const V wx = hn::IfThenElse(right, fx, hn::Sub(one, fx));
                const V column = hn::Add(hn::Mul(hn::LoadU(d, p), hn::Sub(one, fy)),
                                         hn::Mul(hn::LoadU(d, p + f.stride[k][i]), fy));
                acc = hn::Add(acc, hn::Mul(column, hn::Mul(wx, hn::Set(d, f.share[k][i]))));
            }
        }
        hn::Store(acc, d, total + half);
    }
    for (int c = 0; c < 4; ++c) sum[c] += total[c] + total[c + 4];
}

void sampled_texel(const CubePyramid& pyramid, const std::int32_t* level_offsets, const LdSamples& samples,
                   const TexelFrame& m, float* rgb) {
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    const int lanes = static_cast<int>(hn::Lanes(d));
    Fetches fetches;
    float sum[4] = {0, 0, 0, 0};
    const float share = 1.0f / static_cast<float>(samples.count);
    const auto combine = [&](V x, V y, V z, float cx, float cy, float cz) {
        return hn::Add(hn::Add(hn::Mul(x, hn::Set(d, cx)), hn::Mul(y, hn::Set(d, cy))),
                       hn::Mul(z, hn::Set(d, cz)));
    };
    for (int begin = 0; begin < samples.count; begin += kChunk) {
        const int count = std::min(kChunk, samples.count - begin);
        for (int i = 0; i < count; i += lanes) {  // the arrays are padded: whole vectors always
            const V x = hn::LoadU(d, &samples.x[begin + i]), y = hn::LoadU(d, &samples.y[begin + i]);
            const V z = hn::LoadU(d, &samples.z[begin + i]);
            address(d, pyramid, level_offsets, combine(x, y, z, m.tx, m.bx, m.nx),
                    combine(x, y, z, m.ty, m.by, m.ny), combine(x, y, z, m.tz, m.bz, m.nz),
                    hn::LoadU(d, &samples.lod[begin + i]), share, i, fetches);
        }
        fetch(pyramid.texels().data(), fetches, count, sum);
    }
    std::copy_n(sum, 3, rgb);
}

}  // namespace HWY_NAMESPACE
}  // namespace pbr
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pbr {
namespace {

HWY_EXPORT(sampled_texel);

/// A right-handed frame about n, turned by `turns` about it (Duff et al. 2017, "Building an orthonormal
/// basis, revisited").
TexelFrame frame_about(const glm::dvec3& n, double turns) {
    const double sign = n.z < 0 ? -1 : 1;
    const double a = -1 / (sign + n.z), b = n.x * n.y * a;
    const glm::dvec3 t(1 + sign * n.x * n.x * a, sign * b, -sign * n.x), u(b, sign + n.y * n.y * a, -n.y);
    const SinCos turn = sin_cos_pi(2 * turns);
    const glm::dvec3 x = t * turn.cos + u * turn.sin, y = u * turn.cos - t * turn.sin;
    const auto f = [](double value) { return static_cast<float>(value); };
    return {f(x.x), f(x.y), f(x.z), f(y.x), f(y.y), f(y.z), f(n.x), f(n.y), f(n.z)};
}

}  // namespace

void ld_sampled(const CubePyramid& pyramid, const LdSamples& samples, std::uint64_t seed, int size,
                std::span<const CubeTexel> texels, std::span<float> rgb_out) {
    std::int32_t level_offsets[32];
    for (int level = 0; level < pyramid.levels(); ++level) level_offsets[level] = pyramid.offset(level);
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const auto& [face, x, y] = texels[i];
        const double turns = random_unit(seed, size, face, x, y);
        const TexelFrame frame = frame_about(cubemap_texel_direction(texels[i], size), turns);
        HWY_DYNAMIC_DISPATCH(sampled_texel)(pyramid, level_offsets, samples, frame, &rgb_out[i * 3]);
    }
}

}  // namespace pbr
#endif
