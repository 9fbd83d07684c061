#include "pbr/ibl/zonal_harmonics.hpp"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/legendre.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "pbr/ibl/ld.hpp"
#include "pbr/ibl/patches.hpp"
#include "pbr/ibl/spherical_harmonics.hpp"
#include "pbr/ibl/zonal_kernel.hpp"
#include "pbr/numerics/sequence.hpp"
#include "tests/libpbr/support/integrate.hpp"
#include "tests/libpbr/support/property.hpp"

namespace pbr {
namespace {

constexpr double kPi = std::numbers::pi;
using boost::math::quadrature::gauss_kronrod;

TEST(ZonalCosine, HasTheCoefficientsOfIrradiance) {
    const double expected[] = {kPi, 2 * kPi / 3, kPi / 4, 0, -kPi / 24, 0, kPi / 64, 0, -5 * kPi / 640};
    for (int l = 0; l <= 8; ++l) EXPECT_NEAR(zonal_cosine(l), expected[l], 1e-14 * kPi) << l;
}

TEST(ZonalCosine, IsTheIntegralAgainstLegendre) {
    for (int l = 0; l <= 40; ++l) {
        const auto f = [&](double mu) { return 2 * kPi * mu * boost::math::legendre_p(l, mu); };
        EXPECT_NEAR(zonal_cosine(l), (gauss_kronrod<double, 61>::integrate(f, 0.0, 1.0, 6, 1e-14)), 1e-13)
            << l;
    }
}

TEST(ZonalGgx, HasThePublishedCoefficients) {
    const struct {
        double alpha, k[4];
    } rows[] = {{0.1, {.954354, .876140, .783295, .689595}},
                {0.25, {.867396, .662406, .460388, .305538}},
                {0.5, {.763561, .436024, .179937, .055995}},
                {1, {2.0 / 3, 0.25, 0, -1.0 / 24}}};
    for (const auto& row : rows) {
        const std::vector<double> k = zonal_ggx(GgxZonalKernel(row.alpha), 5);
        EXPECT_NEAR(k[0], 1, 1e-12);
        for (int l = 1; l <= 4; ++l) EXPECT_NEAR(k[l], row.k[l - 1], 6e-7) << row.alpha << " " << l;
    }
    // Alpha = 1 is irradiance over pi, in every band.
    const std::vector<double> k = zonal_ggx(GgxZonalKernel(1), 64);
    for (int l = 0; l < 64; ++l) EXPECT_NEAR(k[l], zonal_cosine(l) / kPi, 1e-13) << l;
}

TEST(ZonalGgx, IsTheIntegralAgainstLegendreToItsStatedError) {
    for (const double alpha : {1e-4, 0.03, 0.9}) {
        const GgxZonalKernel kernel(alpha);
        const std::vector<double> k = zonal_ggx(kernel, 256);
        for (const int l : {0, 7, 255}) {
            const auto f = [&](double log_x) {
                const double x = std::exp(log_x);
                return 2 * kPi * kernel.value(x) * x * boost::math::legendre_p(l, 1 - x);
            };
            double sum = 0;
            for (double low = -60; low < 0; low += 2)
                sum += gauss_kronrod<double, 61>::integrate(f, low, low + 2, 4, 1e-13);
            EXPECT_NEAR(k[l], sum, 1e-12) << alpha << " " << l;
        }
    }
}

TEST(ZonalGgx, TurnsRadianceIntoExactPrefilteredRadiance) {
    // LD_lm = k_l E_lm, against the sum over texels; a harmonic sky keeps the truncation out.
    constexpr int kWidth = 64, kHeight = 32, kBands = 32;
    std::vector<float> rgb(kWidth * kHeight * 3);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const glm::dvec3 d = equirect_direction((x + 0.5) / kWidth, (y + 0.5) / kHeight);
            const double value = 1 + 0.6 * d.y + 0.4 * d.x * d.z + 2 * std::pow(std::max(0.0, d.x), 6);
            for (int channel = 0; channel < 3; ++channel)
                rgb[(y * kWidth + x) * 3 + channel] = static_cast<float>(value);
        }
    const PatchBlocks source(EquirectView{rgb.data(), kWidth, kHeight, glm::dmat3(1)});
    const std::vector<glm::dvec3> E = sh_project(source, kBands);
    for (const double alpha : {0.25, 0.5, 1.0}) {
        std::vector<glm::dvec3> LD = E;
        const std::vector<double> k = zonal_ggx(GgxZonalKernel(alpha), kBands);
        sh_scale_bands<double, glm::dvec3>(k, LD);
        const std::vector<glm::dvec3> directions = {{1, 0, 0}, {0, 0.6, 0.8}, {-0.6, -0.8, 0}};
        std::vector<double> exact(9);
        std::uint64_t evaluations = 0;
        ld_exact(source, alpha, directions, exact, evaluations);
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR((sh_reconstruct<double, glm::dvec3>(kBands, LD, directions[i]).x), exact[3 * i],
                        3e-4 * exact[3 * i])
                << alpha;
    }
}

TEST(Windows, AreOneAtTheMeanAndFallToZero) {
    EXPECT_EQ(window_hann(0, 4.0), 1);
    EXPECT_NEAR(window_hann(2, 4.0), 0.5, 1e-15);
    EXPECT_EQ(window_hann(4, 4.0), 0);
    EXPECT_EQ(window_hann(9, 4.0), 0);
    EXPECT_EQ(window_lanczos(0, 3.0), 1);
    EXPECT_NEAR(window_lanczos(1, 2.0), 2 / kPi, 1e-15);
    EXPECT_EQ(window_lanczos(3, 3.0), 0);
    EXPECT_EQ(window_lanczos(7, 3.0), 0);
    EXPECT_EQ(window_gauss(0, 0.3), 1);
    EXPECT_NEAR(window_gauss(2, 0.1), std::exp(-0.6), 1e-15);
    for (int l = 0; l < 8; ++l) EXPECT_GE(window_hann(l, 8.0f), window_hann(l + 1, 8.0f));
}

/// The least value over a fine grid, by another set of points than the library's.
double least_value(int bands, const std::vector<double>& c) {
    double least = 1e300;
    for (int i = 0; i <= 180; ++i)
        for (int j = 0; j < 240; ++j) {
            const double theta = kPi * i / 180, phi = 2 * kPi * j / 240, s = std::sin(theta);
            least = std::min(least, sh_reconstruct<double, double>(
                                        bands, c, {s * std::cos(phi), s * std::sin(phi), std::cos(theta)}));
        }
    return least;
}

TEST(Dering, LiftsTheIrradianceOfASunToZeroAndNoFurther) {
    for (const Vec3<double> sun : {Vec3<double>(0, 0, 1), Vec3<double>(0.48, -0.6, 0.64)})
        for (const int bands : {3, 5}) {
            std::vector<double> c(sh_count(bands));
            sh_evaluate<double>(bands, sun, c);  // a point light of unit flux
            std::vector<double> irradiance = c;
            for (int l = 0; l < bands; ++l)
                for (int m = -l; m <= l; ++m) irradiance[sh_index(l, m)] *= zonal_cosine(l);
            const double before = least_value(bands, irradiance);
            ASSERT_LT(before, -0.02);
            const double t = dering_time(bands, irradiance);
            const double mean = irradiance[0] * std::sqrt(1 / (4 * kPi));
            for (const double factor : {1.0, 0.97}) {
                std::vector<double> windowed = irradiance, factors(bands);
                for (int l = 0; l < bands; ++l) factors[l] = window_gauss(l, factor * t);
                sh_scale_bands<double, double>(factors, windowed);
                if (factor == 1)
                    EXPECT_GE(least_value(bands, windowed), -2e-6 * mean);
                else
                    EXPECT_LT(least_value(bands, windowed), -1e-4 * mean);
            }
        }
}

TEST(Dering, LiftsAnySeriesOfPositiveMean) {
    for (int trial = 0; trial < 30; ++trial) {
        const int bands = 2 + trial % 7;
        std::vector<double> c(sh_count(bands)), factors(bands);
        for (int i = 0; i < sh_count(bands); ++i) c[i] = 2 * random_unit(31, trial, i) - 1;
        c[0] = 0.5;
        const double t = dering_time(bands, c);
        for (int l = 0; l < bands; ++l) factors[l] = window_gauss(l, t);
        sh_scale_bands<double, double>(factors, c);
        EXPECT_GE(least_value(bands, c), -2e-6) << bands << " bands, trial " << trial;
        EXPECT_EQ(c[0], 0.5);
    }
}

TEST(Dering, LeavesWhatIsNotNegative) {
    std::vector<double> c(9, 0.0);
    c[0] = 1;
    c[1] = 0.3;
    EXPECT_EQ(dering_time(3, c), 0);
    c[0] = -1;
    EXPECT_TRUE(std::isinf(dering_time(3, c)));
}

RC_GTEST_PROP(IrradiancePolynomial, IsTheConvolvedSeries, ()) {
    std::array<double, 9> radiance;
    for (double& value : radiance) value = *uniform(-1, 1);
    const Vec3<double> n = *direction();
    std::vector<double> convolved(radiance.begin(), radiance.end());
    const std::vector<double> cosine = {zonal_cosine(0), zonal_cosine(1), zonal_cosine(2)};
    sh_scale_bands<double, double>(cosine, convolved);
    const double expected = sh_reconstruct<double, double>(3, convolved, n);
    const auto polynomial = irradiance_polynomial<double>(radiance);
    RC_ASSERT(std::abs(evaluate_irradiance<double, double>(polynomial, n) - expected) < 1e-14);
}

TEST(IrradiancePolynomial, HasThePublishedConstants) {
    std::array<double, 9> ones;
    ones.fill(1);
    const auto c = irradiance_polynomial<double>(ones);
    EXPECT_NEAR(c[0], .886227, 5e-7);      // c4
    EXPECT_NEAR(c[1], 2 * .511664, 2e-6);  // 2 c2, whose printed last digit is one too high
    EXPECT_NEAR(c[4], 2 * .429043, 1e-6);  // 2 c1
    EXPECT_NEAR(c[6], .743125 / 3, 5e-7);  // c3 z^2 - c5
    EXPECT_NEAR(c[6], .247708, 5e-7);
    EXPECT_NEAR(c[8], .429043, 5e-7);  // c1
}

TEST(IrradiancePolynomial, IsTheIntegralOfTheCosine) {
    // A quadratic environment has no bands beyond: the polynomial is exact.
    const auto L = [](const Vec3<double>& w) { return 2 + w.x - 0.5 * w.y * w.z + 0.7 * w.x * w.x; };
    std::array<double, 9> radiance;
    for (int i = 0; i < 9; ++i)
        radiance[i] =
            integrate_sphere([&](const Vec3<double>& w) { return L(w) * sh_evaluate3(w)[i]; }, 1e-9);
    const auto c = irradiance_polynomial<double>(radiance);
    const Vec3<double> n(0.48, 0.6, 0.64), t = glm::normalize(glm::cross(n, Vec3<double>(0, 0, 1))),
                                           b = glm::cross(n, t);
    const double E = integrate_hemisphere(
        [&](const Vec3<double>& w) { return L(w.x * t + w.y * b + w.z * n) * w.z; }, 1e-9);
    EXPECT_NEAR((evaluate_irradiance<double, double>(c, n)), E, 1e-7);
}

}  // namespace
}  // namespace pbr
