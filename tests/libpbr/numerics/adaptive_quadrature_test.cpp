#include "pbr/numerics/adaptive_quadrature.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace pbr {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(AdaptiveQuadrature, IntegratesPolynomialsOfDegree22InOnePanel) {
    for (int degree = 0; degree <= 22; ++degree) {
        const Estimate e = integrate_adaptive([&](double x) { return std::pow(x, degree); }, 0, 1, {1, 1});
        EXPECT_EQ(e.evaluations, kronrod::kPoints);
        EXPECT_NEAR(e.value, 1.0 / (degree + 1), 3e-16) << degree;
    }
    // The rule inside it is Gauss's: exact to degree 13, not to 14.
    for (const int degree : {13, 14}) {
        double gauss = 0;
        for (int i = 0; i < kronrod::kPoints; ++i)
            gauss += kronrod::kGaussWeights[i] / 2 * std::pow((1 + kronrod::kNodes[i]) / 2, degree);
        EXPECT_EQ(std::abs(gauss - 1.0 / (degree + 1)) < 1e-15, degree == 13);
    }
}

TEST(AdaptiveQuadrature, MeetsItsToleranceOnAnalyticIntegrals) {
    const struct {
        double (*f)(double);
        double low, high, exact;
    } cases[] = {
        {[](double x) { return std::sqrt(x); }, 0, 1, 2.0 / 3},
        {[](double x) { return std::log(x); }, 0, 1, -1},
        {[](double x) { return 1 / (1e-6 + x * x); }, -1, 1, 2e3 * std::atan(1e3)},
        {[](double x) { return std::cos(100 * x); }, 0, 1, std::sin(100.0) / 100},
        {[](double x) { return std::abs(x - 1 / kPi); }, 0, 1,
         (1 / kPi / kPi + (1 - 1 / kPi) * (1 - 1 / kPi)) / 2},
        {[](double x) { return x > 1 / kPi ? 1.0 : 0.0; }, 0, 1, 1 - 1 / kPi},
        {[](double) { return 0.0; }, 0, 1, 0},
    };
    for (const auto& c : cases)
        for (const double relative : {1e-4, 1e-8, 1e-11}) {
            const Estimate e = integrate_adaptive(c.f, c.low, c.high, {relative});
            EXPECT_TRUE(e.converged);
            EXPECT_LE(e.error, relative * std::abs(e.value));
            EXPECT_NEAR(e.value, c.exact, relative * std::abs(c.exact));
            EXPECT_EQ(e.evaluations % kronrod::kPoints, 0);
        }
}

TEST(AdaptiveQuadrature, BreakPointsShowPeaksThatNoNodeSees) {
    const auto spike = [](double x) { return std::exp(-std::pow((x - 0.3) / 1e-7, 2)); };
    const double exact = 1e-7 * std::sqrt(kPi);
    EXPECT_LT(integrate_adaptive(spike, 0, 1).value, exact / 2);  // missed, as the header says
    EXPECT_NEAR(integrate_adaptive(spike, std::array{0.0, 0.3 - 1e-6, 0.3 + 1e-6, 1.0}).value / exact, 1,
                1e-9);
}

TEST(AdaptiveQuadrature, SaysWhenItGaveUp) {
    const auto jump = [](double x) { return x > 0.123 ? 1.0 : 0.0; };
    const Estimate capped = integrate_adaptive(jump, 0, 1, {1e-12, 0, 100});
    EXPECT_FALSE(capped.converged);
    EXPECT_LE(capped.evaluations, 100 + 2 * kronrod::kPoints);
    EXPECT_GT(capped.error, 1e-12);
    // Beyond rounding there is nothing to gain: it stops by itself.
    const Estimate rounding = integrate_adaptive([](double x) { return std::exp(x); }, 0, 1, {1e-17});
    EXPECT_FALSE(rounding.converged);
    EXPECT_LT(rounding.evaluations, 1000);
    EXPECT_NEAR(rounding.value, std::numbers::e - 1, 1e-15);
}

TEST(AdaptiveQuadrature, RectanglesMeetTheirTolerance) {
    const std::array unit = {0.0, 1.0};
    const auto check = [&](const auto& f, double exact, double relative) {
        const Estimate e = integrate_adaptive_2d(f, unit, unit, {relative});
        EXPECT_TRUE(e.converged);
        EXPECT_NEAR(e.value, exact, relative * std::abs(exact));
    };
    check([](double x, double y) { return std::pow(x, 22) * std::pow(y, 21); }, 1.0 / 23 / 22, 1e-13);
    check([](double x, double y) { return std::exp(x * 3 - y); },
          (std::exp(3.0) - 1) / 3 * (1 - std::exp(-1.0)), 1e-12);
    const double arm = std::atan(1 / 1e-2);  // a ridge along x = y^0 = .5
    check([](double x, double) { return 1 / (1e-4 + (2 * x - 1) * (2 * x - 1)); }, arm / 1e-2, 1e-9);
    check([](double x, double y) { return x * x + y * y < 1 ? 1.0 : 0.0; }, kPi / 4, 1e-3);
    // An anisotropic one is cut along the axis that needs it.
    const Estimate e =
        integrate_adaptive_2d([](double x, double) { return std::cos(60 * x); }, unit, unit, {1e-10});
    EXPECT_NEAR(e.value, std::sin(60.0) / 60, 1e-12);
    EXPECT_LT(e.evaluations, 225 * 64);
}

TEST(AdaptiveQuadrature, RectanglesOfNoAreaAreSkipped) {
    const Estimate e = integrate_adaptive_2d([](double, double) { return 1.0; }, std::array{0.0, 0.0, 2.0},
                                             std::array{0.0, 1.0});
    EXPECT_EQ(e.evaluations, 225);
    EXPECT_NEAR(e.value, 2, 1e-14);
    EXPECT_EQ(integrate_adaptive([](double) { return 1.0; }, 1, 1).value, 0);
}

}  // namespace
}  // namespace pbr
