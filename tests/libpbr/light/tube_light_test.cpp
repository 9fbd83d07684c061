#include "pbr/light/tube_light.hpp"

#include <gtest/gtest.h>

#include "tests/libpbr/light/area_reference.hpp"
#include "tests/libpbr/support/chi_square.hpp"
#include "tests/libpbr/support/property.hpp"

namespace pbr {
namespace {

using std::numbers::pi;

const TubeLight<double> kTube{{-0.5, 0, 0}, {0.5, 0, 0}, 0.1};

/// Random, somewhere around the origin, which is outside and not too near for its rounding.
TubeLight<double> random_tube() {
    const Vec end0 = *log_uniform(0.3, 10) * *direction(), end1 = *log_uniform(0.3, 10) * *direction();
    const double nearest = glm::length(closest_point_on_segment(end0, end1, Vec(0)));
    RC_PRE(nearest > 0.02);
    return {end0, end1, nearest * *log_uniform(1e-3, 0.999)};
}

TEST(TubeLight, AgreesWithTheIntegralOverItsSurface) {
    const TubeLight<double> lights[] = {{{-1, 1, 1}, {1, 1, 1.5}, 0.2},       // above the horizon
                                        {{-1, 1, -0.5}, {1, 1, 1.5}, 0.3},    // across, one end below
                                        {{-1, 1, -0.1}, {1, 1, 0.1}, 0.3},    // along it
                                        {{1, 0.1, 0.5}, {3, 0.1, 0.5}, 0.3},  // its far end nearly hidden
                                        {{1, 0, 0.1}, {3, 0, 0.3}, 0.3}};     // hidden
    for (const TubeLight<double>& light : lights)
        EXPECT_NEAR(projected_solid_angle(light, Vec(0), Vec(0, 0, 1)),
                    reference_projected_solid_angle(light, Vec(0), Vec(0, 0, 1)),
                    1e-5);  // the reference's own error
}

RC_GTEST_PROP(TubeLight, IsSeenAsTheUnionOfItsBalls, ()) {
    // Not less than any ball within, not more than the ball around; and as large as a ray count says.
    const TubeLight<double> light = random_tube();
    const Vec n = *direction();
    const double E = projected_solid_angle(light, Vec(0), n), t = *unit_interval();
    RC_ASSERT(E >= 0 && E <= pi);
    const SphereLight<double> within{light.end0 + t * (light.end1 - light.end0), light.radius};
    RC_ASSERT(E >= projected_solid_angle(within, Vec(0), n) - 1e-13);
    const SphereLight<double> around{0.5 * (light.end0 + light.end1),
                                     0.5 * glm::length(light.end1 - light.end0) + light.radius};
    RC_ASSERT(E <= projected_solid_angle(around, Vec(0), n) + 1e-13);
}

RC_GTEST_PROP(TubeLight, MatchesARayCount, ()) {
    const TubeLight<double> light = random_tube();
    const AxisFrame<double> frame = frame_about(*direction());
    constexpr int kSide = 110;
    int hits = 0;
    for (int i = 0; i < kSide * kSide; ++i) {  // cosine-weighted stratified directions above the horizon
        const Sample2 u = hammersley(i, kSide * kSide);
        const double r = std::sqrt(u.u1), phi = 2 * pi * u.u2;
        const Vec wi = frame.to_world({r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u.u1)});
        // Distance between the ray and the axis' segment, by ternary search: it is convex along the segment.
        double low = 0, high = 1;
        const auto distance = [&](double t) {
            const Vec x = light.end0 + t * (light.end1 - light.end0);
            return glm::length(x - std::max(0.0, glm::dot(x, wi)) * wi);
        };
        for (int k = 0; k < 18; ++k) {
            const double a = low + 0.382 * (high - low), b = high - 0.382 * (high - low);
            (distance(a) < distance(b) ? high : low) = distance(a) < distance(b) ? b : a;
        }
        hits += distance(0.5 * (low + high)) < light.radius ? 1 : 0;
    }
    RC_ASSERT(std::abs(projected_solid_angle(light, Vec(0), frame.z) - pi * hits / (kSide * kSide)) < 1e-2);
}

RC_GTEST_PROP(TubeLight, OfNoLengthIsASphere, ()) {
    const SphereLight<double> sphere{*log_uniform(1.01, 30) * *direction(), 1};
    const Vec n = *direction(), along = *direction();
    const double exact = projected_solid_angle(sphere, Vec(0), n);
    RC_ASSERT(projected_solid_angle(TubeLight<double>{sphere.centre, sphere.centre, 1}, Vec(0), n) == exact);
    // Two balls' worth of arcs that nearly agree: other code, the same answer.
    const TubeLight<double> shortest{sphere.centre, sphere.centre + 1e-9 * along, 1};
    RC_ASSERT(std::abs(projected_solid_angle(shortest, Vec(0), n) - exact) < 2e-8);
}

RC_GTEST_PROP(TubeLight, IsContinuousWhereTheNearEndHidesTheRest, ()) {
    // p crosses the cylinder's mantle, prolonged beyond the end.
    const double beyond = *log_uniform(0.01, 5), tilt = *uniform(0, pi), azimuth = *uniform(0, 2 * pi);
    const Vec n(std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt));
    const auto at = [&](double offset) {
        return projected_solid_angle(TubeLight<double>{{0, offset, 0}, {3, offset, 0}, 1},
                                     Vec(-1 - beyond, 0, 0), n);
    };
    RC_ASSERT(std::abs(at(1 - 1e-9) - at(1 + 1e-9)) < 1e-6);
}

