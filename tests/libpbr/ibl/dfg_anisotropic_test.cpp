#include "pbr/ibl/dfg_anisotropic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/sequence.hpp"
#include "tests/libpbr/support/dfg_anisotropic_witness.hpp"

namespace pbr {
namespace {

TangentAzimuth azimuth_of(double half_turns) {
    const SinCos turned = sin_cos_pi(half_turns);
    return {turned.cos, turned.sin};
}

TEST(DfgAnisotropic, AgreesWithAdaptiveIntegrationOverDirectionsOfLight) {
    const DfgRule rule = dfg_anisotropic_rule(1e-7);
    for (const AnisotropicAlpha<double>& alpha :
         {AnisotropicAlpha<double>{0.5, 0.15}, {0.2, 0.9}, {1.5, 0.4}})
        for (const double half_turns : {0.0, 0.2, 0.5})
            for (const double NoV : {0.15, 0.7}) {
                const TangentAzimuth azimuth = azimuth_of(half_turns);
                const DirectionalAlbedo ours = dfg_ggx_anisotropic(NoV, azimuth, alpha, rule);
                const DirectionalAlbedo witness = dfg_anisotropic_witness(NoV, azimuth, alpha);
                EXPECT_NEAR(ours.E, witness.E, 1e-6) << alpha.x << " " << half_turns << " " << NoV;
                EXPECT_NEAR(ours.Fc, witness.Fc, 1e-6) << alpha.x << " " << half_turns << " " << NoV;
            }
}

TEST(DfgAnisotropic, EqualWidthsAreTheRoundLobeAtAnyAzimuth) {
    const DfgRule rule = dfg_anisotropic_rule(1e-7);
    const DfgMethod round = DfgMethod::quadrature(1e-8);
    for (const double alpha : {1e-6, 1e-3, 0.05, 0.3, 1.0})
        for (const double NoV : {0.0, 1e-3, 0.05, 0.3, 0.9, 1.0})
            for (const double half_turns : {0.0, 0.2, 0.5}) {
                const DirectionalAlbedo truth = dfg_ggx(NoV, alpha, round);
                const DirectionalAlbedo ours =
                    dfg_ggx_anisotropic(NoV, azimuth_of(half_turns), {alpha, alpha}, rule);
                EXPECT_NEAR(ours.E, truth.E, 2e-7) << alpha << " " << NoV;
                EXPECT_NEAR(ours.Fc, truth.Fc, 2e-7) << alpha << " " << NoV;
            }
}

TEST(DfgAnisotropic, SwappingWidthsIsAQuarterTurnAndMirrorsChangeNothing) {
    const DfgRule rule = dfg_anisotropic_rule(1e-6);
    for (int i = 0; i < 40; ++i) {
        const double NoV = random_unit(1, i), turn = random_unit(2, i) / 2;
        const AnisotropicAlpha<double> alpha = anisotropic_alpha(random_unit(3, i), random_unit(4, i));
        const DirectionalAlbedo here = dfg_ggx_anisotropic(NoV, azimuth_of(turn), alpha, rule);
        const DirectionalAlbedo swapped =
            dfg_ggx_anisotropic(NoV, azimuth_of(turn + 0.5), {alpha.y, alpha.x}, rule);
        const DirectionalAlbedo mirrored = dfg_ggx_anisotropic(NoV, azimuth_of(-turn), alpha, rule);
        EXPECT_NEAR(here.E, swapped.E, 1e-12);
        EXPECT_NEAR(here.Fc, swapped.Fc, 1e-12);
        EXPECT_NEAR(here.E, mirrored.E, 1e-12);
        EXPECT_LE(here.Fc, here.E);
        EXPECT_LE(here.E, 1);
    }
}

TEST(DfgAnisotropic, EveryRuleKeepsItsPromise) {
    DfgRule truth = dfg_anisotropic_rule(1e-7);
    for (DfgRule::Band& band : truth.bands) {
        band.azimuth = gauss_legendre(100);
        band.radial = gauss_legendre(110);
    }
    for (int i = 0; i < 24; ++i) {
        const double width = i == 0 ? 1e-6 : i % 4 == 0 ? 1.0 : std::pow(random_unit(11, i), 4) + 1e-6;
        AnisotropicAlpha<double> alpha = anisotropic_alpha(width, i % 3 == 0 ? 1.0 : random_unit(12, i));
        if (i % 2 == 0) std::swap(alpha.x, alpha.y);
        const TangentAzimuth azimuth = azimuth_of(i % 2 == 0 ? 0.0 : random_unit(13, i) / 2);
        std::vector<double> NoV{0, 1e-4, 0.0099, 0.01, 0.0999, 0.1, 0.3999, 0.4, 1};
        for (int k = 0; k < 7; ++k) NoV.push_back(std::pow(random_unit(14, i, k), 2));
        NoV.push_back(std::min(1.0, view_widths(azimuth, alpha).along));
        std::vector<double> E(NoV.size()), Fc(NoV.size()), true_E(NoV.size()), true_Fc(NoV.size());
        dfg_ggx_anisotropic_row(NoV, azimuth, alpha, truth, true_E, true_Fc);
        for (const double promised : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7}) {
            dfg_ggx_anisotropic_row(NoV, azimuth, alpha, dfg_anisotropic_rule(promised), E, Fc);
            for (std::size_t k = 0; k < NoV.size(); ++k) {
                EXPECT_NEAR(E[k], true_E[k], promised) << alpha.x << " " << alpha.y << " " << NoV[k];
                EXPECT_NEAR(Fc[k], true_Fc[k], promised) << alpha.x << " " << alpha.y << " " << NoV[k];
            }
        }
    }
}

TEST(DfgAnisotropic, ViewWidthsStandForTheLobeWithinWhatIsStated) {
    const DfgRule rule = dfg_anisotropic_rule(1e-3);
    double worst = 0;
    for (const double roughness : {0.1, 0.4, 0.7, 1.0})
        for (const double half_turns : {0.1, 0.2, 0.25, 0.3, 0.4, 0.46})
            for (const double NoV : {0.0, 0.02, 0.2, 0.6, 1.0}) {
                const AnisotropicAlpha<double> alpha = anisotropic_alpha(roughness * roughness, 1.0);
                const TangentAzimuth azimuth = azimuth_of(half_turns);
                const ViewWidths seen = view_widths(azimuth, alpha);
                const DirectionalAlbedo there = dfg_ggx_anisotropic(NoV, azimuth, alpha, rule);
                const DirectionalAlbedo read = dfg_ggx_anisotropic(NoV, {}, {seen.along, seen.across}, rule);
                worst = std::max({worst, std::abs(there.E - read.E), std::abs(there.Fc - read.Fc)});
            }
    EXPECT_LE(worst, 0.09);
    EXPECT_GT(worst, 0.05);
}

}  // namespace
}  // namespace pbr
