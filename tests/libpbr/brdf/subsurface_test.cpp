#include "pbr/brdf/subsurface.hpp"

#include <gtest/gtest.h>

#include <boost/math/quadrature/exp_sinh.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/libpbr/support/float_error.hpp"
#include "tests/libpbr/support/integrate.hpp"
#include "tests/libpbr/support/property.hpp"
#include "tests/libpbr/support/reflections.hpp"

namespace pbr {
namespace {

using boost::math::quadrature::gauss_kronrod;

TEST(BurleyProfile, IntegratesToTheAlbedoOverThePlane) {
    boost::math::quadrature::exp_sinh<double> half_line;
    for (const double d : {.01, 1.0, 30.0})
        for (const double albedo : {.2, 1.0}) {
            const auto ring = [&](double r) {
                return 2 * std::numbers::pi * r * burley_profile(r, d, albedo);
            };
            EXPECT_NEAR(half_line.integrate(ring, 0.0, std::numeric_limits<double>::infinity(), 1e-12),
                        albedo, 1e-9)
                << d;
        }
    EXPECT_TRUE(std::isinf(burley_profile(0.0, 1.0, 1.0)));
}

TEST(BurleyProfile, CdfIsItsIntegral) {
    for (const double r : {1e-6, .1, 1.0, 7.0, 40.0})
        EXPECT_NEAR(
            burley_cdf(r, 2.0) / (gauss_kronrod<double, 31>::integrate(
                                     [](double x) { return pdf_burley_radius(x, 2.0); }, 0.0, r, 6, 1e-13)),
            1, 1e-12);
    EXPECT_EQ(burley_cdf(0.0, 1.0), 0);
    EXPECT_EQ(burley_cdf(std::numeric_limits<double>::infinity(), 1.0), 1);
    EXPECT_DOUBLE_EQ(pdf_burley_radius(1.3, 2.0), 2 * std::numbers::pi * 1.3 * burley_profile(1.3, 2.0, 1.0));
}

RC_GTEST_PROP(BurleyProfile, SampleAndInverseAreEachOthers, ()) {
    const double d = *log_uniform(1e-3, 1e3), u = *rc::gen::oneOf(uniform(0, 1), log_uniform(1e-16, 1));
    const double r = sample_burley_radius(u, d);
    RC_ASSERT(std::isfinite(r) && r >= 0);
    RC_ASSERT(std::abs(inverse_burley_radius(r, d) - u) <= 4e-15 * u);
    const double x = *log_uniform(1e-9, 30) * d;  // beyond, 1 - u has few bits
    RC_ASSERT(std::abs(sample_burley_radius(burley_cdf(x, d), d) / x - 1) < 1e-10);
    RC_ASSERT(sample_burley_radius(0.0, d) == 0);
}

TEST(BurleyProfile, SamplesFollowTheDensity) {
    // Chi-square over 40 bins of equal width to 10 d.
    constexpr int kBins = 40, kCount = 200'000;
    std::vector<int> observed(kBins + 1);
    for (int i = 0; i < kCount; ++i)
        ++observed[std::min(kBins, static_cast<int>(sample_burley_radius(random_unit(1, i), 1.0) * 4))];
    double statistic = 0;
    for (int bin = 0; bin <= kBins; ++bin) {
        const double to = bin < kBins ? burley_cdf((bin + 1) / 4.0, 1.0) : 1,
                     expected = kCount * (to - burley_cdf(bin / 4.0, 1.0));
        statistic += (observed[bin] - expected) * (observed[bin] - expected) / expected;
    }
    EXPECT_LT(statistic, 83.5);  // 40 degrees of freedom, p = 7e-5
}

/// A random walk in an index-matched half space that scatters isotropically with unit mean free path: the
/// radius and weight of what leaves.
struct Walk {
    double albedo;      ///< share of the flux that leaves
    double difference;  ///< L1 distance of its radial density from Burley's, the fit's d
    double cdf_difference;
};
Walk random_walk(double scattering_albedo, bool diffuse, double (*scale)(double)) {
    constexpr int kCount = 100'000, kBins = 40;
    std::vector<std::pair<double, double>> left;
    double total = 0;
    for (std::uint64_t i = 0; i < kCount; ++i) {
        std::uint64_t draw = 0;
        const auto next = [&] { return random_unit(7 + (diffuse ? 1 : 0), i, draw++); };
        double x = 0, y = 0, z = 0, weight = 1, dz = diffuse ? std::sqrt(next()) : 1,
               dx = std::sqrt(1 - dz * dz), dy = 0;
        while (weight > 1e-3) {
            const double step = -std::log1p(-next());
            if (z + dz * step < 0) {
                left.emplace_back(std::hypot(x - dx * z / dz, y - dy * z / dz), weight);
                total += weight;
                break;
            }
            x += dx * step, y += dy * step, z += dz * step;
            weight *= scattering_albedo;
            const Vec3<double> w = direction_at(2 * next() - 1, next());
            dx = w.x, dy = w.y, dz = w.z;
        }
    }
    const double albedo = total / kCount, d = 1 / scale(albedo), width = 12 * d / kBins;
    std::vector<double> bins(kBins);
    for (const auto& [r, weight] : left)
        if (r < 12 * d) bins[static_cast<std::size_t>(r / width)] += weight / total;
    Walk walk{albedo, 0, 0};
    double cdf = 0;
    for (int bin = 0; bin < kBins; ++bin) {
        walk.difference +=
            std::abs(bins[bin] - (burley_cdf((bin + 1) * width, d) - burley_cdf(bin * width, d)));
        walk.cdf_difference =
            std::max(walk.cdf_difference, std::abs((cdf += bins[bin]) - burley_cdf((bin + 1) * width, d)));
    }
    return walk;
}

TEST(BurleyProfile, FitsARandomWalkAsWellAsStated) {
    for (const double scattering : {.3, .8, .97}) {
        const Walk beam = random_walk(scattering, false, burley_scale_perpendicular<double>);
        EXPECT_LT(beam.difference, .055) << beam.albedo;
        EXPECT_LT(beam.cdf_difference, .028) << beam.albedo;
        const Walk lit = random_walk(scattering, true, burley_scale_diffuse<double>);
        EXPECT_LT(lit.difference, .045) << lit.albedo;
        EXPECT_LT(lit.cdf_difference, .024) << lit.albedo;
        // The two fits aren't each other's.
        EXPECT_GT(random_walk(scattering, false, [](double A) { return 1.3 * burley_scale_perpendicular(A); })
                      .difference,
                  .1);
    }
}

TEST(BurleyProfile, ScalesHaveTheirPublishedValues) {
    EXPECT_DOUBLE_EQ(burley_scale_perpendicular(.8), 1.05);
    EXPECT_DOUBLE_EQ(burley_scale_diffuse(.8), 1.1);
    EXPECT_DOUBLE_EQ(burley_scale_diffuse_mean_free_path(.33), 3.5);
    EXPECT_NEAR(burley_scale_perpendicular(0.0), 1.85 + 7 * .512, 1e-14);
    EXPECT_NEAR(burley_scale_diffuse(0.0), 1.9 + 3.5 * .64, 1e-14);
    EXPECT_NEAR(burley_scale_diffuse_mean_free_path(1.33), 103.5, 1e-11);
}

TEST(PreintegratedDiffusion, AgreesWithIntegrationOverTheSphere) {
    // Every point of the sphere, as seen from the shaded one at the pole; r R(r) removes the singularity by
    // the substitution of cosines, as the solid angle is p dp dphi.
    for (const double curvature_d : {.05, .3, 2.0})
        for (const double NoL : {-.7, 0.0, .25, .9}) {
            const double sin_l = std::sqrt(1 - NoL * NoL), radius = 1 / curvature_d;
            boost::math::quadrature::tanh_sinh<double> theta_rule;
            const auto ring = [&](double theta) {
                const double chord = 2 * radius * std::sin(theta / 2);
                const auto lit = [&](double phi) {
                    return std::max(0.0, NoL * std::cos(theta) + sin_l * std::sin(theta) * std::cos(phi));
                };
                const double irradiance =
                    gauss_kronrod<double, 15>::integrate(lit, 0.0, std::numbers::pi, 9, 1e-9);
                return 2 * irradiance * burley_profile(chord, 1.0, 1.0) * radius * radius * std::sin(theta);
            };
            const auto whole = [&](double theta) {
                return 2 * std::numbers::pi * burley_profile(2 * radius * std::sin(theta / 2), 1.0, 1.0) *
                       radius * radius * std::sin(theta);
            };
            const double value = theta_rule.integrate(ring, 0.0, std::numbers::pi, 1e-7) /
                                 theta_rule.integrate(whole, 0.0, std::numbers::pi, 1e-10);
            EXPECT_NEAR(preintegrated_diffusion(NoL, curvature_d), value, 1e-7) << curvature_d << ' ' << NoL;
        }
}

TEST(PreintegratedDiffusion, MovesLightOnly) {
    for (const double curvature_d : {1e-3, .02, .2, 1.0, 20.0}) {
        const auto at = [&](double NoL) { return preintegrated_diffusion(NoL, curvature_d); };
        const double mean = (gauss_kronrod<double, 61>::integrate(at, -1.0, 0.0, 9, 1e-10) +
                             gauss_kronrod<double, 61>::integrate(at, 0.0, 1.0, 9, 1e-10)) /
                            2;
        EXPECT_NEAR(mean, .25, 1e-8) << curvature_d;
    }
}

TEST(PreintegratedDiffusion, SatisfiesTheIdentityOfOppositeLights) {
    // max(c, 0) - max(-c, 0) = c, and a cosine spread over the sphere is a cosine again: its factor doesn't
    // depend on NoL.
    for (const double curvature_d : {.01, .3, 3.0}) {
        const double factor =
            preintegrated_diffusion(1.0, curvature_d) - preintegrated_diffusion(-1.0, curvature_d);
        for (const double NoL : {.03, .2, .5, .77, .999})
            EXPECT_NEAR(
                preintegrated_diffusion(NoL, curvature_d) - preintegrated_diffusion(-NoL, curvature_d),
                factor * NoL, 1e-9)
                << curvature_d << ' ' << NoL;
    }
}

TEST(PreintegratedDiffusion, EndsInLambertAndInTheMean) {
    for (const double NoL : {-1.0, -.3, 0.0, .4, 1.0}) {
        EXPECT_EQ(preintegrated_diffusion(NoL, 0), std::max(NoL, 0.0));
        EXPECT_NEAR(preintegrated_diffusion(NoL, 1e-6), std::max(NoL, 0.0), 2e-6);
        // A sphere far smaller than d: chords are spread like the profile's 1/r, all round.
        EXPECT_NEAR(preintegrated_diffusion(NoL, 1e4), preintegrated_diffusion(NoL, 1e5), 1e-4);
    }
}

RC_GTEST_PROP(PreintegratedDiffusion, IsIrradianceWithinOneAndContinuous, ()) {
    const double NoL = *uniform(-1, 1), curvature_d = *log_uniform(1e-5, 1e3);
    const double value = preintegrated_diffusion(NoL, curvature_d);
    RC_ASSERT(value >= 0 && value <= 1);
    RC_ASSERT(std::abs(preintegrated_diffusion(NoL, curvature_d * (1 + 1e-9)) - value) < 3e-9);
    RC_ASSERT(std::abs(preintegrated_diffusion(std::min(1.0, NoL + 1e-9), curvature_d) - value) < 4e-9);
}

TEST(WrappedDiffuse, IntegratesToOne) {
    for (const double wrap : {0.0, .3, 1.0}) {
        const auto f = [&](const Vec3<double>& w) { return wrapped_diffuse(w.z, wrap); };
        EXPECT_NEAR(integrate_directions(f, -wrap, 1), 1, 1e-12) << wrap;
        EXPECT_EQ(wrapped_diffuse(-wrap, wrap), 0);
        EXPECT_EQ(wrapped_diffuse(-1.0, wrap), 0);
    }
    EXPECT_DOUBLE_EQ(wrapped_diffuse(.4, 0.0), .4 / std::numbers::pi);
}

TEST(Subsurface, FloatIsWithinTheUlpStated) {
    for (int i = 0; i < 50'000; ++i) {
        const float d = static_cast<float>(.01 + random_unit(1, i)),
                    r = static_cast<float>(std::pow(random_unit(2, i), 4) * 20 + 1e-6) * d,
                    u = static_cast<float>(std::pow(random_unit(3, i), 3)),
                    n = static_cast<float>(random_unit(4, i));
        const double dd = d, dr = r, du = u, dn = n;
        EXPECT_LT(ulp_error(burley_profile(r, d, .5f), burley_profile(dr, dd, .5)), 4 + dr / dd);
        EXPECT_LT(ulp_error(pdf_burley_radius(r, d), pdf_burley_radius(dr, dd)), 4 + dr / dd);
        EXPECT_LT(ulp_error(burley_cdf(r, d), burley_cdf(dr, dd)), 8);
        if (u > 0 && u < .9f) {
            EXPECT_LT(ulp_error(sample_burley_radius(u, d), sample_burley_radius(du, dd)), 16) << u;
        }
        EXPECT_LT(ulp_error(wrapped_diffuse(n, .5f), wrapped_diffuse(dn, .5)), 8);
    }
}

}  // namespace
}  // namespace pbr
