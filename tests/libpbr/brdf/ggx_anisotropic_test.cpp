#include "pbr/brdf/ggx_anisotropic.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/libpbr/support/chi_square.hpp"
#include "tests/libpbr/support/float_error.hpp"
#include "tests/libpbr/support/integrate.hpp"
#include "tests/libpbr/support/property.hpp"
#include "tests/libpbr/support/reflections.hpp"

namespace pbr {
namespace {

constexpr AnisotropicAlpha<double> kWidths[] = {{.3, .3}, {.6, .2}, {.15, .8}, {1.0, .4}};

TEST(GgxAnisotropic, ConventionsHoldWhatTheySay) {
    EXPECT_EQ(anisotropic_alpha(.25, 0.0).x, .25);
    EXPECT_EQ(anisotropic_alpha(.25, 0.0).y, .25);
    EXPECT_NEAR(anisotropic_alpha(.25, 1.0).x / anisotropic_alpha(.25, 1.0).y, 10, 1e-13);
    const auto burley = anisotropic_alpha(.25, .7);
    EXPECT_DOUBLE_EQ(burley.x * burley.y, .25 * .25);
    const auto kulla_conty = anisotropic_alpha_kulla_conty(.25, -.5);
    EXPECT_DOUBLE_EQ(kulla_conty.x, .125);
    EXPECT_DOUBLE_EQ(kulla_conty.y, .375);
}

TEST(GgxAnisotropic, ProjectedAreaOfNormalsIsOne) {
    for (const auto& alpha : kWidths)
        EXPECT_NEAR(integrate_hemisphere(
                        [&](const Vec3<double>& w) { return D_ggx_anisotropic(w, alpha) * w.z; }, 1e-9),
                    1, 1e-8)
            << alpha.x;
}

TEST(GgxAnisotropic, MaskedVisibleAreaEqualsTheProjectedOne) {
    // Heitz 2014, eq. 14; the clamp's edge costs digits.
    for (const auto& alpha : kWidths)
        for (const double turns : {0.0, .13, .25}) {
            const Vec3<double> wo = direction_at(.35, turns);
            const double area = integrate_hemisphere(
                [&](const Vec3<double>& w) {
                    return std::max(0.0, glm::dot(wo, w)) * D_ggx_anisotropic(w, alpha);
                },
                1e-6);
            EXPECT_NEAR(2 * wo.z / (wo.z + smith_ggx_root_anisotropic(wo, alpha)) * area, wo.z, 1e-5);
        }
}

TEST(GgxAnisotropic, IsTheIsotropicOneWhereTheWidthsAgree) {
    double worst_root = 0, worst_V = 0;
    for (int i = 0; i < 20'000; ++i) {
        const Reflection<float> r = as_float(sample_reflection(i));
        const float a = static_cast<float>(std::pow(random_unit(1, i), 3) + 1e-3);
        const AnisotropicAlpha<float> alpha{a, a};
        ASSERT_EQ(D_ggx_anisotropic(r.wm, alpha), D_ggx(r.NoH, r.sin2, a));
        worst_root = std::max(
            worst_root, ulp_distance(smith_ggx_root_anisotropic(r.wo, alpha), smith_ggx_root(r.NoV, a)));
        worst_V = std::max(worst_V, ulp_distance(V_smith_ggx_anisotropic_correlated(r.wo, r.wi, alpha),
                                                 V_smith_ggx_correlated(r.NoL, r.NoV, a)));
        const float u1 = static_cast<float>(random_unit(2, i)), u2 = static_cast<float>(random_unit(3, i));
        if (u1 < 1 && u2 < 1) {
            ASSERT_EQ(sample_ggx_anisotropic_vndf(r.wo, alpha, u1, u2), sample_ggx_vndf(r.wo, a, u1, u2));
        }
    }
    EXPECT_LE(worst_root, 4);
    EXPECT_LE(worst_V, 8);
}

TEST(GgxAnisotropic, TurningTheSurfaceSwapsTheWidths) {
    for (int i = 0; i < 1000; ++i) {
        const Vec3<double> w = sample_reflection(i).wm, turned(-w.y, w.x, w.z);
        const AnisotropicAlpha<double> alpha{.2, .7}, swapped{.7, .2};
        EXPECT_NEAR(D_ggx_anisotropic(w, alpha) / D_ggx_anisotropic(turned, swapped), 1, 1e-13);
    }
}

TEST(GgxAnisotropic, NdfSamplingMatchesItsDensity) {
    for (const auto& alpha : kWidths)
        EXPECT_GT(chi_square_p_value(
                      [&](double u1, double u2) { return sample_ggx_anisotropic_ndf(alpha, u1, u2); },
                      [&](const Vec3<double>& w) { return pdf_ggx_anisotropic_ndf(alpha, w); }),
                  kSignificance)
            << alpha.x;
}

TEST(GgxAnisotropic, VndfSamplingMatchesItsDensity) {
    for (const auto& alpha : kWidths)
        for (const double NoV : {0.0, .3, 1.0}) {
            const Vec3<double> wo = direction_at(NoV, .1);
            EXPECT_GT(
                chi_square_p_value(
                    [&](double u1, double u2) { return sample_ggx_anisotropic_vndf(wo, alpha, u1, u2); },
                    [&](const Vec3<double>& w) { return pdf_ggx_anisotropic_vndf(wo, alpha, w); }),
                kSignificance)
                << alpha.x << ' ' << NoV;
        }
}

TEST(GgxAnisotropic, InverseReturnsTheSample) {
    for (int i = 0; i < 5000; ++i) {
        const double u1 = random_unit(4, i), u2 = random_unit(5, i);
        const AnisotropicAlpha<double> alpha = anisotropic_alpha(1e-2 + random_unit(6, i), random_unit(7, i));
        const Sample2 ndf = inverse_ggx_anisotropic_ndf(alpha, sample_ggx_anisotropic_ndf(alpha, u1, u2));
        EXPECT_NEAR(ndf.u1, u1, 1e-9);
        EXPECT_NEAR(std::remainder(ndf.u2 - u2, 1.0), 0, 1e-9);
        const Vec3<double> wo = direction_at(random_unit(8, i), random_unit(9, i));
        const Sample2 vndf =
            inverse_ggx_anisotropic_vndf(wo, alpha, sample_ggx_anisotropic_vndf(wo, alpha, u1, u2));
        EXPECT_NEAR(vndf.u2, u2, 1e-7);
        if (u2 > 1e-3 && u2 < .999) {
            EXPECT_NEAR(std::remainder(vndf.u1 - u1, 1.0), 0, 1e-6);
        }
    }
}

RC_GTEST_PROP(GgxAnisotropic, IsReciprocalBelowTheCorrelatedOneAndLosesLight, ()) {
    const Vec3<double> wo = *direction_above(), wi = *direction_above();
    const AnisotropicAlpha<double> alpha = anisotropic_alpha(*log_uniform(1e-4, 1), *unit_interval());
    RC_PRE(wo.z > 0 && wi.z > 0);
    const double V = V_smith_ggx_anisotropic_correlated(wo, wi, alpha);
    RC_ASSERT(V == V_smith_ggx_anisotropic_correlated(wi, wo, alpha));
    RC_ASSERT(V * (1 + 1e-14) >= V_smith_ggx_anisotropic_uncorrelated(wo, wi, alpha));
    RC_ASSERT(V * 4 * wo.z * wi.z <= 1 + 1e-14);  // G <= 1
    RC_ASSERT(std::isfinite(V_smith_ggx_anisotropic_uncorrelated({1, 0, 0}, {0, 1, 0}, alpha)));
}

TEST(GgxAnisotropic, AlbedoIsBelowOneAndNearTheIsotropicOneNormally) {
    for (const double NoV : {.1, .5, 1.0}) {
        const AnisotropicAlpha<double> alpha = anisotropic_alpha(.3, .6);
        const double E = reflection_albedo(
            [&](const Reflection<double>& r) {
                return D_ggx_anisotropic(r.wm, alpha) * V_smith_ggx_anisotropic_correlated(r.wo, r.wi, alpha);
            },
            NoV, 1e-6);
        EXPECT_GT(E, .7);
        EXPECT_LT(E, 1);
    }
}

TEST(GgxAnisotropic, FloatIsWithinTheUlpStated) {
    for (int i = 0; i < 100'000; ++i) {
        const Reflection<float> r = as_float(sample_reflection(i));
        const Reflection<double> d = as_double(r);
        const auto a = anisotropic_alpha(static_cast<float>(std::pow(random_unit(10, i), 3) + 1e-3),
                                         static_cast<float>(random_unit(11, i)));
        const AnisotropicAlpha<double> b{a.x, a.y};
        EXPECT_NEAR(glm::length(Vec3<double>(sample_ggx_anisotropic_vndf(r.wo, a, .3f, .6f))), 1,
                    4 * 0x1p-23);
        EXPECT_LT(ulp_error(pdf_ggx_anisotropic_ndf(a, r.wm), pdf_ggx_anisotropic_ndf(b, d.wm)), 14);
        if (d.LoH > .1) {  // below, wo.wm cancels
            EXPECT_LT(
                ulp_error(pdf_ggx_anisotropic_vndf(r.wo, a, r.wm), pdf_ggx_anisotropic_vndf(d.wo, b, d.wm)),
                20);
        }
        EXPECT_LT(ulp_error(D_ggx_anisotropic(r.wm, a), D_ggx_anisotropic(d.wm, b)), 12);
        EXPECT_LT(ulp_error(smith_ggx_root_anisotropic(r.wo, a), smith_ggx_root_anisotropic(d.wo, b)), 4);
        EXPECT_LT(ulp_error(V_smith_ggx_anisotropic_correlated(r.wo, r.wi, a),
                            V_smith_ggx_anisotropic_correlated(d.wo, d.wi, b)),
                  8);
        EXPECT_LT(ulp_error(V_smith_ggx_anisotropic_uncorrelated(r.wo, r.wi, a),
                            V_smith_ggx_anisotropic_uncorrelated(d.wo, d.wi, b)),
                  8);
    }
}

}  // namespace
}  // namespace pbr
