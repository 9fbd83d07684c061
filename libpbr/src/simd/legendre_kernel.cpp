// Legendre sums. Lanes hold rings. Analysis adds the rings of a lane in ascending order and the lanes at the
// end, so its bits do not depend on the vector width either.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/simd/legendre_kernel.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "pbr/numerics/elementary.hpp"
#include "src/simd/legendre_kernel.hpp"
#include "src/simd/vector_math.hpp"

HWY_BEFORE_NAMESPACE();
namespace pbr {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, kRingLanes>;
using V = hn::Vec<D>;

constexpr double kSmall = 0x1p-512;

/// P_lm of `count` vectors of rings, one lane-group each, stepping through the degrees.
template <int count>
struct Recurrence {
    V x[count], now[count], before[count];
    V exponent[count];  ///< the functions are now / kSmall^exponent; 0 from where they matter
    bool scaled;

    HWY_INLINE void start(const Rings& rings, const LegendreOrder& legendre, int ring, int stride) {
        const D d;
        scaled = false;
        for (int v = 0; v < count; ++v) {
            const int at = ring + v * stride;
            const V log2_p = hn::Add(
                hn::Set(d, legendre.log2_start),
                hn::Mul(hn::Set(d, static_cast<double>(legendre.order)), hn::LoadU(d, &rings.log2_sine[at])));
            const V shift = hn::Max(hn::Ceil(hn::Mul(log2_p, hn::Set(d, 1.0 / 512))), hn::Set(d, -1e6));
            exponent[v] = hn::IfThenElseZero(hn::Le(log2_p, hn::Set(d, -500.0)), shift);
            const V rest = hn::Sub(log2_p, hn::Mul(hn::Set(d, 512.0), exponent[v]));
            x[v] = hn::LoadU(d, &rings.cosine[at]);
            now[v] = exp(d, hn::Mul(hn::Max(rest, hn::Set(d, -900.0)), hn::Set(d, std::numbers::ln2)));
            before[v] = hn::Zero(d);
            scaled |= !hn::AllTrue(d, hn::Ge(exponent[v], hn::Zero(d)));
        }
    }

    /// What counts of a vector: zero where the function is below kSmall.
    HWY_INLINE V value(int v) const { return hn::IfThenElseZero(hn::Ge(exponent[v], hn::Zero(D())), now[v]); }

    HWY_INLINE void step(double a, double b) {
        const V va = hn::Set(D(), a), vb = hn::Set(D(), b);
        for (int v = 0; v < count; ++v) {
            const V next = hn::Mul(va, hn::Sub(hn::Mul(x[v], now[v]), hn::Mul(vb, before[v])));
            before[v] = now[v];
            now[v] = next;
        }
    }

