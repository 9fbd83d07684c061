#include "pbr/reference/tube_light.hpp"

#include <gtest/gtest.h>

#include "tests/libpbr/light/area_reference.hpp"
#include "tests/libpbr/reference/lobes.hpp"

namespace pbr {
namespace {

const TubeLight<double> kTubes[] = {{{-1, 1, 1}, {1, 1, 1.5}, 0.2},       // above the horizon
                                    {{-1, 1, -0.5}, {1, 1, 1.5}, 0.3},    // across, one end below
                                    {{-1, 1, -0.1}, {1, 1, 0.1}, 0.3},    // along it
                                    {{1, 0.1, 2.5}, {1, 0.1, 0.5}, 0.3},  // upright
                                    {{1, 0.1, 0.5}, {3, 0.1, 0.5}, 0.3},  // its far end nearly hidden
                                    {{1, 0, 0.1}, {3, 0, 0.3}, 0.3},      // hidden
                                    {{1, 0, 0.8}, {1, 0, 0.8}, 0.4},      // a sphere
                                    {{-1, 0, 0.1}, {1, 0, 0.1}, 0.4}};    // all around

TEST(ReflectedFromTube, OfLambertIsTheClosedForm) {
    // The closed form goes round the outline and shares nothing with an integral over directions.
    for (const TubeLight<double>& tube : kTubes) {
        const Estimate e = reflected_radiance_from_tube(lambert, view(0.5), tube, one, {1e-14, 1e-16});
        EXPECT_NEAR(e.value * kPi, projected_solid_angle(tube, Vec(0), Vec(0, 0, 1)), 1e-13) << tube.end0.x;
    }
}

TEST(ReflectedFromTube, OfALobeIsTheIntegralOverTheSurface) {
    const Ggx brdf{0.4};
    for (int i = 0; i < 4; ++i) {
        const Vec wo = view(0.5, -1);
        const auto lobe = [&](const Vec& wi) { return wi.z > 0 ? brdf(wo, wi) * wi.z : 0.0; };
        const double by_area = integrate_light(kTubes[i], Vec(0), lobe, 1e-5);
        EXPECT_NEAR(reflected_radiance_from_tube(brdf, wo, kTubes[i], one, {1e-7}).value, by_area,
                    1e-3 * by_area);
    }
}

TEST(ReflectedFromTube, MirrorImageOfATubeIsItsRadiance) {
    const double alpha = 1e-3;
    const Vec wo = view(0.6), mirror(-wo.x, -wo.y, wo.z),
              side = glm::normalize(glm::cross(mirror, Vec(0, 0, 1)));
    const Peak peak{mirror, alpha};
    const TubeLight<double> tube{2.0 * mirror - side, 2.0 * mirror + side, 0.4};
    const Estimate e = reflected_radiance_from_tube(Ggx{alpha}, wo, tube, one, {1e-7}, std::span(&peak, 1));
    EXPECT_NEAR(e.value, 1, 4e-4);  // the lobe's tail beyond the near rim, .2 rad away: (2 alpha / .2)^2
    EXPECT_LT(e.value, 1);
}

}  // namespace
}  // namespace pbr
