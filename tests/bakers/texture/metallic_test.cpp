// Sets that state metallic: to every packing, and to specular-gloss and back.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pbr/numerics/sequence.hpp"
#include "tests/bakers/texture/fixtures.hpp"

namespace pbrbake::texture::test {
namespace {

constexpr int kSize = 48;

TextureParams metallic_defaults() {
    TextureParams params = defaults();
    params.model = Model::metallic_roughness;
    params.diffuse = params.specular = "";
    params.base_color = "crate_base.png";
    params.metallic_roughness = "crate_orm.png";
    return params;
}

float random(int channel, int x, int y) {
    return static_cast<float>(
        pbr::random_unit(static_cast<std::uint64_t>(channel), static_cast<std::uint64_t>(y * kSize + x)));
}

/// Half of it metal or not, half of it anything; corners first.
float metallic_at(int x, int y) {
    if (y == 0) return static_cast<float>(x % 2);
    return y < kSize / 2 ? std::round(random(4, x, y)) : random(4, x, y);
}

Inputs metallic_set(int bits) {
    Inputs inputs;
    inputs["base_color"] = source(kSize, kSize, 3, bits, [](int x, int y) {
        if (y == 0) return Rgba{float(x & 2) / 2, float(x & 4) / 4, float(x & 8) / 8, 1};
        return Rgba{random(1, x, y), random(2, x, y), random(3, x, y), 1};
    });
    inputs["metallic_roughness"] = source(kSize, kSize, 3, 0, [](int x, int y) {
        const auto code = [](float v) { return std::round(v * 255) / 255; };
        return Rgba{.25f, code(random(5, x, y)), code(metallic_at(x, y)), 1};
    });
    return inputs;
}

float largest_difference(const Image& a, const Image& b) {
    float largest = 0;
    for (std::size_t i = 0; i < a.levels[0].texels.size(); ++i)
        largest = std::max(largest, std::abs(a.levels[0].texels[i] - b.levels[0].texels[i]));
    return largest;
}

TEST(MetallicSet, ReturnsAsItIsInItsOwnPacking) {
    const Inputs inputs = metallic_set(0);
    const Baked baked = bake_set(metallic_defaults(), inputs, PixelType::float32);
    EXPECT_LT(largest_difference(baked.image("base_color"), inputs.at("base_color").image), 1e-4);
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const float* before = inputs.at("metallic_roughness").image.texel(0, 0, y, x);
            const float* after = baked.image("orm").texel(0, 0, y, x);
            ASSERT_EQ(after[1], before[1]);
            ASSERT_EQ(after[2], before[2]);
        }
    EXPECT_LT(baked.figure("energy_error"), 1e-5);
    EXPECT_EQ(baked.set()["gloss"]["in"], "metallic_roughness.g");
    EXPECT_EQ(baked.set()["gloss"]["is"], "perceptual_roughness");
    EXPECT_TRUE(baked.product.warnings.empty());
}

TEST(MetallicSet, EightBitCodesReturn) {
    const Inputs inputs = metallic_set(8);
    const Baked baked = bake_set(metallic_defaults(), inputs, PixelType::unorm8);
    EXPECT_EQ(largest_difference(baked.image("base_color"), inputs.at("base_color").image), 0);
}

TEST(MetallicSet, EveryPackingKeepsItsLook) {
    const Inputs inputs = metallic_set(0);
    for (const Packing packing : {Packing::gltf, Packing::unity, Packing::unreal, Packing::frostbite,
                                  Packing::separate, Packing::specular_gloss}) {
        SCOPED_TRACE(enum_name(packing));
        TextureParams params = metallic_defaults();
        params.packing = packing;
        const Baked baked = bake_set(params, inputs, PixelType::float32);
        // Targets without coupling have no 1 - f0 in their diffuse: base colour shifts by up to 4 %.
        EXPECT_LT(baked.figure("energy_error"), 5e-3);
        EXPECT_LT(baked.figure("delta_e_mean"), .5);
    }
}

TEST(MetallicSet, MapsOfOneChannelAndUnityMasksAreRead) {
    TextureParams params = metallic_defaults();
    params.metallic_roughness = "";
    params.metallic = "crate_mask.png";
    params.gloss_in = GlossIn::metallic_alpha;
    params.gloss_is = GlossIs::smoothness;
    Inputs inputs = metallic_set(0);
    inputs.erase("metallic_roughness");
    inputs["metallic"] = source(kSize, kSize, 4, 0, [](int x, int y) {
        return Rgba{metallic_at(x, y), 0, 0, .75f};
    });
    const Baked baked = bake_set(params, inputs, PixelType::float32);
    EXPECT_EQ(baked.image("orm").texel(0, 0, 5, 5)[1], .25f);
    EXPECT_EQ(baked.image("orm").texel(0, 0, 0, 1)[2], 1);
    EXPECT_EQ(baked.image("orm").texel(0, 0, 0, 2)[2], 0);
}

/// Through files of the baker's own: metallic -> specular-gloss -> metallic.
TEST(MetallicSet, ReturnsThroughSpecularGloss) {
    for (const auto& [pixel, visible, metallic] :
         {std::tuple(PixelType::float32, 1e-4, 1e-3), std::tuple(PixelType::half, 2e-3, .02),
          std::tuple(PixelType::unorm16, 1e-4, .005)}) {
        SCOPED_TRACE(static_cast<int>(pixel));
        TextureParams there = metallic_defaults();
        there.packing = Packing::specular_gloss;
        const Inputs inputs = metallic_set(0);
        const Baked gloss = bake_set(there, inputs, pixel);
        EXPECT_LE(gloss.figure("f0_max_error"), visible);
        EXPECT_EQ(gloss.set()["images"]["specular_gloss"][3], "smoothness");
        Inputs legacy;
        for (const auto& [field, name] : {std::pair("diffuse", "diffuse"), {"specular", "specular_gloss"}}) {
            legacy[field].image = gloss.image(name);
            legacy[field].colour_space = "lin_rec709";
            legacy[field].bits = pixel == PixelType::unorm16 ? 16 : 0;
        }
        TextureParams back = defaults();
        back.f0_tolerance = 0;
        back.maps = {ExtraMap::confidence};
        const Baked baked = bake_set(back, legacy, PixelType::float32);
        EXPECT_LE(baked.figure("diffuse_max_error"), visible);
        EXPECT_LE(baked.figure("f0_max_error"), visible);
        double off = 0, count = 0;
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x) {
                if (*baked.image("confidence").texel(0, 0, y, x) < .5f) continue;
                const float before = std::round(metallic_at(x, y) * 255) / 255;
                off += static_cast<double>(std::abs(baked.image("orm").texel(0, 0, y, x)[2] - before));
                ++count;
            }
        EXPECT_GT(count, kSize * kSize * .8);
        EXPECT_LT(off / count, metallic);
    }
}

