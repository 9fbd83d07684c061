#include "pbr/ibl/split_sum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "pbr/brdf/disney_diffuse.hpp"
#include "pbr/brdf/ggx.hpp"
#include "pbr/ibl/dfg.hpp"
#include "tests/libpbr/support/integrate.hpp"
#include "tests/libpbr/support/property.hpp"

namespace pbr {
namespace {

TEST(SplitSum, IsTheExactIntegralUnderAConstantEnvironment) {
    constexpr double kRadiance = 3, kF0 = 0.04, kF90 = 0.8, kAlpha = 0.3;
    for (const double NoV : {0.2, 0.8}) {
        const auto brdf = [&](const Vec3<double>& wo, const Vec3<double>& wi) {
            const Vec3<double> h = glm::normalize(wo + wi);
            return D_ggx(h.z, h.x * h.x + h.y * h.y, kAlpha) * V_smith_ggx_correlated(wi.z, wo.z, kAlpha) *
                   F_schlick(kF0, kF90, glm::dot(wi, h));
        };
        const DirectionalAlbedo dfg = dfg_ggx(NoV, kAlpha, DfgMethod::quadrature(1e-8));
        const double exact = kRadiance * directional_albedo(brdf, NoV, 1e-9);
        EXPECT_NEAR(split_sum_specular(kRadiance, kF0, kF90, dfg.E - dfg.Fc, dfg.Fc), exact, 1e-7);
        EXPECT_NEAR(split_sum_specular_from_albedo(kRadiance, kF0, kF90, dfg.Fc, dfg.E), exact, 1e-7);
    }
}

TEST(SplitSum, DiffuseIsTheExactIntegralUnderAConstantEnvironment) {
    constexpr double kRadiance = 3, kColour = 0.7, kRoughness = 0.6, kNoV = 0.4;
    const auto brdf = [&](const Vec3<double>& wo, const Vec3<double>& wi) {
        return kColour * f_disney_diffuse(wi.z, wo.z, glm::dot(wi, glm::normalize(wo + wi)), kRoughness);
    };
    const double exact = kRadiance * directional_albedo(brdf, kNoV, 1e-9),
                 albedo = albedo_disney_diffuse(kNoV, kRoughness);
    EXPECT_NEAR(split_sum_diffuse(kRadiance, kColour, albedo), exact, 1e-8);
    EXPECT_NEAR(split_sum_diffuse_from_irradiance(kRadiance * std::numbers::pi, kColour, albedo), exact,
                1e-8);
}

RC_GTEST_PROP(SplitSum, BothTableFormsAgreeAndKeepEnergy, ()) {
    const double Fc = *unit_interval(), E = Fc + (1 - Fc) * *unit_interval();
    const double f0 = *unit_interval(), f90 = *unit_interval();
    const double a = split_sum_specular(1.0, f0, f90, E - Fc, Fc),
                 b = split_sum_specular_from_albedo(1.0, f0, f90, Fc, E);
    RC_ASSERT(std::abs(a - b) < 1e-15);
    RC_ASSERT(a >= 0);
    RC_ASSERT(a <= 1 + 1e-15);
    const double single = split_sum_specular(1.0f, static_cast<float>(f0), static_cast<float>(f90),
                                             static_cast<float>(E - Fc), static_cast<float>(Fc));
    RC_ASSERT(std::abs(single - a) < 4e-7);
    // Filament's mix for f90 = 1.
    RC_ASSERT(std::abs(split_sum_specular_from_albedo(1.0, f0, 1.0, Fc, E) - ((1 - f0) * Fc + f0 * E)) <
              1e-15);
}

TEST(SplitSum, TakesColours) {
    const glm::vec3 LD(1, 2, 3), f0(0.1f, 0.2f, 0.3f), f90(1);
    const glm::vec3 result = split_sum_specular(LD, f0, f90, 0.5f, 0.25f);
    EXPECT_FLOAT_EQ(result.y, 2 * (0.2f * 0.5f + 0.25f));
    EXPECT_FLOAT_EQ(split_sum_diffuse(LD, f0, 0.5f).z, 3 * 0.3f * 0.5f);
}

TEST(SplitSum, DiffuseErrsAsStatedUnderASkyWithASlope) {
    // Radiance 1 + w.e: exactly the lobe's albedo and its first moment along e; irradiance / pi is 1 + 2/3
    // n.e. The worst e is along the difference.
    const double rows[][3] = {{0, .1, .021}, {0, .9, .021}, {.5, .1, .094}, {1, .1, .132}, {1, .5, .027}};
    for (const auto& [roughness, NoV, stated] : rows) {
        const Vec3<double> wo(std::sqrt(1 - NoV * NoV), 0, NoV);
        const double p = roughness;
        const auto moment = [&](int axis) {
            return integrate_hemisphere(
                [&](const Vec3<double>& wi) {
                    const double LoH = glm::dot(wi, glm::normalize(wo + wi));
                    return f_disney_diffuse(wi.z, wo.z, LoH, p) * wi.z * wi[axis];
                },
                1e-6);
        };
        const double albedo = albedo_disney_diffuse(NoV, p);
        const Vec3<double> exact(moment(0), 0, moment(2));
        // Of e along each axis, less the constant part, which both have.
        const auto split = [&](double n_dot_e) {
            return split_sum_diffuse(1 + 2.0 / 3 * n_dot_e, 1.0, albedo) - albedo;
        };
        EXPECT_NEAR(glm::length(exact - Vec3<double>(0, 0, split(1))) / albedo, stated, 6e-4)
            << roughness << ' ' << NoV;
    }
}

}  // namespace
}  // namespace pbr
