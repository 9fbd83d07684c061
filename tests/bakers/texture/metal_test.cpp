// Texels in which materials mix: edges of rust and paint on metal.

#include <gtest/gtest.h>

#include <array>

#include "bakers/texture/maps.hpp"
#include "pbr/legacy/specular_gloss.hpp"
#include "pbr/numerics/sequence.hpp"
#include "tests/bakers/texture/fixtures.hpp"

namespace pbrbake::texture::test {
namespace {

/// f0 of a metal beside what reflects diffusely.
struct Pair {
    Colour metal, diffuse;
};

constexpr std::array<Pair, 6> kPairs{{
    {{.56f, .57f, .58f}, {.3f, .1f, .03f}},   // steel, rust
    {{.56f, .57f, .58f}, {.02f, .05f, .4f}},  // steel, blue paint
    {{.91f, .92f, .92f}, {.5f, .02f, .02f}},  // aluminium, red paint
    {{1.f, .77f, .34f}, {.05f, .3f, .1f}},    // gold, enamel
    {{.95f, .64f, .54f}, {.1f, .4f, .35f}},   // copper, verdigris
    {{.25f, .25f, .25f}, {.8f, .75f, .1f}},   // dark metal, bright paint
}};

/// Rows of each pair, its share of metal rising along x, with noise where `noise` is above 0.
pbr::Reflected<float> mixed(int x, int y, int size, float noise) {
    const Pair& pair = kPairs[static_cast<std::size_t>(y) * kPairs.size() / static_cast<std::size_t>(size)];
    const auto random = static_cast<float>(pbr::random_unit(3, static_cast<std::uint64_t>(y * size + x)));
    const float share =
        std::clamp(static_cast<float>(x) / static_cast<float>(size - 1) + noise * (random - .5f), 0.f, 1.f);
    return {pair.diffuse * (1 - share), Colour(.04f) * (1 - share) + pair.metal * share};
}

Inputs mixed_set(int size, int bits, float noise) {
    const auto reflected = [=](int x, int y) { return mixed(x, y, size, noise); };
    Inputs inputs;
    inputs["diffuse"] = source(size, size, 3, bits, [=](int x, int y) {
        const auto d = pbr::diffuse_colour(reflected(x, y), pbr::DiffuseCoupling::fresnel);
        return Rgba{d.x, d.y, d.z, 1};
    });
    inputs["specular"] = source(size, size, 4, bits, [=](int x, int y) {
        const auto s = reflected(x, y).f0;
        return Rgba{s.x, s.y, s.z, .7f};
    });
    return inputs;
}

TEST(MixedTexels, KeepDiffuseAndF0) {
    for (const auto& [bits, pixel, largest] :
         {std::tuple(0, PixelType::float32, 1e-4), std::tuple(16, PixelType::float32, 1e-4),
          std::tuple(8, PixelType::float32, 1. / 255)})
        for (const bool regularise : {false, true})
            for (const float noise : {0.f, .5f})
                for (const double tolerance : {0., .02}) {
                    TextureParams params = defaults();
                    params.regularise = regularise;
                    params.f0_tolerance = tolerance;
                    const Baked baked = bake_set(params, mixed_set(96, bits, noise), pixel);
                    EXPECT_LE(baked.figure("diffuse_max_error"), largest)
                        << bits << regularise << noise << tolerance;
                    EXPECT_LE(baked.figure("f0_max_error"), largest)
                        << bits << regularise << noise << tolerance;
                }
}

/// Means of metallic may have no material either.
TEST(MixedTexels, KeepDiffuseAndF0AtSmallerLevels) {
    constexpr int kSize = 64;
    TextureParams params = defaults();
    params.levels = 0;
    const Baked baked = bake_set(params, mixed_set(kSize, 0, .5f), PixelType::float32);
    const float unit = baked.set()["dielectric_f0_unit"].get<float>();
    for (int level = 1; level <= 4; ++level) {
        const int step = 1 << level, size = kSize / step;
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                pbr::Reflected<float> mean{Colour(0), Colour(0)};
                for (int i = 0; i < step * step; ++i) {
                    const auto texel = mixed(x * step + i % step, y * step + i / step, kSize, .5f);
                    mean.diffuse += texel.diffuse / static_cast<float>(step * step);
                    mean.f0 += texel.f0 / static_cast<float>(step * step);
                }
                const auto colour = [&](const char* image) {
                    const float* texel = baked.image(image).texel(level, 0, y, x);
                    return Colour(texel[0], texel[1], texel[2]);
                };
                const auto back = pbr::reflected_from_metallic<float>(
                    {colour("base_color"), colour("orm").z, colour("specular") * unit},
                    pbr::DiffuseCoupling::fresnel);
                for (int c = 0; c < 3; ++c) {
                    EXPECT_NEAR(back.diffuse[c], mean.diffuse[c], 1e-4) << level << " " << x << " " << y;
                    EXPECT_NEAR(back.f0[c], mean.f0[c], 1e-4) << level << " " << x << " " << y;
                }
            }
    }
}

}  // namespace
}  // namespace pbrbake::texture::test
