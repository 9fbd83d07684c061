// Mixed-radix Stockham passes. Lanes hold independent signals, so any vector width gives the same bits.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/simd/fourier_kernel.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <cassert>
#include <vector>

#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/fourier.hpp"

HWY_BEFORE_NAMESPACE();
namespace pbr {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, kFourierLanes>;
using V = hn::Vec<D>;

struct Complex {
    V re, im;
};

HWY_INLINE Complex load(const double* element, int lane) {
    return {hn::LoadU(D(), element + lane), hn::LoadU(D(), element + kFourierLanes + lane)};
}
HWY_INLINE void store(const Complex& z, double* element, int lane) {
    hn::StoreU(z.re, D(), element + lane);
    hn::StoreU(z.im, D(), element + kFourierLanes + lane);
}
HWY_INLINE Complex add(const Complex& a, const Complex& b) {
    return {hn::Add(a.re, b.re), hn::Add(a.im, b.im)};
}
HWY_INLINE Complex sub(const Complex& a, const Complex& b) {
    return {hn::Sub(a.re, b.re), hn::Sub(a.im, b.im)};
}
HWY_INLINE Complex mul(const Complex& a, const double* w) {
    const V re = hn::Set(D(), w[0]), im = hn::Set(D(), w[1]);
    return {hn::Sub(hn::Mul(a.re, re), hn::Mul(a.im, im)), hn::Add(hn::Mul(a.re, im), hn::Mul(a.im, re))};
}

HWY_INLINE Complex scaled(const Complex& a, double by) {
    const V factor = hn::Set(D(), by);
    return {hn::Mul(a.re, factor), hn::Mul(a.im, factor)};
}
/// -i a
HWY_INLINE Complex turned(const Complex& a) { return {a.im, hn::Neg(a.re)}; }

/// One pass: sub-transforms of length n at stride s become those of length n / radix.
struct Pass {
    const double* twiddles;  ///< of the whole size
    int size, radix, n, s;
    const double* from;
    double* to;

