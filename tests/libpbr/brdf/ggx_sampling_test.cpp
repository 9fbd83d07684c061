#include "pbr/brdf/ggx_sampling.hpp"

#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <vector>

#include "pbr/numerics/quadrature.hpp"

namespace pbr {
namespace {

/// Chi-square of samples against a pdf over a grid of cos(theta) x phi; returns the p-value. `sample(u1, u2)`
/// gives a direction, `pdf(direction)` its density per steradian.
template <class Sample, class Pdf>
double chi_square_p_value(const Sample& sample, const Pdf& pdf) {
    constexpr int kRings = 16, kSectors = 16, kCount = 200'000, kSub = 24;
    std::vector<double> observed(kRings * kSectors), expected(kRings * kSectors);
    double outside = 0;
    for (int i = 0; i < kCount; ++i) {
        const Vec3<double> w = sample(random_unit(11, i, 0), random_unit(11, i, 1));
        if (w.z < 0) {
            ++outside;
            continue;
        }
        const int ring = std::min(kRings - 1, static_cast<int>(w.z * kRings));
        const int sector = std::min(kSectors - 1, static_cast<int>(azimuth_turns(w.x, w.y) * kSectors));
        observed[ring * kSectors + sector] += 1;
    }
    EXPECT_EQ(outside, 0);
    const QuadratureRule rule = gauss_legendre(kSub);
    for (int ring = 0; ring < kRings; ++ring)
        for (int sector = 0; sector < kSectors; ++sector)
            for (int a = 0; a < kSub; ++a)
                for (int b = 0; b < kSub; ++b) {
                    const double z = (ring + rule.nodes[a]) / kRings,
                                 turns = (sector + rule.nodes[b]) / kSectors;
                    const double s = std::sqrt(1 - z * z);
                    const Vec3<double> w(s * std::cos(2 * std::numbers::pi * turns),
                                         s * std::sin(2 * std::numbers::pi * turns), z);
                    expected[ring * kSectors + sector] += rule.weights[a] * rule.weights[b] * pdf(w) * 2 *
                                                          std::numbers::pi / (kRings * kSectors) * kCount;
                }
    double statistic = 0, pooled_observed = 0, pooled_expected = 0;
    int cells = 0;
    for (std::size_t i = 0; i < observed.size(); ++i) {
        if (expected[i] < 10) {
            pooled_observed += observed[i];
            pooled_expected += expected[i];
            continue;
        }
        statistic += (observed[i] - expected[i]) * (observed[i] - expected[i]) / expected[i];
        ++cells;
    }
    if (pooled_expected > 5) {
        statistic +=
            (pooled_observed - pooled_expected) * (pooled_observed - pooled_expected) / pooled_expected;
        ++cells;
    }
    return boost::math::cdf(complement(boost::math::chi_squared(cells - 1), statistic));
}

constexpr double kSignificance = 1e-4;

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

}  // namespace
}  // namespace pbr
