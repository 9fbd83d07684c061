#include "pbr/numerics/elementary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "pbr/numerics/sequence.hpp"

namespace pbr {
namespace {

constexpr int kPoints = 200'000;

/// The C library in long double is the second witness.
TEST(Elementary, SinCosPiAgreesWithLongDouble) {
    long double worst = 0;
    for (int i = 0; i < kPoints; ++i) {
        const double x = (random_unit(1, i) - 0.5) * std::ldexp(1.0, i % 12);
        const long double reduced =
            std::remainder(static_cast<long double>(x), 2.0L) * std::numbers::pi_v<long double>;
        const SinCos value = sin_cos_pi(x);
        worst = std::max(
            {worst, std::abs(value.sin - std::sin(reduced)), std::abs(value.cos - std::cos(reduced))});
    }
    EXPECT_LE(worst, 2.3e-16L);
}

TEST(Elementary, SinCosPiIsExactAtQuarterTurns) {
    for (int k = -9; k <= 9; ++k) {
        const SinCos value = sin_cos_pi(k / 2.0);
        EXPECT_EQ(value.sin * value.cos, 0) << k;
        EXPECT_EQ(std::abs(value.sin) + std::abs(value.cos), 1) << k;
    }
    EXPECT_EQ(sin_cos_pi(0.5).sin, 1);
    EXPECT_EQ(sin_cos_pi(-0.5).sin, -1);
    EXPECT_EQ(sin_cos_pi(1).cos, -1);
}

TEST(Elementary, LogAndExpAgreeWithLongDouble) {
    long double worst_log = 0, worst_exp = 0;
    for (int i = 0; i < kPoints; ++i) {
        const double x = std::ldexp(1 + random_unit(2, i), i % 600 - 300);
        const long double log = std::log(static_cast<long double>(x));
        worst_log = std::max(worst_log, std::abs(log_exact(x) - log) / std::max(std::abs(log), 1e-8L));
        const double y = (random_unit(3, i) - 0.5) * 1400;
        const long double exp = std::exp(static_cast<long double>(y));
        worst_exp = std::max(worst_exp, std::abs(exp_exact(y) - exp) / exp);
    }
    EXPECT_LE(worst_log, 4e-16L);
    EXPECT_LE(worst_exp, 4e-16L);
}

TEST(Elementary, LogDefinesItsEdges) {
    EXPECT_EQ(log_exact(1), 0);
    EXPECT_EQ(log2_exact(1), 0);
    EXPECT_TRUE(std::isnan(log_exact(0)));
    EXPECT_TRUE(std::isnan(log_exact(-1)));
    EXPECT_TRUE(std::isinf(log_exact(std::numeric_limits<double>::infinity())));
}

TEST(Elementary, CbrtAgreesWithLongDouble) {
    long double worst = 0;
    for (int i = 0; i < kPoints; ++i) {
        const double x = std::ldexp(1 + random_unit(6, i), i % 1980 - 990);
        const long double root = std::cbrt(static_cast<long double>(x));
        worst = std::max(worst, std::abs(cbrt_exact(x) - root) / root);
    }
    EXPECT_LE(worst, 4e-16L);
    for (const double root : {0., 1., 2., 3., 10., 1e-100, 1e100})
        EXPECT_NEAR(cbrt_exact(root * root * root), root, 4e-16 * root);
}

TEST(Elementary, Atan2AgreesWithLongDouble) {
    long double worst = 0;
    for (int i = 0; i < kPoints; ++i) {
        const double y = random_unit(4, i) - 0.5,
                     x = (random_unit(5, i) - 0.5) * std::ldexp(1.0, i % 40 - 20);
        worst = std::max(worst, std::abs(atan2_exact(y, x) - std::atan2(static_cast<long double>(y), x)));
    }
    EXPECT_LE(worst, 7e-16L);
    EXPECT_EQ(atan2_exact(0, 0), 0);
    EXPECT_EQ(atan2_exact(0, -1), std::numbers::pi);
    EXPECT_EQ(atan2_exact(-0.0, -1), std::numbers::pi);
}

}  // namespace
}  // namespace pbr
