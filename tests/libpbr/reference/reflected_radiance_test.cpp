#include "pbr/reference/reflected_radiance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pbr/brdf/disney_diffuse.hpp"
#include "pbr/ibl/dfg.hpp"
#include "tests/libpbr/reference/lobes.hpp"
#include "tests/libpbr/support/integrate.hpp"
#include "tests/libpbr/support/property.hpp"

namespace pbr {
namespace {

TEST(ReflectedRadiance, OfLambertUnderAConstantAndCosinePowers) {
    const Vec3<double> wo = view(0.7, 2);
    expect_holds(reflected_radiance(lambert, wo, one), 1);
    for (const int n : {1, 2, 7, 100, 1000})
        expect_holds(reflected_radiance(lambert, wo, [&](const Vec3<double>& w) { return std::pow(w.z, n); }),
                     2.0 / (n + 2));
    // Azimuths are where they should be: the mean of x^2 weighted by the cosine is 1/4, and so is y^2's; xy
    // has 0.
    expect_holds(reflected_radiance(lambert, wo, [](const Vec3<double>& w) { return w.x * w.x; }), 0.25);
    expect_holds(reflected_radiance(lambert, wo, [](const Vec3<double>& w) { return w.y * w.y; }), 0.25);
    EXPECT_NEAR(
        reflected_radiance(lambert, wo, [](const Vec3<double>& w) { return w.x * w.y; }, {1e-9, 1e-12}).value,
        0, 1e-12);
}

TEST(ReflectedRadiance, AgreesWithTheTestsOwnIntegrator) {
    const auto sky = [](const Vec3<double>& w) { return 1 + w.x - 0.5 * w.y + std::exp(w.z * w.x); };
    for (const double alpha : {0.2, 1.0}) {
        const Vec3<double> wo = view(0.4, 1);
        const Ggx brdf{alpha};
        const double other =
            integrate_hemisphere([&](const Vec3<double>& wi) { return brdf(wo, wi) * sky(wi) * wi.z; }, 1e-9);
        EXPECT_NEAR(reflected_radiance(brdf, wo, sky).value, other, 1e-8);
        EXPECT_NEAR(reflected_radiance_half_vector(brdf, wo, sky, alpha).value, other, 1e-8);
    }
}

TEST(ReflectedRadiance, OfDisneyDiffuseIsItsClosedFormAlbedo) {
    for (const double NoV : {0.1, 0.9}) {
        const auto brdf = [](const Vec3<double>& wo, const Vec3<double>& wi) {
            return f_disney_diffuse(wi.z, wo.z, glm::dot(wi, glm::normalize(wo + wi)), 0.7);
        };
        expect_holds(reflected_radiance(brdf, view(NoV), one), albedo_disney_diffuse(NoV, 0.7));
    }
}

TEST(ReflectedRadiance, OfNarrowLobesIsTheirAlbedo) {
    const DfgMethod method = DfgMethod::quadrature(1e-8);
    for (const double alpha : {1e-5, 1e-3, 1e-2, 0.1, 1.0})
        for (const double NoV : {0.05, 0.5, 1.0}) {
            const Estimate e = reflected_radiance_half_vector(Ggx{alpha}, view(NoV, 0.3), one, alpha);
            EXPECT_TRUE(e.converged) << alpha << " " << NoV;
            EXPECT_LT(e.evaluations, 100'000);
            EXPECT_NEAR(e.value, dfg_ggx(NoV, alpha, method).E, 1.2e-8) << alpha << " " << NoV;
        }
    // The published corner (maths.md's digit is off in the fourth place).
    EXPECT_NEAR(reflected_radiance_half_vector(Ggx{0.1}, view(0.1), one, 0.1).value, .8834550019, 1e-9);
    EXPECT_NEAR(reflected_radiance_half_vector(Ggx{1.0}, view(1), one, 1.0).value, 1 - std::numbers::ln2,
                1e-9);
}

TEST(ReflectedRadiance, FindsANarrowLobeByItsPeakAndMissesItWithout) {
    const double alpha = 1e-3;
    const Vec3<double> wo = view(0.5);
    const Peak peak{Vec3<double>(-wo.x, -wo.y, wo.z), alpha};
    const double exact = reflected_radiance_half_vector(Ggx{alpha}, wo, one, alpha).value;
    EXPECT_NEAR(reflected_radiance(Ggx{alpha}, wo, one, {1e-8}, std::span(&peak, 1)).value, exact, 1e-7);
    // A lobe has tails that lead to it; a light without any does not: a sun of 1e-4 rad, normal to the
    // surface's view.
    const Peak sun{view(0.7, 2), 1e-4};
    const auto sky = [&](const Vec3<double>& w) {
        const Vec3<double> off = w - sun.direction;
        return std::exp(-glm::dot(off, off) / (sun.width_rad * sun.width_rad));
    };
    const double sunlit = sun.width_rad * sun.width_rad * 0.7;
    EXPECT_NEAR(reflected_radiance(lambert, wo, sky, {1e-6}, std::span(&sun, 1)).value / sunlit, 1, 1e-6);
    EXPECT_LT(reflected_radiance(lambert, wo, sky, {1e-6}).value, 1e-3 * sunlit);
}

TEST(ReflectedRadiance, StaysTheSameWhenAllTurnsAboutTheNormal) {
    const auto sky = [](const Vec3<double>& w) { return 1 + 0.8 * w.x; };
    const auto turned = [](const Vec3<double>& w) {
        return 1 + 0.8 * (w.x * std::cos(1.0) + w.y * std::sin(1.0));
    };
    const Ggx brdf{0.2};
    EXPECT_NEAR(reflected_radiance_half_vector(brdf, view(0.3), sky, 0.2).value,
                reflected_radiance_half_vector(brdf, view(0.3, 1), turned, 0.2).value, 2e-9);
}

/// E/L of a sphere, closed form, its centre at angle w from the normal (Frostbite's listing 8 in its own
/// words).
double sphere_form_factor(double w, double s) {
    const double cw = std::cos(w), sw = std::sin(w), s2 = std::sin(s) * std::sin(s);
    if (cw > std::sin(s)) return kPi * s2 * cw;
    if (cw < -std::sin(s)) return 0;
    const double x = std::sqrt(1 / s2 - 1), y = -x * cw / sw, root = sw * std::sqrt(1 - y * y);
    return (cw * std::acos(y) - x * root) * s2 + std::atan(root / x);
}

TEST(ReflectedFromCap, IsTheSphereFormFactorAcrossTheHorizon) {
    const double s = kPi / 6,
                 published[][2] = {
                     {0, .78539816}, {80, .171832}, {90, .090586}, {100, .035449}, {115, .00124003}};
    for (const auto& [degrees, expected] : published)
        EXPECT_NEAR(sphere_form_factor(degrees * kPi / 180, s), expected, 6e-7);
    for (double degrees = 0; degrees < 125; degrees += 5) {
        const double w = degrees * kPi / 180;
        const Vec3<double> centre = 2.0 * Vec3<double>(0.6 * std::sin(w), 0.8 * std::sin(w), std::cos(w));
        const Estimate e =
            reflected_radiance_from_cap(lambert, view(0.5), cap_of_sphere(centre, 1), one, {1e-9, 1e-14});
        expect_holds(e, sphere_form_factor(w, s) / kPi);
        EXPECT_LT(e.evaluations, 20'000);
    }
}

TEST(ReflectedFromCap, OfAllDirectionsIsTheHemisphere) {
    expect_holds(reflected_radiance_from_cap(lambert, view(0.5), cap_of_sphere({0.1, 0, 0.2}, 1), one),
                 1);  // within the sphere
    expect_holds(reflected_radiance_from_cap(lambert, view(0.5), {{0.6, 0, -0.8}, kPi}, one), 1);
    EXPECT_EQ(reflected_radiance_from_cap(lambert, view(0.5), {{0, 0, -1}, 1}, one).value, 0);
}

TEST(ReflectedFromCap, OfASunFarSmallerThanTheLobeIsTheBrdfTimesItsIlluminance) {
    constexpr double kHalfAngle = .00465;
    const Vec3<double> sun = view(0.6, 2), wo = view(0.4);
    const double illuminance = kPi * std::sin(kHalfAngle) * std::sin(kHalfAngle) * sun.z;
    const Estimate e = reflected_radiance_from_cap(Ggx{0.5}, wo, {sun, kHalfAngle}, one);
    EXPECT_NEAR(e.value / (Ggx{0.5}(wo, sun) * illuminance), 1, 1e-4);
}

TEST(ReflectedFromCap, OfALobeFarNarrowerThanTheLightIsItsAlbedo) {
    const double alpha = 1e-3;
    const Vec3<double> wo = view(0.6), mirror(-wo.x, -wo.y, wo.z);
    const Peak peak{mirror, alpha};
    const SphericalCap cap{glm::normalize(mirror + Vec3<double>(0, 0.1, 0)), 0.5};
    const Estimate e = reflected_radiance_from_cap(Ggx{alpha}, wo, cap, one, {1e-8}, std::span(&peak, 1));
    EXPECT_TRUE(e.converged);
    // Of D NoH, a share alpha²/(alpha² + tan²) lies beyond half the light's nearest rim, .4 rad away: 2.5e-5.
    EXPECT_NEAR(e.value, 1, 5e-5);
    EXPECT_LT(e.value, 1);
    // The same from the whole hemisphere, the light as an indicator.
    const auto lit = [&](const Vec3<double>& w) { return glm::dot(w, cap.axis) > std::cos(0.5) ? 1.0 : 0.0; };
    EXPECT_NEAR(e.value, reflected_radiance_half_vector(Ggx{alpha}, wo, lit, alpha, {1e-7, 0, 400'000}).value,
                1e-6);
}

}  // namespace
}  // namespace pbr
