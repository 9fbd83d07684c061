// The f0 of legacy lobes, a lane a lobe: the operations of energy.cpp in their order, never fused, so that
// any vector width gives the bits of the scalar function. That does what is left of a row.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/simd/mean_albedo_kernel.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>

#include "pbr/legacy/energy.hpp"
#include "src/legacy/mean_albedo_fit.hpp"

HWY_BEFORE_NAMESPACE();
namespace pbr {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, 8>;
using V = hn::Vec<D>;
constexpr D d;
constexpr hn::Rebind<float, D> df;

HWY_INLINE V set(double value) { return hn::Set(d, value); }

HWY_INLINE V polynomial(const std::array<double, 11>& coefficients, V x) {
    V sum = hn::Zero(d);
    for (std::size_t i = coefficients.size(); i-- > 0;) sum = hn::Add(hn::Mul(sum, x), set(coefficients[i]));
    return sum;
}

/// MeanAlbedo of some lobes.
struct Lobes {
    V E, Fc;
};

/// See pbr::mean_specular_albedo; of one f0.
HWY_INLINE V specular_albedo(double f0, const Lobes& lobes, bool is_multiple) {
    const double f90 = std::min(1., kF90Slope * f0), F_avg = f0 + (f90 - f0) * kMeanWeight;
    const V single = hn::Add(hn::Mul(set(f0), hn::Sub(lobes.E, lobes.Fc)), hn::Mul(set(f90), lobes.Fc));
    if (!is_multiple) return single;
    const V lost = hn::Sub(set(1), lobes.E);
    return hn::Add(single, hn::Div(hn::Mul(hn::Mul(set(F_avg * F_avg), lobes.E), lost),
                                   hn::Sub(set(1), hn::Mul(set(F_avg), lost))));
}

/// Single-scattering albedo is k0 + k1 F_avg, and f0 is offset + slope F_avg: energy.cpp's Piece.
struct Pieces {
    V k0, k1, offset, slope;
};

HWY_INLINE Pieces pieces(const Lobes& lobes, V mean_albedo, bool is_multiple) {
    constexpr double kBelow = 1 + (kF90Slope - 1) * kMeanWeight, kAbove = 1 - kMeanWeight;
    const auto is_below = hn::Lt(mean_albedo, specular_albedo(kFullF90, lobes, is_multiple));
    const auto choose = [&](V below, V above) HWY_ATTR { return hn::IfThenElse(is_below, below, above); };
    const V direct = hn::Sub(lobes.E, lobes.Fc);
    const V k1_below = hn::Div(hn::Add(lobes.E, hn::Mul(set(kF90Slope - 1), lobes.Fc)), set(kBelow));
    const V k0_above = hn::Sub(lobes.Fc, hn::Div(hn::Mul(direct, set(kMeanWeight)), set(kAbove)));
    return {choose(hn::Zero(d), k0_above), choose(k1_below, hn::Div(direct, set(kAbove))),
            choose(hn::Zero(d), set(-kMeanWeight / kAbove)), choose(set(1 / kBelow), set(1 / kAbove))};
}

/// F_avg of what reflects c besides its piece's k0.
HWY_INLINE V mean_fresnel(const Lobes& lobes, const Pieces& piece, V c, bool is_multiple) {
    if (!is_multiple) return hn::Div(c, piece.k1);
    const V r = hn::Sub(set(1), lobes.E), a = hn::Mul(r, hn::Sub(piece.k1, lobes.E));
    const V b = hn::Add(piece.k1, hn::Mul(c, r));
    const V square = hn::Sub(hn::Mul(b, b), hn::Mul(hn::Mul(set(4), a), c));
    return hn::Div(hn::Mul(set(2), c), hn::Add(b, hn::Sqrt(hn::Max(square, hn::Zero(d)))));
}

HWY_INLINE void f0_at(std::size_t i, const float* mean_albedo, const float* perceptual_roughness,
                      bool is_multiple, float* f0, std::uint8_t* clamped) {
    const auto load = [i](const float* values)
                          HWY_ATTR { return hn::PromoteTo(d, hn::LoadU(df, values + i)); };
    const V albedo = load(mean_albedo), p = load(perceptual_roughness), one = set(1), zero = hn::Zero(d);
    const Lobes lobes{polynomial(kMeanE, p), polynomial(kMeanFc, p)};
    const V most = specular_albedo(1, lobes, is_multiple);
    const Pieces piece = pieces(lobes, albedo, is_multiple);
    const V F_avg = mean_fresnel(lobes, piece, hn::Sub(albedo, piece.k0), is_multiple);
    const V solved = hn::Min(hn::Max(hn::Add(piece.offset, hn::Mul(piece.slope, F_avg)), zero), one);
    const V reachable = hn::IfThenElse(hn::Ge(albedo, most), one, solved);
    hn::StoreU(hn::DemoteTo(df, hn::IfThenElseZero(hn::Gt(albedo, zero), reachable)), df, f0 + i);
    const auto is_beyond = hn::Gt(albedo, hn::Mul(most, set(1 + 1e-6)));
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, is_beyond, bits);
    for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) clamped[i + lane] = bits[0] >> lane & 1;
}

/// Returns how many lobes were done.
std::size_t f0_all(const float* mean_albedo, const float* perceptual_roughness, Scattering scattering,
                   std::size_t count, float* f0, std::uint8_t* clamped) {
    const std::size_t lanes = hn::Lanes(d);
    const bool is_multiple = scattering == Scattering::multiple;
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes)
        f0_at(i, mean_albedo, perceptual_roughness, is_multiple, f0, clamped);
    return i;
}

}  // namespace HWY_NAMESPACE
}  // namespace pbr
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pbr {
namespace {

HWY_EXPORT(f0_all);

}  // namespace

void f0_from_mean_albedo(const float* mean_albedo, const float* perceptual_roughness, Scattering scattering,
                         std::size_t count, float* f0, std::uint8_t* clamped) {
    std::size_t i =
        HWY_DYNAMIC_DISPATCH(f0_all)(mean_albedo, perceptual_roughness, scattering, count, f0, clamped);
    for (; i < count; ++i) {
        const MeanAlbedo lobe = mean_albedo_ggx(static_cast<double>(perceptual_roughness[i]));
        const SolvedF0 solved = f0_from_mean_albedo(static_cast<double>(mean_albedo[i]), lobe, scattering);
        f0[i] = static_cast<float>(solved.f0);
        clamped[i] = solved.clamped;
    }
}

}  // namespace pbr
#endif