RC_GTEST_PROP(TubeLight, DoesNotDependOnTheFrame, ()) {
    const TubeLight<double> light = random_tube();
    const Vec n = *direction(), shift = 5.0 * *direction();
    const AxisFrame<double> frame = frame_about(*direction());
    const double E = projected_solid_angle(light, Vec(0), n);
    const double nearest = glm::length(closest_point_on_segment(light.end0, light.end1, Vec(0)));
    const TubeLight<double> turned{frame.to_world(light.end1) + shift, frame.to_world(light.end0) + shift,
                                   light.radius};
    RC_ASSERT(std::abs(projected_solid_angle(turned, shift, frame.to_world(n)) - E) <
              1e-12 * (1 + 1 / nearest));
}

TEST(TubeLight, IsContinuousAcrossTheHorizon) {
    double before = -1;
    for (int i = 0; i <= 36000; ++i) {
        const double turn = radians(i * 0.01);
        const double E = projected_solid_angle(kTube, Vec(0.3, 0, 0.4),
                                               Vec(std::cos(turn), 0.1, std::sin(turn)) / std::sqrt(1.01));
        if (before >= 0) {
            ASSERT_NEAR(E, before, 2e-4) << i;
        }
        before = E;
    }
}

TEST(TubeLight, SurroundsAPointInsideAndIsDarkWithoutRadius) {
    for (const Vec& n : {Vec(0, 0, 1), Vec(1, 0, 0)}) {
        for (const Vec& p : {Vec(0), Vec(0.5, 0.09, 0), Vec(-0.59, 0, 0)}) {
            EXPECT_EQ(projected_solid_angle(kTube, p, n), pi);
            EXPECT_EQ(projected_solid_angle_structured(kTube, p, n), pi);
        }
        const TubeLight<double> line{kTube.end0, kTube.end1, 0};
        EXPECT_EQ(projected_solid_angle(line, Vec(0, 0, 1), n), 0);
        EXPECT_EQ(projected_solid_angle_structured(line, Vec(0, 0, 1), n), 0);
        EXPECT_EQ(projected_solid_angle_structured(line, Vec(0), n), 0);
    }
    EXPECT_NEAR(projected_solid_angle(kTube, Vec(0, 0, 0.1 + 1e-12), Vec(0, 0, -1)), pi, 1e-5);
    EXPECT_NEAR(projected_solid_angle(kTube, Vec(2, 0, 0.1), Vec(-1, 0, 0)),
                pi * 0.01 / (2.25 + 0.01) * 1.5 / std::sqrt(2.26), 1e-14);
}

TEST(TubeLight, FarAwayIsAPoint) {
    // Across it shows the cylinder's section 2 r l and the caps' pi r^2.
    const double section = 2 * 0.1 * 1 + pi * 0.01;
    EXPECT_NEAR(projected_solid_angle(kTube, Vec(0, 0, 1e4), Vec(0, 0, -1)) * 1e8 / section, 1, 1e-5);
    const TubeLight<float> light{{-0.5f, 0, 0}, {0.5f, 0, 0}, 0.1f};
    EXPECT_NEAR(projected_solid_angle(light, Vec3<float>(0, 0, 1e4f), Vec3<float>(0, 0, -1)) * 1e8 / section,
                1, 1e-5);
}

TEST(TubeLight, ThinAndLongIsALine) {
    // An endless line of radius r at height h over a facing receiver: E/L = pi r / h.
    const TubeLight<double> light{{-1e5, 0, 1}, {1e5, 0, 1}, 1e-4};
    EXPECT_NEAR(projected_solid_angle(light, Vec(0), Vec(0, 0, 1)) / (pi * 1e-4), 1, 1e-6);
}

const auto kExact = [](const Vec& p, const Vec& n) { return projected_solid_angle(kTube, p, n); };
const auto kFacing = [](const Vec& p) { return projected_solid_angle(kTube, p, -glm::normalize(p)); };

