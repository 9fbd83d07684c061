#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>

#include "bakers/texture/calibrate.hpp"
#include "pbr/legacy/exponent.hpp"
#include "pbr/legacy/phong.hpp"
#include "pbr/legacy/specular_gloss.hpp"
#include "pbr/numerics/sequence.hpp"
#include "tests/bakers/texture/fixtures.hpp"

namespace pbrbake::texture::test {
namespace {

constexpr auto kFresnel = pbr::DiffuseCoupling::fresnel;

/// A metallic material a texel: corners, gradients and noise.
pbr::MetallicMaterial<float> truth(int x, int y, int size) {
    const auto random = [&](int channel) {
        return static_cast<float>(
            pbr::random_unit(static_cast<std::uint64_t>(channel), static_cast<std::uint64_t>(y * size + x)));
    };
    const float last = static_cast<float>(size - 1), u = static_cast<float>(x) / last,
                v = static_cast<float>(y) / last;
    if (y < size / 2) return {Colour(u), std::min(1.f, 2 * v), Colour(.04f)};
    return {Colour(random(1), random(2), random(3)), random(4) < .5f ? std::round(random(5)) : random(5),
            Colour(.04f)};
}

Inputs specular_gloss_set(int size, int bits) {
    Inputs inputs;
    inputs["diffuse"] = source(size, size, 3, bits, [&](int x, int y) {
        const auto d =
            pbr::diffuse_colour(pbr::reflected_from_metallic(truth(x, y, size), kFresnel), kFresnel);
        return Rgba{d.x, d.y, d.z, 1};
    });
    inputs["specular"] = source(size, size, 4, bits, [&](int x, int y) {
        const auto s = pbr::reflected_from_metallic(truth(x, y, size), kFresnel).f0;
        return Rgba{s.x, s.y, s.z, static_cast<float>(x) / static_cast<float>(size - 1)};
    });
    return inputs;
}

TEST(Texture, RoundTripsMetallicSetsThroughSpecularGloss) {
    TextureParams params = defaults();
    params.f0_tolerance = 0;
    for (const auto& [bits, pixel, largest] :
         {std::tuple(0, PixelType::float32, 1e-4), std::tuple(16, PixelType::float32, 1e-4),
          std::tuple(8, PixelType::unorm16, 1. / 255)}) {
        SCOPED_TRACE(bits);
        const Baked baked = bake_set(params, specular_gloss_set(64, bits), pixel);
        EXPECT_LE(baked.figure("diffuse_max_error"), largest);
        EXPECT_LE(baked.figure("f0_max_error"), largest);
        EXPECT_LE(baked.figure("energy_error"), largest);
        EXPECT_EQ(baked.product.scale, 1);
    }
}

/// Half an sRGB code is worth most near white: 1.14 / 255.
constexpr double kHalfCode = .5 / 255 * 2.4 / 1.055 * 1.0001;

TEST(Texture, EightBitsReturnWithinHalfACode) {
    for (const double f0_tolerance : {0., .02}) {
        TextureParams params = defaults();
        params.f0_tolerance = f0_tolerance;
        const Baked baked = bake_set(params, specular_gloss_set(128, 8), PixelType::unorm8);
        EXPECT_LE(baked.figure("diffuse_max_error"), kHalfCode);
        EXPECT_LE(baked.figure("f0_max_error"), 1.25 / 255);  // base colour and residual are both rounded
        EXPECT_LE(baked.figure("delta_e_max"), 1);
    }
}

TEST(Texture, MetallicReturnsWhereTheDataTellIt) {
    TextureParams params = defaults();
    params.f0_tolerance = 0;
    params.maps = {ExtraMap::confidence};
    const Baked baked = bake_set(params, specular_gloss_set(64, 0), PixelType::float32);
    double error = 0, count = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            if (*baked.image("confidence").texel(0, 0, y, x) < .5f) continue;
            error += std::abs(
                static_cast<double>(baked.image("orm").texel(0, 0, y, x)[2] - truth(x, y, 64).metallic));
            ++count;
        }
    EXPECT_GT(count, 64 * 64 * .8);
    EXPECT_LT(error / count, 1e-3);
}

TEST(Texture, BytesDoNotDependOnThreads) {
    TextureParams params = defaults();
    params.levels = 0;
    params.dither = true;
    params.maps = {ExtraMap::confidence, ExtraMap::difference};
    const Inputs inputs = specular_gloss_set(61, 8);
    const Baked one = bake_set(params, inputs, PixelType::unorm8, 1),
                three = bake_set(params, inputs, PixelType::unorm8, 3);
    for (std::size_t i = 0; i < one.product.images.size(); ++i)
        for (std::size_t l = 0; l < one.product.images[i].levels.size(); ++l)
            EXPECT_EQ(one.product.images[i].levels[l].texels, three.product.images[i].levels[l].texels);
    EXPECT_EQ(one.figure("delta_e_mean"), three.figure("delta_e_mean"));
}

/// Of a library's maps nearly all dielectrics have one f0; what the brightest has may not spoil it.
TEST(Texture, TheF0ThatMostTexelsHaveIsStoredExactly) {
    for (const float common : {.0395f, .0409f, .033f})
        for (const float largest : {.055f, .0978f, .11f}) {
            Inputs inputs;
            inputs["diffuse"] = source(32, 32, 3, 0, [](int, int) { return Rgba{.2f, .2f, .2f, 1}; });
            inputs["specular"] = source(32, 32, 3, 0, [&](int x, int y) {
                const float f0 = x == 0 && y == 0 ? largest : common;
                return Rgba{f0, f0, f0, 1};
            });
            TextureParams params = defaults();
            params.surface = SurfaceIs::dielectric;
            const Baked baked = bake_set(params, inputs, PixelType::unorm8);
            const float unit = baked.set()["dielectric_f0_unit"].get<float>();
            EXPECT_NEAR(*baked.image("specular").texel(0, 0, 9, 9) * unit, common, 2e-4 * common);
            EXPECT_GE(unit, largest);
            EXPECT_LE(unit, 1.05 * largest);
        }
}

/// A specular map that is no metal's by its colours, as one factor is.
TEST(Texture, GreySpecularMapsOverSaturatedColoursStayDielectric) {
    Inputs inputs;
    inputs["diffuse"] = source(32, 32, 3, 8, [](int x, int) {
        return x < 16 ? Rgba{.5f, .05f, .02f, 1} : Rgba{.02f, .1f, .4f, 1};
    });
    inputs["specular"] = source(32, 32, 3, 8, [](int x, int y) {
        const float f0 = .06f + .14f * static_cast<float>(x + y) / 62;
        return Rgba{f0, f0, f0, 1};
    });
    const Baked baked = bake_set(defaults(), inputs, PixelType::float32);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) EXPECT_LT(baked.image("orm").texel(0, 0, y, x)[2], .02f);
    EXPECT_LT(baked.figure("f0_max_error"), 1e-6);
    EXPECT_LT(baked.figure("diffuse_max_error"), 1. / 255);
}

