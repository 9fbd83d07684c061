// The tests' own instruments: a test that can't fail holds nothing.

#include <cmath>
#include <numbers>

#include "tests/libpbr/support/chi_square.hpp"
#include "tests/libpbr/support/integrate.hpp"
#include "tests/libpbr/support/property.hpp"

namespace pbr {
namespace {

Vec3<double> uniform_above(double u1, double u2) {
    const double s = std::sqrt(1 - u1 * u1), phi = 2 * std::numbers::pi * u2;
    return {s * std::cos(phi), s * std::sin(phi), u1};
}

TEST(Support, ChiSquareAcceptsTheRightDensityAndRejectsAWrongOne) {
    const double p = 1 / (2 * std::numbers::pi);
    EXPECT_GT(chi_square_p_value(uniform_above, [&](const Vec3<double>&) { return p; }), kSignificance);
    EXPECT_LT(
        chi_square_p_value(uniform_above, [&](const Vec3<double>& w) { return p * (1 + .1 * (w.z - .5)); }),
        kSignificance);
}

TEST(Support, IntegralsOverDirectionsAreThoseOfPolynomials) {
    EXPECT_NEAR(integrate_hemisphere([](const Vec3<double>& w) { return w.z; }), std::numbers::pi, 1e-12);
    EXPECT_NEAR(integrate_sphere([](const Vec3<double>& w) { return w.x * w.x; }), 4 * std::numbers::pi / 3,
                1e-12);
}

TEST(Support, UlpDistanceCountsAcrossZero) {
    EXPECT_EQ(ulp_distance(1.0f, std::nextafter(1.0f, 2.0f)), 1);
    EXPECT_EQ(ulp_distance(1.0, std::nextafter(1.0, 2.0)), 1);
    EXPECT_EQ(ulp_distance(-1e9, std::nextafter(-1e9, 0.0)), 1);
    EXPECT_EQ(ulp_distance(1.0, 2.0), 0x1p52);
    EXPECT_EQ(ulp_distance(0.0, -0.0), 0);
    EXPECT_EQ(
        ulp_distance(std::numeric_limits<double>::denorm_min(), -std::numeric_limits<double>::denorm_min()),
        2);
    EXPECT_TRUE(std::isinf(ulp_distance(std::nan(""), 1.0)));
}

RC_GTEST_PROP(Support, GeneratorsStayInTheirDomain, ()) {
    const double u = *unit_interval();
    RC_ASSERT(u >= 0 && u <= 1);
    const Vec3<double> w = *direction_above();
    RC_ASSERT(w.z >= 0);
    RC_ASSERT(std::abs(w.x * w.x + w.y * w.y + w.z * w.z - 1) < 1e-14);
}

}  // namespace
}  // namespace pbr
