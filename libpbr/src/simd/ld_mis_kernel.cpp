// Multiple importance sampling of lobe and picture. Samples of the lobe need the picture's texel they fall
// into: addresses are found a vector of samples at a time, texels are read one by one. Samples of the picture
// need the lobe alone, 16 side by side, whatever the vector width: it doesn't change the bits.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/simd/ld_mis_kernel.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>

#include "pbr/ibl/environment_sampler.hpp"
#include "pbr/ibl/ld_mis.hpp"
#include "src/simd/cube_face.hpp"
#include "src/simd/ld_kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace pbr {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kChunk = 256;  // samples addressed before their texels are read

/// Texels of a chunk of samples, and what makes N_p p / k of their densities.
struct Places {
    HWY_ALIGN_MAX std::int32_t row[kChunk], column[kChunk];
    HWY_ALIGN_MAX float factor[kChunk];
};

/// Angle of (x, y) from the x axis, in turns, within [-1/2, 1/2]; 0 at (0, 0). The polynomial through the
/// Chebyshev points of t^2 in [0, 1] for atan(t) / (2 pi t), off by 1e-8; rounding adds 4e-8.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V turns_of(D d, V y, V x) {
    const V ax = hn::Abs(x), ay = hn::Abs(y);
    const V t = hn::Div(hn::Min(ax, ay), hn::Max(hn::Max(ax, ay), hn::Set(d, 1e-30f)));
    const V t2 = hn::Mul(t, t);
    V sum = hn::Set(d, -0.00072571343f);
    for (const float c : {0.0037847871f, -0.0093630460f, 0.015706787f, -0.022286929f, 0.031778407f,
                          -0.053049227f, 0.15915492f})
        sum = hn::Add(hn::Mul(sum, t2), hn::Set(d, c));
    const V first = hn::Mul(sum, t);  // in the first eighth
    const V quarter = hn::IfThenElse(hn::Gt(ay, ax), hn::Sub(hn::Set(d, 0.25f), first), first);
    const V half = hn::IfThenElse(hn::Lt(x, hn::Zero(d)), hn::Sub(hn::Set(d, 0.5f), quarter), quarter);
    return hn::CopySign(half, y);
}

/// Which of `count` equal parts of [0, 1] a coordinate lies in; the end one for those a rounding outside.
template <class D, class V = hn::Vec<D>>
HWY_INLINE hn::Vec<hn::Rebind<std::int32_t, D>> index_of(D d, V coordinate, int count) {
    const hn::Rebind<std::int32_t, D> di;
    const auto index = hn::ConvertTo(di, hn::Mul(coordinate, hn::Set(d, static_cast<float>(count))));
    return hn::Min(hn::Max(index, hn::Zero(di)), hn::Set(di, count - 1));
}

/// Texels of an equirect in directions of its own frame.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void equirect_places(D d, const EnvironmentSampler& environment, V x, V y, V z, V factor, int at,
                                Places& out) {
    const hn::Rebind<std::int32_t, D> di;
    const V half = hn::Set(d, 0.5f);
    const V u = hn::Sub(half, turns_of(d, x, z));
    const V v = hn::Abs(turns_of(d, hn::Sqrt(hn::Add(hn::Mul(x, x), hn::Mul(z, z))), y));
    // The seam at u = 1 is column 0 again, as equirect_point has it.
    const V wrapped = hn::IfThenZeroElse(hn::Ge(u, hn::Set(d, 1.0f)), u);
    hn::Store(index_of(d, wrapped, environment.columns()), di, out.column + at);
    hn::Store(index_of(d, hn::Add(v, v), environment.rows()), di, out.row + at);
    hn::Store(factor, d, out.factor + at);
}

/// Texels of a cube map.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void cube_places(D d, const EnvironmentSampler& environment, V x, V y, V z, V factor, int at,
                            Places& out) {
    const hn::Rebind<std::int32_t, D> di;
    const V one = hn::Set(d, 1.0f), half = hn::Set(d, 0.5f);
    const auto [face, s, t, inverse] = face_point(d, x, y, z);
    const int n = environment.columns();
    const auto first_row = hn::ConvertTo(di, hn::Mul(face, hn::Set(d, static_cast<float>(n))));
    hn::Store(index_of(d, hn::Mul(hn::Add(s, one), half), n), di, out.column + at);
    hn::Store(hn::Add(first_row, index_of(d, hn::Mul(hn::Add(t, one), half), n)), di, out.row + at);
    // Densities of cube maps are per area of the face.
    hn::Store(hn::Mul(factor, hn::Mul(inverse, hn::Mul(inverse, inverse))), d, out.factor + at);
}