TEST(Texture, NoiseDoesNotLeadBeyondWhite) {
    TextureParams params = defaults();
    params.dither = true;
    Inputs inputs;
    inputs["diffuse"] = source(32, 32, 3, 0, [](int, int) { return Rgba{.9999f, .9999f, .9999f, 1}; });
    inputs["specular"] = source(32, 32, 3, 0, [](int, int) { return Rgba{.001f, .001f, .001f, 1}; });
    EXPECT_EQ(bake_set(params, inputs, PixelType::unorm8).product.scale, 1);
}

TEST(Texture, ASetWithoutExponentHasTheOneOfTheRoughnessItGets) {
    TextureParams params = defaults();
    params.model = Model::blinn_phong;
    params.calibrate = Calibrate::none;
    Inputs inputs;
    inputs["diffuse"] = source(4, 4, 3, 0, [](int, int) { return Rgba{.2f, .2f, .2f, 1}; });
    inputs["specular"] = source(4, 4, 3, 0, [](int, int) { return Rgba{.1f, .1f, .1f, 1}; });
    const auto texels = [&] {
        std::vector<std::vector<float>> values;
        for (const Image& image : bake_set(params, inputs, PixelType::float32).product.images)
            values.push_back(image.levels[0].texels);
        return values;
    };
    const auto without = texels();
    params.power = 30;  // alpha^2 = 2 / (30 + 2) is that of perceptual roughness .5
    const auto with = texels();
    ASSERT_EQ(without.size(), with.size());
    for (std::size_t i = 0; i < with.size(); ++i)
        for (std::size_t k = 0; k < with[i].size(); ++k) EXPECT_NEAR(without[i][k], with[i][k], 1e-6);
}

