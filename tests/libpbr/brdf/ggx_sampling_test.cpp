#include "pbr/brdf/ggx_sampling.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/libpbr/support/chi_square.hpp"
#include "tests/libpbr/support/float_error.hpp"
#include "tests/libpbr/support/reflections.hpp"

namespace pbr {
namespace {

TEST(GgxNdfSampling, MatchesItsDensity) {
    for (const double alpha : {0.2, 0.5, 1.0})
        EXPECT_GT(chi_square_p_value([&](double u1, double u2) { return sample_ggx_ndf(alpha, u1, u2); },
                                     [&](const Vec3<double>& w) { return pdf_ggx_ndf(alpha, w); }),
                  kSignificance)
            << alpha;
}

TEST(GgxVndfSampling, MatchesItsDensity) {
    for (const double alpha : {0.3, 0.7, 1.0})
        for (const double NoV : {0.0, 0.2, 0.7, 1.0}) {
            const Vec3<double> wo(std::sqrt(1 - NoV * NoV), 0, NoV);
            EXPECT_GT(
                chi_square_p_value([&](double u1, double u2) { return sample_ggx_vndf(wo, alpha, u1, u2); },
                                   [&](const Vec3<double>& w) { return pdf_ggx_vndf(wo, alpha, w); }),
                kSignificance)
                << alpha << " " << NoV;
        }
}

TEST(GgxSampling, InverseReturnsTheSample) {
    for (int i = 0; i < 5'000; ++i) {
        const double u1 = random_unit(1, i), u2 = random_unit(2, i), alpha = 1e-3 + random_unit(3, i) * 0.999;
        const double NoV = random_unit(4, i), turns = random_unit(5, i);
        const Sample2 ndf = inverse_ggx_ndf(alpha, sample_ggx_ndf(alpha, u1, u2));
        EXPECT_NEAR(ndf.u1, u1, 1e-9);
        EXPECT_NEAR(ndf.u2, u2, 1e-9);
        const SinCos azimuth = sin_cos_pi(2 * turns);
        const double sine = std::sqrt(1 - NoV * NoV);
        const Vec3<double> wo(sine * azimuth.cos, sine * azimuth.sin, NoV);
        const Sample2 vndf = inverse_ggx_vndf(wo, alpha, sample_ggx_vndf(wo, alpha, u1, u2));
        EXPECT_NEAR(vndf.u2, u2, 1e-7) << alpha << " " << NoV;
        if (u2 > 1e-3 && u2 < 0.999) {
            EXPECT_NEAR(std::remainder(vndf.u1 - u1, 1.0), 0, 1e-6) << alpha << " " << NoV;
        }
    }
}

TEST(GgxSampling, SamplesAreUnitVectorsAboveTheSurface) {
    for (int i = 0; i < 10'000; ++i) {
        const float alpha = i % 3 == 0 ? 1e-4f : static_cast<float>(random_unit(1, i));
        const float NoV = i % 5 == 0 ? 0.0f : static_cast<float>(random_unit(2, i));
        const Vec3<float> wo(std::sqrt(1 - NoV * NoV), 0, NoV);
        const float u1 = static_cast<float>(random_unit(3, i)) * 0.999999f,
                    u2 = static_cast<float>(random_unit(4, i)) * 0.999999f;
        for (const Vec3<float>& wm : {sample_ggx_ndf(std::max(alpha, 1e-6f), u1, u2),
                                      sample_ggx_vndf(wo, std::max(alpha, 1e-6f), u1, u2)}) {
            EXPECT_NEAR(glm::length(wm), 1, 1e-5f);
            EXPECT_GE(wm.z, -1e-6f);
        }
    }
}

TEST(GgxSampling, FloatIsWithinTheUlpStated) {
    for (int i = 0; i < 50'000; ++i) {
        const Reflection<float> r = as_float(sample_reflection(i));
        const Reflection<double> d = as_double(r);
        const float alpha = static_cast<float>(std::pow(random_unit(1, i), 3) + 1e-3),
                    u1 = static_cast<float>(random_unit(2, i)) * .999f,
                    u2 = static_cast<float>(random_unit(3, i)) * .999f;
        const double a = alpha;
        EXPECT_NEAR(glm::length(Vec3<double>(sample_ggx_ndf(alpha, u1, u2))), 1, 4 * 0x1p-23);
        EXPECT_NEAR(glm::length(Vec3<double>(sample_ggx_vndf(r.wo, alpha, u1, u2))), 1, 4 * 0x1p-23);
        EXPECT_LT(ulp_error(pdf_ggx_ndf(alpha, r.wm), pdf_ggx_ndf(a, d.wm)), 10);
        if (d.LoH > .1) {  // below, wo.wm cancels
            EXPECT_LT(ulp_error(pdf_ggx_vndf(r.wo, alpha, r.wm), pdf_ggx_vndf(d.wo, a, d.wm)), 16);
        }
    }
}

}  // namespace
}  // namespace pbr
