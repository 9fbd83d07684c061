#include "pbr/legacy/energy.hpp"
#include "pbr/legacy/specular_gloss.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "pbr/brdf/fresnel.hpp"
#include "pbr/brdf/multiscatter.hpp"
#include "pbr/ibl/dfg.hpp"
#include "pbr/legacy/exponent.hpp"
#include "pbr/legacy/phong.hpp"
#include "pbr/numerics/sequence.hpp"

namespace pbr {
namespace {

/// 2 integral E mu dmu and 2 integral Fc mu dmu by quadrature, from the table's own source.
MeanAlbedo by_quadrature(double alpha) {
    if (alpha <= 0) return {1, 1. / 21};
    const QuadratureRule rule = gauss_legendre(32);
    std::vector<double> mu, weight;
    for (int i = 0; i < rule.size(); ++i) {
        mu.push_back(alpha * rule.nodes[i]);
        weight.push_back(alpha * rule.weights[i]);
        mu.push_back(std::pow(alpha, rule.nodes[i]));
        weight.push_back(-std::log(alpha) * mu.back() * rule.weights[i]);
    }
    std::vector<double> E(mu.size()), Fc(mu.size());
    dfg_ggx_row(mu, alpha, DfgMethod::quadrature(1e-7), E, Fc);
    MeanAlbedo mean{};
    for (std::size_t i = 0; i < mu.size(); ++i) {
        mean.E += 2 * weight[i] * mu[i] * E[i];
        mean.Fc += 2 * weight[i] * mu[i] * Fc[i];
    }
    if (alpha >= 1) return {average_albedo_ggx(1), mean.Fc};
    return mean;
}

TEST(LegacyEnergy, MeansMatchQuadrature) {
    for (int i = 0; i <= 40; ++i) {
        const double p = i / 40.;
        const MeanAlbedo fit = mean_albedo_ggx(p), truth = by_quadrature(p * p);
        EXPECT_NEAR(fit.E, average_albedo_ggx(p * p), 5e-6) << p;
        EXPECT_NEAR(fit.Fc, truth.Fc, 5e-6) << p;
    }
}

TEST(LegacyEnergy, MeanAlbedoIsThatOfItsParts) {
    // Kulla-Conty's lobe has the colour of multiscatter_colour and loses nothing at f0 = 1.
    const MeanAlbedo lobe = mean_albedo_ggx(.9);
    const double F_avg = average_schlick(.5, 1.);
    EXPECT_NEAR(mean_specular_albedo(.5, lobe, Scattering::multiple),
                .5 * (lobe.E - lobe.Fc) + lobe.Fc + multiscatter_colour(F_avg, lobe.E) * (1 - lobe.E), 1e-14);
    EXPECT_NEAR(mean_specular_albedo(1, lobe, Scattering::multiple), 1, 1e-14);
    EXPECT_NEAR(mean_specular_albedo(1, lobe, Scattering::single), lobe.E, 1e-14);
    EXPECT_EQ(mean_specular_albedo(0, lobe, Scattering::multiple), 0);
    EXPECT_EQ(mean_specular_albedo(0, 1, lobe, Scattering::single), lobe.Fc);
    const double f90 = f90_from_f0(Vec3<double>(.01));
    EXPECT_NEAR(mean_specular_albedo(.01, f90, lobe, Scattering::multiple),
                mean_specular_albedo(.01, lobe, Scattering::multiple), 1e-15);
}

TEST(LegacyEnergy, SolvedF0ReflectsWhatWasAskedFor) {
    for (const Scattering scattering : {Scattering::single, Scattering::multiple})
        for (const double p : {0., .05, .3, .7, 1.})
            for (int i = 0; i <= 200; ++i) {
                const MeanAlbedo lobe = mean_albedo_ggx(p);
                const double wanted = i / 200.;
                const SolvedF0 solved = f0_from_mean_albedo(wanted, lobe, scattering);
                const double found = mean_specular_albedo(solved.f0, lobe, scattering);
                if (solved.clamped)
                    EXPECT_LT(found, wanted);
                else
                    EXPECT_NEAR(found, wanted, 1e-6 * wanted) << p << " " << wanted;
            }
    EXPECT_EQ(f0_from_mean_albedo(std::numeric_limits<double>::quiet_NaN(), {1, 0}, Scattering::single).f0,
              0);
    EXPECT_EQ(f0_from_mean_albedo(-1, {1, 0}, Scattering::single).f0, 0);
}

TEST(LegacyEnergy, ManyLobesAreSolvedAsOneIs) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    std::vector<float> albedo{0,      -1,        std::numeric_limits<float>::quiet_NaN(), kInfinity, 1,
                              1e-30f, 1.0000005f};
    while (albedo.size() < 5003)
        albedo.push_back(static_cast<float>(std::pow(random_unit(1, albedo.size()), 3)) * 1.1f);
    std::vector<float> perceptual_roughness, f0(albedo.size());
    for (std::size_t i = 0; i < albedo.size(); ++i)
        perceptual_roughness.push_back(i % 50 < 2 ? static_cast<float>(i % 50)
                                                  : static_cast<float>(random_unit(2, i)));
    std::vector<std::uint8_t> clamped(albedo.size());
    for (const Scattering scattering : {Scattering::single, Scattering::multiple})
        for (const std::size_t count : {std::size_t{1}, std::size_t{37}, albedo.size()}) {
            f0_from_mean_albedo(albedo.data(), perceptual_roughness.data(), scattering, count, f0.data(),
                                clamped.data());
            for (std::size_t i = 0; i < count; ++i) {
                const MeanAlbedo lobe = mean_albedo_ggx(static_cast<double>(perceptual_roughness[i]));
                const SolvedF0 one = f0_from_mean_albedo(static_cast<double>(albedo[i]), lobe, scattering);
                ASSERT_EQ(f0[i], static_cast<float>(one.f0)) << albedo[i] << " " << perceptual_roughness[i];
                ASSERT_EQ(clamped[i], one.clamped) << albedo[i] << " " << perceptual_roughness[i];
            }
        }
}

TEST(LegacyEnergy, BlinnPhongKeepsItsMeanAlbedo) {
    // The lobe's albedo here is by quadrature, not by the fit that the f0 was solved with; n over [1, 1e5].
    for (const double n : {1., 3., 10., 50., 300., 1e4, 1e5})
        for (const PhongNorm norm : {PhongNorm::energy, PhongNorm::none, PhongNorm::over_pi})
            for (const double ks : {.01, .04, .2, .5, 1.}) {
                const PhongAlbedo<double> legacy = phong_albedo(norm, PhongLobe::blinn, n);
                const double wanted = ks * legacy.mean;
                if (ks * legacy.normal > .9 || wanted > .9) continue;
                const double alpha = alpha_from_blinn_phong(n);
                const SolvedF0 solved =
                    f0_from_mean_albedo(wanted, mean_albedo_ggx(std::sqrt(alpha)), Scattering::multiple);
                EXPECT_FALSE(solved.clamped) << n << " " << ks;
                const double found =
                    mean_specular_albedo(solved.f0, by_quadrature(alpha), Scattering::multiple);
                EXPECT_NEAR(found / wanted, 1, .02) << n << " " << ks;
                EXPECT_NEAR(found / wanted, 1, 1e-3) << n << " " << ks;
            }
}

/// Sums single scattering and what bounces between facets channel by channel, with the colour's own f90.
TEST(LegacyEnergy, ColouredLobesKeepTheMeanOfTheirChannels) {
    for (const double roughness : {.5, .64, .8, 1.})
        for (const Vec3<double>& colour :
             {Vec3<double>(.8, .1, .1), Vec3<double>(.5, .4, .3), Vec3<double>(0, 0, 1)})
            for (const double mean : {.05, .2, .3}) {
                const MeanAlbedo lobe = mean_albedo_ggx(roughness);
                const double grey = f0_from_mean_albedo(mean, lobe, Scattering::multiple).f0;
                const Vec3<double> f0 = colour * (grey / mean_channel(colour));
                const double scale = coloured_f0_scale(f0, mean, lobe, Scattering::multiple);
                const double f90 = std::min(1., 50 * .33 * 3 * mean_channel(f0 * scale));
                double found = 0;
                for (int c = 0; c < 3; ++c)
                    found +=
                        mean_specular_albedo(std::min(1., f0[c] * scale), f90, lobe, Scattering::multiple) /
                        3;
                if (max_channel(f0) * scale < 1) {
                    EXPECT_NEAR(found / mean, 1, 1e-3);
                } else {
                    EXPECT_LT(found, mean * 1.001);
                }
            }
}

}  // namespace
}  // namespace pbr
