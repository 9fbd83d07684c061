#include "pbr/numerics/legendre.hpp"

#include <gtest/gtest.h>

#include <boost/math/special_functions/legendre.hpp>
#include <vector>

namespace pbr {
namespace {

TEST(LegendrePolynomials, AreThoseOfAnIndependentEvaluation) {
    std::vector<double> p(512);
    std::vector<float> single(64);
    for (int i = 0; i <= 40; ++i) {
        const double x = -1 + i / 20.0;
        legendre_polynomials<double>(x, p);
        legendre_polynomials<float>(static_cast<float>(x), single);
        for (const int l : {0, 1, 2, 3, 10, 63, 200, 511}) {
            // Long double, so that the other side's rounding does not count.
            const auto exact = static_cast<double>(boost::math::legendre_p(l, static_cast<long double>(x)));
            EXPECT_NEAR(p[l], exact, 4e-14) << l << " " << x;
        }
        const double rounded = static_cast<float>(x);
        for (int l = 0; l < 64; ++l)
            EXPECT_NEAR(single[l], boost::math::legendre_p(l, rounded), 1e-5) << l << " " << x;
    }
}

TEST(LegendrePolynomials, AreOneAtOneAndAlternateAtMinusOne) {
    std::vector<double> p(300);
    legendre_polynomials<double>(1, p);
    for (const double value : p) EXPECT_EQ(value, 1);
    legendre_polynomials<double>(-1, p);
    for (int l = 0; l < 300; ++l) EXPECT_EQ(p[l], l % 2 == 0 ? 1 : -1);
    double one[1] = {0};
    legendre_polynomials<double>(0.3, one);
    EXPECT_EQ(one[0], 1);
}

}  // namespace
}  // namespace pbr
