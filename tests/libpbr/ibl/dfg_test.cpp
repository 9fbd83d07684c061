#include "pbr/ibl/dfg.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "pbr/brdf/fresnel.hpp"
#include "pbr/numerics/sequence.hpp"
#include "tests/libpbr/support/dfg_witness.hpp"

namespace pbr {
namespace {

TEST(Dfg, AgreesWithAnEvaluationOverDirectionsOfLight) {
    for (const DfgVisibility visibility : {DfgVisibility::correlated, DfgVisibility::uncorrelated}) {
        const DfgMethod method = DfgMethod::quadrature(1e-8).with(visibility);
        for (const double alpha : {1e-6, 1e-3, 0.01, 0.05, 0.1, 0.25, 0.5, 1.0})
            for (const double NoV : {1e-4, 0.01, 0.05, 0.1, 0.3, 0.5, 0.9, 1.0, 0.3 * alpha, alpha}) {
                const DirectionalAlbedo ours = dfg_ggx(NoV, alpha, method);
                const AlbedoWitness<double> witness = dfg_witness<double, 50>(NoV, alpha, visibility);
                EXPECT_NEAR(ours.E, witness.E, 1e-8) << alpha << " " << NoV;
                EXPECT_NEAR(ours.Fc, witness.Fc, 1e-8) << alpha << " " << NoV;
            }
    }
}

TEST(Dfg, HasThePublishedValues) {
    const double rows[][4] = {{.1, .1, .88345407, .30091151},  {.1, .5, .96920499, .03213906},
                              {.25, .1, .89162235, .13969245}, {.25, .5, .85726344, .02234730},
                              {.5, .5, .69825070, .01014998},  {1, .1, .76021047, .02386689},
                              {1, .5, .45069386, .00298874},   {1, 1, 1 - std::log(2.0), 3.361e-5}};
    for (const auto& row : rows) {
        const DirectionalAlbedo albedo = dfg_ggx(row[1], row[0], DfgMethod::quadrature(1e-8));
        EXPECT_NEAR(albedo.E, row[2], 1e-6) << row[0] << " " << row[1];
        EXPECT_NEAR(albedo.Fc, row[3], 1e-6) << row[0] << " " << row[1];
    }
    EXPECT_NEAR(dfg_ggx(1, 1, DfgMethod::quadrature(1e-8)).E, 1 - std::log(2.0), 1e-13);
}

/// Domain of the promised errors: the corners and random points of [0, 1] x [1e-8, 1].
std::vector<std::pair<double, std::vector<double>>> domain() {
    std::vector<double> views{0,    1e-8,   1e-6, 1e-4,   1e-3, 0.00999, 0.01,
                              0.03, 0.0999, 0.1,  0.3999, 0.4,  0.99,    1};
    for (int i = 0; i < 24; ++i) views.push_back(random_unit(1, i));
    std::vector<std::pair<double, std::vector<double>>> rows;
    for (const double alpha : {1e-8, 1e-6, 1e-4, 1e-3, 0.01, 0.03, 0.1, 0.5, 1.0})
        rows.emplace_back(alpha, views);
    for (int i = 0; i < 16; ++i) {
        std::vector<double> near_alpha = views;
        const double alpha = std::pow(random_unit(2, i), 4) + 1e-8;
        for (const double factor : {0.1, 0.5, 1.0, 2.0}) near_alpha.push_back(std::min(1.0, alpha * factor));
        rows.emplace_back(alpha, near_alpha);
    }
    return rows;
}

TEST(Dfg, EveryRuleKeepsItsPromiseOverTheWholeDomain) {
    DfgMethod truth = DfgMethod::quadrature(1e-8);
    for (DfgRule::Band& band : truth.rule.bands) {
        band.azimuth = gauss_legendre(120);
        band.radial = gauss_legendre(200);
    }
    const auto rows = domain();
    for (const DfgVisibility visibility : {DfgVisibility::correlated, DfgVisibility::uncorrelated})
        for (const double promised : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
            const DfgMethod method = DfgMethod::quadrature(promised).with(visibility);
            EXPECT_EQ(method.rule.max_error, promised);
            double worst = 0;
            for (const auto& [alpha, views] : rows) {
                std::vector<double> E(views.size()), Fc(views.size()), true_E(views.size()),
                    true_Fc(views.size());
                dfg_ggx_row(views, alpha, method, E, Fc);
                dfg_ggx_row(views, alpha, truth.with(visibility), true_E, true_Fc);
                for (std::size_t i = 0; i < views.size(); ++i)
                    worst = std::max({worst, std::abs(E[i] - true_E[i]), std::abs(Fc[i] - true_Fc[i])});
            }
            EXPECT_LE(worst, promised) << static_cast<int>(visibility);
        }
}

TEST(Dfg, HoldsItsBoundsAndLimits) {
    const DfgMethod rule = DfgMethod::quadrature(1e-6);
    for (const auto& [alpha, views] : domain())
        for (const double NoV : views) {
            const DirectionalAlbedo albedo = dfg_ggx(NoV, alpha, rule);
            EXPECT_GE(albedo.Fc, 0);
            EXPECT_LE(albedo.Fc, albedo.E);
            EXPECT_LE(albedo.E, 1);
        }
    for (const auto& [alpha, views] : domain()) EXPECT_NEAR(dfg_ggx(0, alpha, rule).E, 1, 1e-6) << alpha;
    EXPECT_NEAR(dfg_ggx(0.4, 1e-8, rule).E, 1, 1e-6);
    EXPECT_NEAR(dfg_ggx(0.4, 1e-8, rule).Fc, std::pow(0.6, 5), 1e-6);
    EXPECT_EQ(dfg_ggx(0.4, 0, rule).E, 1);
    EXPECT_EQ(dfg_ggx(0.4, 0, rule).Fc, schlick_weight(0.4));
    EXPECT_NEAR(dfg_ggx(1e-4, 1e-4, rule).E, 0.89, 0.01);  // the limits don't commute
}

TEST(Dfg, RowIsBitForBitTheSameAsSingleViews) {
    std::vector<double> views;
    for (int i = 0; i < 37; ++i) views.push_back(random_unit(9, i));
    std::vector<double> E(views.size()), Fc(views.size());
    const DfgMethod rule = DfgMethod::quadrature(1e-4);
    dfg_ggx_row(views, 0.2, rule, E, Fc);
    for (std::size_t i = 0; i < views.size(); ++i) {
        const DirectionalAlbedo single = dfg_ggx(views[i], 0.2, rule);
        EXPECT_EQ(single.E, E[i]);
        EXPECT_EQ(single.Fc, Fc[i]);
    }
}

TEST(Dfg, MonteCarloAgreesWithinFourSigma) {
    constexpr int kRuns = 64, kSamples = 1000;
    for (const auto& [alpha, NoV] : {std::pair{.1, .1}, {.1, .5}, {.25, .1}, {.5, .5}, {1., .1}, {1., .5}}) {
        const DirectionalAlbedo truth = dfg_ggx(NoV, alpha, DfgMethod::quadrature(1e-8));
        double sum = 0, squares = 0, sum_fc = 0, squares_fc = 0;
        for (int run = 0; run < kRuns; ++run) {
            const DirectionalAlbedo estimate =
                dfg_ggx(NoV, alpha, DfgMethod::importance_sampling(kSamples, random_bits(5, run)));
            sum += estimate.E;
            squares += estimate.E * estimate.E;
            sum_fc += estimate.Fc;
            squares_fc += estimate.Fc * estimate.Fc;
        }
        const auto sigma = [](double s, double s2) {
            return std::sqrt(std::max(0.0, s2 / kRuns - s * s / kRuns / kRuns) / (kRuns - 1));
        };
        EXPECT_NEAR(sum / kRuns, truth.E, 4 * sigma(sum, squares) + 1e-9) << alpha << " " << NoV;
        EXPECT_NEAR(sum_fc / kRuns, truth.Fc, 4 * sigma(sum_fc, squares_fc) + 1e-9) << alpha << " " << NoV;
    }
}

}  // namespace
}  // namespace pbr
