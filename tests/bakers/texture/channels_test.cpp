// Which channels of files are read, and what becomes of numbers that no surface has.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/bakers/texture/fixtures.hpp"

namespace pbrbake::texture::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

SourceImage flat(const Rgba& value, int channels = 3, int bits = 0) {
    return source(16, 16, channels, bits, [&](int, int) { return value; });
}

/// A dielectric of grey paint.
Inputs paint() {
    Inputs inputs;
    inputs["diffuse"] = flat({.3f, .3f, .3f, 1});
    inputs["specular"] = flat({.04f, .04f, .04f, 1});
    return inputs;
}

/// One file for all: occlusion, opacity, metallic and specular in its channels.
TEST(Channels, OfAPackedPictureAreReadEach) {
    const Rgba packed{.25f, .5f, .05f, .75f};
    const std::array channels{Channel::automatic, Channel::r, Channel::g, Channel::b, Channel::a};
    for (const Channel channel : channels) {
        SCOPED_TRACE(enum_name(channel));
        const float expected =
            packed[channel == Channel::automatic ? 0 : static_cast<std::size_t>(index_of(channel))];
        TextureParams params = defaults();
        params.occlusion_channel = params.opacity_channel = channel;
        params.packing = Packing::separate;
        params.occlusion = params.opacity = "packed.png";
        Inputs inputs = paint();
        inputs["occlusion"] = inputs["opacity"] = flat(packed, 4);
        Baked baked = bake_set(params, inputs, PixelType::float32);
        EXPECT_FLOAT_EQ(*baked.image("occlusion").texel(0, 0, 0, 0), expected);
        EXPECT_FLOAT_EQ(baked.product.images[0].texel(0, 0, 0, 0)[3], expected);

        params = defaults();
        params.model = Model::metallic_roughness;
        params.metallic = "packed.png";
        params.metallic_channel = channel;
        inputs.clear();
        inputs["base_color"] = flat({.3f, .3f, .3f, 1});
        inputs["metallic"] = flat(packed, 4);
        baked = bake_set(params, inputs, PixelType::float32);
        EXPECT_FLOAT_EQ(baked.image("orm").texel(0, 0, 0, 0)[2], expected);
    }
}

TEST(Channels, OfSpecularAreGreyOneByOne) {
    Inputs floats = paint();
    floats["specular"] = flat({.02f, .06f, .1f, .2f}, 4, 8);
    Inputs codes = floats;
    codes["specular"] = coded(floats["specular"]);
    TextureParams params = defaults();
    params.packing = Packing::specular_gloss;
    params.gloss_in = GlossIn::none;
    for (const Channel channel : {Channel::r, Channel::g, Channel::b, Channel::a})
        for (const Inputs& inputs : {floats, codes}) {
            params.specular_channel = channel;
            const float expected = floats["specular"].image.texel(0, 0, 0, 0)[index_of(channel)];
            const Baked baked = bake_set(params, inputs, PixelType::float32);
            const float* f0 = baked.image("specular_gloss").texel(0, 0, 0, 0);
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(f0[c], expected, 1e-6);
        }
}

TEST(Channels, ThatAreStatedMustBeThere) {
    const auto expect_refusal = [](const TextureParams& params, const char* field) {
        Inputs inputs = paint();
        inputs[field] = flat({.5f, .5f, 1, 1});
        try {
            bake_set(params, inputs, PixelType::float32);
            ADD_FAILURE() << field;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr(std::string("the picture of ") + field + " has no alpha"));
        }
    };
    TextureParams params = defaults();
    params.occlusion_channel = params.opacity_channel = params.specular_channel = Channel::a;
    params.normal_in = NormalIn::ag;
    expect_refusal(params, "specular");
    params.specular_channel = Channel::automatic;
    for (const char* field : {"occlusion", "opacity", "normal"}) expect_refusal(params, field);
}

TEST(Channels, OpacityThatIsStatedButAbsentIsAWarning) {
    TextureParams params = defaults();
    params.alpha_is = AlphaIs::opacity;
    EXPECT_THAT(bake_set(params, paint(), PixelType::float32).product.warnings,
                Contains(HasSubstr("alpha of diffuse is absent")));
    Inputs inputs = paint();
    inputs["diffuse"] = flat({.3f, .3f, .3f, .5f}, 4);
    params.gloss_in = GlossIn::diffuse_alpha;
    EXPECT_THAT(bake_set(params, inputs, PixelType::float32).product.warnings,
                Contains(HasSubstr("alpha of diffuse is gloss")));
    params.gloss_in = GlossIn::none;
    EXPECT_THAT(bake_set(params, inputs, PixelType::float32).product.warnings,
                Not(Contains(HasSubstr("alpha_is"))));
    params.material = "paint";  // says it of all of its pictures
    EXPECT_THAT(bake_set(params, paint(), PixelType::float32).product.warnings,
                Not(Contains(HasSubstr("alpha_is"))));
}

