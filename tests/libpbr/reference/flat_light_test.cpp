#include "pbr/reference/flat_light.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pbr/reference/reflected_radiance.hpp"
#include "tests/libpbr/reference/lobes.hpp"

namespace pbr {
namespace {

TEST(ReflectedFromParallelogram, IsTheFormFactorOfARectangle) {
    // Parallel and above a corner: Howell, catalogue B-4 (corner form factor over pi), four of them for the
    // middle.
    const auto corner = [](double a, double b) {
        const double ra = std::sqrt(1 + a * a), rb = std::sqrt(1 + b * b);
        return (a / ra * std::atan(b / ra) + b / rb * std::atan(a / rb)) / (2 * kPi);
    };
    const FlatLight light{{0, 0, 2}, {0, 1, 0}, {3, 0, 0}};  // faces down
    expect_holds(reflected_radiance_from_parallelogram(lambert, view(0.5), light, one), 4 * corner(0.5, 1.5));
    const FlatLight back{{0, 0, 2}, {3, 0, 0}, {0, 1, 0}};
    EXPECT_EQ(reflected_radiance_from_parallelogram(lambert, view(0.5), back, one).value, 0);
    // A wall that stands on the surface's horizon, half of it below: B-5, perpendicular, above a corner.
    const FlatLight wall{{0, 2, 0}, {1, 0, 0}, {0, 0, 3}};
    const auto perpendicular = [](double a, double h,
                                  double d) {  // a wide, h high, at distance d, one side at the point
        const double r = std::hypot(h, d);
        return (std::atan(a / d) - d / r * std::atan(a / r)) / (2 * kPi);
    };
    expect_holds(reflected_radiance_from_parallelogram(lambert, view(0.5), wall, one),
                 2 * perpendicular(1, 3, 2));
}

TEST(ReflectedFromParallelogram, SkewedAndAcrossTheHorizonIsWhatDirectionsGive) {
    const FlatLight light{{0.5, 1.5, 0.3}, {0.7, 0.2, 0.4}, {-0.2, 0.3, 0.9}};
    const Ggx brdf{0.4};
    const Vec3<double> wo = view(0.5, -1);
    const Vec3<double> normal = glm::cross(light.half_u, light.half_v);
    ASSERT_LT(glm::dot(light.centre, normal), 0);  // faces the point
    const auto lit = [&](const Vec3<double>& w) {
        const double slope = glm::dot(w, normal), t = glm::dot(light.centre, normal) / slope;
        if (!(slope < 0)) return 0.0;
        const Vec3<double> offset = t * w - light.centre;
        const double area2 = glm::dot(normal, normal);
        const double u = glm::dot(glm::cross(offset, light.half_v), normal) / area2;
        const double v = glm::dot(glm::cross(light.half_u, offset), normal) / area2;
        return std::abs(u) < 1 && std::abs(v) < 1 ? 1.0 : 0.0;
    };
    const double by_area = reflected_radiance_from_parallelogram(brdf, wo, light, one).value;
    EXPECT_NEAR(reflected_radiance(brdf, wo, lit, {1e-4, 0, 1'000'000}).value, by_area, 3e-4 * by_area);
}

TEST(ReflectedFromParallelogram, MirrorImageOfALightIsItsRadiance) {
    const double alpha = 1e-3;
    const Vec3<double> wo = view(0.6), mirror(-wo.x, -wo.y, wo.z);
    const Vec3<double> side = glm::normalize(glm::cross(mirror, Vec3<double>(0, 0, 1)));
    const FlatLight light{2.0 * mirror + 0.1 * side, side, glm::cross(side, mirror)};
    const Peak peak{mirror, alpha};
    ASSERT_LT(glm::dot(light.centre, glm::cross(light.half_u, light.half_v)), 0);
    const Estimate e =
        reflected_radiance_from_parallelogram(Ggx{alpha}, wo, light, one, {1e-7}, std::span(&peak, 1));
    EXPECT_NEAR(e.value, 1, 1e-4);
}

TEST(ReflectedFromDisk, IsTheFormFactorOfADisk) {
    for (const double height : {0.1, 1.0, 20.0}) {  // r^2 / (r^2 + h^2), above its centre
        const FlatLight light{{0, 0, height}, {0, 1.5, 0}, {1.5, 0, 0}};
        expect_holds(reflected_radiance_from_disk(lambert, view(0.5), light, one),
                     2.25 / (2.25 + height * height));
    }
}

TEST(ReflectedFromDisk, FacingThePointIsTheCapThatItFills) {
    // Seen from the point a disk square to its direction fills a cap exactly, across the horizon too.
    for (const double degrees : {10.0, 70.0, 90.0, 105.0}) {
        const double w = degrees * kPi / 180;
        const Vec3<double> axis(0.6 * std::sin(w), 0.8 * std::sin(w), std::cos(w));
        const Vec3<double> side = glm::normalize(glm::cross(axis, Vec3<double>(0, 0, 1)));
        const FlatLight light{axis, std::tan(0.5) * side, std::tan(0.5) * glm::cross(side, axis)};
        const Ggx brdf{0.4};
        const double cap = reflected_radiance_from_cap(brdf, view(0.5), {axis, 0.5}, one).value;
        EXPECT_NEAR(reflected_radiance_from_disk(brdf, view(0.5), light, one).value, cap, 1e-8) << degrees;
    }
}

TEST(ReflectedFromFlatLight, InItsPlaneOrBehindItIsNothing) {
    const FlatLight light{{0, 0, 0.0}, {1, 0, 0}, {0, 0.5, 0.8}};  // the point lies in its plane
    EXPECT_EQ(reflected_radiance_from_parallelogram(lambert, view(0.5), light, one).value, 0);
    EXPECT_EQ(reflected_radiance_from_disk(lambert, view(0.5), light, one).value, 0);
    const FlatLight below{{0, 0, -2}, {0, 1, 0}, {1, 0, 0}};
    EXPECT_EQ(reflected_radiance_from_parallelogram(lambert, view(0.5), below, one).value, 0);
    EXPECT_EQ(reflected_radiance_from_disk(lambert, view(0.5), below, one).value, 0);
}

}  // namespace
}  // namespace pbr