TEST(MetallicSet, BelievesItsMaskAndNoStatedSurface) {
    TextureParams params = metallic_defaults();
    params.surface = SurfaceIs::any;
    EXPECT_TRUE(check(params, "png").empty());
    params.surface = SurfaceIs::metal;
    ASSERT_EQ(check(params, "png").size(), 1u);
    EXPECT_EQ(check(params, "png").front().pointer, "/surface");
    params.source = "scene.mtl";  // whose other materials may have no mask
    EXPECT_TRUE(check(params, "png").empty());
    const Baked baked = bake_set(params, metallic_set(0), PixelType::float32);
    EXPECT_EQ(baked.image("orm").texel(0, 0, 0, 2)[2], 0);
    EXPECT_EQ(std::ranges::count_if(baked.product.warnings,
                                    [](const std::string& text) { return text.starts_with("surface: "); }),
              1);
}

TEST(MetallicSet, MapsOfOtherModelsAreMistakes) {
    TextureParams params = metallic_defaults();
    EXPECT_TRUE(check(params, "png").empty());
    params.specular = "s.png";
    EXPECT_EQ(check(params, "png").front().pointer, "/specular");
    params = metallic_defaults();
    params.metallic = "m.png";
    EXPECT_EQ(check(params, "png").front().pointer, "/metallic_roughness");
    params = metallic_defaults();
    params.base_color = params.metallic_roughness = "";
    EXPECT_EQ(check(params, "png").front().pointer, "/base_color");
    params = defaults();
    params.base_color = "b.png";
    EXPECT_EQ(check(params, "png").front().pointer, "/base_color");
}

}  // namespace
}  // namespace pbrbake::texture::test
