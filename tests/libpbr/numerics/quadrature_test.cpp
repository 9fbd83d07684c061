#include "pbr/numerics/quadrature.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "pbr/numerics/sum.hpp"

namespace pbr {
namespace {

TEST(GaussLegendre, IntegratesPolynomialsOfDegree2NMinus1) {
    for (const int n : {1, 2, 3, 5, 8, 16, 33, 64}) {
        const QuadratureRule rule = gauss_legendre(n);
        for (int degree = 0; degree < 2 * n; ++degree) {
            CompensatedSum sum;
            for (int i = 0; i < n; ++i) sum += rule.weights[i] * std::pow(rule.nodes[i], degree);
            EXPECT_NEAR(sum.value(), 1.0 / (degree + 1), 4e-15) << n << " points, degree " << degree;
        }
    }
}

TEST(GaussLegendre, HasAscendingNodesAndPositiveWeights) {
    const QuadratureRule rule = gauss_legendre(512);
    CompensatedSum total;
    for (int i = 0; i < rule.size(); ++i) {
        EXPECT_GT(rule.nodes[i], i > 0 ? rule.nodes[i - 1] : 0.0);
        EXPECT_LT(rule.nodes[i], 1);
        EXPECT_GT(rule.weights[i], 0);
        total += rule.weights[i];
    }
    EXPECT_NEAR(total.value(), 1, 2e-13);
}

TEST(CompensatedSum, KeepsWhatPlainSummationLoses) {
    CompensatedSum sum;
    double plain = 0;
    for (const double term : {1e16, 1.0, 1.0, -1e16}) {
        sum += term;
        plain += term;
    }
    EXPECT_EQ(sum.value(), 2);
    EXPECT_NE(plain, 2);
}

}  // namespace
}  // namespace pbr
