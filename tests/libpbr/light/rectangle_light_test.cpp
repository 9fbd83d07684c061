#include "pbr/light/rectangle_light.hpp"

#include <gtest/gtest.h>

#include "pbr/light/solid_angle.hpp"
#include "tests/libpbr/light/area_reference.hpp"
#include "tests/libpbr/support/property.hpp"

namespace pbr {
namespace {

using std::numbers::pi;

const RectangleLight<double> kUnitSquare{Vec(0), {0.5, 0, 0}, {0, 0.5, 0}, Emission::one_sided};

/// A random rectangle about the origin's surroundings, seen from the origin.
RectangleLight<double> random_rectangle() {
    const auto [x, y] = plane_of(*direction());
    return {*log_uniform(0.3, 10) * *direction(), *log_uniform(0.01, 3) * x, *log_uniform(0.01, 3) * y,
            Emission::two_sided};
}

TEST(RectangleLight, AgreesWithTheIntegralOverItsSurface) {
    const RectangleLight<double> light{{0.5, 0.2, 0.4}, {0.3, 0.1, 0.4}, {0.4, 0, -0.3}, Emission::two_sided};
    RectangleLight<double> front = light;
    if (glm::dot(front_normal(light), light.centre) > 0) front.half_x = -front.half_x;
    for (const Vec& n : {Vec(0, 0, 1), Vec(1, 0, 0), Vec(-0.6, 0, 0.8)})
        EXPECT_NEAR(projected_solid_angle(light, Vec(0), n),
                    reference_projected_solid_angle(front, Vec(0), n), 1e-6);
    EXPECT_NEAR(solid_angle(light, Vec(0)), reference_solid_angle(front, Vec(0)), 1e-9);
}

TEST(RectangleLight, SolidAngleMatchesThePyramidOnItsAxis) {
    for (const double h : {1e-3, 0.1, 1.0, 30.0}) {
        const RectangleLight<double> light{{0, 0, h}, {0.7, 0, 0}, {0, -0.3, 0}, Emission::one_sided};
        EXPECT_NEAR(solid_angle(light, Vec(0)) / solid_angle_of_rectangle(1.4, 0.6, h).value(), 1, 1e-12) << h;
    }
    EXPECT_EQ(solid_angle_of_rectangle(2.0, 2.0, 0.0).value(), 2 * pi);
    EXPECT_NEAR(solid_angle_of_rectangle(2.0, 2.0, 1.0).value(), 4 * pi / 6, 1e-15);  // a face of the cube
}

RC_GTEST_PROP(RectangleLight, IsBetweenItsBounds, ()) {
    const RectangleLight<double> light = random_rectangle();
    const Vec n = *direction();
    const double omega = solid_angle(light, Vec(0)), E = projected_solid_angle(light, Vec(0), n);
    const double other = projected_solid_angle(light, Vec(0), -n);
    RC_ASSERT(E >= 0 && E <= std::min(omega, pi) + 1e-13);
    RC_ASSERT(omega >= 0 && omega < 2 * pi);
    RC_ASSERT(other >= 0);
    // E(n) - E(-n) is linear in n: the light's vector irradiance.
    const Vec vector(projected_solid_angle(light, Vec(0), Vec(1, 0, 0)) -
                         projected_solid_angle(light, Vec(0), Vec(-1, 0, 0)),
                     projected_solid_angle(light, Vec(0), Vec(0, 1, 0)) -
                         projected_solid_angle(light, Vec(0), Vec(0, -1, 0)),
                     projected_solid_angle(light, Vec(0), Vec(0, 0, 1)) -
                         projected_solid_angle(light, Vec(0), Vec(0, 0, -1)));
    RC_ASSERT(std::abs(E - other - glm::dot(vector, n)) < 1e-8 * omega + 1e-13);
    for (const double approximate :
         {projected_solid_angle_structured(light, Vec(0), n), projected_solid_angle_mrp(light, Vec(0), n)})
        RC_ASSERT(approximate >= 0 && approximate <= omega + 1e-12);
}

RC_GTEST_PROP(RectangleLight, FloatIsTheDoubleOfItsInputs, ()) {
    const RectangleLight<double> wide = random_rectangle();
    const RectangleLight<float> light{Vec3<float>(wide.centre), Vec3<float>(wide.half_x),
                                      Vec3<float>(wide.half_y), wide.emission};
    const Vec3<float> n(*direction());
    const double exact = projected_solid_angle(in_double(light), Vec(0), Vec(n));
    RC_ASSERT(std::abs(projected_solid_angle(light, Vec3<float>(0), n) - exact) <=
              1e-6 * solid_angle(wide, Vec(0)));
}

TEST(RectangleLight, ShinesFromItsFrontOrBoth) {
    RectangleLight<double> light = kUnitSquare;
    EXPECT_GT(projected_solid_angle(light, Vec(0, 0, 1), Vec(0, 0, -1)), 0.2);
    for (const auto& one :
         {projected_solid_angle(light, Vec(0, 0, -1), Vec(0, 0, 1)),
          projected_solid_angle_structured(light, Vec(0, 0, -1), Vec(0, 0, 1)),
          projected_solid_angle_mrp(light, Vec(0, 0, -1), Vec(0, 0, 1)), solid_angle(light, Vec(0, 0, -1))})
        EXPECT_EQ(one, 0);
    light.emission = Emission::two_sided;
    EXPECT_EQ(projected_solid_angle(light, Vec(0, 0, -1), Vec(0, 0, 1)),
              projected_solid_angle(light, Vec(0, 0, 1), Vec(0, 0, -1)));
    EXPECT_EQ(projected_solid_angle_mrp(light, Vec(0, 0, -1), Vec(0, 0, 1)),
              projected_solid_angle_mrp(light, Vec(0, 0, 1), Vec(0, 0, -1)));
}

TEST(RectangleLight, IsDarkInItsOwnPlaneAndWithoutArea) {
    RectangleLight<double> light = kUnitSquare;
    light.emission = Emission::two_sided;
    for (const Vec& p : {Vec(2, 0, 0), Vec(0, 0, 0), Vec(0.5, 0, 0), Vec(0.5, 0.5, 0)})
        for (const Vec& n : {Vec(0, 0, 1), Vec(1, 0, 0)}) {
            EXPECT_EQ(projected_solid_angle(light, p, n), 0);
            EXPECT_EQ(projected_solid_angle_structured(light, p, n), 0);
            EXPECT_EQ(projected_solid_angle_mrp(light, p, n), 0);
        }
    light.half_y = Vec(0);
    EXPECT_EQ(projected_solid_angle(light, Vec(0, 0, 1), Vec(0, 0, -1)), 0);
    EXPECT_EQ(projected_solid_angle_structured(light, Vec(0, 0, 1), Vec(0, 0, -1)), 0);
    EXPECT_EQ(projected_solid_angle_mrp(light, Vec(0, 0, 1), Vec(0, 0, -1)), 0);
    // Coplanar with the receiver: on its horizon.
    EXPECT_NEAR(projected_solid_angle(kUnitSquare, Vec(2, 0, 1e-12), Vec(0, 0, -1)), 0, 1e-12);
}

TEST(RectangleLight, FillsTheHemisphereAtItsSurface) {
    EXPECT_NEAR(projected_solid_angle(kUnitSquare, Vec(0, 0, 1e-9), Vec(0, 0, -1)), pi, 1e-8);
    EXPECT_NEAR(solid_angle(kUnitSquare, Vec(0, 0, 1e-9)), 2 * pi, 1e-6);
    EXPECT_NEAR(projected_solid_angle(kUnitSquare, Vec(0, 0, 1e-9), Vec(1, 0, 0)), pi / 2, 1e-8);
}

TEST(RectangleLight, FarAwayIsAPoint) {
    const double d = 1e4, point = 0.8 * 0.6 / (d * d);  // area 1, cosines at the light and the receiver
    const Vec away = Vec(0.6, 0, 0.8);
    const Vec n = -(0.6 * away + 0.8 * Vec(0.8, 0, -0.6));
    EXPECT_NEAR(projected_solid_angle(kUnitSquare, d * away, n) / point, 1, 1e-5);
    EXPECT_NEAR(projected_solid_angle_structured(kUnitSquare, d * away, n) / point, 1, 1e-5);
    const RectangleLight<float> light{Vec3<float>(0), {0.5f, 0, 0}, {0, 0.5f, 0}, Emission::one_sided};
    EXPECT_NEAR(projected_solid_angle(light, Vec3<float>(d * away), Vec3<float>(n)) / point, 1, 1e-5);
}

TEST(RectangleLight, IsContinuousAcrossTheHorizon) {
    double before = projected_solid_angle(kUnitSquare, Vec(0, 0, 1), Vec(1, 0, 0));
    for (int i = 1; i <= 18000; ++i) {
        const double turn = radians(i * 0.01);
        const double E =
            projected_solid_angle(kUnitSquare, Vec(0, 0, 1), Vec(std::cos(turn), 0, std::sin(turn)));
        ASSERT_NEAR(E, before, 1.5e-4) << i;
        before = E;
    }
}

const auto kSolidAngle = [](const Vec& p) { return solid_angle(kUnitSquare, p); };
const auto kExact = [](const Vec& p, const Vec& n) { return projected_solid_angle(kUnitSquare, p, n); };

double head_on_error(double distance) {
    const Vec p(0, 0, distance), n(0, 0, -1);
    return projected_solid_angle_structured(kUnitSquare, p, n) / kExact(p, n) - 1;
}

TEST(RectangleLight, StructuredSamplingErrsAsStated) {
    const auto structured = [](const Vec& p, const Vec& n) {
        return projected_solid_angle_structured(kUnitSquare, p, n);
    };
    EXPECT_NEAR(head_on_error(0.1), -0.470, 5e-4);
    EXPECT_NEAR(head_on_error(0.5), -0.204, 5e-4);
    EXPECT_NEAR(head_on_error(1), -0.0865, 5e-5);
    EXPECT_NEAR(head_on_error(4), -0.0071, 5e-5);
    EXPECT_NEAR(worst_error(0.5, structured, kExact, kSolidAngle), 0.52, 5e-3);
    EXPECT_NEAR(worst_error(1, structured, kExact, kSolidAngle), 0.104, 5e-4);
    EXPECT_NEAR(worst_error(2, structured, kExact, kSolidAngle), 0.037, 5e-4);
    EXPECT_NEAR(worst_error(4, structured, kExact, kSolidAngle), 0.019, 5e-4);
}

TEST(RectangleLight, MostRepresentativePointErrsAsStated) {
    const auto mrp = [](const Vec& p, const Vec& n) { return projected_solid_angle_mrp(kUnitSquare, p, n); };
    EXPECT_NEAR(worst_error(0.5, mrp, kExact, kSolidAngle), 0.58, 5e-3);
    EXPECT_NEAR(worst_error(1, mrp, kExact, kSolidAngle), 0.48, 5e-3);
    EXPECT_NEAR(worst_error(2, mrp, kExact, kSolidAngle), 0.30, 5e-3);
    EXPECT_NEAR(worst_error(4, mrp, kExact, kSolidAngle), 0.15, 5e-3);
}

RC_GTEST_PROP(RectangleLight, ClosestPointIsInsideAndNearest, ()) {
    const RectangleLight<double> light = random_rectangle();
    const double a = *uniform(-3, 3), b = *uniform(-3, 3), c = *uniform(-1, 1), d = *uniform(-1, 1);
    const Vec x = light.centre + a * light.half_x + b * light.half_y;
    const Vec other = light.centre + c * light.half_x + d * light.half_y;
    RC_ASSERT(glm::length(x - closest_point(light, x)) <= glm::length(x - other) + 1e-12);
}

}  // namespace
}  // namespace pbr
