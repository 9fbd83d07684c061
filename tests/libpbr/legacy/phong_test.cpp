#include "pbr/legacy/phong.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "pbr/brdf/reflection.hpp"
#include "pbr/numerics/quadrature.hpp"

namespace pbr {
namespace {

constexpr double kPi = std::numbers::pi, kInf = std::numeric_limits<double>::infinity();

/// Albedo of cos^n from one view, by a product rule over the light's directions: no half vectors, no closed
/// forms.
double albedo(PhongLobe lobe, double n, double NoV, const QuadratureRule& rule) {
    const Vec3<double> wo(std::sqrt(1 - NoV * NoV), 0, NoV), mirror(-wo.x, 0, wo.z);
    double sum = 0;
    for (int i = 0; i < rule.size(); ++i)
        for (int j = 0; j < rule.size(); ++j) {
            const double z = rule.nodes[i], phi = kPi * rule.nodes[j], s = std::sqrt(1 - z * z);
            const Vec3<double> wi(s * std::cos(phi), s * std::sin(phi), z);
            const double cosine =
                lobe == PhongLobe::blinn ? reflection(wo, wi).NoH : std::max(0., dot(mirror, wi));
            if (cosine > 0) sum += 2 * kPi * rule.weights[i] * rule.weights[j] * std::pow(cosine, n) * z;
        }
    return sum;
}

TEST(Phong, AlbedosMatchBruteForce) {
    const QuadratureRule rule = gauss_legendre(64), views = gauss_legendre(32);
    for (const PhongLobe lobe : {PhongLobe::blinn, PhongLobe::mirror})
        for (const double n : {0., 1., 2.5, 10., 50.}) {
            SCOPED_TRACE(n);
            EXPECT_NEAR(albedo(lobe, n, 1, rule) / normal_albedo(lobe, n), 1, 1e-4);
            double mean = 0;
            for (int i = 0; i < views.size(); ++i)
                mean += 2 * views.weights[i] * views.nodes[i] * albedo(lobe, n, views.nodes[i], rule);
            EXPECT_NEAR(mean / phong_albedo(PhongNorm::none, lobe, n).mean, 1, 2e-3);
        }
}

TEST(Phong, UnnormalisedLobesReflectWhatTheyAreKnownToReflect) {
    EXPECT_NEAR(blinn_phong_normal_albedo(10.), 1.50, .005);
    EXPECT_NEAR(blinn_phong_normal_albedo(50.), .447, .001);
    EXPECT_NEAR(blinn_phong_normal_albedo(1000.), .025, .0001);
    EXPECT_NEAR(blinn_phong_normal_albedo(0.), kPi, 1e-12);
    EXPECT_NEAR(phong_mean_albedo(0.), 5 * kPi / 6, 1e-11);
}

TEST(Phong, NormsMakeKsTheAlbedoAtNormalView) {
    for (const double n : {0., 1e-6, 1., 50., 1e5, 1e12, kInf}) {
        EXPECT_NEAR(phong_albedo(PhongNorm::energy, PhongLobe::blinn, n).normal, 1, 1e-14) << n;
        EXPECT_NEAR(phong_albedo(PhongNorm::energy, PhongLobe::mirror, n).normal, 1, 1e-14) << n;
    }
    // (n + 8) / 8 pi is an approximation: 20 % at n = 1, .1 % at 1000.
    EXPECT_NEAR(phong_albedo(PhongNorm::n_plus_8, PhongLobe::blinn, 1e3).normal, 1, 3e-3);
    EXPECT_NEAR(phong_albedo(PhongNorm::over_pi, PhongLobe::blinn, 50.).mean * kPi,
                phong_albedo(PhongNorm::none, PhongLobe::blinn, 50.).mean, 1e-15);
}

TEST(Phong, HardExponentsHaveFiniteAlbedos) {
    for (const PhongLobe lobe : {PhongLobe::blinn, PhongLobe::mirror})
        for (const PhongNorm norm :
             {PhongNorm::energy, PhongNorm::n_plus_8, PhongNorm::none, PhongNorm::over_pi})
            for (const float n : {-1.f, 0.f, 1e-6f, 1.f, 2.f, 50.f, 1e4f, 1e6f, 1e30f,
                                  static_cast<float>(kInf), std::numeric_limits<float>::quiet_NaN()}) {
                const PhongAlbedo<float> a = phong_albedo(norm, lobe, n);
                EXPECT_TRUE(std::isfinite(a.normal) && std::isfinite(a.mean) && a.normal >= 0) << n;
            }
    EXPECT_EQ(phong_albedo(PhongNorm::energy, PhongLobe::blinn, kInf).mean, .5);
    EXPECT_NEAR(phong_albedo(PhongNorm::energy, PhongLobe::mirror, 1e8).mean, 2. / 3, 1e-4);
}

TEST(Phong, WallisIntegralIsExactWhereItIsRational) {
    double W = kPi / 2;
    for (int n = 0; n < 200; n += 2) {
        EXPECT_NEAR(wallis_integral(n) / W, 1, 1e-11) << n;
        W *= (n + 1.) / (n + 2.);
    }
    EXPECT_NEAR(wallis_integral(1), 1, 1e-11);
    EXPECT_NEAR(wallis_integral(3), 2. / 3, 1e-11);
}

}  // namespace
}  // namespace pbr