/// Adds what the lobe's samples say: L / (N_k + N_p p / k) each.
void add_lobe_samples(const EnvironmentSampler& environment, const MisSamples& samples, std::size_t first,
                      const TexelFrame& m, double* sum) {
    const hn::ScalableTag<float> d;
    using V = hn::Vec<decltype(d)>;
    const int lanes = static_cast<int>(hn::Lanes(d));
    const float lobe_count = static_cast<float>(samples.lobe_count);
    const auto combine = [&](V x, V y, V z, float cx, float cy, float cz) HWY_ATTR {
        return hn::Add(hn::Add(hn::Mul(x, hn::Set(d, cx)), hn::Mul(y, hn::Set(d, cy))),
                       hn::Mul(z, hn::Set(d, cz)));
    };
    Places places;
    for (int begin = 0; begin < samples.lobe_count; begin += kChunk) {
        const int count = std::min(kChunk, samples.lobe_count - begin);
        for (int i = 0; i < count; i += lanes) {  // the arrays are padded: whole vectors always
            const std::size_t at = first + static_cast<std::size_t>(begin + i);
            const V x = hn::LoadU(d, &samples.x[at]), y = hn::LoadU(d, &samples.y[at]),
                    z = hn::LoadU(d, &samples.z[at]);
            const V wx = combine(x, y, z, m.tx, m.bx, m.nx), wy = combine(x, y, z, m.ty, m.by, m.ny);
            const V wz = combine(x, y, z, m.tz, m.bz, m.nz),
                    factor = hn::LoadU(d, &samples.picture_over_lobe[at]);
            if (environment.is_cube())
                cube_places(d, environment, wx, wy, wz, factor, i, places);
            else
                equirect_places(d, environment, wx, wy, wz, factor, i, places);
        }
        float chunk[3] = {0, 0, 0};
        for (int i = 0; i < count; ++i) {
            const float* texel =
                &environment.texels()[(static_cast<std::size_t>(places.row[i]) * environment.columns() +
                                       static_cast<std::size_t>(places.column[i])) *
                                      4];
            const float weight = 1 / (lobe_count + texel[3] * places.factor[i]);
            for (int c = 0; c < 3; ++c) chunk[c] += texel[c] * weight;
        }
        for (int c = 0; c < 3; ++c) sum[c] += static_cast<double>(chunk[c]);
    }
}

/// Adds what the picture's samples say: L k / (N_k k + N_p p) each.
void add_picture_samples(const MisSamples& samples, std::size_t first, const MisLobe& lobe,
                         const glm::dvec3& n, double* sum) {
    const hn::CappedTag<float, kMisPadding> d;
    using V = hn::Vec<decltype(d)>;
    const int lanes = static_cast<int>(hn::Lanes(d));
    const V nx = hn::Set(d, static_cast<float>(n.x)), ny = hn::Set(d, static_cast<float>(n.y)),
            nz = hn::Set(d, static_cast<float>(n.z));
    const V one = hn::Set(d, 1.0f), half = hn::Set(d, 0.5f),
            lobe_count = hn::Set(d, static_cast<float>(samples.lobe_count));
    const V a2 = hn::Set(d, lobe.alpha2), slope = hn::Set(d, (1 - lobe.alpha2) / 4),
            factor = hn::Set(d, lobe.normalisation);
    HWY_ALIGN_MAX float out[3][kMisPadding];
    for (int begin = 0; begin < samples.picture_count; begin += kChunk) {
        const int end = std::min(begin + kChunk, samples.picture_count);
        for (int lane = 0; lane < kMisPadding; lane += lanes) {
            V r = hn::Zero(d), g = hn::Zero(d), b = hn::Zero(d);
            for (int i = begin; i < end; i += kMisPadding) {
                const std::size_t at = first + static_cast<std::size_t>(i + lane);
                // k as simd/ld_exact_kernel.cpp has it, from the chord.
                const V dx = hn::Sub(nx, hn::LoadU(d, &samples.px[at])),
                        dy = hn::Sub(ny, hn::LoadU(d, &samples.py[at]));
                const V dz = hn::Sub(nz, hn::LoadU(d, &samples.pz[at]));
                const V chord2 = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
                const V mu = hn::Max(hn::Zero(d), hn::Sub(one, hn::Mul(half, chord2)));
                const V f = hn::Add(a2, hn::Mul(slope, chord2));
                const V k = hn::Div(hn::Mul(mu, factor), hn::Mul(f, f));
                const V weight =
                    hn::Div(k, hn::Add(hn::Mul(lobe_count, k), hn::LoadU(d, &samples.density[at])));
                r = hn::Add(r, hn::Mul(weight, hn::LoadU(d, &samples.r[at])));
                g = hn::Add(g, hn::Mul(weight, hn::LoadU(d, &samples.g[at])));
                b = hn::Add(b, hn::Mul(weight, hn::LoadU(d, &samples.b[at])));
            }
            hn::Store(r, d, out[0] + lane);
            hn::Store(g, d, out[1] + lane);
            hn::Store(b, d, out[2] + lane);
        }
        for (int c = 0; c < 3; ++c)
            for (const float partial : out[c]) sum[c] += static_cast<double>(partial);
    }
}

void texel(const EnvironmentSampler& environment, const MisSamples& samples, int set, const MisLobe& lobe,
           const glm::dvec3& n, const TexelFrame& in_picture, float* rgb) {
    const auto padded = [set](int count) {
        return static_cast<std::size_t>((count + kMisPadding - 1) / kMisPadding * kMisPadding) * set;
    };
    double sum[3] = {0, 0, 0};
    add_lobe_samples(environment, samples, padded(samples.lobe_count), in_picture, sum);
    add_picture_samples(samples, padded(samples.picture_count), lobe, n, sum);
    for (int c = 0; c < 3; ++c) rgb[c] = static_cast<float>(sum[c]);
}

}  // namespace HWY_NAMESPACE
}  // namespace pbr
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pbr {

HWY_EXPORT(texel);

void mis_texel(const EnvironmentSampler& environment, const MisSamples& samples, int set, const MisLobe& lobe,
               const glm::dvec3& n, const TexelFrame& in_picture, float* rgb) {
    HWY_DYNAMIC_DISPATCH(texel)(environment, samples, set, lobe, n, in_picture, rgb);
}

}  // namespace pbr
#endif
