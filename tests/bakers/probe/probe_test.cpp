#include "bakers/probe/probe.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bakers/probe/chain.hpp"
#include "bakers/probe/method.hpp"
#include "pbr/ibl/cubemap.hpp"
#include "tests/bakers/probe/pictures.hpp"

namespace pbrbake::probe {
namespace {

/// Largest difference of level 0 from f at texel centres.
template <class F>
double worst_at_level_0(const Product& product, const F& f) {
    const int n = product.images[0].levels[0].width;
    double worst = 0;
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                const glm::dvec3 expected = f(pbr::cubemap_texel_direction({face, x, y}, n));
                for (int c = 0; c < 3; ++c)
                    worst =
                        std::max(worst, std::abs(product.images[0].texel(0, face, y, x)[c] - expected[c]));
            }
    return worst;
}

TEST(ProbeBaker, LevelsHaveTheSizesAndRoughnessOfTheLinearMapping) {
    ProbeParams params = defaults();
    const Product product = bake_probe(params, equirect(64, axes_picture));
    ASSERT_EQ(product.images[0].levels.size(), 4u);
    for (int l = 0; l < 4; ++l) {
        const Json& level = product.properties["levels"][static_cast<std::size_t>(l)];
        EXPECT_EQ(product.images[0].levels[static_cast<std::size_t>(l)].width, 32 >> l);
        EXPECT_EQ(level["size"], 32 >> l);
        EXPECT_DOUBLE_EQ(level["perceptual_roughness"].get<double>(), l / 3.0);
        EXPECT_DOUBLE_EQ(level["alpha"].get<double>(), l * l / 9.0);
    }
    params.levels = 0;
    params.size = 256;
    EXPECT_EQ(level_count(params), 6);
    EXPECT_EQ(size_of_level(params, 5), 8);
}

TEST(ProbeBaker, ALevelHoldsTheRoughnessListedForIt) {
    // The smoothest level is that of an even list of four: it decides what is analysed for all.
    const std::vector<double> list{0, 1.0 / 3, 1.0 / 3, 1};
    ProbeParams params = defaults();
    params.levels = 0;
    params.perceptual_roughness = list;
    EXPECT_TRUE(check(params, "ktx2").empty());
    for (const Integrator integrator : {Integrator::harmonic, Integrator::fis, Integrator::reference}) {
        params.integrator = integrator;
        const Product listed = bake_probe(params, equirect(32, axes_picture));
        ASSERT_EQ(listed.images[0].levels.size(), 4u);
        EXPECT_EQ(listed.properties["levels"][1]["perceptual_roughness"], list[1]);
        EXPECT_DOUBLE_EQ(listed.properties["levels"][2]["alpha"].get<double>(), 1.0 / 9);
        EXPECT_EQ(listed.properties["level_mapping"],
                  "piecewise linear through the perceptual_roughness of the levels");
        // The same lobe at half the size: 2 x 2 texels of level 1 have the mean of one of level 2.
        const float* fine = listed.images[0].texel(1, 0, 8, 8);
        const float* coarse = listed.images[0].texel(2, 0, 4, 4);
        EXPECT_NEAR(fine[0], coarse[0], 0.1);
        params.perceptual_roughness = {};
        params.levels = 4;
        const Product even = bake_probe(params, equirect(32, axes_picture));
        for (const std::size_t l : {1u, 3u})
            EXPECT_EQ(listed.images[0].levels[l].texels, even.images[0].levels[l].texels);
        params.perceptual_roughness = list;
        params.levels = 0;
    }
}

TEST(ProbeBaker, RefusesRoughnessThatFallsOrStartsRough) {
    const auto mistake = [](int levels, std::vector<double> list) {
        ProbeParams params = defaults();
        params.levels = levels;
        params.perceptual_roughness = std::move(list);
        const std::vector<Mistake> mistakes = check(params, "ktx2");
        return mistakes.empty() ? std::string() : mistakes[0].pointer + " " + mistakes[0].message;
    };
    EXPECT_EQ(mistake(3, {0, 0.5, 1}), "");
    EXPECT_EQ(mistake(0, {0.1, 0.5}),
              "/perceptual_roughness/0 found 0.1; allowed: 0, for level 0 is the mirror");
    EXPECT_EQ(mistake(0, {0, 0.5, 0.4}),
              "/perceptual_roughness/2 found 0.4; allowed: 0.5 to 1, no level smoother than the one before");
    EXPECT_EQ(mistake(0, {0, 0}),
              "/perceptual_roughness/1 found 0; allowed: 0.01 to 1, no level smoother than the one before");
    EXPECT_EQ(mistake(4, {0, 0.5}),
              "/levels found 4, and perceptual_roughness lists 2 levels; allowed: 0 or 2");
    EXPECT_EQ(mistake(0, {0, 0.1, 0.2, 0.3, 0.4, 0.5, 1}),
              "/perceptual_roughness found 7 levels; allowed: at most 6 for size 32");
}

TEST(ProbeBaker, OrientationFollowsTheDocumentedFrame) {
    ProbeParams params = defaults();
    params.levels = 1;
    EXPECT_LT(worst_at_level_0(bake_probe(params, equirect(256, axes_picture)), axes_picture), 0.02);
    params.rotate_deg = 90;  // counter-clockwise from above: what was at +z comes to +x
    EXPECT_LT(worst_at_level_0(bake_probe(params, equirect(256, axes_picture)),
                               [](const glm::dvec3& d) {
                                   return axes_picture({-d.z, d.y, d.x});
                               }),
              0.02);
    params.rotate_deg = 0;
    params.mirror = true;
    EXPECT_LT(worst_at_level_0(bake_probe(params, equirect(256, axes_picture)),
                               [](const glm::dvec3& d) {
                                   return axes_picture({-d.x, d.y, d.z});
                               }),
              0.02);
    params.mirror = false;
    params.up = Up::z;  // the picture's up is the world's +z
    EXPECT_LT(worst_at_level_0(bake_probe(params, equirect(256, axes_picture)),
                               [](const glm::dvec3& d) {
                                   return axes_picture({d.x, d.z, -d.y});
                               }),
              0.02);
}

TEST(ProbeBaker, CubeSourceOfTheSameSizeKeepsLevel0BitExact) {
    const Inputs inputs = noise_cube(32);
    EXPECT_EQ(bake_probe(defaults(), inputs).images[0].levels[0].texels,
              inputs.at("source").image.levels[0].texels);
}

TEST(ProbeBaker, CubeSourceTurnsByQuartersExactlyAndByNothingElse) {
    const Inputs inputs = noise_cube(16);
    ProbeParams params = defaults();
    params.size = 16;
    params.levels = 1;
    params.rotate_deg = 90;
    const Product turned = bake_probe(params, inputs);
    const std::vector<float>& before = inputs.at("source").image.levels[0].texels;
    std::vector<float> sorted_before = before, sorted_after = turned.images[0].levels[0].texels;
    EXPECT_NE(before, sorted_after);
    std::sort(sorted_before.begin(), sorted_before.end());
    std::sort(sorted_after.begin(), sorted_after.end());
    EXPECT_EQ(sorted_before, sorted_after);  // a permutation
    // What faced +z now faces +x, row by row.
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            EXPECT_EQ(turned.images[0].texel(0, 0, y, x)[0], inputs.at("source").image.texel(0, 4, y, x)[0]);
    params.rotate_deg = 45;
    try {
        bake_probe(params, inputs);
        FAIL() << "45 degrees were accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::invalid_job);
        EXPECT_NE(error.message().find("90"), std::string::npos);
    }
}

TEST(ProbeBaker, EveryIntegratorKeepsAConstantEnvironmentConstant) {
    for (const Integrator integrator :
         {Integrator::is, Integrator::mis, Integrator::fis, Integrator::harmonic, Integrator::reference}) {
        ProbeParams params = defaults();
        params.integrator = integrator;
        const Product product =
            bake_probe(params, equirect(32, [](const glm::dvec3&) { return glm::dvec3(0.5, 7, 1e-4); }));
        for (const Level& level : product.images[0].levels)
            for (std::size_t i = 0; i < level.texels.size(); i += 3) {
                ASSERT_NEAR(level.texels[i], 0.5f, 0.5f * 1e-5f);
                ASSERT_NEAR(level.texels[i + 1], 7, 7 * 1e-5f);
            }
    }
}

TEST(ProbeBaker, FilteredSamplesApproachTheReference) {
    const auto lamps = [](const glm::dvec3& d) {
        return glm::dvec3(0.1 + (d.x > 0.9 ? 20 : 0), 0.5 + 0.5 * d.y, 0.2 + (d.z < -0.95 ? 50 : 0));
    };
    const Inputs inputs = equirect(128, lamps);
    ProbeParams params = defaults();
    params.integrator = Integrator::reference;
    const Product truth = bake_probe(params, inputs);
    params.integrator = Integrator::fis;
    const auto error = [&](int samples, std::size_t level) {
        params.samples = {samples};
        const Product product = bake_probe(params, inputs);
        const auto &a = product.images[0].levels[level].texels, &b = truth.images[0].levels[level].texels;
        double squared = 0, mean = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            squared += (a[i] - b[i]) * (a[i] - b[i]);
            mean += b[i];
        }
        return std::sqrt(squared * static_cast<double>(a.size())) / mean;
    };
    for (const std::size_t level : {1u, 2u, 3u}) {
        const double coarse = error(32, level), fine = error(2048, level);
        EXPECT_LT(fine, coarse / 6.4) << "level " << level;  // 64 times the samples: an eighth, less a fifth
        EXPECT_LT(fine, 0.01);
    }
}

