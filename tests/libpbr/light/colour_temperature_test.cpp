#include "pbr/light/colour_temperature.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "pbr/light/cie_1931.hpp"
#include "tests/libpbr/support/property.hpp"

namespace pbr {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

double distance(const Chromaticity& a, const Chromaticity& b) {
    return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y));
}

TEST(PlanckRadiance, IsThatOfLongDoubleArithmetic) {
    constexpr long double h = 6.62607015e-34L, c = 299792458.0L, k = 1.380649e-23L;
    for (const double nm : {100.0, 360.0, 555.0, 830.0, 1e5})
        for (const double kelvin : {300.0, 2856.0, 6500.0, 1e6, 1e12}) {
            const long double l = nm * 1e-9, x = h * c / (l * k * kelvin);
            if (x > 700) continue;
            const long double exact = 2 * h * c * c / (l * l * l * l * l) / std::expm1(x);
            EXPECT_NEAR(static_cast<double>(planck_radiance(nm * 1e-9, kelvin) / exact), 1,
                        static_cast<double>(2 + x) * 0x1p-52 + 4e-16)
                << nm << " " << kelvin;
        }
}

TEST(PlanckRadiance, IsDefinedAtBothEnds) {
    EXPECT_EQ(planck_radiance(500e-9, 0), 0);
    EXPECT_EQ(planck_radiance(500e-9, 1), 0);
    // Rayleigh-Jeans: 2 c k T / lambda^4.
    const double l = 1e-3, T = 1e9, limit = 2 * 299792458.0 * 1.380649e-23 * T / (l * l * l * l);
    EXPECT_NEAR(planck_radiance(l, T) / limit, 1, 1e-7);
    EXPECT_TRUE(std::isfinite(planck_radiance(360e-9, 1e200)));
}

TEST(PlanckRadiance, PeaksWhereWienSays) {
    const double T = 5772, peak = 2.897771955e-3 / T;
    EXPECT_GT(planck_radiance(peak, T), planck_radiance(peak * (1 + 1e-4), T));
    EXPECT_GT(planck_radiance(peak, T), planck_radiance(peak * (1 - 1e-4), T));
}

TEST(PlanckianLocus, HasTheKnownChromaticities) {
    const struct {
        double kelvin, x, y;
    } known[] = {{2000, .52668, .41330},
                 {2856, .44754, .40743},
                 {4000, .38044, .37675},
                 {6500, .31353, .32363},
                 {10000, .28063, .28829}};
    for (const auto& [kelvin, x, y] : known) {
        EXPECT_NEAR(planckian_chromaticity(kelvin).x, x, 5.5e-6) << kelvin;
        EXPECT_NEAR(planckian_chromaticity(kelvin).y, y, 5.5e-6) << kelvin;
    }
}

TEST(PlanckianLocus, HoldsIlluminantA) {
    // CIE 15 defines it with c2 = 1.435e-2 m K at 2848 K and prints (.44757, .40745), reckoned at 5 nm.
    const double kelvin = 2848 * 1.438776877503934e-2 / 1.435e-2;
    EXPECT_NEAR(planckian_chromaticity(kelvin).x, .44757, 1.1e-5);
    EXPECT_NEAR(planckian_chromaticity(kelvin).y, .40745, 1.1e-5);
}

