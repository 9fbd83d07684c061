// Gloss at its end, where alpha squared is below what half floats hold.

#include <gtest/gtest.h>

#include "tests/bakers/texture/fixtures.hpp"

namespace pbrbake::texture::test {
namespace {

/// Smoothness 1 is a mirror, and 254/255 a perceptual roughness of 1/255, alpha (1/255)^2, whose square
/// is 2.4e-10: at every level, in every pixel type, by both certificates.
TEST(TextureHardCases, MirrorsAndTheCodeBesideThemStayWhatTheyAre) {
    for (const PixelType pixel : {PixelType::half, PixelType::float32, PixelType::unorm8})
        for (const double smoothness : {1., 254. / 255}) {
            TextureParams params = defaults();
            params.levels = 0;
            params.normal = "set_n.png";
            params.gloss_in = GlossIn::specular_alpha;
            params.gloss_is = GlossIs::smoothness;
            Inputs inputs;
            inputs["diffuse"] = source(8, 8, 3, 8, [](int, int) { return Rgba{.2f, .2f, .2f, 1}; });
            inputs["specular"] = source(8, 8, 4, 8, [&](int, int) {
                return Rgba{.04f, .04f, .04f, static_cast<float>(smoothness)};
            });
            inputs["normal"] = source(8, 8, 3, 0, [](int, int) { return Rgba{.5f, .5f, 1, 1}; });
            const Baked baked = bake_set(params, inputs, pixel);
            const double right = 1 - smoothness, step = pixel == PixelType::unorm8 ? 1e-7 : 2e-6;
            for (int level = 0; level < 4; ++level)
                EXPECT_NEAR(baked.image("orm").texel(level, 0, 0, 0)[1], right, step) << level;
            EXPECT_LT(baked.figure("energy_error"), .01);
        }
}

/// Beside a mirror the lobe's variance is the mean of both: alpha^2 of the level is half of the rough
/// texel's.
TEST(TextureHardCases, LevelsOfMirrorsAverageVariance) {
    TextureParams params = defaults();
    params.levels = 0;
    Inputs inputs;
    inputs["diffuse"] = source(2, 2, 3, 0, [](int, int) { return Rgba{.2f, .2f, .2f, 1}; });
    inputs["specular"] = source(2, 2, 4, 0, [](int x, int) {
        return Rgba{.04f, .04f, .04f, x == 0 ? 1.f : .5f};
    });
    const Baked baked = bake_set(params, inputs, PixelType::float32);
    const double alpha = .25;
    EXPECT_NEAR(baked.image("orm").texel(1, 0, 0, 0)[1], std::sqrt(std::sqrt(alpha * alpha / 2)), 1e-6);
}

}  // namespace
}  // namespace pbrbake::texture::test
