#include "pbr/ibl/distance_roughness.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "pbr/brdf/ggx_sampling.hpp"
#include "tests/libpbr/support/property.hpp"

namespace pbr {
namespace {

/// Radius of the footprint of a share of D NoH on a wall square to the cone's axis, by the sampler of D NoH.
double footprint(double alpha, double share, double distance) {
    const Vec3<double> rim = sample_ggx_ndf(alpha, share, 0.0);
    return distance * std::hypot(rim.x, rim.y) / rim.z;
}

RC_GTEST_PROP(DistanceRoughness, AlphaKeepsTheFootprintOfEveryShare, ()) {
    const double alpha = *uniform(1e-3, 1), share = *uniform(0.01, 0.99), far = *uniform(0.1, 10),
                 near = far * *uniform(0.01, 1);
    const double adjusted = distance_based_alpha(near, far, alpha);
    RC_ASSERT(std::abs(footprint(adjusted, share, far) / footprint(alpha, share, near) - 1) < 1e-12);
}

RC_GTEST_PROP(DistanceRoughness, StaysBetweenZeroAndTheOriginal, ()) {
    const double near = *unit_interval() * 5, far = *unit_interval() * 5, r = *unit_interval();
    for (const double adjusted :
         {distance_based_alpha(near, far, r), distance_based_perceptual_roughness(near, far, r)}) {
        RC_ASSERT(adjusted >= 0);
        RC_ASSERT(adjusted <= r * (1 + 1e-15));
    }
    const auto single = distance_based_perceptual_roughness(static_cast<float>(near), static_cast<float>(far),
                                                            static_cast<float>(r));
    if (std::abs(near - far) > 1e-6)
        RC_ASSERT(std::abs(single - distance_based_perceptual_roughness(near, far, r)) < 1e-6);
}

TEST(DistanceRoughness, EdgesLeaveTheOriginal) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (const auto f : {distance_based_alpha<double>, distance_based_perceptual_roughness<double>}) {
        EXPECT_EQ(f(0, 0, 0.5), 0.5);
        EXPECT_EQ(f(kInfinity, kInfinity, 0.5), 0.5);
        EXPECT_EQ(f(2, 1, 0.5), 0.5);
        EXPECT_EQ(f(0, 1, 0.0), 0);
        EXPECT_EQ(f(1, kInfinity, 1.0), f == &distance_based_alpha<double> ? 0 : 1);
    }
    EXPECT_EQ(distance_based_alpha(0.0, 1.0, 0.5), 0);
    EXPECT_EQ(distance_based_perceptual_roughness(0.0, 1.0, 0.5), 0.25);
}

TEST(DistanceRoughness, FrostbitesFormMissesTheFootprintByTheStatedFigures) {
    const auto exact = [](double p, double ratio) {
        return std::sqrt(distance_based_alpha(ratio, 1.0, p * p));
    };
    EXPECT_NEAR(distance_based_perceptual_roughness(.1, 1.0, .1), .019, 5e-4);
    EXPECT_NEAR(exact(.1, .1), .032, 5e-4);
    EXPECT_NEAR(distance_based_perceptual_roughness(.1, 1.0, .6), .384, 5e-4);
    EXPECT_NEAR(exact(.6, .1), .19, 5e-4);
}

}  // namespace
}  // namespace pbr
