#include "pbr/ibl/spherical_harmonics.hpp"

#include <gtest/gtest.h>

#include <boost/math/special_functions/legendre.hpp>
#include <boost/math/special_functions/spherical_harmonic.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/patches.hpp"
#include "pbr/numerics/quadrature.hpp"
#include "pbr/numerics/sequence.hpp"
#include "tests/libpbr/support/property.hpp"

namespace pbr {
namespace {

constexpr double kPi = std::numbers::pi;

/// Y by Boost in long double, which has the Condon-Shortley phase: (-1)^m takes it out.
double by_boost(int l, int m, const Vec3<double>& d) {
    using boost::math::spherical_harmonic_i, boost::math::spherical_harmonic_r;
    const long double x = d.x, y = d.y, z = d.z;
    const long double theta = std::atan2(std::hypot(x, y), z), phi = std::atan2(y, x);
    const unsigned band = static_cast<unsigned>(l);
    if (m == 0) return static_cast<double>(spherical_harmonic_r(band, 0, theta, phi));
    const int a = std::abs(m);
    const long double part =
        m > 0 ? spherical_harmonic_r(band, a, theta, phi) : spherical_harmonic_i(band, a, theta, phi);
    return static_cast<double>((a % 2 == 0 ? 1 : -1) * std::numbers::sqrt2_v<long double> * part);
}

TEST(SphericalHarmonics, HaveTheSignsOfRamamoorthiAndHanrahan) {
    // 2001, eq. 3: all constants with a plus sign.
    const Vec3<double> d(0.48, 0.6, 0.64);
    const double expected[9] = {0.282095,
                                0.488603 * d.y,
                                0.488603 * d.z,
                                0.488603 * d.x,
                                1.092548 * d.x * d.y,
                                1.092548 * d.y * d.z,
                                0.315392 * (3 * d.z * d.z - 1),
                                1.092548 * d.x * d.z,
                                0.546274 * (d.x * d.x - d.y * d.y)};
    const auto closed = sh_evaluate3(d);
    for (int i = 0; i < 9; ++i) EXPECT_NEAR(closed[i], expected[i], 1e-6) << i;
}

RC_GTEST_PROP(SphericalHarmonics, AreThoseOfAnIndependentEvaluation, ()) {
    constexpr int kBands = 32;
    const Vec3<double> d = *direction();
    std::vector<double> basis(sh_count(kBands));
    sh_evaluate<double>(kBands, d, basis);
    for (const int l : {0, 1, 2, 5, 8, 17, 31})
        for (int m = -l; m <= l; ++m) RC_ASSERT(std::abs(basis[sh_index(l, m)] - by_boost(l, m, d)) < 5e-14);
    const auto closed = sh_evaluate3(d);
    for (int i = 0; i < 9; ++i) RC_ASSERT(std::abs(closed[i] - basis[i]) < 4 * 2.3e-16);
}

TEST(SphericalHarmonics, AreOrthonormal) {
    // Product rule exact for the squares of all bands: Gauss-Legendre in z, equal steps in azimuth.
    constexpr int kBands = 32, kCount = sh_count(kBands);
    const QuadratureRule rule = gauss_legendre(kBands);
    std::vector<double> gram(kCount * kCount), basis(kCount);
    constexpr int kSteps = 2 * kBands;
    std::vector<std::vector<double>> rows;
    std::vector<double> weights;
    for (int i = 0; i < rule.size(); ++i)
        for (int j = 0; j < kSteps; ++j) {
            const double z = 2 * rule.nodes[i] - 1, phi = 2 * kPi * j / kSteps,
                         s = std::sqrt((1 - z) * (1 + z));
            sh_evaluate<double>(kBands, {s * std::cos(phi), s * std::sin(phi), z}, basis);
            rows.push_back(basis);
            weights.push_back(rule.weights[i] * 4 * kPi / kSteps);
        }
    double worst = 0;
    for (int a = 0; a < kCount; a += 41)
        for (int b = 0; b < kCount; ++b) {
            double sum = 0;
            for (std::size_t i = 0; i < rows.size(); ++i) sum += weights[i] * rows[i][a] * rows[i][b];
            worst = std::max(worst, std::abs(sum - (a == b)));
        }
    EXPECT_LT(worst, 2e-14);
}

RC_GTEST_PROP(SphericalHarmonics, ObeyTheAdditionTheorem, ()) {
    constexpr int kBands = 32;
    const Vec3<double> a = *direction(), b = *direction();
    std::vector<double> at_a(sh_count(kBands)), at_b(sh_count(kBands));
    sh_evaluate<double>(kBands, a, at_a);
    sh_evaluate<double>(kBands, b, at_b);
    const double mu = std::clamp(glm::dot(a, b), -1.0, 1.0);
    for (int l = 0; l < kBands; ++l) {
        double sum = 0;
        for (int m = -l; m <= l; ++m) sum += at_a[sh_index(l, m)] * at_b[sh_index(l, m)];
        RC_ASSERT(std::abs(sum - (2 * l + 1) / (4 * kPi) * boost::math::legendre_p(l, mu)) < 1e-12);
    }
}

RC_GTEST_PROP(SphericalHarmonics, FloatFollowsDouble, ()) {
    constexpr int kBands = 8;
    const Vec3<double> d = *direction();
    const Vec3<float> rounded(d);
    std::vector<float> single(sh_count(kBands));
    std::vector<double> exact(sh_count(kBands));
    sh_evaluate<float>(kBands, rounded, single);
    sh_evaluate<double>(kBands, Vec3<double>(rounded), exact);
    for (int i = 0; i < sh_count(kBands); ++i) RC_ASSERT(std::abs(single[i] - exact[i]) < 2e-6);
    const auto closed = sh_evaluate3(rounded);
    for (int i = 0; i < 9; ++i) RC_ASSERT(std::abs(closed[i] - exact[i]) < 4 * 1.2e-7);
}

TEST(SphericalHarmonics, ReconstructABandLimitedFunction) {
    std::vector<glm::dvec3> coefficients(9);
    for (int i = 0; i < 9; ++i) coefficients[i] = glm::dvec3(i, 1, -i * 0.5);
    const Vec3<double> d(0, 0.6, 0.8);
    const glm::dvec3 value = sh_reconstruct<double, glm::dvec3>(3, coefficients, d);
    const auto basis = sh_evaluate3(d);
    double expected = 0;
    for (int i = 0; i < 9; ++i) expected += i * basis[i];
    EXPECT_NEAR(value.x, expected, 1e-14);
    EXPECT_NEAR(value.z, -expected / 2, 1e-14);
}

TEST(ShProjection, OfAConstantPictureIsItsMean) {
    std::vector<float> rgb(64 * 32 * 3, 2.5f);
    for (const std::vector<glm::dvec3>& c :
         {sh_project(PatchBlocks(EquirectView{rgb.data(), 64, 32, glm::dmat3(1)}), 8),
          sh_project(PatchBlocks(CubeView{rgb.data(), 8}), 8)}) {
        EXPECT_NEAR(c[0].x / 2.5, std::sqrt(4 * kPi), 3e-7 * std::sqrt(4 * kPi));
        for (int i = 1; i < 64; ++i) EXPECT_NEAR(c[i].y, 0, 2.5 * 3e-7) << i;
    }
}

TEST(ShProjection, OfOneTexelIsTheIntegralOfTheBasisOverIt) {
    // Witness: the indicator of an equirect texel in closed form over longitude, by quadrature over
    // colatitude.
    constexpr int kWidth = 8, kHeight = 4, kX = 5, kY = 1, kBands = 8;
    std::vector<float> rgb(kWidth * kHeight * 3, 0.f);
    rgb[(kY * kWidth + kX) * 3 + 1] = 1.f;
    const auto c = sh_project(PatchBlocks(EquirectView{rgb.data(), kWidth, kHeight, glm::dmat3(1)}), kBands);
    const QuadratureRule rule = gauss_legendre(24);
    std::vector<double> basis(sh_count(kBands)), expected(sh_count(kBands));
    for (int i = 0; i < 24; ++i)
        for (int j = 0; j < 24; ++j) {
            const double u = (kX + rule.nodes[i]) / kWidth, v = (kY + rule.nodes[j]) / kHeight;
            const double area =
                2 * kPi / kWidth * kPi / kHeight * std::sin(kPi * v) * rule.weights[i] * rule.weights[j];
            sh_evaluate<double>(kBands, equirect_direction(u, v), basis);
            for (int k = 0; k < sh_count(kBands); ++k) expected[k] += area * basis[k];
        }
    const double mean = expected[0] / std::sqrt(4 * kPi);
    for (int k = 0; k < sh_count(kBands); ++k) {
        EXPECT_NEAR(c[k].y, expected[k], 3e-7 * std::max(mean, 0.1)) << k;
        EXPECT_EQ(c[k].x, 0);
    }
}

TEST(ShProjection, OfACubeAndItsEquirectAgreeInLowBands) {
    // Texels of a smooth function: differences are those of constant texels, second order in their size.
    const auto f = [](const glm::dvec3& d) { return static_cast<float>(1 + 0.5 * d.x - 0.3 * d.y * d.z); };
    std::vector<float> cube(6 * 32 * 32 * 3), map(128 * 64 * 3);
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 32; ++x)
                cube[((face * 32 + y) * 32 + x) * 3] = f(cubemap_texel_direction({face, x, y}, 32));
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 128; ++x)
            map[(y * 128 + x) * 3] = f(equirect_direction((x + 0.5) / 128, (y + 0.5) / 64));
    const auto a = sh_project(PatchBlocks(CubeView{cube.data(), 32}), 3);
    const auto b = sh_project(PatchBlocks(EquirectView{map.data(), 128, 64, glm::dmat3(1)}), 3);
    const double k = std::sqrt(4 * kPi / 3), k2 = std::sqrt(4 * kPi / 15);
    const double exact[9] = {std::sqrt(4 * kPi), 0, 0, 0.5 * k, 0, -0.3 * k2, 0, 0, 0};
    for (int i = 0; i < 9; ++i) {
        EXPECT_NEAR(a[i].x, exact[i], 2e-3) << i;
        EXPECT_NEAR(b[i].x, exact[i], 2e-3) << i;
    }
}

}  // namespace
}  // namespace pbr
