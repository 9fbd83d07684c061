// What is promised of a table as a shader reads it.

#include "bakers/dfg/sampled.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "bakers/dfg/analytic_fit.hpp"
#include "bakers/dfg/dfg.hpp"
#include "bakers/dfg/layout.hpp"
#include "bakers/dfg/terms.hpp"
#include "bakers/io/io.hpp"
#include "pbr/brdf/multiscatter.hpp"
#include "pbr/numerics/quadrature.hpp"
#include "pbr/numerics/sequence.hpp"

namespace pbrbake::dfg {
namespace {

DfgParams defaults() {
    DfgParams params{};
    params.size = {0};
    params.min_perceptual_roughness = 0.05;
    params.samples = 1024;
    return params;
}

Product stored(const DfgParams& params, PixelType pixel = PixelType::half, Accuracy accuracy = {}) {
    Context context(1, std::move(accuracy));
    Product product = bake(params, {}, context);
    product.scale = io::quantise(product.images, product.pixel.value_or(pixel));
    return product;
}

/// A shader's lookup in the default layout, written as a shader has it.
double look_up(const Product& product, double NoV, double perceptual_roughness, int channel) {
    const Level& level = product.images[0].levels[0];
    const double x = std::sqrt(NoV) * (level.width - 1), y = perceptual_roughness * (level.height - 1);
    const int x0 = std::min(static_cast<int>(x), level.width - 2),
              y0 = std::min(static_cast<int>(y), level.height - 2);
    const auto at = [&](int j, int i) {
        return product.images[0].texel(0, 0, j, i)[channel] / product.scale;
    };
    return std::lerp(std::lerp(at(y0, x0), at(y0, x0 + 1), x - x0),
                     std::lerp(at(y0 + 1, x0), at(y0 + 1, x0 + 1), x - x0), y - y0);
}

double figure(const Certificate& certificate, const std::string& metric) {
    for (const Figure& figure : certificate.figures)
        if (figure.metric == metric) return figure.value;
    ADD_FAILURE() << metric;
    return NAN;
}

/// The largest error at a million points: 1,000 random roughnesses by 1,000 random views.
double brute_force(const Product& product) {
    const pbr::DfgMethod truth = pbr::DfgMethod::quadrature(1e-5);
    std::vector<double> NoV(1000), E(1000), Fc(1000);
    double worst = 0;
    for (int row = 0; row < 1000; ++row) {
        // Half of the rows uniform in both; half where the error is: towards smooth and grazing.
        const double v = pbr::random_unit(11, row);
        const double perceptual_roughness = 0.05 + 0.95 * (row % 2 == 0 ? v : v * v * v);
        for (int i = 0; i < 1000; ++i) {
            const double u = pbr::random_unit(12, row, i);
            NoV[i] = row % 2 == 0 ? u : u * u;
        }
        pbr::dfg_ggx_row(NoV, perceptual_roughness * perceptual_roughness, truth, E, Fc);
        for (int i = 0; i < 1000; ++i)
            worst =
                std::max({worst, std::abs(look_up(product, NoV[i], perceptual_roughness, 0) - (E[i] - Fc[i])),
                          std::abs(look_up(product, NoV[i], perceptual_roughness, 1) - Fc[i])});
    }
    return worst;
}

TEST(DfgSampled, DefaultLayoutKeepsItsPromiseAtAMillionRandomPoints) {
    const Product product = stored(defaults());
    Context context(2, {});
    context.set_certify_fully(true);
    const Certificate certificate = certify(defaults(), {}, product, context);
    const double certified = figure(certificate, "max_abs_error_sampled"), found = brute_force(product);
    EXPECT_LE(certified, 2.5e-3);
    EXPECT_LE(found, certified * 1.02);  // cells are looked at in their middles and quarters
    EXPECT_GT(found, certified * 0.8);   // a million points come near it
    EXPECT_LE(certified, figure(certificate, "interpolation_error") + figure(certificate, "max_abs_error"));
}

TEST(DfgSampled, DefaultLayoutOf256IsWithin1e3) {
    DfgParams params = defaults();
    params.size = {256};
    const Product product = stored(params);
    Context context(2, {});
    const DfgParams layout = settled(params);
    EXPECT_LE(
        sampled_errors(layout, &product, pbr::DfgMethod::quadrature(1e-5), Probing::middles, 0, 0, context)
            .sampled,
        1e-3);
}

TEST(DfgSampled, AccuracyAsSampledChoosesSizeAndPixel) {
    const Accuracy loose{"", 2e-2, true};
    const Product small = stored(defaults(), PixelType::half, loose);
    EXPECT_LT(small.images[0].levels[0].width, 64);
    EXPECT_EQ(small.pixel, PixelType::half);
    Context context(2, loose);
    const Certificate certificate = certify(defaults(), {}, small, context);
    EXPECT_EQ(certificate.headline->metric, "max_abs_error_sampled");
    EXPECT_EQ(certificate.headline->evidence, Evidence::measured);
    EXPECT_LE(certificate.headline->value, loose.max_error);
}

TEST(DfgSampled, WhiteFurnaceOfKullaContyReturnsOne) {
    DfgParams params = defaults();
    params.terms = {Term::multiscatter};
    params.size = {256};
    const Product product = stored(params);
    const pbr::QuadratureRule rule = pbr::gauss_legendre(64);
    double worst = 0;
    for (int i = 0; i < 200; ++i) {
        const double p = 0.05 + 0.95 * std::pow(i / 199.0, 2), average_lost = look_up(product, 0.5, p, 1);
        // The lobe's integral over directions of light, and single scattering as it is, not as tabulated.
        double multiple = 0;
        for (int k = 0; k < rule.size(); ++k) {
            const double u = rule.nodes[k], mu = u * u * u;  // E bends at mu = alpha
            multiple += rule.weights[k] * 3 * u * u * 2 * mu * look_up(product, mu, p, 0);
        }
        std::vector<double> NoV, E(64), Fc(64);
        for (int k = 0; k < 64; ++k) NoV.push_back(std::pow(k / 63.0, 3));
        pbr::dfg_ggx_row(NoV, p * p, pbr::DfgMethod::quadrature(1e-6), E, Fc);
        for (int k = 0; k < 64; ++k) {
            const double lost = look_up(product, NoV[k], p, 0);
            worst = std::max(worst, std::abs(E[k] + lost * multiple / average_lost - 1));
        }
    }
    RecordProperty("worst", std::to_string(worst));
    EXPECT_LE(worst, 2e-3) << worst;
}

TEST(DfgSampled, CertificateSaysWhatTheTableBuysOverAnAnalyticFit) {
    const Product product = stored(defaults());
    Context context(1, {});
    const Certificate certificate = certify(defaults(), {}, product, context);
    EXPECT_NEAR(figure(certificate, "analytic_fit_error"), 0.50, 0.01);
    EXPECT_LT(figure(certificate, "max_abs_error_sampled") * 100, figure(certificate, "analytic_fit_error"));
    // Where the fit was made to be good, it is: facing views of a rough surface.
    const pbr::DirectionalAlbedo exact = pbr::dfg_ggx(0.5, 1, pbr::DfgMethod::quadrature(1e-6));
    EXPECT_NEAR(karis_fit(0.5, 1).scale, exact.E - exact.Fc, 0.01);
    EXPECT_NEAR(karis_fit(0.5, 1).bias, exact.Fc, 0.01);
}

TEST(DfgTerms, EachIsBakedOnlyIfAskedForAndLeavesTheOthersAlone) {
    const Term all[] = {Term::ggx,        Term::disney_diffuse, Term::multiscatter, Term::charlie,
                        Term::clear_coat, Term::uncorrelated,   Term::eon};
    const std::string effects[] = {"ggx",        "disney_diffuse", "multiscatter", "charlie",
                                   "clear_coat", "uncorrelated",   "eon"};
    const auto baked = [&](std::vector<Term> terms, std::map<std::string, std::uint64_t>& counts) {
        DfgParams params = defaults();
        params.size = {12, 9};
        params.terms = std::move(terms);
        Context context(1, {"draft"});
        Product product = bake(params, {}, context);
        counts = context.counts();
        return product;
    };
    for (int a = 0; a < 7; ++a)
        for (int b = 0; b < 7; ++b) {
            if (a == b) continue;
            std::map<std::string, std::uint64_t> alone_counts, pair_counts;
            const Product alone = baked({all[a]}, alone_counts), pair = baked({all[b], all[a]}, pair_counts);
            const int own = alone.images[0].channel_count(), offset = pair.images[0].channel_count() - own;
            for (int y = 0; y < 9; ++y)
                for (int x = 0; x < 12; ++x)
                    for (int c = 0; c < own; ++c)
                        ASSERT_EQ(alone.images[0].texel(0, 0, y, x)[c],
                                  pair.images[0].texel(0, 0, y, x)[offset + c])
                            << effects[a] << " beside " << effects[b];
            EXPECT_GT(alone_counts[effects[a]], 0u) << effects[a];
            const bool needs_ggx = all[a] == Term::multiscatter || all[a] == Term::clear_coat;
            if (!(needs_ggx && all[b] == Term::ggx)) {
                EXPECT_EQ(alone_counts[effects[b]], 0u) << effects[b] << " while baking " << effects[a];
            }
            EXPECT_EQ(pair_counts[effects[a]], alone_counts[effects[a]]);
        }
}

TEST(DfgTerms, HoldTheirLimitsAtEverySize) {
    for (const Term term : {Term::ggx, Term::disney_diffuse, Term::multiscatter, Term::charlie,
                            Term::clear_coat, Term::uncorrelated, Term::eon, Term::subsurface})
        for (const std::vector<int>& size : {std::vector{1}, {2}, {1, 512}})
            for (const RoughnessAxis axis : {RoughnessAxis::perceptual, RoughnessAxis::alpha}) {
                DfgParams params = defaults();
                params.terms = {term};
                params.size = size;
                params.roughness_axis = axis;
                Context context(1, {"draft"});
                const Product product = bake(params, {}, context);
                for (const float value : product.images[0].levels[0].texels) {
                    EXPECT_TRUE(std::isfinite(value)) << enum_name(term);
                    EXPECT_GE(value, 0) << enum_name(term);
                    EXPECT_LE(value, term == Term::charlie ? 2.2f : 1.04f) << enum_name(term);
                }
            }
}

TEST(DfgTerms, AreWhatTheirDefinitionsSay) {
    DfgParams params = defaults();
    params.size = {9, 9};
    const auto at = [&](Term term, int x, int y, int channel) {
        params.terms = {term};
        Context context(1, {});
        return static_cast<double>(bake(params, {}, context).images[0].texel(0, 0, y, x)[channel]);
    };
    const double scale = at(Term::ggx, 4, 6, 0), bias = at(Term::ggx, 4, 6, 1);
    EXPECT_NEAR(at(Term::multiscatter, 4, 6, 0), 1 - (scale + bias), 1e-7);
    EXPECT_NEAR(at(Term::multiscatter, 0, 8, 1), 1 - 0.40913710, 1e-6);
    EXPECT_NEAR(at(Term::clear_coat, 4, 6, 0), 0.04 * scale + bias, 1e-7);
    EXPECT_LT(at(Term::uncorrelated, 4, 6, 0), scale);  // G1 G1 is below the correlated G2
    EXPECT_EQ(at(Term::eon, 4, 0, 0), 1);               // Lambert
    EXPECT_EQ(at(Term::subsurface, 8, 0, 0), 1);        // flat, light at the zenith
    EXPECT_EQ(at(Term::subsurface, 0, 0, 0), 0);        // flat, lit from behind
    EXPECT_GT(at(Term::subsurface, 3, 8, 0), 0);        // bent: light comes round
}

TEST(DfgTargets, SetTheLayoutUnlessTheBakeStatesItsOwn) {
    DfgParams params = defaults();
    params.target = Target::unity_hdrp;
    DfgParams layout = settled(params);
    EXPECT_EQ(layout.size, (std::vector{64, 64}));
    EXPECT_EQ(layout.axis, Axis::sqrt_nov);
    EXPECT_EQ(layout.align, Align::ends);
    EXPECT_EQ(layout.form, Form::mix);
    EXPECT_EQ(channel_names(layout), (std::vector<std::string>{"ggx.bias", "ggx.albedo", "disney_diffuse"}));
    params.form = Form::scale_bias;
    params.size = {0, 128};
    layout = settled(params);
    EXPECT_EQ(layout.form, Form::scale_bias);
    EXPECT_EQ(layout.size, (std::vector{64, 128}));
    params.target = Target::o3de;
    EXPECT_TRUE(settled(params).flip_rows);
    params.flip_rows = true;
    EXPECT_FALSE(settled(params).flip_rows);
    params = defaults();
    params.target = Target::unreal;
    EXPECT_EQ(settled(params).size, (std::vector{128, 32}));
}

TEST(DfgTargets, StoreUnitysDisneyDiffuseLessOneHalf) {
    DfgParams params = defaults();
    params.target = Target::unity_hdrp;
    params.size = {8};
    Context context(1, {});
    const Product unity = bake(params, {}, context);
    params.disney = Disney::original;
    const Product plain = bake(params, {}, context);
    EXPECT_NEAR(unity.images[0].texel(0, 0, 5, 3)[2] + 0.5f, plain.images[0].texel(0, 0, 5, 3)[2], 1e-7f);
}

}  // namespace
}  // namespace pbrbake::dfg
