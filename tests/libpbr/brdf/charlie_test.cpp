#include "pbr/brdf/charlie.hpp"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <limits>

#include "tests/libpbr/support/chi_square.hpp"
#include "tests/libpbr/support/float_error.hpp"
#include "tests/libpbr/support/property.hpp"
#include "tests/libpbr/support/reflections.hpp"

namespace pbr {
namespace {

using boost::math::quadrature::gauss_kronrod;

/// Smith's masking by its definition: cosine over the area of fibres that face the direction.
double G1_by_integration(double cosine, double alpha) {
    const double sine = std::sqrt(1 - cosine * cosine);
    const auto ring = [&](double z) {
        const double a = cosine * z, b = sine * std::sqrt(1 - z * z);
        const double mean =
            a >= b ? a : (a * std::acos(-a / b) + std::sqrt(b * b - a * a)) / std::numbers::pi;
        return 2 * std::numbers::pi * D_charlie(z, alpha) * mean;
    };
    return cosine / (gauss_kronrod<double, 61>::integrate(ring, 0.0, sine, 8, 1e-9) +
                     gauss_kronrod<double, 61>::integrate(ring, sine, 1.0, 8, 1e-9));
}

TEST(Charlie, ProjectedAreaOfNormalsIsOne) {
    for (const double alpha : {1e-4, 1e-2, .1, .5, 1.0}) {
        const double width = std::sqrt(alpha);
        const auto ring = [&](double z) { return 2 * std::numbers::pi * D_charlie(z, alpha) * z; };
        const double area =
            gauss_kronrod<double, 61>::integrate(ring, 0.0, std::min(1.0, 8 * width), 10, 1e-12) +
            gauss_kronrod<double, 61>::integrate(ring, std::min(1.0, 8 * width), 1.0, 10, 1e-12);
        EXPECT_NEAR(area, 1, 1e-9) << alpha;
    }
}

TEST(Charlie, DistributionHasItsEnds) {
    for (const double alpha : {1e-6, .01, 1.0}) {
        EXPECT_EQ(D_charlie(1.0, alpha), 0);
        EXPECT_NEAR(D_charlie(0.0, alpha) / ((2 + 1 / alpha) / (2 * std::numbers::pi)), 1, 1e-15);
    }
    EXPECT_NEAR(D_charlie(.6, 1.0), 3 * .8 / (2 * std::numbers::pi), 1e-15);
    // As alpha -> 0, (1 - c^2)^(1/2a) -> exp(-c^2 / 2a): a band of width sqrt(alpha), not 0/0.
    const double alpha = 1e-10, c = std::sqrt(alpha);
    EXPECT_NEAR(D_charlie(c, alpha) * 2 * std::numbers::pi * alpha, std::exp(-.5), 1e-9);
}

TEST(Charlie, VisibilityHasItsEnds) {
    EXPECT_TRUE(std::isinf(V_neubelt(0.0, 0.0)));
    EXPECT_DOUBLE_EQ(V_neubelt(0.0, .5), .5);
    EXPECT_DOUBLE_EQ(V_neubelt(1.0, 1.0), .25);
    for (const double alpha : {.01, .3, 1.0}) {
        EXPECT_LT(lambda_charlie(1.0, alpha), 5e-8);
        EXPECT_LT(lambda_charlie(0.0, alpha), 8e8);
        EXPECT_TRUE(std::isfinite(V_charlie(0.0, 0.0, alpha)));
        // As published, V NoL at NoV = 1e-9 is 1 / (4 NoV (1 + Lambda)), far above what Smith's pole leaves.
        EXPECT_GT(1 / (4 * 1e-9 * (1 + lambda_charlie(1e-9, alpha))), 1);
        EXPECT_NEAR(V_charlie(1.0, 1.0, alpha), .25, 1e-7);
    }
}

TEST(Charlie, LambdaIsContinuousWhereItsHalvesMeet) {
    for (const double alpha : {.01, .3, 1.0})
        EXPECT_NEAR(lambda_charlie(std::nextafter(.5, 0.0), alpha) / lambda_charlie(.5, alpha), 1, 1e-13);
    for (const double alpha : {.01, .3, 1.0})
        EXPECT_NEAR(V_charlie(kCharlieSmallestCosine<double> * (1 - 1e-12), .4, alpha) /
                        V_charlie(kCharlieSmallestCosine<double>, .4, alpha),
                    1, 1e-11);
}

TEST(Charlie, FitOfLambdaIsAsFarFromSmithAsStated) {
    const auto worst = [](double alpha) {
        double error = 0;
        for (double c = .005; c < 1; c += .01)
            error =
                std::max(error, std::abs(1 / (1 + lambda_charlie(c, alpha)) - G1_by_integration(c, alpha)));
        return error;
    };
    for (const double alpha : {.1, .15, .25, .4, .6, 1.0}) EXPECT_LT(worst(alpha), .045) << alpha;
    EXPECT_NEAR(worst(.05), .0915, 5e-4);
    EXPECT_NEAR(worst(.01), .337, 5e-3);
}

TEST(Charlie, AlbedoAgreesWithAdaptiveIntegration) {
    for (const double alpha : {.01, .1, .5, 1.0})
        for (const double NoV : {0.0, .02, .3, 1.0}) {
            const auto lobe = [&](auto V) {
                return reflection_albedo(
                    [&](const Reflection<double>& r) { return D_charlie(r.NoH, alpha) * V(r.NoL, r.NoV); },
                    NoV, 1e-7);
            };
            EXPECT_NEAR(albedo_charlie(NoV, alpha, CharlieVisibility::neubelt), lobe(V_neubelt<double>), 8e-6)
                << alpha << ' ' << NoV;
            EXPECT_NEAR(albedo_charlie(NoV, alpha, CharlieVisibility::charlie),
                        lobe([&](double l, double v) { return V_charlie(l, v, alpha); }), 8e-6)
                << alpha << ' ' << NoV;
        }
}

TEST(Charlie, ReturnsAsMuchAsStated) {
    const auto most = [](double alpha, CharlieVisibility visibility) {
        double largest = 0;
        for (double NoV = 0; NoV <= 1; NoV += NoV < .02 ? .001 : .02)
            largest = std::max(largest, albedo_charlie(NoV, alpha, visibility));
        return largest;
    };
    for (const double alpha : {.07, .1, .3, 1.0})
        EXPECT_LT(most(alpha, CharlieVisibility::charlie), 1) << alpha;
    EXPECT_NEAR(most(.01, CharlieVisibility::charlie), 2.13, .01);
    EXPECT_NEAR(most(1.0, CharlieVisibility::charlie), .942, 1e-3);
    EXPECT_NEAR(most(1.0, CharlieVisibility::neubelt), .637, 1e-3);
    EXPECT_NEAR(most(.25, CharlieVisibility::neubelt), .9375, 1e-3);
    EXPECT_NEAR(most(.1, CharlieVisibility::neubelt), 1.354, 1e-3);
    EXPECT_NEAR(most(.01, CharlieVisibility::neubelt), 4.02, .01);
}

TEST(Charlie, SamplingMatchesItsDensity) {
    for (const double alpha : {.05, .3, 1.0})
        EXPECT_GT(chi_square_p_value([&](double u1, double u2) { return sample_charlie_ndf(alpha, u1, u2); },
                                     [&](const Vec3<double>& w) { return pdf_charlie_ndf(alpha, w); }),
                  kSignificance)
            << alpha;
}

RC_GTEST_PROP(Charlie, InverseReturnsTheSample, ()) {
    const double alpha = *log_uniform(1e-3, 1), u1 = *uniform(0, 1), u2 = *uniform(0, 1);
    const Vec3<double> wm = sample_charlie_ndf(alpha, u1, u2);
    RC_ASSERT(std::abs(glm::length(wm) - 1) < 1e-15 * 8);
    RC_ASSERT(wm.z >= 0);
    const Sample2 u = inverse_charlie_ndf(alpha, wm);
    RC_ASSERT(std::abs(u.u1 - u1) < 1e-9);
    RC_ASSERT(u1 < 1e-9 || std::abs(std::remainder(u.u2 - u2, 1.0)) < 1e-9);
}

RC_GTEST_PROP(Charlie, IsFiniteAndReciprocal, ()) {
    const double NoL = *unit_interval(), NoV = *unit_interval(), NoH = *unit_interval(),
                 alpha = *log_uniform(1e-4, 1);
    RC_ASSERT(std::isfinite(D_charlie(NoH, alpha)) && D_charlie(NoH, alpha) >= 0);
    RC_ASSERT(std::isfinite(V_charlie(NoL, NoV, alpha)));
    RC_ASSERT(ulp_distance(V_charlie(NoL, NoV, alpha), V_charlie(NoV, NoL, alpha)) <= 4);
    RC_ASSERT(ulp_distance(V_neubelt(NoL, NoV), V_neubelt(NoV, NoL)) <= 4);
}

TEST(Charlie, FloatIsWithinTheUlpStated) {
    for (int i = 0; i < 50'000; ++i) {
        const float h = static_cast<float>(random_unit(1, i)),
                    alpha = static_cast<float>(std::pow(random_unit(2, i), 2) + .01),
                    l = static_cast<float>(random_unit(3, i)), v = static_cast<float>(random_unit(4, i));
        const double dh = h, da = alpha, D = D_charlie(dh, da);
        if (D > 1e-30) {
            EXPECT_LT(ulp_error(D_charlie(h, alpha), D),
                      8 + (4 * std::abs(std::log1p(-dh * dh) / 2) + 2) / da)
                << h << ' ' << alpha;
        }
        EXPECT_LT(ulp_error(V_neubelt(l, v), V_neubelt<double>(l, v)), 4);
        EXPECT_LT(ulp_error(V_charlie(l, v, alpha), V_charlie<double>(l, v, alpha)), 64);
    }
}

}  // namespace
}  // namespace pbr
