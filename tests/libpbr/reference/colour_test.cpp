#include "pbr/reference/colour.hpp"

#include <gtest/gtest.h>

#include "pbr/brdf/material.hpp"
#include "pbr/brdf/material_effects.hpp"
#include "pbr/reference/reflected_radiance.hpp"
#include "tests/libpbr/reference/lobes.hpp"
#include "tests/libpbr/support/integrate.hpp"

namespace pbr {
namespace {

TEST(ReflectedColour, OfAMaterialUnderASphereLightIsTheSumOverItsCap) {
    const Material material(StandardMaterial<double>{{.8, .5, .2}, .4, 0, .5}, ClearCoat<double>{.7, .2});
    const SphericalCap cap = cap_of_sphere({.5, -1, 1.5}, .6);
    const Vec3<double> wo = view(.6, 1);
    const ColourEstimate e = reflected_colour(
        material, [&](const auto& brdf) { return reflected_radiance_from_cap(brdf, wo, cap, one, {1e-9}); });
    EXPECT_TRUE(e.converged);
    EXPECT_GT(e.value.x, e.value.y);
    EXPECT_GT(e.value.y, e.value.z);
    for (int channel = 0; channel < 3; ++channel) {
        // In a frame about the cap's axis, by the tests' own integrator.
        const Vec3<double> side = glm::normalize(glm::cross(cap.axis, Vec3<double>(0, 0, 1)));
        const Vec3<double> up = glm::cross(side, cap.axis);
        const double other = integrate_directions(
            [&](const Vec3<double>& w) {
                const Vec3<double> wi = w.x * side + w.y * up + w.z * cap.axis;
                return material.f(wo, wi)[channel] * wi.z;
            },
            std::cos(cap.half_angle_rad), 1, 1e-9);
        EXPECT_NEAR(e.value[channel], other, 1e-8 * other);
    }
}

TEST(ReflectedColour, OfLambertUnderASphereIsItsFormFactorTimesItsColour) {
    const Vec3<double> colour(.8, .5, .2);
    const Material material(StandardMaterial<double>{colour, .4, 0, 0}, LambertDiffuse<double>{});
    const ColourEstimate e = reflected_colour(material, [&](const auto& brdf) {
        return reflected_radiance_from_cap(brdf, view(.6), cap_of_sphere({0, 0, 2}, 1), one, {1e-9});
    });
    for (int channel = 0; channel < 3; ++channel) EXPECT_NEAR(e.value[channel], colour[channel] / 4, 1e-9);
}

}  // namespace
}  // namespace pbr
