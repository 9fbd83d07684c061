// Vector functions of double for the kernels: only Mul, Add, Div and Sqrt, never fused, so that every target
// gives the same bits. Included once a target by the kernels; hence the toggled guard.

#if defined(PBR_SIMD_VECTOR_MATH_HPP_) == defined(HWY_TARGET_TOGGLE)
#ifdef PBR_SIMD_VECTOR_MATH_HPP_
#undef PBR_SIMD_VECTOR_MATH_HPP_
#else
#define PBR_SIMD_VECTOR_MATH_HPP_
#endif

#include <hwy/highway.h>

#include <numbers>

HWY_BEFORE_NAMESPACE();
namespace pbr {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// e^x for |x| <= 700, relative error below 3e-16: 2^k e^r with |r| <= ln(2)/2 and the Taylor series of e^r.
template <class D, class V = hn::Vec<D>>
V exp(D d, V x) {
    const hn::Rebind<std::int64_t, D> di;
    const V k = hn::Round(hn::Mul(x, hn::Set(d, std::numbers::log2e)));
    const V r = hn::Sub(hn::Sub(x, hn::Mul(k, hn::Set(d, 0x1.62e42fefa38p-1))),
                        hn::Mul(k, hn::Set(d, 0x1.ef35793c7673p-45)));
    V series = hn::Set(d, 1.0);
    for (int n = 14; n >= 1; --n)
        series = hn::Add(hn::Mul(hn::Mul(series, r), hn::Set(d, 1.0 / n)), hn::Set(d, 1.0));
    const auto bits = hn::ShiftLeft<52>(hn::Add(hn::ConvertTo(di, k), hn::Set(di, 1023)));
    return hn::Mul(series, hn::BitCast(d, bits));
}

template <class V>
struct SinhCosh {
    V sinh, cosh;
};

/// sinh and cosh of y in [0, 700]; relative error below 2e-14 (sinh by its series below 1e-2).
template <class D, class V = hn::Vec<D>>
SinhCosh<V> sinh_cosh(D d, V y) {
    const V half = hn::Set(d, 0.5);
    const V e = exp(d, y), inverse = hn::Div(hn::Set(d, 1.0), e);
    const V y2 = hn::Mul(y, y);
    const V series =
        hn::Mul(y, hn::Add(hn::Set(d, 1.0),
                           hn::Mul(y2, hn::Add(hn::Set(d, 1.0 / 6),
                                               hn::Mul(y2, hn::Add(hn::Set(d, 1.0 / 120),
                                                                   hn::Mul(y2, hn::Set(d, 1.0 / 5040))))))));
    const V direct = hn::Mul(half, hn::Sub(e, inverse));
    return {hn::IfThenElse(hn::Lt(y, hn::Set(d, 1e-2)), series, direct), hn::Mul(half, hn::Add(e, inverse))};
}

/// Natural logarithm of normal x > 0; absolute error below 1e-15 max(1, |ln x|).
template <class D, class V = hn::Vec<D>>
V log(D d, V x) {
    const hn::Rebind<std::int64_t, D> di;
    const auto bits = hn::BitCast(di, x);
    // m in [sqrt(1/2), sqrt(2)): move the exponent's boundary to sqrt(1/2).
    const auto shifted = hn::Sub(bits, hn::Set(di, 0x3fe6a09e667f3bcd));
    const auto exponent = hn::ShiftRight<52>(shifted);
    const V m = hn::BitCast(d, hn::Sub(bits, hn::ShiftLeft<52>(exponent)));
    const V s = hn::Div(hn::Sub(m, hn::Set(d, 1.0)), hn::Add(m, hn::Set(d, 1.0)));
    const V s2 = hn::Mul(s, s);
    V series = hn::Zero(d);
    for (int k = 23; k >= 1; k -= 2) series = hn::Add(hn::Mul(series, s2), hn::Set(d, 2.0 / k));
    return hn::Add(hn::Mul(hn::ConvertTo(d, exponent), hn::Set(d, std::numbers::ln2)), hn::Mul(s, series));
}

/// asinh of x in [0, 1e150]: the logarithm, or the first terms of its series for small x. Relative error
/// below 1e-13.
template <class D, class V = hn::Vec<D>>
V asinh(D d, V x) {
    const V one = hn::Set(d, 1.0), x2 = hn::Mul(x, x);
    const V direct = log(d, hn::Add(x, hn::Sqrt(hn::Add(x2, one))));
    const V series = hn::Mul(
        x, hn::Add(one, hn::Mul(x2, hn::Add(hn::Set(d, -1.0 / 6),
                                            hn::Mul(x2, hn::Add(hn::Set(d, 3.0 / 40),
                                                                hn::Mul(x2, hn::Set(d, -5.0 / 112))))))));
    return hn::IfThenElse(hn::Lt(x, hn::Set(d, 1e-2)), series, direct);
}

}  // namespace HWY_NAMESPACE
}  // namespace pbr
HWY_AFTER_NAMESPACE();

#endif
