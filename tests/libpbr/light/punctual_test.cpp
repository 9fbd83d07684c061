#include "pbr/light/punctual.hpp"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <limits>

#include "pbr/light/solid_angle.hpp"
#include "pbr/light/unit_conversions.hpp"
#include "tests/libpbr/support/integrate.hpp"
#include "tests/libpbr/support/property.hpp"

namespace pbr {
namespace {

using Vec = Vec3<double>;
constexpr double kPi = std::numbers::pi, kInf = std::numeric_limits<double>::infinity(), kDeg = kPi / 180;

TEST(PunctualDistance, IsTheInverseSquareUnderItsWindow) {
    for (const double d : {.02, .5, 3.0, 7.9}) {
        const double linear = 1 - std::pow(d / 8, 4);
        EXPECT_NEAR(distance_attenuation(d, 8.0) * d * d, linear * linear, 1e-14) << d;
        EXPECT_NEAR(distance_attenuation(d, kInf) * d * d, 1, 1e-15);
    }
    EXPECT_NEAR(1 - distance_window(1.0, 2.0), .12, .005);
}

TEST(PunctualDistance, EndsAtItsRadiusAndAtTheBulb) {
    EXPECT_EQ(distance_attenuation(8.0, 8.0), 0);
    EXPECT_EQ(distance_attenuation(1e30f, 8.0f), 0);
    EXPECT_NEAR(distance_attenuation(0.0, 8.0), 1e4, 1e-11);
    EXPECT_NEAR(distance_attenuation(.01, kInf), 1e4, 1e-11);
    EXPECT_NEAR(distance_attenuation(.005, kInf), 1e4, 1e-11);
    EXPECT_EQ(distance_window(0.0, kInf), 1);
    EXPECT_EQ(distance_window(3e38f, std::numeric_limits<float>::infinity()), 1);
    for (const double d : {0.0, 1e-9, 1.0}) EXPECT_EQ(distance_attenuation(d, 0.0), 0);
    // No slope at the radius: within h of it the window is 16 (h/R)^2.
    EXPECT_NEAR(distance_window(1 - 1e-4, 1.0), 16e-8, 1e-10);
}

/// The penumbra by its definition, apart from the listing's scale and offset.
double penumbra(double cosine, double inner, double outer) {
    const double t = (cosine - std::cos(outer)) / (std::cos(inner) - std::cos(outer));
    return t <= 0 ? 0 : t >= 1 ? 1 : t * t;
}

TEST(PunctualSpot, FallsAsASquareFromInnerToOuterAngle) {
    const SpotCone<double> cone = spot_cone(20 * kDeg, 40 * kDeg);
    for (double angle = 0; angle <= 180; angle += 2.5)
        EXPECT_NEAR(spot_attenuation(std::cos(angle * kDeg), cone),
                    penumbra(std::cos(angle * kDeg), 20 * kDeg, 40 * kDeg), 1e-14);
    EXPECT_EQ(spot_attenuation(1.0, cone), 1);
    EXPECT_EQ(spot_attenuation(-1.0, cone), 0);
    EXPECT_NEAR(spot_attenuation(std::cos(40 * kDeg), cone), 0, 1e-30);
}

TEST(PunctualSpot, WithEqualOrCrossedAnglesHasTheHardestEdge) {
    for (const double inner : {30.0, 50.0}) {
        const SpotCone<double> cone = spot_cone(inner * kDeg, 30 * kDeg);
        EXPECT_DOUBLE_EQ(cone.scale, 1000);
        EXPECT_EQ(spot_attenuation(std::cos(30 * kDeg) + 1.0001e-3, cone), 1);
        EXPECT_NEAR(spot_attenuation(std::cos(30 * kDeg) + .5e-3, cone), .25, 1e-12);
        EXPECT_EQ(spot_attenuation(std::cos(30 * kDeg) - 1e-12, cone), 0);
    }
}

TEST(PunctualSpot, IsDimmedOnItsAxisWhenNarrow) {
    EXPECT_NEAR(spot_attenuation(1.0, spot_cone(0.0, 1 * kDeg)), .0232, 5e-5);
    EXPECT_LT(spot_attenuation(1.0, spot_cone(0.0, 2.55 * kDeg)), 1);
    EXPECT_EQ(spot_attenuation(1.0, spot_cone(0.0, 2.57 * kDeg)), 1);
    EXPECT_EQ(spot_attenuation(1.0, spot_cone(0.0, 0.0)), 0);
}

TEST(PunctualSpot, SolidAngleIsTheIntegralOfItsAttenuation) {
    const double cones[][2] = {{20, 40}, {0, 90}, {0, 1}, {30, 30}, {89, 170}, {0, 180}, {2, 2.5}};
    for (const auto& [inner, outer] : cones) {
        const SpotCone<double> cone = spot_cone(inner * kDeg, outer * kDeg);
        const double first = std::cos(outer * kDeg), full = std::min(first + 1 / cone.scale, 1.0);
        const auto at = [&](double z) { return spot_attenuation(z, cone); };
        const double sum =
            2 * kPi *
            (boost::math::quadrature::gauss_kronrod<double, 15>::integrate(at, first, full) + (1 - full));
        EXPECT_NEAR(solid_angle_of_spot(cone).value(), sum, 1e-13) << inner << " " << outer;
        EXPECT_NEAR(cone.on_axis, cone.scale + cone.offset, 1e-12) << inner << " " << outer;
    }
    EXPECT_EQ(solid_angle_of_spot(spot_cone(0.0, 0.0)).value(), 0);
    // Without a penumbra it is the cone, but for the step.
    EXPECT_NEAR(solid_angle_of_spot(spot_cone(kPi / 3, kPi / 3)).value(), solid_angle_cone(kPi / 3).value(),
                2 * kPi * kSpotCosineStep);
}

TEST(Punctual, AnEnclosingSphereCatchesThePowerOfASpot) {
    const SpotCone<double> cone = spot_cone(.4, .9);
    const Candelas<double> I = intensity_from_power(Lumens<double>(1000), solid_angle_of_spot(cone));
    const auto lux = [&](const Vec& w) {  // sphere of radius 2 about the light; the surface looks inwards
        return 4 * illuminance_of_spot(I, Vec(0, 0, 1), cone, -2.0 * w, -w, kInf).value();
    };
    const double flux = integrate_directions(lux, std::cos(.9), std::cos(.4)) +
                        integrate_directions(lux, std::cos(.4), 1) +
                        integrate_directions(lux, -1, std::cos(.9));
    EXPECT_NEAR(flux, 1000, 1e-7);
}

TEST(Punctual, IlluminanceIsTheCosineLaw) {
    const Candelas<double> I(100);
    EXPECT_NEAR(illuminance_of_point(I, Vec(0, 0, 2), Vec(0, 0, 1), kInf).value(), 25, 1e-13);
    EXPECT_NEAR(illuminance_of_point(I, Vec(2, 0, 2), Vec(0, 0, 1), kInf).value(), 100 * std::sqrt(.5) / 8,
                1e-13);
    EXPECT_EQ(illuminance_of_point(I, Vec(1, 0, -1e-9), Vec(0, 0, 1), kInf).value(), 0);
    EXPECT_EQ(illuminance_of_point(I, Vec(0, 0, 0), Vec(0, 0, 1), kInf).value(), 0);
    const SpotCone<double> cone = spot_cone(.1, .2);
    EXPECT_EQ(illuminance_of_spot(I, Vec(0, 0, -1), cone, Vec(0, 0, 0), Vec(0, 0, 1), kInf).value(), 0);
    EXPECT_NEAR(illuminance_of_spot(I, Vec(0, 0, -1), cone, Vec(0, 0, 2), Vec(0, 0, 1), kInf).value(), 25,
                1e-12);
    EXPECT_EQ(illuminance_of_spot(I, Vec(0, 0, 1), cone, Vec(0, 0, 2), Vec(0, 0, 1), kInf).value(), 0);
}

RC_GTEST_PROP(Punctual, IsFiniteInRangeAndFallsWithDistance, ()) {
    const double R = *rc::gen::weightedOneOf<double>(
        {{1, rc::gen::element(0.0, kInf, 1e-3)}, {2, log_uniform(1e-2, 1e3)}});
    const double near = *rc::gen::weightedOneOf<double>(
        {{1, rc::gen::element(0.0, .01, R < kInf ? R : 1)}, {2, log_uniform(1e-6, 1e3)}});
    const double far = near * *uniform(1, 2);
    const double a = distance_attenuation(near, R), b = distance_attenuation(far, R);
    RC_ASSERT(a >= 0 && a <= 1e4 * (1 + 1e-15) && b <= a * (1 + 1e-15));
    const double inner = *uniform(0, kPi), outer = *unit_interval() * kPi;
    const SpotCone<double> cone = spot_cone(inner, outer);
    const Vec w = *direction(), axis = *direction();
    const double share = spot_attenuation(glm::dot(w, axis), cone);
    RC_ASSERT(share >= 0 && share <= 1);
    const double angle = solid_angle_of_spot(cone).value();
    RC_ASSERT(angle >= 0 && angle <= solid_angle_cone(outer).value() + 1e-12);
}

RC_GTEST_PROP(Punctual, InFloatIsCloseToDouble, ()) {
    const float d = static_cast<float>(*log_uniform(1e-3, 20)),
                R = static_cast<float>(*log_uniform(1e-2, 20));
    const float eps = std::numeric_limits<float>::epsilon();
    RC_ASSERT(std::abs(distance_window(d, R) - distance_window(double(d), double(R))) <= 2 * eps);
    const float inner = static_cast<float>(*rc::gen::oneOf(uniform(0, 1), log_uniform(1e-7, 1)));
    const float outer = inner * static_cast<float>(*uniform(1.01, 2)) + 1e-9f;
    const double exact = solid_angle_of_spot(spot_cone(double(inner), double(outer))).value();
    RC_ASSERT(std::abs(solid_angle_of_spot(spot_cone(inner, outer)).value() / exact - 1) <= 16 * eps);
}

TEST(PunctualSpot, StatesTheIntensityOfNarrowConesInFloat) {
    for (const double degrees : {30.0, 1.0, .1, .01}) {
        const Steradians<float> angle = solid_angle_of_spot(spot_cone(0.f, static_cast<float>(degrees * kDeg)));
        // The ramp rises over 1 - cos outer, to 1 or, below 2.56 degrees, to 1000 times that.
        const double edge = 2 * std::pow(std::sin(degrees * kDeg / 2), 2), top = std::min(1000 * edge, 1.0);
        const double exact = 2 * kPi * top * top * edge / 3;
        EXPECT_NEAR(angle.value() / exact, 1, 2e-6) << degrees;
    }
}

}  // namespace
}  // namespace pbr