    static constexpr int kElement = 2 * kFourierLanes;
    /// `index` in 0 … size - 1.
    const double* twiddle(long index) const { return twiddles + 2 * index; }
    const double* source(int p, int j, int q) const {
        return from + (q + static_cast<long>(s) * (p + n / radix * j)) * kElement;
    }
    double* target(int p, int k, int q) const {
        return to + (q + static_cast<long>(s) * (radix * p + k)) * kElement;
    }
};

void pass_2(const Pass& pass) {
    const int lanes = static_cast<int>(hn::Lanes(D()));
    for (int p = 0; p < pass.n / 2; ++p)
        for (int q = 0; q < pass.s; ++q)
            for (int lane = 0; lane < kFourierLanes; lane += lanes) {
                const Complex a = load(pass.source(p, 0, q), lane), b = load(pass.source(p, 1, q), lane);
                store(add(a, b), pass.target(p, 0, q), lane);
                store(mul(sub(a, b), pass.twiddle(static_cast<long>(p) * pass.s)), pass.target(p, 1, q),
                      lane);
            }
}

void pass_4(const Pass& pass) {
    const int lanes = static_cast<int>(hn::Lanes(D()));
    for (int p = 0; p < pass.n / 4; ++p) {
        const long turn = static_cast<long>(p) * pass.s;
        const double *w1 = pass.twiddle(turn), *w2 = pass.twiddle(2 * turn), *w3 = pass.twiddle(3 * turn);
        for (int q = 0; q < pass.s; ++q)
            for (int lane = 0; lane < kFourierLanes; lane += lanes) {
                const Complex a0 = load(pass.source(p, 0, q), lane), a1 = load(pass.source(p, 1, q), lane);
                const Complex a2 = load(pass.source(p, 2, q), lane), a3 = load(pass.source(p, 3, q), lane);
                const Complex even = add(a0, a2), even_difference = sub(a0, a2);
                const Complex odd = add(a1, a3), odd_difference = turned(sub(a1, a3));
                store(add(even, odd), pass.target(p, 0, q), lane);
                store(mul(add(even_difference, odd_difference), w1), pass.target(p, 1, q), lane);
                store(mul(sub(even, odd), w2), pass.target(p, 2, q), lane);
                store(mul(sub(even_difference, odd_difference), w3), pass.target(p, 3, q), lane);
            }
    }
}

void pass_3(const Pass& pass) {
    constexpr double kSine = 0.86602540378443864676;  // of a third of a turn; its cosine is -1/2
    const int lanes = static_cast<int>(hn::Lanes(D()));
    for (int p = 0; p < pass.n / 3; ++p) {
        const long turn = static_cast<long>(p) * pass.s;
        const double *w1 = pass.twiddle(turn), *w2 = pass.twiddle(2 * turn);
        for (int q = 0; q < pass.s; ++q)
            for (int lane = 0; lane < kFourierLanes; lane += lanes) {
                const Complex a0 = load(pass.source(p, 0, q), lane), a1 = load(pass.source(p, 1, q), lane);
                const Complex a2 = load(pass.source(p, 2, q), lane), sum = add(a1, a2);
                const Complex even = sub(a0, scaled(sum, 0.5)), odd = turned(scaled(sub(a1, a2), kSine));
                store(add(a0, sum), pass.target(p, 0, q), lane);
                store(mul(add(even, odd), w1), pass.target(p, 1, q), lane);
                store(mul(sub(even, odd), w2), pass.target(p, 2, q), lane);
            }
    }
}

void pass_5(const Pass& pass) {
    constexpr double kCosine1 = 0.30901699437494742410, kCosine2 = -0.80901699437494742410;
    constexpr double kSine1 = 0.95105651629515357212, kSine2 = 0.58778525229247312917;
    const int lanes = static_cast<int>(hn::Lanes(D()));
    for (int p = 0; p < pass.n / 5; ++p) {
        const long turn = static_cast<long>(p) * pass.s;
        for (int q = 0; q < pass.s; ++q)
            for (int lane = 0; lane < kFourierLanes; lane += lanes) {
                const auto from = [&](int j) HWY_ATTR { return load(pass.source(p, j, q), lane); };
                const auto to = [&](int k, const Complex& z) HWY_ATTR {
                    store(mul(z, pass.twiddle(k * turn)), pass.target(p, k, q), lane);
                };
                const Complex a0 = from(0), a1 = from(1), a2 = from(2), a3 = from(3), a4 = from(4);
                const Complex sum1 = add(a1, a4), sum2 = add(a2, a3), d1 = sub(a1, a4), d2 = sub(a2, a3);
                const Complex even1 = add(a0, add(scaled(sum1, kCosine1), scaled(sum2, kCosine2)));
                const Complex even2 = add(a0, add(scaled(sum1, kCosine2), scaled(sum2, kCosine1)));
                const Complex odd1 = turned(add(scaled(d1, kSine1), scaled(d2, kSine2)));
                const Complex odd2 = turned(sub(scaled(d1, kSine2), scaled(d2, kSine1)));
                store(add(a0, add(sum1, sum2)), pass.target(p, 0, q), lane);
                to(1, add(even1, odd1));
                to(2, add(even2, odd2));
                to(3, sub(even2, odd2));
                to(4, sub(even1, odd1));
            }
    }
}

void pass_any(const Pass& pass) {
    const int lanes = static_cast<int>(hn::Lanes(D()));
    const long root = pass.size / pass.radix;
    for (int p = 0; p < pass.n / pass.radix; ++p)
        for (int q = 0; q < pass.s; ++q)
            for (int lane = 0; lane < kFourierLanes; lane += lanes)
                for (int k = 0; k < pass.radix; ++k) {
                    Complex sum = load(pass.source(p, 0, q), lane);
                    for (int j = 1; j < pass.radix; ++j)
                        sum = add(sum, mul(load(pass.source(p, j, q), lane),
                                           pass.twiddle(root * (static_cast<long>(j) * k % pass.radix))));
                    store(mul(sum, pass.twiddle(static_cast<long>(p) * k * pass.s)), pass.target(p, k, q),
                          lane);
                }
}

/// All passes, to and fro between `data` and `work`; the result is in `work` after an odd number of them.
void fourier_passes(const double* twiddles, int size, const std::vector<int>& radices, double* data,
                    double* work) {
    Pass pass{twiddles, size, 0, size, 1, data, work};
    for (const int radix : radices) {
        pass.radix = radix;
        if (radix == 4)
            pass_4(pass);
        else if (radix == 2)
            pass_2(pass);
        else if (radix == 3)
            pass_3(pass);
        else if (radix == 5)
            pass_5(pass);
        else
            pass_any(pass);
        pass.n /= radix;
        pass.s *= radix;
        pass.from = pass.to;
        pass.to = pass.from == work ? data : work;
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace pbr
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pbr {
namespace {

HWY_EXPORT(fourier_passes);

}  // namespace

FourierPlan::FourierPlan(int size) : size_(size) {
    assert(size >= 1);
    int rest = size;
    for (const int radix : {4, 2, 3, 5})
        for (; rest % radix == 0; rest /= radix) radices_.push_back(radix);
    for (int radix = 7; rest > 1; radix += 2)
        for (; rest % radix == 0; rest /= radix) radices_.push_back(radix);
    for (int k = 0; k < size; ++k) {
        const SinCos angle = sin_cos_pi(-2.0 * k / size);
        twiddles_.insert(twiddles_.end(), {angle.cos, angle.sin});
    }
}

void FourierPlan::transform(double* data, double* work) const {
    HWY_DYNAMIC_DISPATCH(fourier_passes)(twiddles_.data(), size_, radices_, data, work);
    if (radices_.size() % 2 == 1) std::copy_n(work, batch_doubles(), data);
}

int fast_fourier_size(int at_least) {
    for (int n = at_least;; ++n) {
        int rest = n;
        for (const int radix : {2, 3, 5})
            while (rest % radix == 0) rest /= radix;
        if (rest == 1) return n;
    }
}

}  // namespace pbr
#endif
