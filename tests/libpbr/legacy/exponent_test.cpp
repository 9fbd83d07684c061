#include "pbr/legacy/exponent.hpp"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>

#include "pbr/brdf/roughness.hpp"

namespace pbr {
namespace {

using boost::math::quadrature::gauss_kronrod;
constexpr double kInf = std::numeric_limits<double>::infinity(),
                 kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(Exponent, HardValuesHaveDefinedAlphas) {
    // Right answers written first: what is no exponent is the widest lobe, an infinite one a mirror.
    EXPECT_EQ(alpha_from_blinn_phong(-1.), 1);
    EXPECT_EQ(alpha_from_blinn_phong(0.), 1);
    EXPECT_EQ(alpha_from_blinn_phong(kNaN), 1);
    EXPECT_EQ(alpha_from_blinn_phong(kInf), 0);
    EXPECT_NEAR(alpha_from_blinn_phong(1e-6), 1, 1e-6);
    EXPECT_NEAR(alpha_from_blinn_phong(1.), std::sqrt(2. / 3), 1e-15);
    EXPECT_NEAR(alpha_from_blinn_phong(2.), std::sqrt(.5), 1e-15);
    EXPECT_NEAR(alpha_from_blinn_phong(1e4), 1.41407e-2, 1e-7);
    EXPECT_NEAR(alpha_from_blinn_phong(1e6), 1.41421e-3, 1e-8);
    // n = 50 is .443 in perceptual roughness; converters have it at .196, .776 and .293.
    EXPECT_NEAR(perceptual_roughness_from_alpha(alpha_from_blinn_phong(50.)), .4429, 5e-5);
}

TEST(Exponent, GoesBackFromAlpha) {
    for (const LobeFit fit : {LobeFit::slope, LobeFit::l2, LobeFit::cumulative, LobeFit::half_width})
        for (const double n : {3., 50., 1e4, 1e6})
            EXPECT_NEAR(blinn_phong_from_alpha(alpha_from_blinn_phong(n, fit), fit) / n, 1, 1e-13) << n;
    EXPECT_EQ(blinn_phong_from_alpha(1.), 0);
    EXPECT_EQ(blinn_phong_from_alpha(0.), kInf);
    EXPECT_EQ(blinn_phong_from_alpha(1e-30f),
              std::numeric_limits<float>::infinity());  // its square underflows
}

TEST(Exponent, PhongIsFourTimesAsNarrow) {
    // Lobes about the mirror direction, on the plane of incidence, seen along the normal: the half vector is
    // at half the angle.
    for (const double angle : {.001, .01})
        EXPECT_NEAR(
            std::pow(std::cos(angle), 100.) / std::pow(std::cos(angle / 2), blinn_phong_from_phong(100.)), 1,
            100 * angle * angle * angle * angle);
    EXPECT_EQ(alpha_from_phong(10.), alpha_from_blinn_phong(40.));
}

// The fits, each found again by minimising what it is defined by, over x = n theta^2 / 2, where Blinn-Phong
// is e^-x and GGX s / (x + s)^2 with s = (factor)^2.
double best_factor(double (*cost)(double)) {
    return std::sqrt(boost::math::tools::brent_find_minima(cost, .1, 4., 40).first);
}

TEST(Exponent, FitsMinimiseWhatTheyAreNamedAfter) {
    const auto l2 = [](double s) {
        const auto squared = [s](double x) {
            const double difference = s / ((x + s) * (x + s)) - std::exp(-x);
            return difference * difference;
        };
        return gauss_kronrod<double, 31>::integrate(squared, 0., kInf, 12, 1e-12);
    };
    EXPECT_NEAR(best_factor(l2), alpha_factor(LobeFit::l2), 1e-5);
    const auto cumulative = [](double s) {
        const auto squared = [s](double theta) {  // in units of sqrt(2 / n)
            const double x = theta * theta, difference = x / (x + s) - 1 + std::exp(-x);
            return difference * difference;
        };
        return gauss_kronrod<double, 31>::integrate(squared, 0., kInf, 12, 1e-12);
    };
    EXPECT_NEAR(best_factor(cumulative), alpha_factor(LobeFit::cumulative), 5e-3);
    const double s = std::pow(alpha_factor(LobeFit::half_width), 2), x = std::log(2);
    EXPECT_NEAR(s * s / ((x + s) * (x + s)), .5, 1e-5);
    EXPECT_EQ(alpha_factor(LobeFit::slope), 1);
}

}  // namespace
}  // namespace pbr
