// What is read as gloss, as what, and whether the record says why.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "bakers/texture/gloss.hpp"
#include "pbr/legacy/exponent.hpp"
#include "tests/bakers/texture/fixtures.hpp"

namespace pbrbake::texture::test {
namespace {

using testing::Contains;
using testing::HasSubstr;

/// A set whose specular has an alpha from 0 to 1.
Inputs set_with_alpha() {
    Inputs inputs;
    inputs["diffuse"] = source(16, 16, 3, 8, [](int, int) { return Rgba{.3f, .3f, .3f, 1}; });
    inputs["specular"] = source(16, 16, 4, 8, [](int x, int) {
        return Rgba{.05f, .05f, .05f, static_cast<float>(x) / 15};
    });
    return inputs;
}

double roughness_at(const Baked& baked, int x) {
    return static_cast<double>(baked.image("orm").texel(0, 0, 0, x)[1]);
}

TEST(Gloss, AlphaOfAPhongSetIsItsExponentAndSaysSo) {
    TextureParams params = defaults();
    for (const Model model : {Model::blinn_phong, Model::phong}) {
        params.model = model;
        params.power_scale = 128;
        const Baked baked = bake_set(params, set_with_alpha(), PixelType::float32);
        const double n = 128 * 9 / 15. * (model == Model::phong ? 4 : 1);
        EXPECT_NEAR(roughness_at(baked, 9), std::pow(2 / (n + 2), .25), 1e-4);
        EXPECT_THAT(baked.product.warnings,
                    Contains(testing::AllOf(HasSubstr("gloss_is"), HasSubstr("power_scale"))));
        EXPECT_EQ(baked.set()["gloss"],
                  Json({{"in", "specular.a"},
                        {"is", "power"},
                        {"reason", "model " + std::string(enum_name(model)) + " has exponents"}}));
    }
}

TEST(Gloss, StatedMeaningsAreFollowedWithoutAWarning) {
    TextureParams params = defaults();
    params.model = Model::blinn_phong;
    params.gloss_is = GlossIs::smoothness;
    Baked baked = bake_set(params, set_with_alpha(), PixelType::float32);
    EXPECT_NEAR(roughness_at(baked, 12), 1 - 12 / 15., 1e-4);
    EXPECT_EQ(baked.set()["gloss"]["reason"], "stated by gloss_is");
    EXPECT_THAT(baked.product.warnings, testing::Not(Contains(HasSubstr("power_scale"))));
    params.gloss_in = GlossIn::none;
    params.power = 50;
    baked = bake_set(params, set_with_alpha(), PixelType::float32);
    EXPECT_NEAR(roughness_at(baked, 12), .443, 1e-3);
    params.gloss_in = GlossIn::automatic;  // a stated exponent is the set's; the alpha is something else
    baked = bake_set(params, set_with_alpha(), PixelType::float32);
    EXPECT_NEAR(roughness_at(baked, 12), .443, 1e-3);
    EXPECT_EQ(baked.set()["gloss"], Json({{"in", "none"}, {"reason", "stated by power"}}));
}

TEST(Gloss, AnExponentStandsInForAnAlphaOfExponents) {
    TextureParams params = defaults();
    params.model = Model::blinn_phong;
    params.gloss_is = GlossIs::power;
    params.power_scale = params.power = 16;
    const Baked varied = bake_set(params, set_with_alpha(), PixelType::float32);
    EXPECT_NEAR(roughness_at(varied, 9), std::pow(2 / (16 * 9 / 15. + 2), .25), 1e-4);
    Inputs flat = set_with_alpha();
    flat["specular"] = source(16, 16, 3, 8, [](int, int) { return Rgba{.05f, .05f, .05f, 1}; });
    EXPECT_NEAR(roughness_at(bake_set(params, flat, PixelType::float32), 9), std::pow(2 / 18., .25), 1e-4);
}

TEST(Gloss, IsItsFactorWhereItIsConstant) {
    TextureParams params = defaults();
    params.gloss_in = GlossIn::constant;
    params.gloss_factor = .7;
    for (const Model model : {Model::specular_gloss, Model::blinn_phong}) {
        params.model = model;
        const Baked baked = bake_set(params, set_with_alpha(), PixelType::float32);
        EXPECT_NEAR(roughness_at(baked, 12), .3, 1e-6);
        EXPECT_EQ(baked.set()["gloss"]["in"], "constant");
        EXPECT_EQ(baked.set()["gloss"]["is"], "smoothness");
    }
    // A glTF material's picture whose alpha is 1 need not store it.
    params.gloss_in = GlossIn::specular_alpha;
    params.source = "set.gltf";
    Inputs inputs = set_with_alpha();
    inputs["specular"] = source(16, 16, 3, 8, [](int, int) { return Rgba{.05f, .05f, .05f, 1}; });
    EXPECT_NEAR(roughness_at(bake_set(params, inputs, PixelType::float32), 12), .3, 1e-6);
}

std::string refusal(const TextureParams& params, const Inputs& inputs) {
    try {
        bake_set(params, inputs, PixelType::float32);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::unreadable_input);
        return error.what();
    }
    return "none";
}

TEST(Gloss, AStatedAlphaThatIsAbsentIsAnError) {
    Inputs inputs = set_with_alpha();
    for (const char* field : {"specular", "normal"})
        inputs[field] = source(16, 16, 3, 8, [](int, int) { return Rgba{.05f, .05f, .05f, 1}; });
    for (const auto& [in, field] : {std::pair(GlossIn::specular_alpha, "specular"),
                                    {GlossIn::diffuse_alpha, "diffuse"},
                                    {GlossIn::normal_alpha, "normal"}}) {
        TextureParams params = defaults();
        params.gloss_in = in;
        EXPECT_THAT(refusal(params, inputs),
                    testing::AllOf(HasSubstr("gloss_in: found \"" + std::string(enum_name(in)) + "\""),
                                   HasSubstr(std::string("picture of ") + field + " has no alpha")));
    }
}

/// A packed map: smoothness, its exponents' and others', one a channel.
TEST(Gloss, IsTheChannelThatIsStated) {
    Inputs inputs = set_with_alpha();
    inputs["gloss"] = source(16, 16, 4, 0, [](int x, int) {
        return Rgba{.1f, .2f, static_cast<float>(x) / 15, .7f};
    });
    TextureParams params = defaults();
    const std::array expected{.9, .9, .8, 3 / 15., .3};  // auto: red
    for (const Channel channel : {Channel::automatic, Channel::r, Channel::g, Channel::b, Channel::a}) {
        params.gloss_channel = channel;
        const Baked baked = bake_set(params, inputs, PixelType::float32);
        EXPECT_NEAR(roughness_at(baked, 12), expected[static_cast<std::size_t>(channel)], 1e-6);
    }
    EXPECT_EQ(bake_set(params, inputs, PixelType::float32).set()["gloss"]["in"], "gloss.a");
    inputs["gloss"] = source(16, 16, 3, 0, [](int, int) { return Rgba{.1f, .2f, .3f, 1}; });
    EXPECT_THAT(refusal(params, inputs), HasSubstr("gloss_channel: found \"a\""));
    inputs.erase("gloss");
    EXPECT_THAT(refusal(params, inputs), HasSubstr("gloss_channel: found \"a\""));
}

TEST(Gloss, StoredAsSrgbIsDecoded) {
    Inputs inputs = set_with_alpha();
    inputs["gloss"] = source(16, 16, 3, 0, [](int x, int) {
        const float code = static_cast<float>(x) / 15;  // 51 / 255 a step
        return Rgba{code, code, code, 1};
    });
    inputs["gloss"].bits = 8;
    inputs["gloss"].colour_space = "raw";
    TextureParams params = defaults();
    params.gloss_space = GlossSpace::srgb;
    const Baked baked = bake_set(params, inputs, PixelType::float32);
    EXPECT_NEAR(roughness_at(baked, 0), 1, 1e-6);
    EXPECT_NEAR(roughness_at(baked, 12), 1 - std::pow((.8 + .055) / 1.055, 2.4), 1e-6);
    EXPECT_NEAR(roughness_at(baked, 15), 0, 1e-6);
}

/// Readers turn infinity into the largest float, which is as much a mirror's.
TEST(Gloss, AnInfiniteExponentIsAMirrors) {
    constexpr float kInfinite = std::numeric_limits<float>::max();
    Inputs inputs = set_with_alpha();
    inputs["gloss"] = source(16, 16, 3, 0, [](int x, int) {
        return Rgba{x < 8 ? 10.f : kInfinite, 0, 0, 1};
    });
    for (const Model model : {Model::specular_gloss, Model::blinn_phong, Model::phong})
        for (const double scale : {.5, 1., 128.}) {
            TextureParams params = defaults();
            params.model = model;
            params.gloss_is = GlossIs::power;
            params.power_scale = scale;
            const Baked baked = bake_set(params, inputs, PixelType::float32);
            const double n = 10 * scale * (model == Model::phong ? 4 : 1);
            EXPECT_NEAR(roughness_at(baked, 3), std::pow(2 / (n + 2), .25), 1e-6);
            EXPECT_LT(roughness_at(baked, 12), 1e-9);
            EXPECT_NEAR(baked.set()["exponent_max"].get<double>(), 10 * scale, 1e-5);
            EXPECT_TRUE(std::isfinite(baked.figure("energy_error")));
        }
}

TEST(Gloss, NamesTellPolarity) {
    EXPECT_EQ(gloss_named("maps/crate_roughness.png"), GlossIs::perceptual_roughness);
    EXPECT_EQ(gloss_named("crate-Gloss2.tga"), GlossIs::smoothness);
    EXPECT_EQ(gloss_named("rough/crate_g.tga"), GlossIs::automatic);
    TextureParams params = defaults();
    params.gloss = "crate_rough.png";
    Inputs inputs = set_with_alpha();
    inputs["gloss"] = source(16, 16, 3, 8, [](int x, int) {
        const float v = static_cast<float>(x) / 15;
        return Rgba{v, v, v, 1};
    });
    inputs["gloss"].colour_space = "raw";
    const float stored = inputs["gloss"].image.texel(0, 0, 0, 12)[0];
    Baked baked = bake_set(params, inputs, PixelType::float32);
    EXPECT_NEAR(roughness_at(baked, 12), static_cast<double>(stored), 1e-5);
    EXPECT_EQ(baked.set()["gloss"]["reason"], "the file's name");
    params.gloss_is = GlossIs::smoothness;
    baked = bake_set(params, inputs, PixelType::float32);
    EXPECT_NEAR(roughness_at(baked, 12), 1 - static_cast<double>(stored), 1e-5);
}

/// Codes are read by tables, floats one by one.
TEST(Gloss, CodesAndFloatsOfAPictureMakeTheSameSet) {
    for (const Model model : {Model::specular_gloss, Model::blinn_phong}) {
        TextureParams params = defaults();
        params.model = model;
        params.levels = 0;
        Inputs floats = set_with_alpha();
        floats["diffuse"] = source(8, 16, 4, 8, [](int x, int y) {
            return Rgba{static_cast<float>(x) / 7, static_cast<float>(y) / 15, .5f,
                        static_cast<float>(y) / 15};
        });
        Inputs codes;
        for (const auto& [field, image] : floats) codes[field] = coded(image);
        const Baked a = bake_set(params, floats, PixelType::unorm8),
                    b = bake_set(params, codes, PixelType::unorm8);
        for (std::size_t i = 0; i < a.product.images.size(); ++i)
            for (std::size_t l = 0; l < a.product.images[i].levels.size(); ++l)
                EXPECT_EQ(a.product.images[i].levels[l].texels, b.product.images[i].levels[l].texels);
        EXPECT_EQ(a.set(), b.set());
    }
}

TEST(Gloss, ExponentsOfLargeMapsAreThoseOfTheirTexelsAndBetweenThem) {
    // Many more texels than a 16-bit map has codes; and a map of half the size, bilinear and repeated.
    constexpr int kWidth = 640, kHeight = 512;
    TextureParams params = defaults();
    params.model = Model::blinn_phong;
    params.gloss = "set_power.png";
    params.gloss_is = GlossIs::power;
    params.power_scale = 1000;
    for (const int shrink : {1, 2}) {
        const int width = kWidth / shrink, height = kHeight / shrink;
        Inputs inputs;
        inputs["diffuse"] = source(kWidth, kHeight, 3, 0, [](int, int) { return Rgba{.3f, .3f, .3f, 1}; });
        inputs["specular"] = source(1, 1, 3, 0, [](int, int) { return Rgba{.05f, .05f, .05f, 1}; });
        inputs["gloss"] = source(width, height, 1, 16, [](int x, int y) {
            return Rgba{static_cast<float>((x * 97 + y * 31) % 1009) / 1009, 0, 0, 0};
        });
        const Image& gloss = inputs["gloss"].image;
        const auto stored = [&](int x, int y) {
            return static_cast<double>(*gloss.texel(0, 0, (y + height) % height, (x + width) % width));
        };
        Context context(1, {});
        context.set_pixels({PixelType::float32});
        const Product product = bake(params, inputs, context);
        const auto orm = std::ranges::find(product.images, "orm", &Image::name);
        ASSERT_NE(orm, product.images.end());
        for (int i = 0; i < kWidth * kHeight; i += 61) {
            const int x = i % kWidth, y = i / kWidth;
            const double u = (x + .5) / shrink - .5, v = (y + .5) / shrink - .5;
            const int left = static_cast<int>(std::floor(u)), top = static_cast<int>(std::floor(v));
            const double fx = u - left, fy = v - top;
            const double value = (1 - fy) * ((1 - fx) * stored(left, top) + fx * stored(left + 1, top)) +
                                 fy * ((1 - fx) * stored(left, top + 1) + fx * stored(left + 1, top + 1));
            ASSERT_NEAR(orm->texel(0, 0, y, x)[1], std::pow(2 / (1000 * value + 2), .25), 1e-6)
                << x << " " << y;
        }
    }
}

TEST(Gloss, MapsShowEnergyAndColourThatALobeCannotKeep) {
    TextureParams params = defaults();
    params.model = Model::blinn_phong;
    params.norm = Norm::none;
    params.calibrate = Calibrate::none;
    params.gloss_is = GlossIs::power;
    params.power_scale = 1000;
    params.maps = {ExtraMap::difference, ExtraMap::energy};
    Inputs inputs = set_with_alpha();
    inputs["specular"] = source(16, 16, 4, 0, [](int x, int) {
        return Rgba{1, 1, 1, x < 8 ? .002f : 1.f};  // exponents 2, which reflects 2.1, and 1000
    });
    const Baked baked = bake_set(params, inputs, PixelType::float32);
    EXPECT_GT(*baked.image("difference").texel(0, 0, 0, 0), .9f);
    EXPECT_LT(*baked.image("energy").texel(0, 0, 0, 0), .3f);
    EXPECT_LT(*baked.image("difference").texel(0, 0, 0, 15), .05f);
    EXPECT_NEAR(*baked.image("energy").texel(0, 0, 0, 15), .5, .01);
}

}  // namespace
}  // namespace pbrbake::texture::test
