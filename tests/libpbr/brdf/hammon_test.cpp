#include "pbr/brdf/hammon.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/libpbr/support/float_error.hpp"
#include "tests/libpbr/support/property.hpp"
#include "tests/libpbr/support/reflections.hpp"

namespace pbr {
namespace {

double swept_albedo(double rho, double NoV, double alpha) {
    return reflection_albedo_fixed(
        [&](const Reflection<double>& r) { return f_hammon(rho, r.NoL, r.NoV, r.NoH, r.LoV, alpha); }, NoV);
}

TEST(HammonDiffuse, HasTheAlbedosStated) {
    EXPECT_NEAR(swept_albedo(1, 0, 0), 0, 1e-12);
    EXPECT_NEAR(swept_albedo(1, 0, 1), 1.181, 1e-3);
    double most = 0;
    for (double alpha = 0; alpha <= 1; alpha += .125)
        for (const double NoV : {0.0, .05, .2, .5, 1.0}) most = std::max(most, swept_albedo(1, NoV, alpha));
    EXPECT_LE(most, 1.1815);
    const QuadratureRule rule = gauss_legendre(6);
    const auto mean = [&](double alpha) {
        double sum = 0;
        for (int i = 0; i < rule.size(); ++i)
            sum += 2 * rule.weights[i] * rule.nodes[i] * swept_albedo(1, rule.nodes[i], alpha);
        return sum;
    };
    EXPECT_NEAR(mean(0), 20.0 / 21, 1e-5);
    EXPECT_NEAR(mean(1), 1.073, 1e-3);
    for (double before = 0, alpha = 0; alpha <= 1; alpha += .125) {  // the ends are the extremes
        EXPECT_GT(mean(alpha), before);
        before = mean(alpha);
    }
}

TEST(HammonDiffuse, AlbedoAgreesWithAdaptiveIntegration) {
    for (const auto& [alpha, NoV] : {std::pair{0.0, .3}, {.01, .1}, {.3, .6}, {1.0, .1}, {1.0, 1.0}})
        for (const double rho : {1.0, .5})
            EXPECT_NEAR(
                rho * (albedo_hammon_single(NoV, alpha) + rho * kHammonMultipleAlbedo<double> * alpha),
                reflection_albedo(
                    [rho, alpha = alpha](const Reflection<double>& r) {
                        return f_hammon(rho, r.NoL, r.NoV, r.NoH, r.LoV, alpha);
                    },
                    NoV, 1e-10),
                1e-8)
                << alpha << " " << NoV;
    for (const double alpha : {0.0, 1e-3, .5, 1.0})
        for (const double NoV : {0.0, 1e-6, 1e-4, .02})
            EXPECT_NEAR(albedo_hammon_single(NoV, alpha) + kHammonMultipleAlbedo<double> * alpha,
                        swept_albedo(1, NoV, alpha), 1e-5);
}

TEST(HammonDiffuse, SmoothSurfaceIsShirleys) {
    // 1.05 (1 - (1 - NoL)^5)(1 - (1 - NoV)^5): the mean over NoL of the second factor is 20/21, so that 1.05
    // = 21/20.
    for (const double NoV : {.1, .5, 1.0})
        EXPECT_NEAR(swept_albedo(1, NoV, 0), 1 - std::pow(1 - NoV, 5), 1e-6) << NoV;
}

TEST(HammonDiffuse, MultipleScatteringIsQuadraticInTheColour) {
    const double one = f_hammon(1.0, .4, .6, .7, .2, .5), half = f_hammon(.5, .4, .6, .7, .2, .5);
    EXPECT_NEAR(one - 2 * half, .1159 * .5 / 2, 1e-15);
    EXPECT_NEAR(.1159 * std::numbers::pi, .3641, 1e-4);
}

TEST(HammonDiffuse, GrazingEndIsAsStated) {
    EXPECT_TRUE(std::isinf(f_hammon(1.0, 0.0, 0.0, 0.0, 1.0, .5)));
    EXPECT_EQ(f_hammon(1.0, 0.0, 0.0, 0.0, 1.0, 0.0), 0);
    for (double c = 1e-3; c > 1e-12; c /= 10) EXPECT_LT(f_hammon(1.0, c, c, c, 1.0, 1.0) * c, .13);
}

RC_GTEST_PROP(HammonDiffuse, IsReciprocalAndPositive, ()) {
    const Reflection<double> r = reflection(*direction(1e-9), *direction(1e-9));
    const double alpha = *unit_interval(), rho = *unit_interval();
    const double f = f_hammon(rho, r.NoL, r.NoV, r.NoH, r.LoV, alpha);
    RC_ASSERT(std::isfinite(f) && f >= -1e-15);
    RC_ASSERT(std::abs(f - f_hammon(rho, r.NoV, r.NoL, r.NoH, r.LoV, alpha)) <= 1e-15 * (1 + f));
}

TEST(HammonDiffuse, FloatIsWithinTheUlpStated) {
    for (int i = 0; i < 50'000; ++i) {
        const Reflection<float> r = as_float(sample_reflection(i));
        const Reflection<double> d = as_double(r);
        const float alpha = static_cast<float>(random_unit(1, i));
        const double rho = .7f, a = alpha;
        const double f = f_hammon(rho, d.NoL, d.NoV, d.NoH, d.LoV, a);
        EXPECT_LT(ulp_error_of(std::max(1.0, f), f_hammon(.7f, r.NoL, r.NoV, r.NoH, r.LoV, alpha), f), 16);
    }
}

}  // namespace
}  // namespace pbr