TEST(Texture, PhongLobesKeepEnergyAndReportWhatTheyCannot) {
    TextureParams params = defaults();
    params.calibrate = Calibrate::none;
    params.gloss = "set_g.png";
    params.gloss_is = GlossIs::power_log2;
    params.power_scale = 16.6;  // up to 1e5
    for (const auto& [model, norm] : {std::pair(Model::blinn_phong, Norm::energy),
                                      {Model::blinn_phong, Norm::n_plus_8},
                                      {Model::blinn_phong, Norm::none},
                                      {Model::blinn_phong, Norm::over_pi},
                                      {Model::phong, Norm::energy},
                                      {Model::phong, Norm::none}}) {
        SCOPED_TRACE(std::string(enum_name(model)) + ", " + std::string(enum_name(norm)));
        params.model = model;
        params.norm = norm;
        const auto lobe = model == Model::phong ? pbr::PhongLobe::mirror : pbr::PhongLobe::blinn;
        double worst_ks = 1;
        for (int x = 0; x < 64; ++x)  // ks albedo <= .9
            worst_ks = std::min(worst_ks, .9 / pbr::phong_albedo(static_cast<pbr::PhongNorm>(norm), lobe,
                                                                 std::exp2(16.6 * x / 63))
                                                   .normal);
        Inputs inputs;
        inputs["diffuse"] = source(64, 16, 3, 0, [](int, int) { return Rgba{0, 0, 0, 1}; });
        inputs["specular"] = source(64, 16, 3, 0, [&](int, int y) {
            const auto ks = static_cast<float>(worst_ks * (y + 1) / 16);
            return Rgba{ks, ks, ks, 1};
        });
        inputs["gloss"] = source(64, 16, 3, 0, [](int x, int) {
            const auto g = static_cast<float>(x / 63.);
            return Rgba{g, g, g, 1};
        });
        EXPECT_LE(bake_set(params, inputs, PixelType::float32).figure("energy_error"), .02);
        EXPECT_EQ(bake_set(params, inputs, PixelType::float32).figure("f0_clamped"), 0);
    }
    params.model = Model::blinn_phong;
    params.norm = Norm::none;  // n = 1 .. reflects up to 2.5 times what arrives
    Inputs inputs;
    inputs["diffuse"] = source(8, 8, 3, 0, [](int, int) { return Rgba{0, 0, 0, 1}; });
    inputs["specular"] = source(8, 8, 3, 0, [](int, int) { return Rgba{1, 1, 1, 1}; });
    inputs["gloss"] = source(8, 8, 3, 0, [](int x, int) { return Rgba{x < 4 ? 0.f : 1.f, 0, 0, 1}; });
    const Baked baked = bake_set(params, inputs, PixelType::float32);
    EXPECT_EQ(baked.figure("f0_clamped"), .5);
    EXPECT_THAT(baked.product.warnings, testing::Contains(testing::HasSubstr("50 % of texels")));
}