TEST(ProbeBaker, MultipleImportanceSamplingFindsASunThatFilteringBlurs) {
    const Inputs inputs{{"source", builtin_environment("outdoor")}};
    const auto worst_error = [&](Integrator integrator, int samples) {
        ProbeParams params = defaults();
        params.size = 16;
        params.levels = 3;
        params.integrator = integrator;
        params.samples = {samples};
        const Product product = bake_probe(params, inputs);
        Context context(2, {});
        context.set_certify_fully(true);
        double worst = 0;
        for (const Figure& figure : certify(params, inputs, product, context).figures)
            if (figure.metric == "relative_rmse" && figure.level > 0) worst = std::max(worst, figure.value);
        return worst;
    };
    const double of_mis = worst_error(Integrator::mis, 256);
    EXPECT_LT(of_mis, 0.03);
    EXPECT_GT(worst_error(Integrator::fis, 256), 5 * of_mis);
}

TEST(ProbeBaker, BlackEnvironmentsAreBlackWhateverTheIntegrator) {
    for (const Inputs& inputs : {equirect(32, [](const glm::dvec3&) { return glm::dvec3(0); }), [] {
                                     Inputs cube = noise_cube(16);
                                     for (float& value : cube.at("source").image.levels[0].texels) value = 0;
                                     return cube;
                                 }()})
        for (const Integrator integrator : {Integrator::is, Integrator::mis, Integrator::fis,
                                            Integrator::harmonic, Integrator::reference}) {
            ProbeParams params = defaults();
            params.integrator = integrator;
            const Product product = bake_probe(params, inputs);
            for (const Level& level : product.images[0].levels)
                for (const float value : level.texels) ASSERT_EQ(value, 0) << enum_name(integrator);
        }
}

