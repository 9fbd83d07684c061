#include "pbr/light/area_specular.hpp"

#include <gtest/gtest.h>

#include "pbr/reference/reflected_radiance.hpp"
#include "tests/libpbr/light/area_reference.hpp"
#include "tests/libpbr/support/property.hpp"

namespace pbr {
namespace {

using std::numbers::pi;

Vec reflected(const Vec& n, const Vec& wo) { return 2 * glm::dot(n, wo) * n - wo; }

/// Lights of one angular size at distance 2 towards `direction`, all facing the origin.
SphereLight<double> sphere_at(const Vec& direction, double size) { return {2.0 * direction, 2 * size}; }
DiskLight<double> disk_at(const Vec& direction, double size) {
    return {2.0 * direction, -direction, 2 * size, Emission::one_sided};
}
RectangleLight<double> rectangle_at(const Vec& direction, double size) {
    const Vec y(0, 2 * size, 0);
    return {2.0 * direction, glm::cross(y, -direction), y, Emission::one_sided};
}
/// As long as it is far away, lying across the plane of incidence; its radius is a fifth of the size.
TubeLight<double> tube_at(const Vec& direction, double size) {
    return {2.0 * direction - Vec(0, 1, 0), 2.0 * direction + Vec(0, 1, 0), 0.4 * size};
}

struct Ratios {
    double lowest = 1e9, highest = 0;
};

/// Representative point over brute force, for views at 10, 45 and 75 deg and lights whose centre is 0, 1/2, 1
/// and 2 of their own angular radius from the mirror direction, towards the normal.
template <class MakeLight>
Ratios ratios(const MakeLight& make_light, double size, double alpha, double widening) {
    Ratios result;
    for (const double view : {10.0, 45.0, 75.0})
        for (const double off : {0.0, 0.5, 1.0, 2.0}) {
            const double theta = radians(view), light_theta = theta - off * std::asin(size);
            const Vec n(0, 0, 1), wo(std::sin(theta), 0, std::cos(theta));
            const auto light = make_light(Vec(-std::sin(light_theta), 0, std::cos(light_theta)), size);
            const SpecularSurface<double> surface{Vec(0), n, wo, alpha, 1.0};
            const auto lobe = [&](const Vec& wi) { return f_specular(surface, wi) * std::max(wi.z, 0.0); };
            const double exact = integrate_light(light, Vec(0), lobe, 1e-4);
            const double ratio = reflected_luminance_mrp(light, surface, reflected(n, wo), widening) / exact;
            result.lowest = std::min(result.lowest, ratio);
            result.highest = std::max(result.highest, ratio);
        }
    return result;
}

struct Row {
    double size, alpha, lowest, highest;
};

template <class MakeLight>
void expect_ratios(const MakeLight& make_light, double widening, const std::vector<Row>& rows) {
    for (const Row& row : rows) {
        const Ratios got = ratios(make_light, row.size, row.alpha, widening);
        EXPECT_NEAR(got.lowest, row.lowest, 6e-3 * row.lowest + 6e-4) << row.size << ' ' << row.alpha;
        EXPECT_NEAR(got.highest, row.highest, 6e-3 * row.highest + 6e-4) << row.size << ' ' << row.alpha;
    }
}

TEST(AreaSpecular, SphereErrsAsStated) {
    expect_ratios(sphere_at, kCourseNotesWidening,
                  {{.05, .1, .780, 1.444},
                   {.05, .5, .938, 1.058},
                   {.2, .1, .718, 4.648},
                   {.2, .25, .712, 1.956},
                   {.2, .5, .795, 1.353},
                   {.5, .25, .680, 5.237},
                   {.5, .5, .638, 2.255},
                   {.5, 1, .865, 1.806}});
    expect_ratios(sphere_at, kShaderWidening,
                  {{.05, .1, .680, 1.258},
                   {.05, .5, .908, 1.024},
                   {.2, .1, .499, 3.228},
                   {.2, .25, .583, 1.601},
                   {.2, .5, .709, 1.207},
                   {.5, .25, .472, 3.637},
                   {.5, .5, .504, 1.782}});
}

TEST(AreaSpecular, TubeErrsAsStated) {
    expect_ratios(tube_at, kCourseNotesWidening,
                  {{.2, .1, .365, 2.219}, {.2, .5, .613, 1.101}, {.2, 1, .977, 1.043}});
    expect_ratios(tube_at, kShaderWidening, {{.2, .1, .235, 1.429}, {.2, .5, .498, .894}});
}

TEST(AreaSpecular, DiskAndRectangleErrAsStated) {
    expect_ratios(disk_at, kShaderWidening,
                  {{.05, .1, 1.062, 1.964},
                   {.05, .5, 1.001, 1.129},
                   {.2, .1, 1.957, 12.542},
                   {.2, .25, 1.137, 3.065},
                   {.2, .5, 1.021, 1.716}});
    expect_ratios(rectangle_at, kShaderWidening,
                  {{.05, .1, 1.082, 2.101},
                   {.05, .5, 1.002, 1.134},
                   {.2, .1, 2.225, 15.051},
                   {.2, .25, 1.178, 3.407},
                   {.2, .5, 1.027, 1.781}});
}

TEST(AreaSpecular, FSpecularIsTheTextbooksMicrofacetBrdf) {
    const double alpha = 0.3, f0 = 0.04;
    const Vec n = glm::normalize(Vec(0.1, 0.2, 1)), wo = glm::normalize(Vec(1, 0, 1)),
              wi = glm::normalize(Vec(-0.5, 0.6, 0.7));
    const Vec h = glm::normalize(wo + wi);
    const double c = glm::dot(n, h), a2 = alpha * alpha, tan2 = 1 / (c * c) - 1;
    const double D = a2 / (pi * std::pow(c, 4) * std::pow(a2 + tan2, 2));
    const auto lambda = [&](const Vec& w) {
        const double m = glm::dot(n, w);
        return (std::sqrt(1 + a2 * (1 / (m * m) - 1)) - 1) / 2;
    };
    const double G = 1 / (1 + lambda(wo) + lambda(wi)), F = f0 + (1 - f0) * std::pow(1 - glm::dot(wo, h), 5);
    const SpecularSurface<double> surface{Vec(0), n, wo, alpha, f0};
    EXPECT_NEAR(f_specular(surface, wi), D * G * F / (4 * glm::dot(n, wo) * glm::dot(n, wi)), 1e-14);
    EXPECT_EQ(f_specular(surface, -n), 0);
}

RC_GTEST_PROP(AreaSpecular, SmallLightsArePoints, ()) {
    const double alpha = *uniform(0.2, 1), theta = *uniform(0, 1.2);
    const Vec n(0, 0, 1), wo(std::sin(theta), 0, std::cos(theta)), wi = *direction(0.1);
    const SpecularSurface<double> surface{Vec(0), n, wo, alpha, 0.5};
    const double size = 1e-6, expected = f_specular(surface, wi) * wi.z;
    for (const double got :
         {reflected_luminance_mrp(sphere_at(wi, size), surface, reflected(n, wo), kShaderWidening) /
              solid_angle(sphere_at(wi, size), Vec(0)),
          reflected_luminance_mrp(disk_at(wi, size), surface, reflected(n, wo), kShaderWidening) /
              solid_angle(disk_at(wi, size), Vec(0)),
          reflected_luminance_mrp(rectangle_at(wi, size), surface, reflected(n, wo), kShaderWidening) /
              solid_angle(rectangle_at(wi, size), Vec(0))})
        RC_ASSERT(std::abs(got - expected) < 1e-3 * expected);
}

/// The nearest distance between the ray from the origin along r and points of the light, by a dense search.
template <class Light>
double searched_distance(const Light& light, const Vec& r) {
    double nearest = 1e9;
    for (int i = 0; i <= 400; ++i) {
        const Vec x = light.end0 + i / 400.0 * (light.end1 - light.end0);
        nearest = std::min(nearest, glm::length(x - glm::dot(x, r) * r));
    }
    return std::max(nearest - light.radius, 0.0);
}

RC_GTEST_PROP(AreaSpecular, RepresentativePointIsNearestToTheRay, ()) {
    const Vec r = *direction();
    const TubeLight<double> tube{*log_uniform(0.5, 3) * *direction(), *log_uniform(0.5, 3) * *direction(),
                                 *log_uniform(0.01, 0.3)};
    const Vec point = representative_point(tube, Vec(0), r);
    const double distance = glm::length(point - glm::dot(point, r) * r);
    RC_ASSERT(std::abs(distance - searched_distance(tube, r)) < 0.01);
    RC_ASSERT(glm::length(point - closest_point_on_segment(tube.end0, tube.end1, point)) <
              tube.radius * (1 + 1e-9));
}

RC_GTEST_PROP(AreaSpecular, RepresentativePointOfFlatLightsIsTheHitWhereTheRayHits, ()) {
    const double a = *uniform(-0.9, 0.9), b = *uniform(-0.9, 0.9);
    const auto [x, y] = plane_of(*direction());
    const Vec centre = 3.0 * *direction();
    RC_PRE(std::abs(glm::dot(glm::cross(x, y), centre)) > 0.3);
    const RectangleLight<double> rectangle{centre, x, 0.5 * y, Emission::two_sided};
    const Vec target = centre + a * x + 0.5 * b * y;
    RC_ASSERT(glm::length(representative_point(rectangle, Vec(0), glm::normalize(target)) - target) < 1e-12);
    const DiskLight<double> disk{centre, glm::cross(x, y), 1.5, Emission::two_sided};
    RC_ASSERT(glm::length(representative_point(disk, Vec(0), glm::normalize(target)) - target) < 1e-12);
    // Elsewhere it is on the light.
    const Vec r = *direction();
    RC_ASSERT(glm::length(representative_point(disk, Vec(0), r) - centre) < 1.5 * (1 + 1e-12));
    const Vec corner = representative_point(rectangle, Vec(0), r) - centre;
    RC_ASSERT(std::abs(glm::dot(corner, x)) < 1 + 1e-12 && std::abs(glm::dot(corner, y)) < 0.5 + 1e-12);
}

TEST(AreaSpecular, NormalisationIsOneForAPointAndForFlatLights) {
    EXPECT_EQ(specular_normalisation(sphere_at(Vec(0, 0, 1), 0), Vec(0), 0.3, kShaderWidening), 1);
    EXPECT_EQ(specular_normalisation(disk_at(Vec(0, 0, 1), 0.5), Vec(0), 0.3, kShaderWidening), 1);
    EXPECT_EQ(specular_normalisation(rectangle_at(Vec(0, 0, 1), 0.5), Vec(0), 0.3, kShaderWidening), 1);
    EXPECT_NEAR(specular_normalisation(sphere_at(Vec(0, 0, 1), 0.2), Vec(0), 0.1, kShaderWidening), 0.25,
                1e-15);
    EXPECT_NEAR(specular_normalisation(sphere_at(Vec(0, 0, 1), 0.3), Vec(0), 0.1, kCourseNotesWidening), 0.25,
                1e-15);
    EXPECT_EQ(specular_normalisation(sphere_at(Vec(0, 0, 1), 0.3), Vec(0), 1.0, kShaderWidening),
              1);  // clamped
    EXPECT_NEAR(specular_normalisation(tube_at(Vec(0, 0, 1), 0), Vec(0), 0.5, kShaderWidening), 0.5, 1e-15);
}

TEST(AreaSpecular, DominantDirectionGoesFromMirrorToNormal) {
    const Vec n(0, 0, 1), wo(0.6, 0, 0.8);
    EXPECT_LT(glm::length(dominant_direction_area(n, wo, 0.0) - Vec(-0.6, 0, 0.8)), 1e-15);
    EXPECT_LT(glm::length(dominant_direction_area(n, wo, 1.0) - n), 1e-15);
    const Vec quarter = dominant_direction_area(n, wo, 0.25);
    EXPECT_NEAR(quarter.x / quarter.z, -0.45 / 0.85, 1e-15);
}

TEST(AreaSpecular, DominantDirectionTakesAlphaAsItIsNearerToTheLobesMean) {
    const Vec n(0, 0, 1);
    double by_alpha = 0, by_perceptual = 0;
    int count = 0;
    for (const double alpha : {.1, .25, .5, .75, 1.0})
        for (const double NoV : {.1, .3, .5, .7, .9}) {
            const Vec wo(std::sqrt(1 - NoV * NoV), 0, NoV);
            const SpecularSurface<double> surface{Vec(0), n, wo, alpha, 1.0};
            const auto component = [&](int axis) {
                return reflected_radiance_half_vector(
                           [&](const Vec&, const Vec& wi) { return f_specular(surface, wi); }, wo,
                           [&](const Vec& wi) { return wi[axis]; }, alpha, {1e-5, 1e-6})
                    .value;
            };
            const Vec mean = glm::normalize(Vec(component(0), 0, component(2)));
            const auto off = [&](const Vec& d) {
                return std::acos(std::min(glm::dot(d, mean), 1.0)) * 180 / pi;
            };
            by_alpha += off(dominant_direction_area(n, wo, alpha));
            by_perceptual += off(dominant_direction_area(n, wo, std::sqrt(alpha)));
            ++count;
        }
    EXPECT_NEAR(by_alpha / count, 3.61, .01);
    EXPECT_NEAR(by_perceptual / count, 7.16, .01);
}

RC_GTEST_PROP(AreaSpecular, IsFiniteEverywhere, ()) {
    const Vec n = *direction(), wo = *direction(), towards = *direction();
    RC_PRE(glm::dot(n, wo) > 0);
    const double size = *uniform(0, 2), alpha = std::max(*unit_interval(), 1e-3);
    const SpecularSurface<double> surface{Vec(0), n, wo, alpha, *unit_interval()};
    const Vec r = reflected(n, wo);
    for (const double got :
         {reflected_luminance_mrp(sphere_at(towards, size), surface, r, kShaderWidening),
          reflected_luminance_mrp(disk_at(towards, size), surface, r, kShaderWidening),
          reflected_luminance_mrp(rectangle_at(towards, size), surface, r, kShaderWidening),
          reflected_luminance_mrp(tube_at(towards, size), surface, r, kShaderWidening)})
        RC_ASSERT(std::isfinite(got) && got >= 0);
}

}  // namespace
}  // namespace pbr
