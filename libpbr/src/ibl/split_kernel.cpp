#include "pbr/ibl/split_kernel.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "pbr/numerics/elementary.hpp"

namespace pbr {

SplitKernel::SplitKernel(const GgxZonalKernel& kernel, double radius) : kernel_(kernel), radius_(radius) {
    assert(radius > 0 && radius < std::numbers::pi / 2);
    const double sine = sin_cos_pi(radius / (2 * std::numbers::pi)).sin;
    limit_ = 2 * sine * sine;
    // Taylor of (1 - x) / f(x)^2, f = alpha^2 + b x: that of 1/f^2 is (n + 1) (-b/f)^n / f^2.
    const double alpha2 = kernel.alpha() * kernel.alpha(), b = (1 - alpha2) / 2, f = alpha2 + b * limit_;
    double before = 0, power = kernel.normalisation() / (f * f);
    for (std::size_t n = 0; n < polynomial_.size(); ++n) {
        const double term = static_cast<double>(n + 1) * power;
        polynomial_[n] = (1 - limit_) * term - before;
        before = term;
        power *= -b / f;
    }
}

double SplitKernel::far(double one_minus_mu) const {
    if (one_minus_mu >= limit_) return kernel_.value(one_minus_mu);
    const double t = one_minus_mu - limit_;
    return polynomial_[0] + t * (polynomial_[1] + t * (polynomial_[2] + t * polynomial_[3]));
}

double SplitKernel::radius_for(int bands, double max_error) {
    const double digits = std::clamp(-log2_exact(max_error) / log2_exact(10), 1.0, 6.0);
    return std::min(1.0, (5 * digits - 1) / bands);
}

}  // namespace pbr