TEST(Texture, ExponentOfFiftyIsNotWhatConvertersMakeOfIt) {
    TextureParams params = defaults();
    params.model = Model::blinn_phong;
    params.power = 50;
    Inputs inputs = specular_gloss_set(4, 8);
    inputs["specular"].image.channels.pop_back();
    inputs["specular"] = source(4, 4, 3, 8, [](int, int) { return Rgba{.1f, .1f, .1f, 1}; });
    const Baked baked = bake_set(params, inputs, PixelType::float32);
    EXPECT_NEAR(baked.image("orm").texel(0, 0, 0, 0)[1], .443, .001);
}

TEST(Texture, TakesUnequalOddAndSingleTexelMaps) {
    TextureParams params = defaults();
    params.normal = "set_n.png";
    params.occlusion = "set_ao.png";
    params.levels = 0;
    Inputs inputs;
    inputs["diffuse"] = source(7, 5, 3, 8, [](int, int) { return Rgba{.5f, .4f, .3f, 1}; });
    inputs["specular"] = source(1, 1, 3, 8, [](int, int) { return Rgba{.04f, .04f, .04f, 1}; });
    inputs["normal"] = source(14, 3, 3, 0, [](int, int) { return Rgba{.5f, .5f, 1, 1}; });
    inputs["occlusion"] = source(2, 2, 3, 0, [](int x, int) { return Rgba{static_cast<float>(x), 0, 0, 1}; });
    const Baked baked = bake_set(params, inputs, PixelType::unorm8);
    EXPECT_EQ(baked.set()["size"], Json({14, 5}));
    EXPECT_EQ(baked.product.images[0].levels.size(), 4u);
    EXPECT_EQ(baked.product.images[0].levels.back().width, 1);
    for (const Image& image : baked.product.images)
        for (const Level& level : image.levels)
            for (const float value : level.texels) EXPECT_TRUE(value >= 0 && value <= 1) << image.name;
    EXPECT_LT(baked.figure("energy_error"), .02);
    EXPECT_EQ(baked.product.warnings.size(), 5u);  // four sizes, and no gloss
}

TEST(Texture, FindsOutWhichWayGreenPoints) {
    for (const bool is_down : {false, true}) {
        TextureParams params = defaults();
        params.normal = "set_n.png";
        Inputs inputs = specular_gloss_set(64, 8);
        inputs["normal"] = source(64, 64, 3, 0, [&](int x, int y) {
            // Slopes of h = sin(x / 5 + y / 7) + sin(x / 9 - y / 4), y up.
            const double a = std::cos(x / 5. - y / 7.), b = std::cos(x / 9. + y / 4.);
            const double sx = .3 * (a / 5 + b / 9), sy = .3 * (a / 7 - b / 4),
                         l = std::sqrt(1 + sx * sx + sy * sy);
            return Rgba{static_cast<float>(.5 - .5 * sx / l),
                        static_cast<float>(.5 - (is_down ? -.5 : .5) * sy / l),
                        static_cast<float>(.5 + .5 / l), 1};
        });
        const Baked baked = bake_set(params, inputs, PixelType::unorm8);
        EXPECT_EQ(baked.set()["normal_green"], is_down ? "down" : "up");
        EXPECT_GT(std::abs(baked.set()["green_correlation"].get<double>()), .9);
    }
}