TEST(TubeLight, StructuredSamplingErrsAsStated) {
    const auto structured = [](const Vec& p, const Vec& n) {
        return projected_solid_angle_structured(kTube, p, n);
    };
    const auto beside = [&](double d) {
        return structured(Vec(0, 0, d), Vec(0, 0, -1)) / kExact(Vec(0, 0, d), Vec(0, 0, -1));
    };
    EXPECT_NEAR(beside(0.12), 1.23, 5e-3);
    EXPECT_NEAR(beside(0.52), 0.990, 5e-4);
    EXPECT_NEAR(beside(1), 0.997, 5e-4);
    EXPECT_NEAR(worst_error(0.75, structured, kExact, kFacing), 0.25, 5e-3);
    EXPECT_NEAR(worst_error(1, structured, kExact, kFacing), 0.244, 5e-3);
    EXPECT_NEAR(worst_error(4, structured, kExact, kFacing), 0.142, 5e-3);
    EXPECT_GT(structured(Vec(0, 0, 0.1001), Vec(0, 0, -1)), 1.2 * pi);  // beyond what any light can give
}

TEST(TubeLight, MostRepresentativePointErrsAsStated) {
    const auto mrp = [](const Vec& p, const Vec& n) { return projected_solid_angle_mrp(kTube, p, n); };
    EXPECT_NEAR(worst_error(0.75, mrp, kExact, kFacing), 0.47, 5e-3);
    EXPECT_NEAR(worst_error(4, mrp, kExact, kFacing), 0.14, 5e-3);
    EXPECT_EQ(projected_solid_angle_mrp(kTube, Vec(0), Vec(0, 0, 1)), pi);
}

RC_GTEST_PROP(TubeLight, AreaSampleAndInverseAreARoundTrip, ()) {
    const TubeLight<double> light = random_tube();
    const double u1 = *uniform(0.001, 0.999), u2 = *uniform(0, 1);
    const Vec x = sample_tube_area(light, u1, u2);
    const double scale = 1 + (glm::length(light.end0) + glm::length(light.end1)) / light.radius;
    RC_ASSERT(std::abs(glm::length(x - closest_point_on_segment(light.end0, light.end1, x)) / light.radius -
                       1) < 1e-14 * scale);
    const Sample2 back = inverse_tube_area(light, x);
    RC_ASSERT(std::abs(back.u1 - u1) < 1e-14 * scale);
    const double turn = std::remainder(back.u2 - u2, 1.0);
    RC_ASSERT(std::abs(turn) < 1e-12 * scale);
}

TEST(TubeLight, AreaSamplesHaveTheSurfacesMoments) {
    // E[f] against the integral of f over the surface, by the reference's own parametrisation.
    const TubeLight<double> light{{1, 2, 3}, {1.5, 2.5, 2}, 0.8};
    const auto f = [](const Vec& x) { return x.x * x.x + x.y * x.z; };
    const double area = integrate_surface(
        light, [](const Vec&, const Vec&) { return 1.0; }, 1e-9);
    EXPECT_NEAR(area / surface_area(light), 1, 1e-9);
    EXPECT_NEAR(area * pdf_area(light), 1, 1e-9);
    const double expected = integrate_surface(
                                light, [&](const Vec& x, const Vec&) { return f(x); }, 1e-9) /
                            area;
    constexpr int kCount = 1 << 16;
    double mean = 0;
    for (int i = 0; i < kCount; ++i) {
        const Sample2 u = hammersley(i, kCount);
        mean += f(sample_tube_area(light, u.u1, u.u2)) / kCount;
    }
    EXPECT_NEAR(mean, expected, 1e-3);
}

TEST(TubeLight, AreaSamplesAreUniform) {
    // Twelve bands of equal height, so of equal area by Archimedes, by sixteen sectors.
    const TubeLight<double> light{{1, 2, 3}, {1.5, 2.5, 2}, 0.8};
    const double length = glm::length(light.end1 - light.end0);
    const Vec axis = (light.end1 - light.end0) / length;
    const auto [x, y] = plane_of(axis);
    constexpr int kCount = 100'000;
    std::vector<double> observed(12 * 16), expected(12 * 16, kCount / 192.0);
    for (int i = 0; i < kCount; ++i) {
        const Vec at = sample_tube_area(light, random_unit(7, i, 0), random_unit(7, i, 1)) - light.end0;
        const double share = (glm::dot(at, axis) + light.radius) / (length + 2 * light.radius);
        const double turns = std::atan2(glm::dot(at, y), glm::dot(at, x)) / (2 * pi) + .5;
        observed[std::clamp(int(12 * share), 0, 11) * 16 + std::min(15, int(16 * turns))] += 1;
    }
    EXPECT_GT(pearson_p_value(observed, expected), kSignificance);
}

}  // namespace
}  // namespace pbr