TEST(ProbeBaker, SameBytesAtAnyThreadCount) {
    const Inputs inputs = equirect(64, axes_picture);
    for (const Integrator integrator :
         {Integrator::is, Integrator::mis, Integrator::fis, Integrator::harmonic, Integrator::reference}) {
        ProbeParams params = defaults();
        params.integrator = integrator;
        const Product one = bake_probe(params, inputs, 1);
        for (const int threads : {2, 7}) {
            const Product many = bake_probe(params, inputs, threads);
            for (std::size_t l = 0; l < 4; ++l)
                EXPECT_EQ(many.images[0].levels[l].texels, one.images[0].levels[l].texels);
        }
    }
}

TEST(ProbeBaker, TinyAndOddSizesWork) {
    for (const int size : {1, 2, 3, 7}) {
        ProbeParams params = defaults();
        params.size = size;
        params.levels = full_chain(size);
        const Product product = bake_probe(params, equirect(16, axes_picture));
        for (const Level& level : product.images[0].levels)
            for (const float value : level.texels) {
                EXPECT_GE(value, 1 - 1e-3f);
                EXPECT_LE(value, 3 + 1e-3f);
            }
    }
}

TEST(ProbeParamsCheck, NamesWhatNeitherSchemaNorSizeAllow) {
    ProbeParams params = defaults();
    params.levels = 7;
    params.samples = {1, 2};
    const std::vector<Mistake> mistakes = check(params, "ktx2");
    ASSERT_EQ(mistakes.size(), 2u);
    EXPECT_EQ(mistakes[0].pointer, "/levels");
    EXPECT_NE(mistakes[0].message.find("at most 6"), std::string::npos);
    EXPECT_EQ(mistakes[1].pointer, "/samples");
}

