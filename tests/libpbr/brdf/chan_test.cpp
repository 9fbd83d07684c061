#include "pbr/brdf/chan.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/libpbr/support/float_error.hpp"
#include "tests/libpbr/support/property.hpp"
#include "tests/libpbr/support/reflections.hpp"

namespace pbr {
namespace {

double swept_albedo(double NoV, double alpha) {
    return reflection_albedo_fixed(
        [&](const Reflection<double>& r) { return f_chan(r.NoL, r.NoV, r.NoH, r.LoH, alpha); }, NoV);
}

TEST(ChanDiffuse, HasTheAlbedosStated) {
    EXPECT_NEAR(swept_albedo(0.0, 1e-3), .241, 1e-3);
    EXPECT_NEAR(swept_albedo(0.0, 1.0), 1.158, 1e-3);
    double least = 2, most = 0;
    for (double alpha = 0; alpha <= 1; alpha += .125)
        for (const double NoV : {0.0, .05, .2, .5, 1.0}) {
            least = std::min(least, swept_albedo(NoV, alpha));
            most = std::max(most, swept_albedo(NoV, alpha));
            if (alpha < .49) {
                EXPECT_LT(swept_albedo(NoV, alpha), 1);
            }
        }
    EXPECT_GE(least, .2405);
    EXPECT_LE(most, 1.1585);
    EXPECT_GT(swept_albedo(0.0, .5), 1);
    double least_mean = 2, most_mean = 0;
    for (const double alpha : {0.0, .02, .05, .07, .08, .084, .088, .1, .12, .25, .5, .75, 1.0}) {
        const QuadratureRule rule = gauss_legendre(8);
        double mean = 0;
        for (int i = 0; i < rule.size(); ++i)
            mean += 2 * rule.weights[i] * rule.nodes[i] * swept_albedo(rule.nodes[i], alpha);
        least_mean = std::min(least_mean, mean);
        most_mean = std::max(most_mean, mean);
    }
    EXPECT_NEAR(least_mean, .890, 5e-4);
    EXPECT_NEAR(most_mean, .955, 5e-4);
}

TEST(ChanDiffuse, AlbedoAgreesWithAdaptiveIntegration) {
    for (const auto& [alpha, NoV] :
         {std::pair{0.0, 0.3}, {.01, .1}, {.1, 1.0}, {.3, .6}, {1.0, .05}, {1.0, 1.0}})
        EXPECT_NEAR(albedo_chan(NoV, alpha),
                    reflection_albedo(
                        [alpha = alpha](const Reflection<double>& r) {
                            return f_chan(r.NoL, r.NoV, r.NoH, r.LoH, alpha);
                        },
                        NoV, 1e-10),
                    1e-9)
            << alpha << " " << NoV;  // the witness is off by up to 1e-10 of its panels
    for (const double alpha : {0.0, 1e-3, .08, .5, 1.0})
        for (const double NoV : {0.0, 1e-4, .02})
            EXPECT_NEAR(albedo_chan(NoV, alpha), swept_albedo(NoV, alpha), 1e-5);
}

TEST(ChanDiffuse, GlossIsTheGamesOwn) {
    // alpha^2 = 2 / (1 + 2^(18 g)): g = 0 at alpha 1, 1 at .00276; both ends clamp.
    const double smoothest = std::sqrt(2 / (1 + std::exp2(18.0)));
    EXPECT_NEAR(smoothest, .00276, 1e-5);
    EXPECT_NEAR(f_chan(.4, .6, .7, .5, smoothest), f_chan(.4, .6, .7, .5, 0.0), 1e-12);
    EXPECT_EQ(f_chan(.4, .6, .7, .5, 1e-5), f_chan(.4, .6, .7, .5, 0.0));
    // Written out at gloss 1/2, where both fits are blended.
    const double alpha = std::sqrt(2 / (1 + 512.0)), fifth = std::pow(.5, 5);
    const double rough = .5 + fifth, smooth = (1 - .75 * std::pow(.6, 5)) * (1 - .75 * std::pow(.4, 5));
    const double base = rough + (smooth - rough) * .6;
    const double bump = (34.5 * .25 - 59 * .5 + 24.5) * .5 * std::exp2(-15.4 * std::sqrt(.7));
    EXPECT_NEAR(f_chan(.4, .6, .7, .5, alpha), (base + bump) / std::numbers::pi, 1e-14);
}

RC_GTEST_PROP(ChanDiffuse, IsReciprocalFiniteAndPositive, ()) {
    const Reflection<double> r = reflection(*direction_above(), *direction_above());
    const double alpha = *unit_interval(), f = f_chan(r.NoL, r.NoV, r.NoH, r.LoH, alpha);
    RC_ASSERT(std::isfinite(f) && f >= -1e-15);
    RC_ASSERT(ulp_distance(f, f_chan(r.NoV, r.NoL, r.NoH, r.LoH, alpha)) <= 4);
}

TEST(ChanDiffuse, IsContinuousAcrossItsClamps) {
    // Gloss at which 2.2 g - .5 leaves 0 and 1, and 73.2 g - 21.2 passes 8.9.
    for (const double gloss : {.5 / 2.2, 1.5 / 2.2, 30.1 / 73.2}) {
        const double alpha = std::sqrt(2 / (1 + std::exp2(18 * gloss)));
        EXPECT_NEAR(f_chan(.3, .6, .8, .7, alpha * (1 + 1e-9)), f_chan(.3, .6, .8, .7, alpha * (1 - 1e-9)),
                    1e-7);
    }
}

TEST(ChanDiffuse, FloatIsWithinTheUlpStated) {
    for (int i = 0; i < 50'000; ++i) {
        const Reflection<float> r = as_float(sample_reflection(i));
        const Reflection<double> d = as_double(r);
        const float alpha = static_cast<float>(random_unit(1, i));
        EXPECT_LT(ulp_error_of(1, f_chan(r.NoL, r.NoV, r.NoH, r.LoH, alpha),
                               f_chan<double>(d.NoL, d.NoV, d.NoH, d.LoH, alpha)),
                  16)
            << alpha;
    }
}

}  // namespace
}  // namespace pbr