TEST(Texture, AlphaIsGlossOpacityOrNothing) {
    TextureParams params = defaults();
    Inputs inputs = specular_gloss_set(16, 8);
    EXPECT_EQ(bake_set(params, inputs, PixelType::unorm8).product.images[0].channel_count(), 3);
    inputs["diffuse"] = source(16, 16, 4, 8, [](int x, int) {
        return Rgba{.5f, .5f, .5f, static_cast<float>(x) / 15};
    });
    const Baked baked = bake_set(params, inputs, PixelType::float32);
    EXPECT_EQ(baked.set()["diffuse_alpha"], "opacity");
    EXPECT_EQ(baked.product.images[0].channel_count(), 4);
    EXPECT_NEAR(baked.product.images[0].texel(0, 0, 0, 15)[3], 1, 1e-6);
    EXPECT_NEAR(baked.image("orm").texel(0, 0, 0, 15)[1], 0, 1e-3);  // gloss 1 in the alpha of specular
    params.alpha_is = AlphaIs::nothing;
    EXPECT_EQ(bake_set(params, inputs, PixelType::unorm8).product.images[0].channel_count(), 3);
    params.gloss_in = GlossIn::gloss;
    EXPECT_THROW(bake_set(params, inputs, PixelType::unorm8), Error);
}

TEST(Texture, NamesTellSurfaces) {
    EXPECT_FALSE(surface_word("maps/Concrete01_d.png")->is_metal);
    EXPECT_TRUE(surface_word("steel/rusty-IRON2.tga")->is_metal);
    EXPECT_EQ(surface_word("steel/wall_d.png"), nullptr);
    EXPECT_EQ(surface_word("ironic_d.png"), nullptr);
    EXPECT_EQ(surface_word(""), nullptr);
}

TEST(Texture, ConcreteIsNoMetalAndSteelIsHoweverTheirSpecularWasPainted) {
    for (const auto& [file, metallic] : {std::pair("concrete01_d.png", 0.), std::pair("steel_d.png", 1.)}) {
        TextureParams params = defaults();
        params.model = Model::blinn_phong;
        params.power = 30;
        params.diffuse = file;
        Inputs inputs;
        inputs["diffuse"] = source(16, 16, 3, 8, [](int x, int) {
            return Rgba{.1f + static_cast<float>(x) * .01f, .1f, .1f, 1};
        });
        inputs["specular"] = source(16, 16, 3, 8, [](int, int y) {
            return Rgba{.3f, .3f + static_cast<float>(y) * .01f, .3f, 1};
        });
        const Baked baked = bake_set(params, inputs, PixelType::unorm8);
        EXPECT_EQ(baked.set()["mean_metallic"], metallic) << file;
    }
}

/// A set whose maps are said to be f0, painted: a diffuse colour, and this much grey specular, linear.
Inputs painted_set(float specular) {
    Inputs inputs;
    inputs["diffuse"] = source(16, 16, 3, 8, [](int x, int) {
        return Rgba{.2f + static_cast<float>(x) * .01f, .2f, .2f, 1};
    });
    inputs["specular"] = source(16, 16, 3, 0, [&](int, int) {
        return Rgba{specular, specular, specular, 1};
    });
    return inputs;
}

TEST(Texture, NamesThatContradictF0AreHeard) {
    TextureParams params = defaults();
    params.diffuse = "concrete01_d.png";
    const Baked concrete = bake_set(params, painted_set(.3f), PixelType::float32);
    EXPECT_EQ(concrete.set()["mean_metallic"], 0);
    EXPECT_THAT(concrete.product.warnings, testing::Contains(testing::HasSubstr("the name says concrete")));
    EXPECT_NEAR(concrete.set()["specular_scale"], .04 / .3, 1e-3);
    params.calibrate = Calibrate::none;
    EXPECT_EQ(bake_set(params, painted_set(.3f), PixelType::float32).set()["specular_scale"], 1);
    params.calibrate = Calibrate::automatic;
    EXPECT_EQ(bake_set(params, painted_set(.05f), PixelType::float32).set()["specular_scale"], 1);
    params.source = "scene.gltf";  // made as f0
    EXPECT_EQ(bake_set(params, painted_set(.3f), PixelType::float32).set()["specular_scale"], 1);

    params.source = "";
    params.diffuse = "steel_d.png";
    const Baked steel = bake_set(params, painted_set(.05f), PixelType::float32);
    EXPECT_LT(steel.set()["mean_confidence"], .5);
    EXPECT_THAT(steel.product.warnings, testing::Contains(testing::HasSubstr("the name says steel")));
}