TEST(ProbeParamsCheck, RefusesSamplesWhereNothingSamples) {
    ProbeParams params = defaults();
    params.integrator = Integrator::harmonic;
    ASSERT_EQ(check(params, "ktx2").size(), 1u);
    EXPECT_EQ(check(params, "ktx2")[0].pointer, "/samples");
    params.samples = {0};
    EXPECT_TRUE(check(params, "ktx2").empty());
}

TEST(ProbeMethod, AutoSolvesUnlessSamplesAreGivenOrLobesTooNarrow) {
    ProbeParams params = defaults();
    params.integrator = Integrator::automatic;
    params.samples = {0};
    EXPECT_EQ(method_of(params, {}).integrator, Integrator::harmonic);
    EXPECT_NE(method_of(params, {}).reason, "");
    params.samples = {64};
    EXPECT_EQ(method_of(params, {}).integrator, Integrator::fis);
    params.samples = {0};
    params.size = 8192;
    params.levels = 14;  // level 1 has alpha .006
    EXPECT_EQ(method_of(params, {}).integrator, Integrator::harmonic);
    Accuracy accuracy;
    accuracy.max_error = 1e-12;  // no double holds it
    EXPECT_EQ(method_of(params, accuracy).integrator, Integrator::harmonic);
    params.integrator = Integrator::is;
    EXPECT_EQ(method_of(params, {}).integrator, Integrator::is);
    EXPECT_EQ(method_of(params, {}).reason, "");
}

TEST(ProbeMethod, AccuracyChoosesSamplesThatTheJobDoesNotGive) {
    ProbeParams params = defaults();
    params.samples = {0};
    Accuracy draft;
    draft.name = "draft";
    EXPECT_LT(samples_of_level(params, draft, 1), samples_of_level(params, {}, 1));
    params.samples = {7};
    EXPECT_EQ(samples_of_level(params, draft, 1), 7);
}

TEST(ProbeBaker, AutoMeetsTheAccuracyOnASunlitEnvironment) {
    const Inputs inputs{{"source", builtin_environment("outdoor")}};
    ProbeParams params = defaults();
    params.size = 64;
    params.levels = 4;
    params.integrator = Integrator::automatic;
    params.samples = {0};
    for (const auto& [name, error] : {std::pair{"draft", 1e-2}, {"production", 1e-3}, {"reference", 1e-4}}) {
        Accuracy accuracy;
        accuracy.name = name;
        Context context(2, accuracy);
        const Product product = bake(params, inputs, context);
        EXPECT_EQ(product.properties["integrator"], "harmonic");
        EXPECT_GT(product.properties["levels"][1]["bright_texels_apart"], 0);
        const Certificate certificate = certify(params, inputs, product, context);
        int levels = 0;
        for (const Figure& figure : certificate.figures) {
            if (figure.metric == "relative_rmse" && figure.level > 0) {
                EXPECT_LT(figure.value, error) << name << " level " << *figure.level;
                ++levels;
            }
        }
        EXPECT_EQ(levels, 3);
    }
}

TEST(ProbeParamsCheck, RefusesSizesThatAnExrCubeCannotHalve) {
    ProbeParams params = defaults();
    params.size = 100;
    ASSERT_EQ(check(params, "exr").size(), 1u);
    EXPECT_EQ(check(params, "exr")[0].pointer, "/size");
    EXPECT_TRUE(check(params, "ktx2").empty());
    params.levels = 3;
    EXPECT_TRUE(check(params, "exr").empty());
}

}  // namespace
}  // namespace pbrbake::probe
