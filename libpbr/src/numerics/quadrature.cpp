#include "pbr/numerics/quadrature.hpp"

#include <cassert>
#include <cmath>

#include "pbr/numerics/elementary.hpp"

namespace pbr {
namespace {

struct LegendreValue {
    double p;   ///< P_n(x)
    double dp;  ///< P_n'(x)
};

LegendreValue legendre(int n, double x) {
    double previous = 1, current = x;
    for (int k = 2; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * current - (k - 1) * previous) / k;
        previous = current;
        current = next;
    }
    return {current, n * (x * current - previous) / (x * x - 1)};
}

}  // namespace

QuadratureRule gauss_legendre(int n) {
    assert(n >= 1);
    QuadratureRule rule{std::vector<double>(n), std::vector<double>(n)};
    if (n == 1) return {{0.5}, {1.0}};
    for (int i = 0; i < (n + 1) / 2; ++i) {
        double x =
            sin_cos_pi((i + 0.75) / (n + 0.5)).cos;  // Tricomi's first approximation of the i-th largest root
        LegendreValue value = legendre(n, x);
        for (int iteration = 0; iteration < 8; ++iteration) {
            const double step = value.p / value.dp;
            x -= step;
            value = legendre(n, x);
            if (std::abs(step) < 1e-16) break;
        }
        const double weight = 1 / ((1 - x * x) * value.dp * value.dp);
        rule.nodes[i] = (1 - x) / 2;
        rule.nodes[n - 1 - i] = (1 + x) / 2;
        rule.weights[i] = rule.weights[n - 1 - i] = weight;
    }
    return rule;
}

}  // namespace pbr
