#include "pbr/brdf/eon.hpp"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>

#include "pbr/numerics/vector.hpp"
#include "tests/libpbr/support/float_error.hpp"
#include "tests/libpbr/support/property.hpp"
#include "tests/libpbr/support/reflections.hpp"

namespace pbr {
namespace {

using boost::math::quadrature::gauss_kronrod;

/// Fujii's single scattering as its paper defines it.
double f_fon(const Reflection<double>& r, double diffuse_roughness) {
    const double s = r.LoV - r.NoL * r.NoV, t = s > 0 ? std::max(r.NoL, r.NoV) : 1;
    const double A = 1 / (1 + (.5 - 2 / (3 * std::numbers::pi)) * diffuse_roughness);
    return A * (1 + diffuse_roughness * s / t) / std::numbers::pi;
}

TEST(EonDiffuse, ExactAlbedoIsTheIntegralOfSingleScattering) {
    for (const double r : {.3, 1.0})
        for (const double NoV : {0.0, .2, .6, 1.0})
            EXPECT_NEAR(
                albedo_fon(eon_g_exact(NoV), r),
                reflection_albedo([&](const Reflection<double>& w) { return f_fon(w, r); }, NoV, 1e-7), 1e-6)
                << r << ' ' << NoV;
}

TEST(EonDiffuse, ConstantsAreTheIntegralsTheyStandFor) {
    // 1 - E = A r (C1 - g), so that C1 is g's value at grazing incidence plus what E lacks there: E(0) = 1.
    EXPECT_NEAR(eon_g_exact(0.0), kEonC1<double>, 1e-15);
    EXPECT_EQ(eon_g_exact(1.0), 0);
    const double mean = gauss_kronrod<double, 61>::integrate(
        [](double mu) { return 2 * mu * eon_g_exact(mu); }, 0.0, 1.0, 12, 1e-13);
    EXPECT_NEAR(mean, kEonC2<double>, 1e-11);
}

TEST(EonDiffuse, FittedAlbedoIsAsFarAsStated) {
    double g = 0, value = 0;
    for (int i = 0; i <= 10'000; ++i)
        g = std::max(g, std::abs(eon_g_exact(i * 1e-4) - eon_g_approximate(i * 1e-4)));
    EXPECT_LT(g, 6.1e-4);
    EXPECT_GT(g, 5.9e-4);
    EXPECT_NEAR(eon_g_approximate(0.0), .28825, 1e-5);
    for (int i = 0; i < 100'000; ++i) {
        const Reflection<double> r = sample_reflection(i);
        value = std::max(value, std::abs(f_eon_approximate(1.0, random_unit(1, i), r.NoL, r.NoV, r.LoV) -
                                         f_eon(1.0, random_unit(1, i), r.NoL, r.NoV, r.LoV)));
    }
    EXPECT_LT(value, 4e-4);
}

TEST(EonDiffuse, WhiteSurfaceReturnsEverything) {
    for (const double r : {0.0, .4, 1.0})
        for (const double NoV : {0.0, .1, .5, 1.0}) {
            const auto exact = [&](const Reflection<double>& w) {
                return f_eon(1.0, r, w.NoL, w.NoV, w.LoV);
            };
            EXPECT_NEAR(reflection_albedo(exact, NoV), 1, 1e-6) << r << ' ' << NoV;
        }
}

TEST(EonDiffuse, FittedAlbedoIsAsFarFromOneAsStated) {
    // Both extremes are the roughest's: at NoV .954 and .137.
    double least = 2, most = 0;
    for (const double r : {.3, 1.0})
        for (const double NoV :
             {0.0, .02, .05, .1, .13, .137, .14, .2, .3, .4, .5, .7, .9, .94, .95, .954, .96, .98, 1.0}) {
            const auto fitted = [&](const Reflection<double>& w) {
                return f_eon_approximate(1.0, r, w.NoL, w.NoV, w.LoV);
            };
            const double albedo = reflection_albedo(fitted, NoV);
            least = std::min(least, albedo);
            most = std::max(most, albedo);
        }
    EXPECT_NEAR(1 - least, 5.43e-4, 1e-6);
    EXPECT_NEAR(most - 1, 1.5e-4, 5e-6);
}

TEST(EonDiffuse, ColouredSurfaceReturnsLess) {
    for (const double rho : {.1, .5, .9}) {
        const auto f = [&](const Reflection<double>& w) { return f_eon(rho, .8, w.NoL, w.NoV, w.LoV); };
        EXPECT_LT(reflection_albedo_fixed(f, .3), rho);
        EXPECT_GT(reflection_albedo_fixed(f, .3), .7 * rho);
    }
}

TEST(EonDiffuse, IsLambertAtRoughnessZero) {
    const Vec3<double> rho(.2, .5, .9);
    const Vec3<double> f = f_eon(rho, 0.0, .3, .6, .1);
    for (int c = 0; c < 3; ++c) EXPECT_DOUBLE_EQ(f[c], rho[c] / std::numbers::pi);
    EXPECT_NEAR(f_eon(.7, 1e-12, .3, .6, .1), .7 / std::numbers::pi, 1e-12);
}

RC_GTEST_PROP(EonDiffuse, IsReciprocalPositiveAndBounded, ()) {
    const Reflection<double> r = reflection(*direction_above(), *direction_above());
    const double rho = *unit_interval(), roughness = *unit_interval();
    const double f = f_eon(rho, roughness, r.NoL, r.NoV, r.LoV);
    RC_ASSERT(std::isfinite(f) && f >= -1e-16);
    RC_ASSERT(std::abs(f - f_eon(rho, roughness, r.NoV, r.NoL, r.LoV)) <= 1e-15 * (1 + f));
    RC_ASSERT(f * r.NoL <= .37);
}

TEST(EonDiffuse, IsContinuousWhereRetroreflectionEnds) {
    // s = 0 at LoV = NoL NoV.
    for (const double step : {-1e-12, 1e-12})
        EXPECT_NEAR(f_eon(.8, 1.0, .3, .2, .06 + step), f_eon(.8, 1.0, .3, .2, .06), 2e-12);
}

TEST(EonDiffuse, FloatIsWithinTheUlpStated) {
    for (int i = 0; i < 100'000; ++i) {
        const Reflection<float> r = as_float(sample_reflection(i));
        const Reflection<double> d = as_double(r);
        const float rho = static_cast<float>(random_unit(3, i)),
                    rough = static_cast<float>(random_unit(4, i));
        EXPECT_LT(ulp_error_of(1, eon_g_exact(r.NoL), eon_g_exact(d.NoL)), 4);
        const double f = f_eon(static_cast<double>(rho), static_cast<double>(rough), d.NoL, d.NoV, d.LoV);
        EXPECT_LT(ulp_error_of(std::max(1.0, f), f_eon(rho, rough, r.NoL, r.NoV, r.LoV), f), 32)
            << r.NoL << ' ' << r.NoV;
    }
}

}  // namespace
}  // namespace pbr
