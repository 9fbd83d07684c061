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

/// The polynomial of ascending coefficients, even and odd powers apart: two short chains instead of a long
/// one.
template <std::size_t kCount, class D, class V = hn::Vec<D>>
HWY_INLINE V polynomial(D d, V x, const double (&coefficients)[kCount]) {
    static_assert(kCount % 2 == 0);
    const V x2 = hn::Mul(x, x);
    V even = hn::Set(d, coefficients[kCount - 2]), odd = hn::Set(d, coefficients[kCount - 1]);
    for (std::size_t i = kCount - 2; i > 0; i -= 2) {
        even = hn::Add(hn::Mul(even, x2), hn::Set(d, coefficients[i - 2]));
        odd = hn::Add(hn::Mul(odd, x2), hn::Set(d, coefficients[i - 1]));
    }
    return hn::Add(even, hn::Mul(odd, x));
}

/// e^x for |x| <= 700, relative error below 4e-16: 2^k e^r with |r| <= ln(2)/2 and the Taylor series of e^r,
/// whose first term left out is below 5e-18.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V exp(D d, V x) {
    constexpr double kSeries[] = {
        1,         1,          1. / 2,      1. / 6,       1. / 24,       1. / 120,       1. / 720,
        1. / 5040, 1. / 40320, 1. / 362880, 1. / 3628800, 1. / 39916800, 1. / 479001600, 1. / 6227020800};
    const hn::Rebind<std::int64_t, D> di;
    const V k = hn::Round(hn::Mul(x, hn::Set(d, std::numbers::log2e)));
    const V r = hn::Sub(hn::Sub(x, hn::Mul(k, hn::Set(d, 0x1.62e42fefa38p-1))),
                        hn::Mul(k, hn::Set(d, 0x1.ef35793c7673p-45)));
    const auto bits = hn::ShiftLeft<52>(hn::Add(hn::ConvertTo(di, k), hn::Set(di, 1023)));
    return hn::Mul(polynomial(d, r, kSeries), hn::BitCast(d, bits));
}

/// sinh y for y in [0, 700], given e^y and e^-y: relative error below 2e-14 beside theirs (the series below
/// 1e-2).
template <class D, class V = hn::Vec<D>>
HWY_INLINE V sinh_from_exp(D d, V y, V e, V inverse) {
    constexpr double kSeries[] = {1, 1. / 6, 1. / 120, 1. / 5040};
    const V series = hn::Mul(y, polynomial(d, hn::Mul(y, y), kSeries));
    const V direct = hn::Mul(hn::Set(d, 0.5), hn::Sub(e, inverse));
    return hn::IfThenElse(hn::Lt(y, hn::Set(d, 1e-2)), series, direct);
}

/// sin(x pi/2) for x in [-1, 1], absolute error below 4e-16: the Taylor series, whose first term left out is
/// below 2e-18.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V sin_half_pi(D d, V x) {
    constexpr double kSeries[] = {1,
                                  -1. / 6,
                                  1. / 120,
                                  -1. / 5040,
                                  1. / 362880,
                                  -1. / 39916800,
                                  1. / 6227020800,
                                  -1. / 1307674368e3,
                                  1. / 355687428096e3,
                                  -1. / 121645100408832e3,
                                  1. / 51090942171709440e3,
                                  0};
    const V angle = hn::Mul(x, hn::Set(d, std::numbers::pi / 2));
    return hn::Mul(angle, polynomial(d, hn::Mul(angle, angle), kSeries));
}

/// Natural logarithm of normal x > 0; absolute error below 1e-15 max(1, |ln x|).
template <class D, class V = hn::Vec<D>>
HWY_INLINE V log(D d, V x) {
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
HWY_INLINE V asinh(D d, V x) {
    const V one = hn::Set(d, 1.0), x2 = hn::Mul(x, x);
    const V direct = log(d, hn::Add(x, hn::Sqrt(hn::Add(x2, one))));
    const V series = hn::Mul(
        x, hn::Add(one, hn::Mul(x2, hn::Add(hn::Set(d, -1.0 / 6),
                                            hn::Mul(x2, hn::Add(hn::Set(d, 3.0 / 40),
                                                                hn::Mul(x2, hn::Set(d, -5.0 / 112))))))));
    return hn::IfThenElse(hn::Lt(x, hn::Set(d, 1e-2)), series, direct);
}

/// Angle of (x, y) in (-pi, pi], 0 where both are 0; y = -0 counts as 0. Absolute error below 1e-15. The
/// angle in the first octant is taken to the nearest of 0, pi/8 and pi/4; what is left has a tangent of at
/// most .199, and the first term left out of its series is below 1e-18.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V atan2(D d, V y, V x) {
    constexpr double kSeries[] = {1,       -1. / 3,  1. / 5,  -1. / 7,  1. / 9,  -1. / 11,
                                  1. / 13, -1. / 15, 1. / 17, -1. / 19, 1. / 21, -1. / 23};
    constexpr double kPi = std::numbers::pi, kCos = 0.92387953251128674, kSin = 0.38268343236508977;
    const auto set = [&](double value) HWY_ATTR { return hn::Set(d, value); };
    const V ay = hn::Abs(y), ax = hn::Abs(x), larger = hn::Max(ax, ay), smaller = hn::Min(ax, ay);
    const auto past_first = hn::Gt(smaller, hn::Mul(larger, set(0.19891236737965801)));   // tan(pi/16)
    const auto past_second = hn::Gt(smaller, hn::Mul(larger, set(0.66817863791929892)));  // tan(3 pi/16)
    const auto of_three = [&](double a, double b, double c) HWY_ATTR {
        return hn::IfThenElse(past_second, set(c), hn::IfThenElse(past_first, set(b), set(a)));
    };
    const V cosine = of_three(1, kCos, std::numbers::sqrt2 / 2);
    const V sine = of_three(0, kSin, std::numbers::sqrt2 / 2);
    const V across = hn::Sub(hn::Mul(smaller, cosine), hn::Mul(larger, sine));
    const V along = hn::Add(hn::Mul(larger, cosine), hn::Mul(smaller, sine));
    const V t = hn::Div(across, hn::IfThenElse(hn::Gt(larger, hn::Zero(d)), along, set(1)));
    V angle = hn::Add(of_three(0, kPi / 8, kPi / 4), hn::Mul(t, polynomial(d, hn::Mul(t, t), kSeries)));
    angle = hn::IfThenElse(hn::Gt(ay, ax), hn::Sub(set(kPi / 2), angle), angle);
    angle = hn::IfThenElse(hn::Lt(x, hn::Zero(d)), hn::Sub(set(kPi), angle), angle);
    return hn::IfThenElse(hn::Lt(y, hn::Zero(d)), hn::Neg(angle), angle);
}

}  // namespace HWY_NAMESPACE
}  // namespace pbr
HWY_AFTER_NAMESPACE();

#endif
