#include "pbr/ibl/zonal_kernel.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "pbr/numerics/elementary.hpp"

namespace pbr {
namespace {

/// S(y) = (y/(1-y) + ln(1-y)) / y^2 = sum of y^n (n+1)/(n+2), given 1-y as well. The integral of m/(c - b
/// m)^2 over [0, mu] is mu^2 S(b mu / c) / c^2: well conditioned for every alpha, its end at 1 included.
double tail_series(double y, double one_minus_y) {
    if (y >= 0.1) return (y / one_minus_y + log_exact(one_minus_y)) / (y * y);
    double sum = 0;
    for (int n = 16; n >= 0; --n) sum = sum * y + (n + 1.0) / (n + 2.0);
    return sum;
}

}  // namespace

GgxZonalKernel::GgxZonalKernel(double alpha)
    : alpha_(alpha),
      alpha2_(alpha * alpha),
      b_((1 - alpha2_) / 2),
      c_((1 + alpha2_) / 2),
      tail_at_one_(tail_series(b_ / c_, alpha2_ / c_)),
      normalisation_(c_ * c_ / (2 * std::numbers::pi * tail_at_one_)) {
    assert(alpha > 0 && alpha <= 1);
}

double GgxZonalKernel::value(double one_minus_mu) const {
    if (one_minus_mu >= 1) return 0;
    const double f = alpha2_ + b_ * one_minus_mu;
    return normalisation_ * (1 - one_minus_mu) / (f * f);
}

double GgxZonalKernel::cdf(double one_minus_mu) const {
    const double mu = 1 - one_minus_mu;
    if (mu <= 0) return 1;
    const double f = alpha2_ + b_ * one_minus_mu;
    return 1 - mu * mu * tail_series(b_ * mu / c_, f / c_) / tail_at_one_;
}

double GgxZonalKernel::sample(double u) const {
    if (u <= 0) return 0;
    if (u >= 1) return 1;
    // Newton's method on the cdf, kept inside a shrinking bracket. It starts from the same lobe without its
    // cosine.
    double low = 0, high = 1;
    double x = std::min(0.5, alpha2_ * u / (1 - u));
    for (int iteration = 0; iteration < 200; ++iteration) {
        const double excess = cdf(x) - u;
        (excess > 0 ? high : low) = x;
        const double slope = 2 * std::numbers::pi * value(x);
        double next = slope > 0 ? x - excess / slope : low;
        if (!(next > low && next < high)) next = (low + high) / 2;
        if (std::abs(next - x) <= 1e-15 * next || next == x) return next;
        x = next;
    }
    return x;
}

}  // namespace pbr
