// Smaller levels: means of what is reflected, by strips of rows.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/bakers/texture/fixtures.hpp"

namespace pbrbake::texture::test {
namespace {

TEST(TextureLevels, LevelsKeepMeansAndTurnBumpsIntoRoughness) {
    TextureParams params = defaults();
    params.normal = "set_n.png";
    params.levels = 0;
    params.normal_green = Green::up;
    Inputs inputs;
    inputs["diffuse"] = source(16, 16, 3, 0, [](int x, int) {
        return x % 2 ? Rgba{.8f, .1f, .1f, 1} : Rgba{.2f, .5f, .1f, 1};
    });
    inputs["specular"] = source(16, 16, 4, 0, [](int, int y) {
        return Rgba{.04f, .04f, .04f, y < 8 ? .9f : .901f};
    });
    inputs["normal"] = source(16, 16, 3, 0, [](int x, int) {
        const float tilt = x % 2 ? .3f : -.3f, z = std::sqrt(1 - tilt * tilt);
        return Rgba{tilt * .5f + .5f, .5f, z * .5f + .5f, 1};
    });
    const Baked baked = bake_set(params, inputs, PixelType::float32);
    const Image& base = baked.image("base_color");
    EXPECT_NEAR(base.texel(4, 0, 0, 0)[0], .5, 1e-4);
    EXPECT_NEAR(base.texel(4, 0, 0, 0)[1], .3, 1e-4);
    const double slope2 = .09 / .91,
                 alpha = std::sqrt(1e-4 + slope2);  // variance along x alone, alpha^2 + 2 s^2 / 2
    EXPECT_NEAR(baked.image("orm").texel(1, 0, 0, 0)[1], std::sqrt(alpha), 2e-3);
    EXPECT_NEAR(baked.image("normal").texel(4, 0, 0, 0)[2], 1, 1e-5);
}

/// The largest level is converted by strips; what a strip holds must not show.
TEST(TextureLevels, StripsDoNotShow) {
    TextureParams params = defaults();
    params.levels = 0;
    const Rgba grey{.3f, .2f, .1f, 1};
    for (const auto& [width, height] : {std::pair(1, 301), std::pair(3000, 67), std::pair(301, 1)}) {
        SCOPED_TRACE(width);
        Inputs inputs;
        inputs["diffuse"] = source(width, height, 3, 0, [&](int, int) { return grey; });
        inputs["specular"] = source(width, height, 4, 0, [](int, int) {
            return Rgba{.06f, .06f, .06f, .5f};
        });
        const Baked baked = bake_set(params, inputs, PixelType::float32, 3);
        for (const Image& image : baked.product.images)
            for (const Level& level : image.levels)
                for (std::size_t i = 0; i < level.texels.size(); ++i)
                    ASSERT_NEAR(level.texels[i], level.texels[i % image.channels.size()], 1e-5) << image.name;
    }
}

/// Rows of odd levels are shared between strips; each level is the box filter of the one above.
TEST(TextureLevels, LevelsOfManyStripsAreMeansOfTheOneAbove) {
    TextureParams params = defaults();
    params.levels = 0;
    constexpr int kHeight = 303;
    const auto value = [](int y) { return .5f + .4f * std::sin(static_cast<float>(y * y)); };
    Inputs inputs;
    inputs["diffuse"] = source(2, kHeight, 3, 0, [&](int, int y) {
        return Rgba{value(y), .5f, value(y), 1};
    });
    inputs["specular"] = source(2, kHeight, 4, 0, [](int, int) { return Rgba{.04f, .04f, .04f, .5f}; });
    const Baked baked = bake_set(params, inputs, PixelType::float32, 2);
    const Image& base = baked.image("base_color");
    for (std::size_t l = 1; l < base.levels.size(); ++l) {
        const int above = base.levels[l - 1].height, height = base.levels[l].height;
        for (int y = 0; y < height; ++y) {
            double sum = 0;
            for (int row = 0; row < above; ++row) {
                const double begin = std::max<double>(row, static_cast<double>(y) * above / height),
                             end = std::min<double>(row + 1, static_cast<double>(y + 1) * above / height);
                if (end > begin)
                    sum += (end - begin) *
                           static_cast<double>(base.texel(static_cast<int>(l) - 1, 0, row, 0)[0]);
            }
            ASSERT_NEAR(base.texel(static_cast<int>(l), 0, y, 0)[0], sum * height / above, 1e-5)
                << l << " " << y;
        }
    }
}

/// Where levels mix metal with dielectric, what is left for dielectric f0 is far above the set's unit; floats
/// hold it.
TEST(TextureLevels, FloatLevelsKeepMeanF0OfMetalBesideDielectric) {
    TextureParams params = defaults();
    params.levels = 0;
    const auto is_metal = [](int x, int y) { return (x * 7 + y * 3) % 5 < 2; };
    Inputs inputs;
    inputs["diffuse"] = source(17, 9, 3, 0, [&](int x, int y) {
        return is_metal(x, y) ? Rgba{0, 0, 0, 1} : Rgba{.5f, .3f, .2f, 1};
    });
    inputs["specular"] = source(17, 9, 3, 0, [&](int x, int y) {
        return is_metal(x, y) ? Rgba{.9f, .7f, .4f, 1} : Rgba{.04f, .04f, .04f, 1};
    });
    const Baked baked = bake_set(params, inputs, PixelType::float32);
    const double unit = baked.set()["dielectric_f0_unit"];
    const auto f0 = [&](int level, int x, int y) {
        const double m = baked.image("orm").texel(level, 0, y, x)[2],
                     base = baked.image("base_color").texel(level, 0, y, x)[0],
                     dielectric = baked.image("specular").texel(level, 0, y, x)[0] * unit;
        return dielectric * (1 - m) + base * m;
    };
    double mean = 0;
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 17; ++x) mean += f0(0, x, y) / (17 * 9);
    EXPECT_NEAR(f0(4, 0, 0), mean, 1e-4);
}

TEST(TextureLevels, WhatIsTransparentDoesNotDarkenLevels) {
    TextureParams params = defaults();
    params.levels = 0;
    params.alpha_is = AlphaIs::opacity;
    Inputs inputs;
    inputs["diffuse"] = source(8, 8, 4, 0, [](int x, int y) {
        return y < 4 ? Rgba{.5f, .5f, .5f, 0} : x % 2 ? Rgba{.2f, .6f, .1f, 1} : Rgba{0, 0, 0, 0};
    });
    inputs["specular"] = source(8, 8, 3, 0, [](int, int) { return Rgba{.04f, .04f, .04f, 1}; });
    const Image base = bake_set(params, inputs, PixelType::float32).image("base_color");
    EXPECT_NEAR(base.texel(1, 0, 3, 0)[1], .6, 1e-5);
    EXPECT_NEAR(base.texel(1, 0, 3, 0)[3], .5, 1e-6);
    EXPECT_NEAR(base.texel(1, 0, 0, 0)[1], .5, 1e-5);  // nothing is seen: as if all were
    EXPECT_NEAR(base.texel(1, 0, 0, 0)[3], 0, 1e-6);
    EXPECT_NEAR(base.texel(3, 0, 0, 0)[1], .6, 1e-4);
    EXPECT_NEAR(base.texel(3, 0, 0, 0)[3], .25, 1e-6);
}

}  // namespace
}  // namespace pbrbake::texture::test
