#include "pbr/light/sphere_light.hpp"

#include <gtest/gtest.h>

#include "pbr/light/disk_light.hpp"

#include "tests/libpbr/light/area_reference.hpp"
#include "tests/libpbr/support/chi_square.hpp"
#include "tests/libpbr/support/property.hpp"

namespace pbr {
namespace {

using std::numbers::pi;
constexpr double kUlp = std::numeric_limits<double>::epsilon();

TEST(ProjectedSolidAngleCap, MatchesFiguresAtHalfAngle30) {
    // Angle of the centre from the normal, deg, and E/L from independent integration.
    const std::pair<double, double> figures[] = {
        {0, .78539816}, {80, .171832}, {90, .090586}, {100, .035449}, {115, .00124003}, {120, 0}, {150, 0}};
    for (const auto& [w, expected] : figures)
        EXPECT_NEAR(projected_solid_angle_cap(std::cos(radians(w)), 0.25), expected, 6e-7) << w;
}

TEST(ProjectedSolidAngleCap, KeepsItsDigitsForSmallCapsAcrossTheHorizon) {
    // A small cap is a flat disk of radius s at height t s over the horizon: the integral of y + t over its
    // part above is s^3 ((2/3)(1-t^2)^1.5 + t (pi/2 + asin t + t sqrt(1-t^2))), with relative error about
    // s^2.
    const double s = 1e-6;
    for (const double t : {-0.9, -0.5, 0.0, 0.3, 0.99}) {
        const double w = std::sqrt(1 - t * t);
        const double expected = s * s * s * (2 / 3.0 * w * w * w + t * (pi / 2 + std::asin(t) + t * w));
        EXPECT_NEAR(projected_solid_angle_cap(t * s, s * s) / expected, 1, 1e-9) << t;
    }
}

TEST(ProjectedSolidAngleCap, IsContinuousWhereTheCapTouchesTheHorizon) {
    for (const double s2 : {1e-8, 1e-3, 0.25, 0.9, 0.999999})
        for (const double side : {-1.0, 1.0}) {
            const double edge = side * std::sqrt(s2);
            const double before = projected_solid_angle_cap(edge * (1 - 1e-9), s2);
            const double after = projected_solid_angle_cap(edge * (1 + 1e-9), s2);
            EXPECT_NEAR(before, after, 1e-8 * s2) << s2 << ' ' << side;
        }
}

TEST(ProjectedSolidAngleCap, OfAHemisphereIsOnePlusCosine) {
    for (const double c : {-1.0, -0.5, 0.0, 0.5, 1.0})
        EXPECT_NEAR(projected_solid_angle_cap(c, 1.0), pi / 2 * (1 + c), 1e-15);
}

RC_GTEST_PROP(ProjectedSolidAngleCap, FloatIsWithinThirtyUlpOfItsSize, ()) {
    const float c = static_cast<float>(*uniform(-1, 1)), s2 = static_cast<float>(*unit_interval());
    const double exact = projected_solid_angle_cap<double>(c, s2);
    RC_ASSERT(std::abs(projected_solid_angle_cap(c, s2) - exact) <=
              30 * std::numeric_limits<float>::epsilon() * static_cast<double>(s2));
}

RC_GTEST_PROP(ProjectedSolidAngleCap, GrowsWithSizeAndHeight, ()) {
    const double c = *uniform(-1, 1), s2 = *unit_interval(), step = *uniform(0, 0.1);
    const double E = projected_solid_angle_cap(c, s2), slack = 60 * kUlp;
    RC_ASSERT(E >= 0 && E <= pi);
    RC_ASSERT(projected_solid_angle_cap(std::min(c + step, 1.0), s2) >= E - slack);
    RC_ASSERT(projected_solid_angle_cap(c, std::min(s2 + step, 1.0)) >= E - slack);
}

TEST(AtanMinusArgument, KeepsItsDigits) {
    for (double q = 1e-9; q < 20; q *= 1.3) {
        // In long double the difference keeps its digits above q = 0.05; below, its own series does.
        const long double l = q;
        long double exact = std::atan(l) - l;
        if (q < 0.05) {
            exact = 0;
            for (int k = 25; k >= 3; k -= 2) exact = (k % 4 == 3 ? -1.0L : 1.0L) / k + exact * l * l;
            exact *= l * l * l;
        }
        EXPECT_NEAR(atan_minus_argument(q) / static_cast<double>(exact), 1, 150 * kUlp) << q;
    }
}

TEST(SphereLight, AgreesWithTheIntegralOverItsSurface) {
    const SphereLight<double> light{{1, 0.2, 0.3}, 0.7};
    for (const Vec& n : {Vec(0, 0, 1), Vec(-0.6, 0, 0.8), Vec(0, 0, -1)})
        EXPECT_NEAR(projected_solid_angle(light, Vec(0), n),
                    reference_projected_solid_angle(light, Vec(0), n), 1e-6);
    EXPECT_NEAR(solid_angle(light, Vec(0)), reference_solid_angle(light, Vec(0)), 1e-9);
}

RC_GTEST_PROP(SphereLight, EqualsTheDiskThatFillsItsOutline, ()) {
    // The tangent cone touches the sphere in a circle; the disk in that circle looks the same, and is
    // integrated along its rim, by other code.
    const Vec direction_to = *direction(), n = *direction();
    const double s = std::asin(*uniform(0.01, 0.99)), distance = *log_uniform(0.1, 1e3);
    const SphereLight<double> sphere{distance * direction_to, distance * std::sin(s)};
    const DiskLight<double> disk{distance * std::cos(s) * std::cos(s) * direction_to, -direction_to,
                                 distance * std::sin(s) * std::cos(s)};
    RC_ASSERT(std::abs(projected_solid_angle(sphere, Vec(0), n) - projected_solid_angle(disk, Vec(0), n)) <
              1e-13);
    RC_ASSERT(std::abs(solid_angle(sphere, Vec(0)) - solid_angle(disk, Vec(0))) < 1e-12);
}

TEST(SphereLight, SurroundsAPointInside) {
    const SphereLight<double> light{{0, 0, 1}, 2};
    for (const Vec& n : {Vec(0, 0, 1), Vec(0, 0, -1), Vec(1, 0, 0)}) {
        EXPECT_EQ(projected_solid_angle(light, Vec(0), n), pi);
        EXPECT_EQ(projected_solid_angle(light, light.centre, n), pi);
    }
    EXPECT_EQ(solid_angle(light, Vec(0)), 4 * pi);
    EXPECT_EQ(projected_solid_angle(light, Vec(0, 0, 3), Vec(0, 0, -1)), pi);  // on the surface, facing it
    EXPECT_EQ(projected_solid_angle(light, Vec(0, 0, 3), Vec(0, 0, 1)), 0);
    EXPECT_EQ(solid_angle(light, Vec(0, 0, 3)), 2 * pi);
}

TEST(SphereLight, TouchingTheReceiversPlaneIsWholeAbove) {
    const SphereLight<double> light{{3, 0, 1}, 1};
    EXPECT_NEAR(projected_solid_angle(light, Vec(0), Vec(0, 0, 1)), pi * 0.1 / std::sqrt(10), 1e-15);
    EXPECT_NEAR(projected_solid_angle(light, Vec(0), Vec(0, 0, -1)), 0, 1e-15);
}

TEST(SphereLight, OfNoRadiusShinesNowhere) {
    const SphereLight<double> light{{0, 0, 1}, 0};
    EXPECT_EQ(projected_solid_angle(light, Vec(0), Vec(0, 0, 1)), 0);
    EXPECT_EQ(projected_solid_angle(light, light.centre, Vec(0, 0, 1)), 0);
    EXPECT_EQ(solid_angle(light, Vec(0)), 0);
}

TEST(SphereLight, FarAwayIsAPoint) {
    const SphereLight<float> light{{0.f, 300.f, 400.f}, 1.f};
    const double point = pi / 250000 * 0.8;  // intensity over luminance / distance^2 x cosine
    EXPECT_NEAR(projected_solid_angle(light, Vec3<float>(0), Vec3<float>(0, 0, 1)) / point, 1, 1e-6);
    EXPECT_NEAR(solid_angle(light, Vec3<float>(0)) / (pi / 250000), 1, 1e-5);
}

TEST(SphereLight, FrostbitesClampsCostAsStated) {
    const SphereLight<double> light{Vec(0), 0.5};
    const auto exact = [&](const Vec& p, const Vec& n) { return projected_solid_angle(light, p, n); };
    const auto clamped = [&](const Vec& p, const Vec& n) {
        return projected_solid_angle_frostbite(light, p, n);
    };
    for (const double distance : {0.75, 1.0, 2.0, 4.0}) {
        const double worst =
            worst_error(distance, clamped, exact, [&](const Vec& p) { return solid_angle(light, p); });
        EXPECT_LT(worst, 1.0e-3);
        EXPECT_GT(worst, 0.8e-3);
    }
    const double surface = worst_error(0.5 * (1 + 1e-12), clamped, exact, [](const Vec&) { return 1.0; });
    EXPECT_LT(surface, 2.01e-2);
    EXPECT_GT(surface, 1.9e-2);
}

RC_GTEST_PROP(SphereLight, SampleAndInverseAreARoundTrip, ()) {
    const SphereLight<double> light{10.0 * *direction(), *log_uniform(1e-3, 30)};
    const double u1 = *uniform(0.001, 1), u2 = *uniform(0, 1);
    const Vec wi = sample_sphere_light(light, Vec(0), u1, u2);
    const Sample2 back = inverse_sphere_light(light, Vec(0), wi);
    const double s = std::sqrt(one_minus_cos_half_angle(light, Vec(0)));
    RC_ASSERT(std::abs(glm::length(wi) - 1) < 1e-15);
    RC_ASSERT(std::abs(back.u1 - u1) < 1e-15 / s * 30);
    RC_ASSERT(std::abs(std::remainder(back.u2 - u2, 1.0)) < 1e-14 / s);
    RC_ASSERT(std::abs(pdf_solid_angle(light, Vec(0), wi) * solid_angle(light, Vec(0)) - 1) < 1e-12);
}

RC_GTEST_PROP(SphereLight, FloatSamplesHaveADensity, ()) {
    const Vec3<float> centre(10.0 * *direction());
    const SphereLight<float> light{centre, static_cast<float>(*log_uniform(1e-2, 9))};
    const Vec3<float> wi = sample_sphere_light(light, Vec3<float>(0), static_cast<float>(*unit_interval()),
                                               static_cast<float>(*unit_interval()));
    RC_ASSERT(std::abs(glm::length(wi) - 1) < 1e-6f);
    RC_ASSERT(pdf_solid_angle(light, Vec3<float>(0), wi) > 0);
}

TEST(SphereLight, SamplesFollowTheirDensity) {
    for (const double radius : {0.05, 1.0, 1.9, 5.0}) {  // the last from inside
        const SphereLight<double> light{{0, 0, 2}, radius};
        const double z_min = 1 - one_minus_cos_half_angle(light, Vec(0));
        const double p = chi_square_p_value(
            [&](double u1, double u2) { return sample_sphere_light(light, Vec(0), u1, u2); },
            [&](const Vec& wi) { return pdf_solid_angle(light, Vec(0), wi); }, z_min);
        EXPECT_GT(p, kSignificance) << radius;
    }
}

TEST(SphereLight, DensityIsZeroBesideIt) {
    const SphereLight<double> light{{0, 0, 2}, 1};
    EXPECT_EQ(pdf_solid_angle(light, Vec(0), Vec(0.6, 0, 0.8)), 0);
    EXPECT_EQ(pdf_solid_angle(light, Vec(0), Vec(0, 0, -1)), 0);
}

TEST(SphereLight, StructuredSamplingAndMostRepresentativePointErrAsStated) {
    const SphereLight<double> light{Vec(0), 0.5};
    const auto exact = [&](const Vec& p, const Vec& n) { return projected_solid_angle(light, p, n); };
    const auto whole = [&](const Vec& p) { return solid_angle(light, p); };
    const auto structured = [&](const Vec& p, const Vec& n) {
        return projected_solid_angle_structured(light, p, n);
    };
    const auto mrp = [&](const Vec& p, const Vec& n) { return projected_solid_angle_mrp(light, p, n); };
    const double rows[][3] = {{.55, .175, .50}, {1, .040, .44}, {2, .013, .24}, {4, .0024, .12}};
    for (const auto& [distance, by_structure, by_point] : rows) {
        EXPECT_NEAR(worst_error(distance, structured, exact, whole), by_structure, .05 * by_structure);
        EXPECT_NEAR(worst_error(distance, mrp, exact, whole), by_point, 5e-3);
    }
    EXPECT_EQ(structured(Vec(.1), Vec(0, 0, 1)), pi);
    EXPECT_EQ(mrp(Vec(.1), Vec(0, 0, 1)), pi);
    const SphereLight<double> none{Vec(0), 0};
    EXPECT_EQ(projected_solid_angle_structured(none, Vec(0, 0, 1), Vec(0, 0, -1)), 0);
    EXPECT_EQ(projected_solid_angle_mrp(none, Vec(0, 0, 1), Vec(0, 0, -1)), 0);
}

}  // namespace
}  // namespace pbr