/// Water reflects .02, and nothing solid less: what is below everywhere wasn't measured, and isn't silently
/// taken for a dielectric's.
TEST(Texture, SpecularBelowWatersEverywhereIsDoubted) {
    for (const float specular : {.019f, .01f}) {
        const Baked dim = bake_set(defaults(), painted_set(specular), PixelType::float32);
        EXPECT_LT(dim.set()["mean_confidence"], .5);
        EXPECT_THAT(dim.product.warnings, testing::Contains(testing::HasSubstr("less than water")));
    }
    const Baked usual = bake_set(defaults(), painted_set(.04f), PixelType::float32);
    EXPECT_GT(usual.set()["mean_confidence"], .5);
    EXPECT_THAT(usual.product.warnings, testing::Not(testing::Contains(testing::HasSubstr("water"))));
}

TEST(Texture, DoubtsGlossThatIsLowWhereSpecularIsBright) {
    for (const bool is_rough : {false, true}) {
        TextureParams params = defaults();
        Inputs inputs = specular_gloss_set(16, 8);
        inputs["specular"] = source(16, 16, 4, 8, [&](int x, int) {
            const float s = static_cast<float>(x) / 40, g = static_cast<float>(x) / 15;
            return Rgba{s, s, s, is_rough ? 1 - g : g};
        });
        const auto doubted = testing::Contains(testing::HasSubstr("roughness map"));
        Baked baked = bake_set(params, inputs, PixelType::unorm8);
        EXPECT_NEAR(baked.set()["gloss_correlation"].get<double>(), is_rough ? -1 : 1, .05);
        if (is_rough)
            EXPECT_THAT(baked.product.warnings, doubted);
        else
            EXPECT_THAT(baked.product.warnings, testing::Not(doubted));
        params.gloss_is = GlossIs::smoothness;
        EXPECT_THAT(bake_set(params, inputs, PixelType::unorm8).product.warnings, testing::Not(doubted));
    }
}

TEST(Texture, DoubtsExponentsOfTheWrongScaleAndOcclusionInDiffuse) {
    TextureParams params = defaults();
    params.model = Model::blinn_phong;
    params.gloss_is = GlossIs::power;
    params.power_scale = 1;
    params.gloss = "set_g.png";
    params.occlusion = "set_ao.png";
    Inputs inputs;
    const auto ramp = [](int x, int) {
        const float v = static_cast<float>(x) / 15;
        return Rgba{v, v, v, 1};
    };
    for (const char* field : {"diffuse", "gloss", "occlusion"}) inputs[field] = source(16, 16, 3, 0, ramp);
    inputs["specular"] = source(16, 16, 3, 0, [](int, int) { return Rgba{.04f, .04f, .04f, 1}; });
    const Baked low = bake_set(params, inputs, PixelType::unorm8);
    EXPECT_THAT(low.product.warnings, testing::Contains(testing::HasSubstr("power_scale may be too small")));
    EXPECT_THAT(low.product.warnings, testing::Contains(testing::HasSubstr("count twice")));
    EXPECT_NEAR(low.set()["occlusion_correlation"].get<double>(), 1, 1e-6);
    params.power_scale = 1e6;
    EXPECT_THAT(bake_set(params, inputs, PixelType::unorm8).product.warnings,
                testing::Contains(testing::HasSubstr("power_scale may be too large")));
}

TEST(Texture, SampledCertificatesHoldWhatFullOnesMeasure) {
    TextureParams params = defaults();
    const Inputs inputs = specular_gloss_set(512, 8);
    const Baked full = bake_set(params, inputs, PixelType::unorm8, 2);
    Context context(2, {});
    const Certificate sampled = certify(params, inputs, full.product, context);
    ASSERT_TRUE(sampled.headline->interval);
    EXPECT_EQ(sampled.headline->evidence, Evidence::estimate);
    EXPECT_LE(sampled.headline->interval->first, full.figure("energy_error"));
    EXPECT_GE(sampled.headline->interval->second, full.figure("energy_error"));
    for (const Figure& figure : sampled.figures)
        EXPECT_LE(figure.value, full.figure(figure.metric) * 1.1 + 1e-6);
}

