#include "pbr/light/luminous_efficacy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pbr/light/colour_temperature.hpp"

namespace pbr {
namespace {

TEST(LuminousEfficacy, TurnsWattsIntoLumensAndBack) {
    const LumensPerWatt<double> bulb(15);
    EXPECT_EQ(power_from_watts(Watts<double>(60), bulb).value(), 900);
    EXPECT_EQ(watts_from_power(Lumens<double>(900), bulb).value(), 60);
}

TEST(LuminousEfficacy, OfMonochromaticLightIsThatOfTheCandela) {
    // 540 THz is 555.17 nm in vacuum: a line 1 nm wide about it. Between two entries of the table V is short
    // by the chord's depth, 2e-5.
    EXPECT_NEAR(299'792'458 / 540e12 * 1e9, 555.17, 5e-3);
    const auto line = [](double centre_nm) {
        return power_of_spectrum([=](double l) { return std::max(0.0, 1 - std::abs(l - centre_nm)); });
    };
    EXPECT_NEAR(line(555).value(), 683, 1e-9);
    EXPECT_NEAR(line(555.17).value(), 683, 683 * 3e-5);
    EXPECT_NEAR(line(650).value(), 683 * .107, 1e-9);
    EXPECT_EQ(line(900).value(), 0);
}

TEST(LuminousEfficacy, OfEqualEnergyFollowsFromTheIntegralOfV) {
    // V's integral is 106.857 nm.
    EXPECT_NEAR(power_of_spectrum([](double) { return .01; }).value(), 683 * 1.06857, 1e-3);
}

TEST(LuminousEfficacy, OfBlackBodiesIsAsPublished) {
    EXPECT_NEAR(efficacy_of_black_body(2856).value(), 16.4, .05);
    EXPECT_NEAR(efficacy_of_black_body(5772).value(), 92.0, .05);
    EXPECT_NEAR(efficacy_of_black_body(6600).value(), 95.4, .05);
    EXPECT_GT(efficacy_of_black_body(6600).value(), efficacy_of_black_body(6500).value());
    EXPECT_GT(efficacy_of_black_body(6600).value(), efficacy_of_black_body(6700).value());
    EXPECT_EQ(efficacy_of_black_body(24).value(), 0);
    EXPECT_GT(efficacy_of_black_body(25).value(), 0);
    EXPECT_LT(efficacy_of_black_body(1e70).value(), 1e-180);
}

TEST(LuminousEfficacy, OfBlackBodiesDividesByAllOfTheirRadiation) {
    // Planck's law over all wavelengths, in ln(lambda): the sum of a bump is exact to many digits.
    const double kelvin = 3000;
    double radiance = 0, visible = 0;
    for (double x = -7.5; x < 12; x += 1e-3)
        radiance += planck_radiance(1e-6 * std::exp(x), kelvin) * 1e-6 * std::exp(x) * 1e-3;
    for (int i = 0; i < kCieSamples; ++i)
        visible += cie_1931_observer()[i].y * planck_radiance((kCieFirst_nm + i) * 1e-9, kelvin) * 1e-9;
    EXPECT_NEAR(efficacy_of_black_body(kelvin).value() / (683 * visible / radiance), 1,
                1e-4);  // 1e-4: beyond 55 um
}

}  // namespace
}  // namespace pbr
