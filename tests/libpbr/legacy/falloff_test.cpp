#include "pbr/legacy/falloff.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace pbr {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kDegree = std::numbers::pi / 180;

Falloff ramp(double range, double exponent = 1) {
    Falloff law;
    law.window = FalloffWindow::ramp;
    law.range = range;
    law.exponent = exponent;
    return law;
}

TEST(Falloff, PolynomialIsOneOverTheSum) {
    const Falloff law{1, .7, 1.8};
    for (const double d : {0., .1, 1., 7., 1e3})
        EXPECT_NEAR(falloff_at(law, d) * (1 + .7 * d + 1.8 * d * d), 1, 1e-14);
}

TEST(Falloff, RampIsQuakes) {
    const Falloff law = ramp(300);
    EXPECT_EQ(falloff_at(law, 0), 1);
    EXPECT_NEAR(falloff_at(law, 150), .5, 1e-15);
    EXPECT_EQ(falloff_at(law, 300), 0);
    EXPECT_EQ(falloff_at(law, 1e6), 0);
    EXPECT_NEAR(falloff_at(ramp(300, 2.5), 100), std::pow(2. / 3, 2.5), 1e-14);
}

TEST(Falloff, WindowsAreOneAtTheLightAndNoneAtTheRange) {
    for (const FalloffWindow window :
         {FalloffWindow::ramp, FalloffWindow::smoothstep, FalloffWindow::smootherstep, FalloffWindow::quartic,
          FalloffWindow::quartic_squared}) {
        Falloff law = ramp(10);
        law.window = window;
        EXPECT_NEAR(falloff_at(law, 0), 1, 1e-15);
        EXPECT_LT(falloff_at(law, 10 - 1e-9), 1e-8);
        EXPECT_EQ(falloff_at(law, 10), 0);
        for (double d = 0, last = 1; d < 10; d += .25) {
            EXPECT_LE(falloff_at(law, d), last);
            last = falloff_at(law, d);
        }
    }
}

TEST(Falloff, RangeOfZeroIsDarkAndOfFloatMaxIsNone) {
    for (const FalloffWindow window : {FalloffWindow::cut, FalloffWindow::ramp, FalloffWindow::quartic}) {
        Falloff law{0, 0, 1};
        law.window = window;
        law.range = 0;
        EXPECT_EQ(falloff_at(law, 0), 0);
        EXPECT_EQ(falloff_at(law, 1), 0);
        EXPECT_EQ(falloff_reach(law, .01), 0);
        law.range = std::numeric_limits<float>::max();
        EXPECT_FALSE(has_range(law));
        EXPECT_EQ(falloff_at(law, 2), .25);
    }
}

TEST(Falloff, AllAttenuationsZeroCountAsConstant) {
    const Falloff law{0, 0, 0};
    EXPECT_EQ(falloff_at(law, 0), 1);
    EXPECT_EQ(falloff_at(law, 1e9), 1);
    EXPECT_TRUE(is_constant_fill(law));
    EXPECT_FALSE(is_constant_fill(ramp(300)));
    EXPECT_EQ(falloff_reach(law, .5), kInfinity);
}

TEST(Falloff, PoleIsInfiniteAndPowerHasItsFloor) {
    EXPECT_EQ(falloff_at(Falloff{0, 1, 0}, 0), kInfinity);
    Falloff decay;  // three.js: 1 / max(d^decay, .01)
    decay.power = 1.5, decay.floor = .01;
    EXPECT_EQ(falloff_at(decay, 0), 100);
    EXPECT_NEAR(falloff_at(decay, 4), 1. / 8, 1e-15);
}

TEST(Falloff, FloorEndsTheGrowthOfASum) {
    Falloff law{0, 0, .25};
    law.floor = 1;
    EXPECT_EQ(falloff_at(law, 0), 1);
    EXPECT_EQ(falloff_at(law, 2), 1);
    EXPECT_NEAR(falloff_at(law, 4), .25, 1e-15);
}

TEST(Falloff, ReachIsWhereTheShareIsLeft) {
    EXPECT_NEAR(falloff_reach(Falloff{1, 0, .01}, 1. / 256), std::sqrt(25500.), 1e-9);
    EXPECT_NEAR(falloff_reach(ramp(300), 1e-9), 300, 1e-6);
    EXPECT_EQ(falloff_reach(Falloff{4, 0, 1}, .5), 0);
}

TEST(SpotFalloff, CosinePowerIsOpenGls) {
    const SpotFalloff law{SpotLaw::cosine_power, 0, 45 * kDegree, 8};
    EXPECT_EQ(spot_falloff_at(law, 1), 1);
    EXPECT_NEAR(spot_falloff_at(law, std::cos(.5)), std::pow(std::cos(.5), 8), 1e-14);
    EXPECT_EQ(spot_falloff_at(law, std::cos(46 * kDegree)), 0);
}

TEST(SpotFalloff, AxisPowerWeighsAnyLaw) {
    for (const SpotLaw kind :
         {SpotLaw::hard, SpotLaw::cosine_power, SpotLaw::cosine_ramp, SpotLaw::smoothstep}) {
        SpotFalloff law{kind, .2, 2, 1.5};
        const double plain = spot_falloff_at(law, .6);
        law.axis_power = 1;
        EXPECT_NEAR(spot_falloff_at(law, .6), .6 * plain, 1e-15);
        EXPECT_EQ(spot_falloff_at(law, -.2), 0);
    }
}

TEST(SpotFalloff, SmoothstepHasAnExponent) {
    const SpotFalloff law{SpotLaw::smoothstep, 30 * kDegree, 60 * kDegree, 3};
    const double t = (.7 - .5) / (std::cos(30 * kDegree) - .5), s = t * t * (3 - 2 * t);
    EXPECT_NEAR(spot_falloff_at(law, .7), s * s * s, 1e-14);
}

TEST(SpotFalloff, ConesOfZeroAndOfAllDirectionsAreDefined) {
    const SpotFalloff closed{SpotLaw::cosine_ramp, 0, 0, 2};
    EXPECT_EQ(spot_falloff_at(closed, 1), 1);
    EXPECT_EQ(spot_falloff_at(closed, .999), 0);
    const SpotFalloff open{SpotLaw::hard, 0, std::numbers::pi, 1};
    for (const double cosine : {-1., -.5, 0., 1.}) EXPECT_EQ(spot_falloff_at(open, cosine), 1);
    const SpotFalloff behind{SpotLaw::cosine_power, 0, std::numbers::pi, 2};
    EXPECT_EQ(spot_falloff_at(behind, -.5), 0);
}

TEST(PowerExact, AgreesWithTheCLibrary) {
    for (const double x : {1e-3, .2, .999, 1.7, 40., 1e3})
        for (const double p : {0., .15, 1., 2., 2.2, 7.5, 64.})
            EXPECT_NEAR(power_exact(x, p) / std::pow(x, p), 1, 2e-13) << x << "^" << p;
    EXPECT_EQ(power_exact(0, 0), 1);
    EXPECT_EQ(power_exact(0, 3), 0);
    EXPECT_EQ(power_exact(0, .5), 0);
}

}  // namespace
}  // namespace pbr
