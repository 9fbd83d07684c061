#include "bakers/verify/pareto.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pbrbake::verify {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Points of error = coefficient * (time - fixed)^-exponent, time - fixed growing by 4.
std::vector<Cost> law(double coefficient, double exponent, double fixed, int count) {
    std::vector<Cost> points;
    double variable = .05;
    for (int i = 0; i < count; ++i, variable *= 4)
        points.push_back({fixed + variable, coefficient * std::pow(variable, -exponent)});
    return points;
}

TEST(ParetoFront, KeepsWhatNoPointBeats) {
    const std::vector<Cost> points{{1, 1}, {2, .5}, {2, .6}, {3, .5}, {4, .1}, {.5, 2}, {5, .2}};
    EXPECT_THAT(pareto_front(points), ElementsAre(5, 0, 1, 4));
}

TEST(ParetoFront, TakesTheFirstOfEqualPointsAndNoNumbersThatAreNone) {
    const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
    const std::vector<Cost> points{{1, 1}, {1, 1}, {inf, 0}, {.1, nan}, {2, 0}};
    EXPECT_THAT(pareto_front(points), ElementsAre(0, 4));
    EXPECT_THAT(pareto_front({}), IsEmpty());
}

TEST(PowerLaw, IsFoundAgainInItsOwnPoints) {
    for (const double exponent : {.25, .5, 1., 4.}) {
        const auto found = fit_power_law(law(.3, exponent, 0, 6));
        ASSERT_TRUE(found);
        EXPECT_NEAR(found->exponent, exponent, 1e-12);
        EXPECT_NEAR(found->coefficient, .3, 1e-12);
        EXPECT_EQ(found->fixed, 0);
        EXPECT_LT(found->scatter, 1e-12);
        EXPECT_NEAR(found->price_of_digit(), std::pow(10, 1 / exponent), 1e-9 * std::pow(10, 1 / exponent));
        EXPECT_NEAR(found->time_for(found->error_at(7)), 7, 1e-9);
    }
}

TEST(PowerLaw, SetsApartWhatIsPaidWhateverTheSetting) {
    // The cheapest time is .8; 3/4 of it is one of the candidates.
    std::vector<Cost> points = law(1, .5, .15, 6);
    const auto found = fit_power_law(points);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->exponent, .5, 1e-9);
    EXPECT_NEAR(found->fixed, .15, 1e-12);
    // Without a candidate at the truth the nearest one is off by less than a 64th of the cheapest time.
    points = law(1, .5, .147, 6);
    EXPECT_NEAR(fit_power_law(points)->fixed, .147, .197 / 64);
    EXPECT_NEAR(fit_power_law(points)->exponent, .5, .01);
}

TEST(PowerLaw, StandsTenPerCentOfNoise) {
    std::vector<Cost> points = law(1, .5, 0, 8);
    for (std::size_t i = 0; i < points.size(); ++i) points[i].error *= i % 2 ? 1.1 : 1 / 1.1;
    EXPECT_NEAR(fit_power_law(points)->exponent, .5, .05);
    EXPECT_NEAR(fit_power_law(points)->scatter, std::log10(1.1), .02);
}

TEST(PowerLaw, LeavesOutWhatIsBelowTheFloor) {
    std::vector<Cost> points = law(1, 1, 0, 6);
    for (Cost& point : points) point.error = std::max(point.error, .01);  // the last ones no longer fall
    EXPECT_NEAR(fit_power_law(points, .01)->exponent, 1, 1e-9);
}

TEST(PowerLaw, IsNotClaimedOfTooLittle) {
    EXPECT_FALSE(fit_power_law(law(1, .5, 0, 2)));
    EXPECT_FALSE(fit_power_law(std::vector<Cost>{{1, .5}, {2, .5}, {4, .5}}));      // does not fall
    EXPECT_FALSE(fit_power_law(std::vector<Cost>{{1, .5}, {1.2, .3}, {1.9, .1}}));  // too short a span
    EXPECT_FALSE(fit_power_law(std::vector<Cost>{{1, 0}, {2, 0}, {4, 0}}));         // nothing to fit
}

TEST(Digits, AreTheCheapestPointAtOrBelowEach) {
    const std::vector<Cost> points{{1, .3}, {2, .05}, {3, .009}, {9, .0011}, {4, .02}};
    const auto digits = digits_reached(points);
    ASSERT_EQ(digits.size(), 3u);
    EXPECT_DOUBLE_EQ(digits[0].error, 1);
    EXPECT_EQ(digits[0].point, 0u);
    EXPECT_DOUBLE_EQ(digits[1].error, .1);
    EXPECT_EQ(digits[1].point, 1u);
    EXPECT_DOUBLE_EQ(digits[2].error, .01);
    EXPECT_EQ(digits[2].point, 2u);
    EXPECT_THAT(digits_reached(std::vector<Cost>{{1, 0}}), IsEmpty());
}

TEST(Digits, CountAPowerOfTenAsReached) {
    const std::vector<Cost> points{{1, .1}, {2, .001}};
    ASSERT_EQ(digits_reached(points).size(), 3u);
    EXPECT_EQ(digits_reached(points)[1].point, 1u);  // 1e-2 is first met by 1e-3
}

TEST(Knee, IsWhereErrorStopsFalling) {
    // Two straight pieces in log-log: steep to (10, 1e-3), flat from there.
    const std::vector<Cost> front{{1, 1}, {3, .033}, {10, .001}, {100, .0008}, {1000, .0006}};
    EXPECT_EQ(knee(front), 2u);
}

TEST(Knee, IsNoneOnAStraightLineOrOfTwoPoints) {
    EXPECT_FALSE(knee(std::vector<Cost>{{1, 1}, {10, .001}}));
    EXPECT_FALSE(knee(std::vector<Cost>{{1, 1}, {2, .9}, {100, .01}}));  // above the line throughout
}

}  // namespace
}  // namespace pbrbake::verify
