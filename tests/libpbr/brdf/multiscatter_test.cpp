#include "pbr/brdf/multiscatter.hpp"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>

#include "pbr/ibl/dfg.hpp"
#include "pbr/numerics/vector.hpp"
#include "tests/libpbr/support/property.hpp"

namespace pbr {
namespace {

using boost::math::quadrature::gauss_kronrod;

double E_ggx(double mu, double alpha) { return dfg_ggx(mu, alpha, DfgMethod::quadrature(1e-8)).E; }

TEST(Multiscatter, AverageAlbedoHasThePublishedValues) {
    EXPECT_NEAR(average_albedo_ggx(.25), .88232, 1e-5);
    EXPECT_NEAR(average_albedo_ggx(.5), .70024, 1e-5);
    EXPECT_NEAR(average_albedo_ggx(1.0), .40913710, 2e-8);
    EXPECT_EQ(average_albedo_ggx(0.0), 1);
}

TEST(Multiscatter, AverageAlbedoAgreesWithAdaptiveIntegration) {
    for (const double alpha : {1e-3, .02, .1, .5, 1.0}) {
        const auto mean = [&](double a, double b) {
            return gauss_kronrod<double, 31>::integrate(
                [&](double mu) { return 2 * mu * (1 - E_ggx(mu, alpha)); }, a, b, 4, 1e-9);
        };
        const double split = std::min(1.0, 4 * alpha);
        EXPECT_NEAR(average_albedo_ggx(alpha), 1 - mean(0, alpha) - mean(alpha, split) - mean(split, 1), 2e-8)
            << alpha;
    }
}

TEST(Multiscatter, AverageSchlickIsTheIntegral) {
    const auto weighted = [](double mu) { return 2 * mu * F_schlick(.3, .9, mu); };
    EXPECT_NEAR(average_schlick(.3, .9), (gauss_kronrod<double, 15>::integrate(weighted, 0.0, 1.0)), 1e-14);
    EXPECT_NEAR(average_schlick(Vec3<double>(.3), Vec3<double>(.9)).x, average_schlick(.3, .9), 1e-16);
}

TEST(Multiscatter, KullaContyReturnsOneInAWhiteFurnace) {
    for (const double alpha : {.05, .25, .5, 1.0}) {
        const double E_avg = average_albedo_ggx(alpha);
        for (const double NoV : {0.0, .1, .5, 1.0}) {
            const double E_o = E_ggx(NoV, alpha);
            const auto lobe = [&](double mu) {
                return 2 * std::numbers::pi * mu * f_multiscatter(E_o, E_ggx(mu, alpha), E_avg) *
                       multiscatter_colour(1.0, E_avg);
            };
            const double multiple = gauss_kronrod<double, 31>::integrate(lobe, 0.0, alpha, 4, 1e-9) +
                                    gauss_kronrod<double, 31>::integrate(lobe, alpha, 1.0, 4, 1e-9);
            EXPECT_NEAR(E_o + multiple, 1, 1e-6) << alpha << ' ' << NoV;
        }
    }
}

TEST(Multiscatter, ColourIsTheSumOverBounces) {
    // A path escapes at each facet with E_avg and meets another with 1 - E_avg; each meeting costs F. What
    // single scattering (one facet) lost leaves at the second facet or later, which F = 1 normalises to 1.
    for (const double F : {.04, .5, .95, 1.0})
        for (const double E_avg : {.41, .7, .97}) {
            double inside = F, left = 0;
            for (int bounce = 2; bounce < 5000; ++bounce) {
                inside *= F;
                left += inside * E_avg;
                inside *= 1 - E_avg;
            }
            EXPECT_NEAR(multiscatter_colour(F, E_avg), left, 1e-12) << F << ' ' << E_avg;
        }
}

TEST(Multiscatter, TurquinAndFdezAgueraReturnOneInAWhiteFurnace) {
    for (const double alpha : {.1, .5, 1.0})
        for (const double NoV : {0.0, .2, 1.0}) {
            const DirectionalAlbedo table = dfg_ggx(NoV, alpha, DfgMethod::quadrature(1e-8));
            EXPECT_NEAR(table.E * multiscatter_factor_turquin(1.0, table.E), 1, 1e-14);
            const auto albedo = multiscatter_albedo_fdez_aguera(1.0, 1.0, table.E, table.Fc);
            EXPECT_NEAR(albedo.single + albedo.multiple, 1, 1e-14);
            EXPECT_GT(table.E, .30);
        }
}

TEST(Multiscatter, TheThreeAgreeOnColouredMetals) {
    // Not exactly: they count colour differently. Gold at the roughest, seen from the front.
    const DirectionalAlbedo table = dfg_ggx(1.0, 1.0, DfgMethod::quadrature(1e-8));
    for (const double f0 : {.9, .5}) {
        const double single = f0 * (table.E - table.Fc) + table.Fc, E_avg = average_albedo_ggx(1.0);
        const double kulla_conty =
            single + (1 - table.E) * multiscatter_colour(average_schlick(f0, 1.0), E_avg);
        const double turquin = single * multiscatter_factor_turquin(f0, table.E);
        const auto fdez = multiscatter_albedo_fdez_aguera(f0, 1.0, table.E, table.Fc);
        EXPECT_NEAR(kulla_conty, turquin, .08) << f0;
        EXPECT_NEAR(kulla_conty, fdez.single + fdez.multiple, .08) << f0;
    }
}

TEST(Multiscatter, MirrorHasNothingToReturn) {
    EXPECT_EQ(f_multiscatter(1.0, 1.0, 1.0), 0);
    EXPECT_EQ(f_multiscatter(1.0f, 1.0f, 1.0f), 0);
    EXPECT_EQ(multiscatter_factor_turquin(1.0, 1.0), 1);
    EXPECT_EQ(multiscatter_colour(1.0, 1.0), 1);
    EXPECT_EQ(multiscatter_colour(0.0, .5), 0);
}

RC_GTEST_PROP(Multiscatter, StaysWithinEnergy, ()) {
    const double E = *uniform(.3, 1), Fc = *uniform(0, 1) * E, f0 = *unit_interval(),
                 E_avg = *uniform(.4, .999);
    const auto albedo = multiscatter_albedo_fdez_aguera(f0, 1.0, E, Fc);
    RC_ASSERT(albedo.single >= 0 && albedo.multiple >= 0 && albedo.single + albedo.multiple <= 1 + 1e-14);
    const double colour = multiscatter_colour(f0, E_avg);
    RC_ASSERT(colour >= 0 && colour <= f0 * f0 * (1 + 1e-14));
    RC_ASSERT(f_multiscatter(E, .7, E_avg) == f_multiscatter(.7, E, E_avg));
    RC_ASSERT(E * multiscatter_factor_turquin(f0, E) <= 1 + 1e-14);
}

TEST(Multiscatter, CheaperWaysDifferFromKullaContyOnColouredMetalsAsStated) {
    const double rows[][3] = {{.5, .0183, .0152}, {1.0, .2278, .0948}};
    for (const auto& [alpha, turquin_stated, fdez_aguera_stated] : rows) {
        const double E_avg = average_albedo_ggx(alpha);
        double turquin = 0, fdez_aguera = 0;
        for (const double f0 : {.2, .5, .8, .9})
            for (const double NoV : {.1, .5, 1.0}) {
                const DirectionalAlbedo d = dfg_ggx(NoV, alpha, DfgMethod::quadrature(1e-6));
                const double single = f0 * (d.E - d.Fc) + d.Fc;
                const double exact =
                    single + multiscatter_colour(average_schlick(f0, 1.0), E_avg) * (1 - d.E);
                const auto both = multiscatter_albedo_fdez_aguera(f0, 1.0, d.E, d.Fc);
                turquin =
                    std::max(turquin, std::abs(single * multiscatter_factor_turquin(f0, d.E) / exact - 1));
                fdez_aguera = std::max(fdez_aguera, std::abs((both.single + both.multiple) / exact - 1));
            }
        EXPECT_NEAR(turquin, turquin_stated, 2e-3 * turquin_stated + 1e-4) << alpha;
        EXPECT_NEAR(fdez_aguera, fdez_aguera_stated, 2e-3 * fdez_aguera_stated + 1e-4) << alpha;
    }
}

}  // namespace
}  // namespace pbr
