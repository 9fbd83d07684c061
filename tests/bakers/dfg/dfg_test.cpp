#include "bakers/dfg/dfg.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bakers/dfg/layout.hpp"
#include "bakers/io/io.hpp"
#include "pbr/brdf/disney_diffuse.hpp"
#include "pbr/brdf/fresnel.hpp"
#include "pbr/brdf/ggx.hpp"
#include "pbr/numerics/quadrature.hpp"
#include "pbr/numerics/sequence.hpp"

namespace pbrbake::dfg {
namespace {

DfgParams defaults() {
    DfgParams params{};
    params.size = {16};
    params.terms = {Term::ggx};
    params.min_perceptual_roughness = 0.05;
    params.samples = 1024;
    params.disney = Disney::renormalised;
    params.cloth = Cloth::charlie;
    params.axis = Axis::nov;
    params.roughness_axis = RoughnessAxis::perceptual;
    params.align = Align::center;
    params.form = Form::scale_bias;
    return params;
}

Product bake_table(const DfgParams& params, int threads = 1, Accuracy accuracy = {}) {
    Context context(threads, std::move(accuracy));
    return bake(params, {}, context);
}

float texel(const Product& product, int x, int y, int channel) {
    return product.images[0].texel(0, 0, y, x)[channel];
}

TEST(DfgBaker, TableOf128IsWithin1e6OfItsHighestAccuracyEverywhere) {
    DfgParams params = defaults();
    params.size = {128};
    const Product ours = bake_table(params), truth = bake_table(params, 1, {"reference", 0});
    double worst = 0;
    for (std::size_t i = 0; i < ours.images[0].levels[0].texels.size(); ++i)
        worst = std::max(worst, std::abs(static_cast<double>(ours.images[0].levels[0].texels[i]) -
                                         truth.images[0].levels[0].texels[i]));
    EXPECT_LE(worst, 1e-6);
    EXPECT_GT(worst, 0);  // else nothing was compared
}

TEST(DfgBaker, LayoutFieldsMoveTexelsAsTheySay) {
    DfgParams params = defaults();
    const Product plain = bake_table(params);
    params.flip_rows = true;
    const Product flipped = bake_table(params);
    for (int x = 0; x < 16; ++x) EXPECT_EQ(texel(flipped, x, 15, 0), texel(plain, x, 0, 0));
    params = defaults();
    params.form = Form::mix;
    const Product mix = bake_table(params);
    EXPECT_EQ(texel(mix, 3, 5, 0), texel(plain, 3, 5, 1));                                   // Fc
    EXPECT_NEAR(texel(mix, 3, 5, 1), texel(plain, 3, 5, 0) + texel(plain, 3, 5, 1), 1e-7f);  // E
    params = defaults();
    params.align = Align::ends;
    EXPECT_EQ(value_of_column(params, 0), 0);
    EXPECT_EQ(value_of_column(params, 15), 1);
    EXPECT_EQ(value_of_row(params, 15), 1);
    params.axis = Axis::sqrt_nov;
    EXPECT_DOUBLE_EQ(value_of_column(params, 5), 25.0 / 225);
    for (const double NoV : {0.0, 0.2, 1.0})
        EXPECT_NEAR(value_of_column(params, 0) + std::pow(column_of_value(params, NoV) / 15, 2), NoV, 1e-12);
}

TEST(DfgBaker, ATermThatIsOffLeavesTheOtherColumnsAndCostsNothing) {
    DfgParams params = defaults();
    Context ggx_context(1, {}), both_context(1, {}), disney_context(1, {});
    const Product ggx = bake(params, {}, ggx_context);
    params.terms = {Term::ggx, Term::disney_diffuse};
    const Product both = bake(params, {}, both_context);
    params.terms = {Term::disney_diffuse};
    const Product disney = bake(params, {}, disney_context);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            EXPECT_EQ(texel(ggx, x, y, 0), texel(both, x, y, 0));
            EXPECT_EQ(texel(ggx, x, y, 1), texel(both, x, y, 1));
            EXPECT_EQ(texel(disney, x, y, 0), texel(both, x, y, 2));
        }
    EXPECT_EQ(ggx_context.counts().count("disney_diffuse"), 0u);
    EXPECT_EQ(disney_context.counts().count("ggx"), 0u);
    EXPECT_EQ(both_context.counts().at("ggx"), ggx_context.counts().at("ggx"));
    EXPECT_GT(both_context.counts().at("disney_diffuse"), 0u);
}

TEST(DfgBaker, SameBytesAtAnyThreadCount) {
    DfgParams params = defaults();
    params.size = {61, 47};
    for (const Integrator integrator : {Integrator::quadrature, Integrator::is}) {
        params.integrator = integrator;
        params.samples = 64;
        const Product one = bake_table(params, 1);
        for (const int threads : {2, 7})
            EXPECT_EQ(bake_table(params, threads).images[0].levels[0].texels, one.images[0].levels[0].texels);
    }
}

TEST(DfgBaker, ImportanceSamplingApproachesQuadrature) {
    DfgParams params = defaults();
    const Product truth = bake_table(params);
    params.integrator = Integrator::is;
    double previous = 1;
    for (const int samples : {16, 256, 4096}) {
        params.samples = samples;
        const Product sampled = bake_table(params);
        double squared = 0;
        const auto &a = sampled.images[0].levels[0].texels, &b = truth.images[0].levels[0].texels;
        for (std::size_t i = 0; i < a.size(); ++i) squared += (a[i] - b[i]) * (a[i] - b[i]);
        const double rms = std::sqrt(squared / static_cast<double>(a.size()));
        EXPECT_LT(rms, previous / 3.2);  // 16 times the samples: a quarter of the error, less a fifth
        previous = rms;
    }
    EXPECT_LT(previous, 1e-3);
}

TEST(DfgCertificate, FullOneConfirmsTheSampledOneAndTheBruteForceError) {
    DfgParams params = defaults();
    params.size = {64};
    Product product = bake_table(params);
    product.scale = io::quantise(product.images, PixelType::half);
    Context sampled_context(2, {}), full_context(2, {});
    full_context.set_certify_fully(true);
    const Certificate sampled = certify(params, {}, product, sampled_context);
    const Certificate full = certify(params, {}, product, full_context);
    EXPECT_EQ(sampled.headline->evidence, Evidence::estimate);
    EXPECT_EQ(full.headline->evidence, Evidence::measured);
    EXPECT_LE(sampled.headline->value, full.headline->value);
    EXPECT_GT(sampled.headline->value, full.headline->value / 2);
    EXPECT_LE(full.headline->value, 0x1p-12 + 1e-6);  // half rounds values below 1 by at most 2^-12
    EXPECT_GT(full.headline->value, 1e-5);
}

TEST(DfgCertificate, FindsAPlantedError) {
    DfgParams params = defaults();
    Product product = bake_table(params);
    for (float& value : product.images[0].levels[0].texels) value *= 1.01f;
    Context context(1, {});
    EXPECT_GT(certify(params, {}, product, context).headline->value, 5e-3);
}

}  // namespace
}  // namespace pbrbake::dfg