TEST(PlanckianLocus, IsTheSumOverPlancksLaw) {
    for (const double kelvin : {800.0, 2856.0, 40'000.0, 1e6}) {
        const glm::dvec3 sum = tristimulus([=](double l) { return planck_radiance(l * 1e-9, kelvin); });
        EXPECT_LT(distance(planckian_chromaticity(kelvin), chromaticity_of(sum)), 1e-14) << kelvin;
    }
}

TEST(PlanckianLocus, IsDefinedFromColdestToHottest) {
    const glm::dvec3 last = cie_1931_observer().back();
    for (const double kelvin : {1e-300, 1e-3, 1.0})
        EXPECT_LT(distance(planckian_chromaticity(kelvin), chromaticity_of(last)), 1e-6) << kelvin;
    EXPECT_NEAR(planckian_chromaticity(kInf).x, .2399, 5e-5);
    EXPECT_NEAR(planckian_chromaticity(kInf).y, .2340, 5e-5);
    const glm::dvec3 rayleigh_jeans = tristimulus([](double l) { return std::pow(l, -4); });
    EXPECT_LT(distance(planckian_chromaticity(kInf), chromaticity_of(rayleigh_jeans)), 1e-15);
    EXPECT_LT(distance(planckian_chromaticity(kInf), planckian_chromaticity(1e300)), 1e-12);
}

TEST(Daylight, IsD65AtItsTemperature) {
    const Chromaticity d65 = daylight_chromaticity(daylight_temperature(6500));
    EXPECT_NEAR(d65.x, .3127, 5e-5);
    EXPECT_NEAR(d65.y, .3290, 1.3e-4);
    const Chromaticity d50 = daylight_chromaticity(daylight_temperature(5000));
    EXPECT_NEAR(d50.x, .3457, 1e-4);
    EXPECT_NEAR(d50.y, .3585, 2e-4);
}

TEST(Daylight, IsGreenerThanABlackBodyAndClamped) {
    for (double kelvin = 4000; kelvin <= 25'000; kelvin += 500) {
        const CorrelatedTemperature t = correlated_temperature(daylight_chromaticity(kelvin));
        EXPECT_NEAR(t.temperature_k / kelvin, 1, .005) << kelvin;
        EXPECT_GT(t.duv, 0);
        EXPECT_LT(t.duv, .006);
    }
    EXPECT_LT(distance(daylight_chromaticity(7000 - 1e-6), daylight_chromaticity(7000 + 1e-6)), 5e-7);
    EXPECT_EQ(distance(daylight_chromaticity(100), daylight_chromaticity(4000)), 0);
    EXPECT_EQ(distance(daylight_chromaticity(kInf), daylight_chromaticity(25'000)), 0);
}

TEST(CorrelatedTemperature, OfStandardIlluminantsIsAsPublished) {
    // CIE 15:2004 (chromaticities) and the temperatures commonly given with them, which were
    // reckoned at 5 nm: that moves 7500 K by 2 K.
    const struct {
        const char* name;
        Chromaticity xy;
        double kelvin, tolerance;
    } known[] = {{"A", {.44757, .40745}, 2856, 1},   {"C", {.31006, .31616}, 6774, 2},
                 {"D50", {.34567, .35850}, 5003, 2}, {"D55", {.33242, .34743}, 5503, 2},
                 {"D65", {.31271, .32902}, 6504, 2}, {"D75", {.29902, .31485}, 7504, 3},
                 {"E", {1.0 / 3, 1.0 / 3}, 5455, 2}, {"F2", {.37208, .37529}, 4230, 5},
                 {"F11", {.38052, .37713}, 4000, 2}};
    for (const auto& illuminant : known)
        EXPECT_NEAR(correlated_temperature(illuminant.xy).temperature_k, illuminant.kelvin,
                    illuminant.tolerance)
            << illuminant.name;
    EXPECT_NEAR(correlated_temperature({.31271, .32902}).duv, .0032, 5e-5);
    EXPECT_LT(correlated_temperature({1.0 / 3, 1.0 / 3}).duv, 0);
}

/// Ohno 2014, "Practical use and calculation of CCT and Duv": its example, as the Python package Colour works
/// it out.
TEST(CorrelatedTemperature, IsOhnos) {
    constexpr double u = .1978, v = .3122, n = 2 * u - 8 * v + 4;
    const CorrelatedTemperature t = correlated_temperature({3 * u / n, 2 * v / n});
    EXPECT_NEAR(t.temperature_k, 6507.474, .2);  // of which c2 = 1.4388e-2 makes .1
    EXPECT_NEAR(t.duv, .00322335, 1e-6);
}

/// The same package's locus, whose sums end at 780 nm and have c2 = 1.4388e-2: all its eight digits by our
/// observer.
TEST(PlanckianLocus, IsThatOfAnotherPrograms) {
    const struct {
        double kelvin, u, v;
    } known[] = {{1000, .44796288, .35462962}, {1010, .44563516, .35483063}};
    for (const auto& [kelvin, u, v] : known) {
        glm::dvec3 sum(0);
        for (int nm = 360; nm <= 780; ++nm)
            sum += cie_1931_observer()[static_cast<std::size_t>(nm - 360)] /
                   (std::pow(nm, 5) * std::expm1(1.4388e-2 / (nm * 1e-9 * kelvin)));
        const double n = sum.x + 15 * sum.y + 3 * sum.z;
        EXPECT_NEAR(4 * sum.x / n, u, 6e-9);
        EXPECT_NEAR(6 * sum.y / n, v, 6e-9);
    }
}

TEST(CorrelatedTemperature, IsThatOfTheNearestBlackBody) {
    // Every black body of a fine grid is farther.
    for (const Chromaticity c : {Chromaticity{.40, .45}, {.33, .30}, {.25, .26}, {.55, .38}}) {
        const CorrelatedTemperature t = correlated_temperature(c);
        for (double kelvin = 800; kelvin < 1e5; kelvin *= 1.01)
            EXPECT_GE(glm::distance(uv_1960(c), uv_1960(planckian_chromaticity(kelvin))),
                      std::abs(t.duv) - 1e-15);
    }
}

TEST(CorrelatedTemperature, OutsideItsRangeIsTheEnd) {
    EXPECT_NEAR(correlated_temperature(planckian_chromaticity(600)).temperature_k, 800, 1e-6);
    EXPECT_NEAR(correlated_temperature(planckian_chromaticity(kInf)).temperature_k, 1e5, 1e-3);
    EXPECT_NEAR(correlated_temperature(planckian_chromaticity(800)).duv, 0, 1e-12);
}

TEST(CorrelatedTemperature, IsUndone) {
    double worst = 0;
    for (double kelvin = 800; kelvin < 1e5; kelvin *= 1.5)
        for (const double duv : {-.05, -.01, 0.0, .02, .05}) {
            const Chromaticity c = from_correlated_temperature({kelvin, duv});
            const CorrelatedTemperature t = correlated_temperature(c);
            EXPECT_NEAR(t.temperature_k / kelvin, 1, 1e-9);
            EXPECT_NEAR(t.duv, duv, 1e-12);
            worst = std::max(worst, distance(from_correlated_temperature(t), c));
        }
    EXPECT_LT(worst, 1e-9);
}

TEST(RgbFromTemperature, HasLuminanceOneAndNoNegative) {
    for (const double kelvin : {1.0, 800.0, 1000.0, 1900.0, 1902.0, 6500.0, 1e5, kInf}) {
        const glm::dvec3 rgb = rgb_from_temperature(kelvin);
        EXPECT_NEAR(luminance_of_rgb(rgb), 1, 1e-14) << kelvin;
        EXPECT_GE(std::min({rgb.r, rgb.g, rgb.b}), 0) << kelvin;
    }
    EXPECT_GT(rgb_from_temperature(2000).r, rgb_from_temperature(2000).b);
    EXPECT_LT(rgb_from_temperature(20'000).r, rgb_from_temperature(20'000).b);
}

TEST(RgbFromTemperature, LeavesTheGamutBelowNineteenHundredKelvin) {
    EXPECT_GT(rgb_of(planckian_chromaticity(1901)).b, 0);
    EXPECT_LT(rgb_of(planckian_chromaticity(1900)).b, 0);
    EXPECT_EQ(rgb_from_temperature(1900).b, 0);
    const double lowest = rgb_of(planckian_chromaticity(1000)).b;
    EXPECT_NEAR(1 - 1 / (1 - lowest), .083, 5e-4);
}

TEST(KrystekFit, IsWithinItsErrorOfTheIntegral) {
    double worst = 0, worst_float = 0;
    for (double kelvin = 1000; kelvin <= 15'000; kelvin *= 1.01) {
        const glm::dvec2 fit = planckian_uv_krystek(kelvin);
        worst = std::max(worst, glm::distance(fit, uv_1960(planckian_chromaticity(kelvin))));
        worst_float =
            std::max(worst_float, glm::distance(fit, glm::dvec2(planckian_uv_krystek(float(kelvin)))));
    }
    EXPECT_LT(worst, 1.4e-4);
    EXPECT_GT(worst, 1.3e-4);
    EXPECT_LT(worst_float, 1e-6);
    EXPECT_NEAR(glm::distance(planckian_uv_krystek(4e4), uv_1960(planckian_chromaticity(4e4))), 1.6e-3, 1e-4);
}

}  // namespace
}  // namespace pbr