    HWY_INLINE void rescale() {
        const D d;
        scaled = false;
        for (int v = 0; v < count; ++v) {
            const auto grown =
                hn::And(hn::Lt(exponent[v], hn::Zero(d)), hn::Ge(hn::Abs(now[v]), hn::Set(d, 1.0)));
            const V factor = hn::IfThenElse(grown, hn::Set(d, kSmall), hn::Set(d, 1.0));
            now[v] = hn::Mul(now[v], factor);
            before[v] = hn::Mul(before[v], factor);
            exponent[v] = hn::IfThenElse(grown, hn::Add(exponent[v], hn::Set(d, 1.0)), exponent[v]);
            scaled |= !hn::AllTrue(d, hn::Ge(exponent[v], hn::Zero(d)));
        }
    }
};

void analyse(const Rings& rings, const LegendreOrder& legendre, int first, const double* even,
             const double* odd, double* coefficients) {
    constexpr int kVectors = kRingGroup / kRingLanes;
    const D d;
    const int lanes = static_cast<int>(hn::Lanes(d)), padded = rings.padded(), degrees = legendre.degrees();
    std::vector<double> sums(static_cast<std::size_t>(degrees) * kParts * kRingLanes);
    for (int group = first; group < padded; group += kRingGroup)
        for (int lane = 0; lane < kRingLanes; lane += lanes) {
            Recurrence<kVectors> p;
            p.start(rings, legendre, group + lane, kRingLanes);
            const auto add = [&](int k, const V* values) HWY_ATTR {
                const double* f = (k % 2 == 0 ? even : odd) + group + lane;
                double* sum = &sums[static_cast<std::size_t>(k) * kParts * kRingLanes + lane];
                for (int part = 0; part < kParts; ++part) {
                    V total = hn::LoadU(d, sum + part * kRingLanes);
                    for (int v = 0; v < kVectors; ++v)
                        total = hn::Add(total,
                                        hn::Mul(values[v], hn::LoadU(d, f + part * padded + v * kRingLanes)));
                    hn::StoreU(total, d, sum + part * kRingLanes);
                }
            };
            int k = 0;
            for (; p.scaled && k < degrees; ++k) {
                if (k > 0) p.step(legendre.a[k], legendre.b[k]);
                p.rescale();
                V values[kVectors];
                for (int v = 0; v < kVectors; ++v) values[v] = p.value(v);
                add(k, values);
            }
            for (; k < degrees; ++k) {
                if (k > 0) p.step(legendre.a[k], legendre.b[k]);
                add(k, p.now);
            }
        }
    for (int i = 0; i < degrees * kParts; ++i) {
        const double* s = &sums[static_cast<std::size_t>(i) * kRingLanes];
        coefficients[i] = ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
    }
}

void synthesise(const Rings& rings, const LegendreOrder& legendre, int first, const double* coefficients,
                double* even, double* odd) {
    constexpr int kVectors = 2;
    const D d;
    const int lanes = static_cast<int>(hn::Lanes(d)), padded = rings.padded(), degrees = legendre.degrees();
    for (int part = 0; part < kParts; ++part)
        for (double* out : {even, odd}) std::fill_n(out + part * padded, first, 0.0);
    for (int ring = first; ring < padded; ring += kVectors * lanes) {
        Recurrence<kVectors> p;
        p.start(rings, legendre, ring, lanes);
        V sum[2][kParts][kVectors];
        for (auto& parity : sum)
            for (auto& part : parity)
                for (V& v : part) v = hn::Zero(d);
        const auto add = [&](int k, const V* values, V(&into)[kParts][kVectors]) HWY_ATTR {
            for (int part = 0; part < kParts; ++part) {
                const V c = hn::Set(d, coefficients[k * kParts + part]);
                for (int v = 0; v < kVectors; ++v)
                    into[part][v] = hn::Add(into[part][v], hn::Mul(c, values[v]));
            }
        };
        int k = 0;
        for (; p.scaled && k < degrees; ++k) {
            if (k > 0) p.step(legendre.a[k], legendre.b[k]);
            p.rescale();
            V values[kVectors];
            for (int v = 0; v < kVectors; ++v) values[v] = p.value(v);
            add(k, values, sum[k % 2]);
        }
        const auto plain = [&](V(&into)[kParts][kVectors]) HWY_ATTR {
            if (k > 0) p.step(legendre.a[k], legendre.b[k]);
            add(k++, p.now, into);
        };
        if (k % 2 == 1 && k < degrees) plain(sum[1]);
        while (k + 1 < degrees) {
            plain(sum[0]);
            plain(sum[1]);
        }
        if (k < degrees) plain(sum[0]);
        for (int part = 0; part < kParts; ++part)
            for (int v = 0; v < kVectors; ++v) {
                hn::StoreU(sum[0][part][v], d, even + part * padded + ring + v * lanes);
                hn::StoreU(sum[1][part][v], d, odd + part * padded + ring + v * lanes);
            }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace pbr
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pbr {
namespace {

HWY_EXPORT(analyse);
HWY_EXPORT(synthesise);

}  // namespace

Rings::Rings(const std::vector<double>& colatitudes_rad) {
    for (const double colatitude : colatitudes_rad) {
        const SinCos angle = sin_cos_pi(colatitude / std::numbers::pi);
        cosine.push_back(angle.cos);
        log2_sine.push_back(log2_exact(angle.sin));
    }
    while (cosine.size() % kRingGroup != 0) {  // copies of the last, whose weights are zero
        cosine.push_back(cosine.back());
        log2_sine.push_back(log2_sine.back());
    }
}

int Rings::first(int order, int bands) const {
    // Beyond its turning point sin(theta) = m / (l + 1/2) a function falls faster than exponentially; the
    // margin is that of libsharp (Reinecke & Seljebotn 2013), generous here.
    const double sine = (order - 16 - 0.03 * bands) / bands;
    if (sine <= 0) return 0;
    const double threshold = log2_exact(sine);
    const auto at = std::lower_bound(log2_sine.begin(), log2_sine.end(), threshold) - log2_sine.begin();
    return static_cast<int>(std::min<long>(at, padded() - 1)) / kRingGroup * kRingGroup;
}

LegendreOrder::LegendreOrder(int order_in, int bands_in) : order(order_in), bands(bands_in) {
    // P_mm = sqrt((2m + 1) / 4 pi * product of (2k - 1) / 2k) sin^m
    double product = (2.0 * order + 1) / (4 * std::numbers::pi);
    for (int k = 1; k <= order; ++k) product *= 1 - 0.5 / k;
    log2_start = log2_exact(product) / 2;
    const double m2 = static_cast<double>(order) * order;
    for (int l = order; l <= bands; ++l) {
        const double l2 = static_cast<double>(l) * l, before = (l - 1.0) * (l - 1.0);
        a.push_back(l > order ? std::sqrt((4 * l2 - 1) / (l2 - m2)) : 0);
        b.push_back(l > order + 1 ? std::sqrt((before - m2) / (4 * before - 1)) : 0);
    }
}

void legendre_analyse(const Rings& rings, const LegendreOrder& legendre, int first, const double* even,
                      const double* odd, double* coefficients) {
    HWY_DYNAMIC_DISPATCH(analyse)(rings, legendre, first, even, odd, coefficients);
}

void legendre_synthesise(const Rings& rings, const LegendreOrder& legendre, int first,
                         const double* coefficients, double* even, double* odd) {
    HWY_DYNAMIC_DISPATCH(synthesise)(rings, legendre, first, coefficients, even, odd);
}

}  // namespace pbr
#endif