/// Normals of length 1 whose z was left out, and what was put in its place.
TEST(Channels, NormalsOfTwoChannelsAreWhole) {
    const auto normal = [](int x, int y) {
        const float nx = static_cast<float>(x - 8) / 12, ny = static_cast<float>(y - 8) / 12;
        return std::array{nx, ny, std::sqrt(1 - nx * nx - ny * ny)};
    };
    for (const NormalIn in : {NormalIn::xyz, NormalIn::xy, NormalIn::ag}) {
        SCOPED_TRACE(enum_name(in));
        Inputs inputs = paint();
        inputs["normal"] = source(16, 16, 4, 0, [&](int x, int y) {
            const auto n = normal(x, y);
            const float u = n[0] * .5f + .5f, v = n[1] * .5f + .5f;
            if (in == NormalIn::xyz) return Rgba{u, v, n[2] * .5f + .5f, 1};
            return in == NormalIn::xy ? Rgba{u, v, 0, 1} : Rgba{v, v, v, u};
        });
        TextureParams params = defaults();
        params.normal_in = in;
        params.normal_green = Green::up;
        const Baked baked = bake_set(params, inputs, PixelType::float32);
        for (const auto& [x, y] : {std::pair(3, 12), {8, 8}, {15, 0}}) {
            const float* n = baked.image("normal").texel(0, 0, y, x);
            for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(n[c] * 2 - 1, normal(x, y)[c], 1e-5);
        }
        EXPECT_THAT(baked.product.warnings, Not(Contains(HasSubstr("normal_in"))));
        if (in != NormalIn::xy) continue;
        params.normal_in = NormalIn::xyz;
        EXPECT_THAT(bake_set(params, inputs, PixelType::float32).product.warnings,
                    Contains(HasSubstr("normal_in xy")));
    }
}

/// The interval of half(.04), 2^-16 to either side, has .04 in it: there is nothing to tell metal by.
TEST(Channels, HalvesAreIntervals) {
    for (const bool is_half : {false, true}) {
        Inputs inputs;
        inputs["diffuse"] = flat({0, 0, 0, 1});
        const float f0 = is_half ? .040008544921875f : .04f;
        inputs["specular"] = flat({f0, f0, f0, 1});
        inputs["diffuse"].is_half = inputs["specular"].is_half = is_half;
        TextureParams params = defaults();
        params.f0_tolerance = 0;
        params.maps = {ExtraMap::confidence};
        const Baked baked = bake_set(params, inputs, PixelType::float32);
        EXPECT_LT(baked.image("orm").texel(0, 0, 0, 0)[2], .02f) << is_half;
        EXPECT_LT(*baked.image("confidence").texel(0, 0, 0, 0), .02f) << is_half;
    }
}

TEST(Values, AboveOneAreCountedAndWarnedOf) {
    const auto warns = Contains(HasSubstr("diffuse or specular above 1"));
    for (const char* field : {"diffuse", "specular"}) {
        Inputs inputs = paint();
        inputs[field] = source(16, 16, 3, 0, [](int x, int) {
            return x < 4 ? Rgba{1.5f, .01f, .01f, 1} : Rgba{.01f, .01f, .01f, 1};
        });
        TextureParams params = defaults();
        Baked baked = bake_set(params, inputs, PixelType::float32);
        EXPECT_EQ(baked.set()["above_one"], .25);
        EXPECT_EQ(baked.set()["over_unity"], .25);
        EXPECT_THAT(baked.product.warnings, warns);
        params.diffuse_factor = params.specular_factor = {.5, .5, .5};
        baked = bake_set(params, inputs, PixelType::float32);
        EXPECT_EQ(baked.set()["above_one"], 0);
        EXPECT_THAT(baked.product.warnings, Not(warns));
    }
    Inputs inputs = paint();
    inputs["diffuse"] = coded(flat({.8f, .1f, .1f, 1}, 3, 8));
    TextureParams params = defaults();
    params.diffuse_factor = {2, 1, 1};
    EXPECT_EQ(bake_set(params, inputs, PixelType::float32).set()["above_one"], 1);
}

/// ks is no albedo: that of cos^1000 is .025.
TEST(Values, OfAPhongLobeMayBeAboveOne) {
    TextureParams params = defaults();
    params.model = Model::blinn_phong;
    params.norm = Norm::none;
    params.calibrate = Calibrate::none;
    params.power = 1000;
    Inputs inputs;
    inputs["diffuse"] = flat({0, 0, 0, 1});
    inputs["specular"] = flat({20, 20, 20, 1});
    const Baked baked = bake_set(params, inputs, PixelType::float32);
    EXPECT_EQ(baked.set()["above_one"], 0);
    EXPECT_EQ(baked.set()["f0_clamped"], 0);
    EXPECT_LT(baked.figure("energy_error"), .02);
}

TEST(Values, OfEmissionAboveOneAreWarnedOf) {
    TextureParams params = defaults();
    params.emissive = "glow.exr";
    Inputs inputs = paint();
    inputs["emissive"] = flat({4, 1, .5f, 1});
    EXPECT_THAT(bake_set(params, inputs, PixelType::float32).product.warnings,
                Contains(HasSubstr("emissive: 100 % of texels are above 1")));
    inputs["emissive"] = flat({1, 1, .5f, 1});
    EXPECT_THAT(bake_set(params, inputs, PixelType::float32).product.warnings,
                Not(Contains(HasSubstr("emissive"))));
}

}  // namespace
}  // namespace pbrbake::texture::test