/// All but what makes up for the rounding of other codes.
TEST(Texture, CodesAreThoseOfTheFloatsThatTheyStandFor) {
    for (const Packing packing : {Packing::gltf, Packing::frostbite, Packing::specular_gloss}) {
        TextureParams params = defaults();
        params.levels = 0;
        params.packing = packing;
        params.maps = {ExtraMap::confidence};
        const Inputs inputs = specular_gloss_set(61, 16);
        const Baked coded = bake_set(params, inputs, PixelType::unorm8),
                    floats = bake_set(params, inputs, PixelType::float32);
        ASSERT_EQ(coded.product.images.size(), floats.product.images.size());
        for (std::size_t i = 0; i < coded.product.images.size(); ++i) {
            const Image& image = floats.product.images[i];
            if (image.name == "base_color" || image.name == "specular" || image.name == "diffuse") continue;
            for (std::size_t l = 0; l < image.levels.size(); ++l)
                for (std::size_t k = 0; k < image.levels[l].texels.size(); ++k) {
                    // A reflectance makes up for metallic too.
                    if (packing == Packing::frostbite && k % 4 == 2) continue;
                    const int code = coded.product.images[i].levels[l].codes[k],
                              nearest = unorm8_of(image.levels[l].texels[k],
                                                  channel_transfer(image, k % image.channels.size()));
                    // Metallic isn't rounded up where that takes diffuse light away.
                    const int lowest = nearest - (image.name == "orm" && k % 3 == 2 ? 1 : 0);
                    ASSERT_TRUE(code == nearest || code == lowest) << image.name << " " << l << " " << k;
                }
        }
    }
}

TEST(Texture, NoiseKeepsMeans) {
    for (const double code : {125.3, 129.7, 177.179, 40.5}) {
        TextureParams params = defaults();
        params.dither = true;
        params.occlusion = "set_o.png";
        params.packing = Packing::separate;
        Inputs inputs = specular_gloss_set(256, 0);
        inputs["occlusion"] = source(256, 256, 1, 0, [&](int, int) {
            return Rgba{static_cast<float>(code / 255), 0, 0, 0};
        });
        const Baked baked = bake_set(params, inputs, PixelType::unorm8);
        double sum = 0;
        for (const std::uint8_t stored : baked.image("occlusion").levels[0].codes) sum += stored;
        // A code's error then has the variance 1/4, whatever the number (Lipshitz et al. 1992).
        EXPECT_NEAR(sum / (256 * 256), code, 4 * .5 / 256);
    }
}

TEST(Texture, MistakesAreNamed) {
    TextureParams params = defaults();
    params.diffuse = params.specular = "";
    ASSERT_EQ(check(params, "png").size(), 1u);
    params = defaults();
    params.levels = 0;
    EXPECT_EQ(check(params, "png").front().pointer, "/levels");
    EXPECT_TRUE(check(params, "ktx2").empty());
    params.levels = 1;
    params.packing = Packing::unity;
    EXPECT_EQ(check(params, "gltf").front().pointer, "/packing");
    params.model = Model::phong;
    params.gloss = "g.png";
    EXPECT_EQ(check(params, "png").front().pointer, "/gloss_is");
}

/// Every eighth texel of a file, each way.
SourceImage thinned(const std::filesystem::path& path, const std::string& colour_space) {
    SourceImage file = io::read_source({path, colour_space});
    const Image image = std::move(file.image);
    SourceImage small =
        source(image.levels[0].width / 8, image.levels[0].height / 8, 3, 0, [&](int x, int y) {
            const float* texel = image.texel(0, 0, 8 * y, 8 * x);
            return Rgba{texel[0], texel[1], texel[2], 1};
        });
    return small;
}

