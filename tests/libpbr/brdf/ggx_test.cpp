#include "pbr/brdf/ggx.hpp"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>

#include "pbr/numerics/sequence.hpp"
#include "tests/libpbr/support/float_error.hpp"

namespace pbr {
namespace {

using boost::math::quadrature::gauss_kronrod;

TEST(Ggx, ProjectedAreaOfNormalsIsOne) {
    for (const double alpha : {1e-4, 1e-3, 0.01, 0.1, 0.5, 1.0}) {
        // In x = ln tan(theta), the integrand is one bump of unit width at ln(alpha).
        const auto integrand = [&](double x) {
            const double tangent = std::exp(x), cos2 = 1 / (1 + tangent * tangent);
            const double cosine = std::sqrt(cos2), sin2 = tangent * tangent * cos2;
            return 2 * std::numbers::pi * D_ggx(cosine, sin2, alpha) * cosine * sin2 *
                   cosine;  // sin dtheta = sin^2 cos dx
        };
        const double total = gauss_kronrod<double, 61>::integrate(integrand, std::log(alpha) - 22,
                                                                  std::log(alpha) + 22, 12, 1e-12);
        EXPECT_NEAR(total, 1, 1e-10) << "alpha " << alpha;
    }
}

TEST(Ggx, PeakIsOneOverPiAlphaSquared) {
    for (const double alpha : {1e-8, 1e-4, 0.1, 1.0})
        EXPECT_NEAR(D_ggx(1.0, 0.0, alpha) * std::numbers::pi * alpha * alpha, 1, 1e-14);
    EXPECT_NEAR(D_ggx(1.0f, 0.0f, 1e-4f) * std::numbers::pi_v<float> * 1e-8f, 1.0f, 1e-6f);
}

TEST(Ggx, MaskedVisibleAreaEqualsTheProjectedOne) {
    // Heitz 2014, eq. 14: the visible part of D projects to cos(theta_o).
    for (const double alpha : {0.1, 0.5, 1.0})
        for (const double NoV : {0.05, 0.3, 0.9}) {
            const double sin_v = std::sqrt(1 - NoV * NoV);
            const auto over_azimuth = [&](double theta) {
                const double c = std::cos(theta), s = std::sin(theta);
                const auto visible = [&](double phi) {
                    return std::max(0.0, sin_v * s * std::cos(phi) + NoV * c);
                };
                // The clamp's edge is a panel end.
                const double x = NoV * c / (sin_v * s);
                const double edge = x >= 1 ? std::numbers::pi : std::acos(-x);
                return 2 * gauss_kronrod<double, 31>::integrate(visible, 0.0, edge, 5, 1e-12) *
                       D_ggx(c, s * s, alpha) * s;
            };
            const double area =
                gauss_kronrod<double, 61>::integrate(over_azimuth, 0.0, std::numbers::pi / 2, 10, 1e-11);
            EXPECT_NEAR(G1_smith_ggx(NoV, alpha) * area, NoV, 1e-8) << alpha << " " << NoV;
        }
}

TEST(Ggx, CorrelatedVisibilityIsReciprocalAndNotBelowTheUncorrelatedOne) {
    for (int i = 0; i < 10'000; ++i) {
        const double NoL = random_unit(1, i), NoV = random_unit(2, i),
                     alpha = std::pow(random_unit(3, i), 4) + 1e-8;
        const double correlated = V_smith_ggx_correlated(NoL, NoV, alpha);
        EXPECT_DOUBLE_EQ(correlated, V_smith_ggx_correlated(NoV, NoL, alpha));
        EXPECT_GE(correlated * (1 + 1e-14), V_smith_ggx_uncorrelated(NoL, NoV, alpha));
        EXPECT_LE(correlated * 4 * NoL * NoV, 1 + 1e-14);  // G <= 1
    }
}

TEST(Ggx, FloatFollowsDouble) {
    for (int i = 0; i < 10'000; ++i) {
        const double NoL = random_unit(4, i), NoV = random_unit(5, i),
                     alpha = 1e-3 + random_unit(6, i) * 0.999;
        const double sin2 = random_unit(7, i) * alpha;
        const double exact = D_ggx(std::sqrt(1 - sin2), sin2, alpha);
        EXPECT_NEAR(D_ggx(static_cast<float>(std::sqrt(1 - sin2)), static_cast<float>(sin2),
                          static_cast<float>(alpha)) /
                        exact,
                    1, 1e-6);
        const double V = V_smith_ggx_correlated(NoL, NoV, alpha);
        EXPECT_NEAR(V_smith_ggx_correlated(static_cast<float>(NoL), static_cast<float>(NoV),
                                           static_cast<float>(alpha)) /
                        V,
                    1, 2e-6);
    }
}

TEST(Ggx, SpecularTimesCosineIsFiniteWhereVisibilityIsNot) {
    EXPECT_TRUE(std::isinf(V_smith_ggx_correlated(0.0, 0.0, 0.5)));
    EXPECT_EQ(ggx_specular(0.0, 0.0, 1.0, 0.0, 0.5), 0);
    EXPECT_EQ(ggx_specular(0.0, 0.7, 0.8, 0.36, 0.5), 0);
    EXPECT_DOUBLE_EQ(ggx_specular(0.7, 0.0, 0.8, 0.36, 0.5), D_ggx(0.8, 0.36, 0.5) / (2 * 0.5));
    for (int i = 0; i < 10'000; ++i) {
        const double NoL = random_unit(8, i), NoV = random_unit(9, i), NoH = random_unit(10, i),
                     alpha = std::pow(random_unit(11, i), 4) + 1e-8, sin2 = 1 - NoH * NoH;
        const double product = D_ggx(NoH, sin2, alpha) * V_smith_ggx_correlated(NoL, NoV, alpha) * NoL;
        EXPECT_NEAR(ggx_specular(NoL, NoV, NoH, sin2, alpha) / product, 1, 1e-15);
    }
}

TEST(Ggx, KeepsItsDigitsDownToTheAlphaStated) {
    for (int exponent = 0; exponent <= 17; ++exponent)
        for (int i = 0; i < 2000; ++i) {
            const float alpha =
                static_cast<float>(std::pow(10.0, -exponent) * (1 - .9 * random_unit(16, exponent, i)));
            const double width = std::pow(10.0, 8 * random_unit(17, exponent, i) - 3) * alpha;
            const float sin2 = i % 4 == 0 ? 0 : static_cast<float>(std::min(width * width, 1.0));
            const float NoH = std::sqrt(1 - sin2);
            const double truth = D_ggx<double>(NoH, sin2, alpha);
            if (truth < std::numeric_limits<float>::min()) continue;
            ASSERT_LT(ulp_error(D_ggx(NoH, sin2, alpha), truth), 8) << alpha << ' ' << sin2;
        }
    EXPECT_NEAR(D_ggx(1.0, 0.0, 1e-150) * std::numbers::pi * 1e-150 * 1e-150, 1, 1e-14);
    EXPECT_TRUE(std::isinf(D_ggx(1.0f, 0.0f, 1e-20f)));
    EXPECT_TRUE(std::isinf(D_ggx(1.0f, 0.0f, 1e-30f)));
}

TEST(Ggx, FloatIsWithinTheUlpStated) {
    for (int i = 0; i < 100'000; ++i) {
        const float NoL = static_cast<float>(random_unit(12, i)),
                    NoV = static_cast<float>(random_unit(13, i)),
                    alpha = static_cast<float>(std::pow(random_unit(14, i), 4) + 1e-4),
                    NoH = static_cast<float>(random_unit(15, i)), sin2 = (1 - NoH) * (1 + NoH);
        const double l = NoL, v = NoV, a = alpha, h = NoH, s = sin2;
        EXPECT_LT(ulp_error(D_ggx(NoH, sin2, alpha), D_ggx(h, s, a)), 8);
        EXPECT_LT(ulp_error(smith_ggx_root(NoL, alpha), smith_ggx_root(l, a)), 4);
        EXPECT_LT(ulp_error(G1_smith_ggx(NoL, alpha), G1_smith_ggx(l, a)), 8);
        EXPECT_LT(ulp_error(V_smith_ggx_correlated(NoL, NoV, alpha), V_smith_ggx_correlated(l, v, a)), 8);
        EXPECT_LT(ulp_error(V_smith_ggx_uncorrelated(NoL, NoV, alpha), V_smith_ggx_uncorrelated(l, v, a)), 8);
        EXPECT_LT(ulp_error(ggx_specular(NoL, NoV, NoH, sin2, alpha), ggx_specular(l, v, h, s, a)), 16);
    }
}

}  // namespace
}  // namespace pbr
