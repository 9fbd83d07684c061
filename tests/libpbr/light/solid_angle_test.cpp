#include "pbr/light/solid_angle.hpp"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <limits>

#include "pbr/ibl/cubemap.hpp"
#include "tests/libpbr/support/integrate.hpp"
#include "tests/libpbr/support/property.hpp"

namespace pbr {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(SolidAngle, OfAConeIsItsShareOfTheSphere) {
    EXPECT_DOUBLE_EQ(solid_angle_whole_sphere<double>().value(), 4 * kPi);
    EXPECT_DOUBLE_EQ(solid_angle_cone(kPi).value(), 4 * kPi);
    EXPECT_DOUBLE_EQ(solid_angle_cone(kPi / 2).value(), 2 * kPi);
    EXPECT_DOUBLE_EQ(solid_angle_cone(kPi / 3).value(), kPi);
    EXPECT_EQ(solid_angle_cone(0.0).value(), 0);
    const double z = std::cos(0.7);
    EXPECT_NEAR(solid_angle_cone(0.7).value(),
                integrate_directions([](const Vec3<double>&) { return 1.0; }, z, 1), 1e-10);
}

TEST(SolidAngle, OfANarrowConeKeepsItsDigits) {
    // pi h^2 (1 - h^2/12 + ...).
    for (const double h : {1e-3, 1e-5, 1e-12, 1e-100})
        EXPECT_NEAR(solid_angle_cone(h).value() / (kPi * h * h), 1 - h * h / 12, 1e-14) << h;
    EXPECT_NEAR(solid_angle_cone(1e-4f).value() / (std::numbers::pi_v<float> * 1e-8f), 1, 4e-7f);
}

TEST(SolidAngle, OfAPyramidIsTheIntegralOverItsSection) {
    // At distance 1 the section is [-tx, tx] x [-ty, ty] only if the tangents are those of the faces.
    for (const double ax : {0.1, 1.0, 2.0})
        for (const double ay : {0.3, 1.5}) {
            const double tx = std::tan(ax / 2), ty = std::tan(ay / 2);
            const auto row = [&](double x) {
                const auto at = [&](double y) { return std::pow(1 + x * x + y * y, -1.5); };
                return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(at, -ty, ty, 8, 1e-12);
            };
            const double section =
                boost::math::quadrature::gauss_kronrod<double, 31>::integrate(row, -tx, tx, 8, 1e-12);
            EXPECT_NEAR(solid_angle_pyramid(ax, ay).value(), section, 1e-10) << ax << " " << ay;
            EXPECT_NEAR(solid_angle_of_rectangle(2 * tx, 2 * ty, 1.0).value(), section, 1e-10);
        }
    EXPECT_NEAR(solid_angle_pyramid(kPi / 2, kPi / 2).value(), 4 * kPi / 6, 1e-14);  // a cube's face
    EXPECT_NEAR(solid_angle_pyramid(kPi, kPi).value(), 2 * kPi, 1e-14);
    EXPECT_EQ(solid_angle_pyramid(0.0, 1.0).value(), 0);
}

TEST(SolidAngle, OfARectangleIsThatOfATexel) {
    EXPECT_NEAR(solid_angle_of_rectangle(1.0, 0.4, 1.0).value(), cube_rectangle_solid_angle(-.5, .5, -.2, .2),
                1e-14);
    EXPECT_NEAR(solid_angle_of_rectangle(3.0, 2.0, 0.0).value(), 2 * kPi, 1e-14);
}

TEST(SolidAngle, OfSphereAndDiskAreThoseOfTheirCones) {
    for (const double q : {1e-9, 1e-3, 0.5, 0.999}) {
        EXPECT_NEAR(solid_angle_of_sphere(2 * q, 2.0).value() / solid_angle_cone(std::asin(q)).value(), 1,
                    2e-14);
        EXPECT_NEAR(solid_angle_of_disk(3 * q, 3.0).value() / solid_angle_cone(std::atan(q)).value(), 1,
                    2e-14);
    }
    EXPECT_DOUBLE_EQ(solid_angle_of_sphere(1.0, 1.0).value(), 2 * kPi);
    EXPECT_DOUBLE_EQ(solid_angle_of_sphere(1.0, 0.5).value(), 4 * kPi);
    EXPECT_DOUBLE_EQ(solid_angle_of_disk(1.0, 0.0).value(), 2 * kPi);
    EXPECT_EQ(solid_angle_of_disk(1.0, std::numeric_limits<double>::infinity()).value(), 0);
}

RC_GTEST_PROP(SolidAngle, InFloatIsWithinItsUlpsOfDouble, ()) {
    const float a = static_cast<float>(*log_uniform(1e-6, 3)), b = static_cast<float>(*log_uniform(1e-6, 3));
    const float d = static_cast<float>(*log_uniform(1e-3, 1e3));
    const auto ulps = [](auto single, auto exact) {
        return ulp_distance(single.value(), static_cast<float>(exact.value()));
    };
    RC_ASSERT(ulps(solid_angle_cone(a), solid_angle_cone(double(a))) <= 4);
    RC_ASSERT(ulps(solid_angle_pyramid(a, b), solid_angle_pyramid(double(a), double(b))) <= 8);
    RC_ASSERT(ulps(solid_angle_of_sphere(a, d), solid_angle_of_sphere(double(a), double(d))) <= 8);
    RC_ASSERT(ulps(solid_angle_of_disk(a, d), solid_angle_of_disk(double(a), double(d))) <= 8);
    RC_ASSERT(ulps(solid_angle_of_rectangle(a, b, d),
                   solid_angle_of_rectangle(double(a), double(b), double(d))) <= 8);
}

}  // namespace
}  // namespace pbr