TEST(TextureRealFiles, BoomBoxReturnsThroughSpecularGlossInFloat) {
    const char* data = std::getenv("PBRBAKE_SHARED_DATA");
    if (!data) GTEST_SKIP() << "no shared data: set PBRBAKE_SHARED_DATA to its folder";
    const std::filesystem::path folder = std::filesystem::path(data) / "legacy/gltf_specgloss/BoomBox";
    const SourceImage base = thinned(folder / "BoomBox_baseColor.png", "srgb");
    const SourceImage orm = thinned(folder / "BoomBox_roughnessMetallic.png", "raw");
    const int width = base.image.levels[0].width, height = base.image.levels[0].height;
    const auto material = [&](int x, int y) {
        const float* b = base.image.texel(0, 0, y, x);
        return pbr::MetallicMaterial<float>{Colour(b[0], b[1], b[2]), orm.image.texel(0, 0, y, x)[2],
                                            Colour(.04f)};
    };
    Inputs inputs;
    inputs["diffuse"] = source(width, height, 3, 0, [&](int x, int y) {
        const auto d = pbr::diffuse_colour(pbr::reflected_from_metallic(material(x, y), kFresnel), kFresnel);
        return Rgba{d.x, d.y, d.z, 1};
    });
    inputs["specular"] = source(width, height, 4, 0, [&](int x, int y) {
        const auto s = pbr::reflected_from_metallic(material(x, y), kFresnel).f0;
        return Rgba{s.x, s.y, s.z, 1 - orm.image.texel(0, 0, y, x)[1]};
    });
    TextureParams params = defaults();
    params.f0_tolerance = 0;
    params.maps = {ExtraMap::confidence};
    const Baked baked = bake_set(params, inputs, PixelType::float32);
    EXPECT_LE(baked.figure("diffuse_max_error"), 1e-4);
    EXPECT_LE(baked.figure("f0_max_error"), 1e-4);
    double told = 0, told_error = 0, error = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double off = std::abs(
                static_cast<double>(baked.image("orm").texel(0, 0, y, x)[2] - material(x, y).metallic));
            error += off;
            if (*baked.image("confidence").texel(0, 0, y, x) < .5f) continue;
            told_error += off;
            ++told;
        }
    RecordProperty("mean_metallic_error", std::to_string(error / width / height));
    RecordProperty("told_share", std::to_string(told / width / height));
    RecordProperty("told_error", std::to_string(told_error / told));
    EXPECT_LT(told_error / told, 1e-3);
    EXPECT_LT(error / width / height, 1e-3);
}

TEST(TextureRealFiles, BoomBoxReturnsInEightBits) {
    const char* data = std::getenv("PBRBAKE_SHARED_DATA");
    if (!data) GTEST_SKIP() << "no shared data: set PBRBAKE_SHARED_DATA to its folder";
    const std::filesystem::path folder = std::filesystem::path(data) / "legacy/gltf_specgloss/BoomBox";
    Inputs inputs;
    for (const auto& [field, file] :
         {std::pair("diffuse", "BoomBox_diffuse.png"), {"specular", "BoomBox_specularGlossiness.png"}}) {
        const SourceImage small = thinned(folder / file, "srgb");
        const Level& level = small.image.levels[0];
        inputs[field] = source(level.width, level.height, 3, 8, [&](int x, int y) {
            const float* texel = small.image.texel(0, 0, y, x);
            return Rgba{texel[0], texel[1], texel[2], 1};
        });
    }
    TextureParams params = defaults();
    params.f0_tolerance = 0;
    const Baked baked = bake_set(params, inputs, PixelType::unorm8, 2);
    EXPECT_LE(baked.figure("diffuse_max_error"), 1. / 255);
    EXPECT_LE(baked.figure("f0_max_error"), 1. / 255);
}

}  // namespace
}  // namespace pbrbake::texture::test
