// Tables against evaluations that share nothing with them.

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>

#include "bakers/dfg/dfg.hpp"
#include "bakers/dfg/layout.hpp"
#include "pbr/brdf/disney_diffuse.hpp"
#include "pbr/brdf/fresnel.hpp"
#include "tests/libpbr/support/dfg_witness.hpp"

namespace pbrbake::dfg {
namespace {

DfgParams table_of_128(Axis axis, Align align) {
    DfgParams params{};
    params.size = {128};
    params.terms = {Term::ggx, Term::disney_diffuse};
    params.axis = axis;
    params.align = align;
    return settled(params);
}

/// Albedo of the diffuse BRDF as it is evaluated in a shader, over directions of light. A polynomial in NoL,
/// and one in cos(phi): both rules are exact.
double disney_witness(double NoV, double perceptual_roughness) {
    const auto over_height = [&](double NoL) {
        constexpr int kAzimuths = 16;
        double ring = 0;
        for (int k = 0; k < kAzimuths; ++k) {
            const double sines = std::sqrt((1 - NoL * NoL) * (1 - NoV * NoV));
            const double LoV = NoL * NoV + sines * std::cos((k + 0.5) * 2 * std::numbers::pi / kAzimuths);
            ring +=
                pbr::f_disney_diffuse(NoL, NoV, std::sqrt((1 + LoV) / 2), perceptual_roughness) / kAzimuths;
        }
        return ring * 2 * std::numbers::pi * NoL;
    };
    return boost::math::quadrature::gauss<double, 30>::integrate(over_height, 0, 1);
}

/// The largest error of the texels of every `step`th row and column, and of the 6 x 12 in the hard corner.
double worst_error(const DfgParams& params, const Accuracy& accuracy, int step) {
    Context context(1, accuracy);
    const Product product = bake(params, {}, context);
    double worst = 0;
    for (int y = 0; y < params.height(); ++y)
        for (int x = 0; x < params.width(); ++x) {
            if ((x % step != 0 || y % step != 0) && (x >= 6 || y >= 12)) continue;
            const double NoV = value_of_column(params, x), p = value_of_row(params, y);
            const auto witness = p > 0 ? pbr::dfg_witness<double>(NoV, p * p, pbr::DfgVisibility::correlated)
                                       : pbr::AlbedoWitness<double>{1, pbr::schlick_weight(NoV)};
            const float* texel = product.images[0].texel(0, 0, y, x);
            worst = std::max({worst, std::abs(texel[0] - (witness.E - witness.Fc)),
                              std::abs(texel[1] - witness.Fc), std::abs(texel[2] - disney_witness(NoV, p))});
        }
    return worst;
}

TEST(DfgWitness, TexelsAreWithinTheirAccuracyOfAnEvaluationOverDirectionsOfLight) {
    for (const auto& [axis, align] : {std::pair{Axis::sqrt_nov, Align::ends}, {Axis::nov, Align::center}}) {
        EXPECT_LE(worst_error(table_of_128(axis, align), {"draft"}, 11), 1e-3);
        EXPECT_LE(worst_error(table_of_128(axis, align), {"production"}, 7), 1e-6);
    }
}

/// A minute of CPU time: --gtest_also_run_disabled_tests.
TEST(DfgWitness, DISABLED_EveryTexelIsWithinItsAccuracy) {
    for (const auto& [axis, align] : {std::pair{Axis::sqrt_nov, Align::ends}, {Axis::nov, Align::center}}) {
        const double draft = worst_error(table_of_128(axis, align), {"draft"}, 1),
                     production = worst_error(table_of_128(axis, align), {"production"}, 1);
        std::printf("draft %.2e, production %.2e\n", draft, production);
        EXPECT_LE(draft, 1e-3);
        EXPECT_LE(production, 1e-6);
    }
}

}  // namespace
}  // namespace pbrbake::dfg
