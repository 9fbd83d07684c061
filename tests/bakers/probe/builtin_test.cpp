#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/io/io.hpp"
#include "pbr/ibl/environment.hpp"
#include "tests/bakers/probe/pictures.hpp"

namespace pbrbake::probe {
namespace {

TEST(Builtin, OutdoorSunHasItsIlluminanceAndLuminance) {
    const SourceImage source = builtin_environment("outdoor");
    const Level& level = source.image.levels[0];
    EXPECT_EQ(source.units, "cd/m^2");
    double lux = 0, peak = 0;
    const glm::dvec3 sun = pbr::equirect_direction(597.5 / 1024, 127.5 / 512);
    for (int y = 0; y < level.height; ++y)
        for (int x = 0; x < level.width; ++x) {
            const float* rgb = source.image.texel(0, 0, y, x);
            const double luminance = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
            peak = std::max(peak, luminance);
            const glm::dvec3 d = pbr::equirect_direction((x + 0.5) / level.width, (y + 0.5) / level.height);
            const double cosine = d.x * sun.x + d.y * sun.y + d.z * sun.z;
            if (luminance < 1e6) continue;  // the sun's texels alone
            lux += luminance * cosine * 2 * std::numbers::pi / level.width *
                   (std::cos(std::numbers::pi * y / level.height) -
                    std::cos(std::numbers::pi * (y + 1) / level.height));
        }
    EXPECT_NEAR(lux, 100'000, 200);      // 100 klx, and the sky behind the disk
    EXPECT_NEAR(peak, 1.472e9, 0.02e9);  // texels wholly inside the disk
}

TEST(Builtin, OutdoorBakesIntoHalfWithoutInfAndEqualsFloatAfterScaling) {
    ProbeParams params = defaults();
    params.size = 64;
    const Inputs inputs{{"source", builtin_environment("outdoor")}};
    const Product exact = bake_probe(params, inputs);
    Product half = exact;
    const double scale = io::quantise(half.images, PixelType::half);
    EXPECT_LT(scale, 1);
    EXPECT_EQ(std::exp2(std::round(std::log2(scale))), scale);  // a power of two
    for (std::size_t l = 0; l < exact.images[0].levels.size(); ++l)
        for (std::size_t i = 0; i < exact.images[0].levels[l].texels.size(); ++i) {
            const double stored = half.images[0].levels[l].texels[i],
                         value = exact.images[0].levels[l].texels[i] * scale;
            ASSERT_TRUE(std::isfinite(stored));
            ASSERT_LE(std::abs(stored - value),
                      std::max(value * 0x1p-11, 0x1p-25));  // half's rounding, subnormals included
        }
}

TEST(Builtin, UnknownNameSaysWhatThereIs) {
    try {
        builtin_environment("mars");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::unreadable_input);
        EXPECT_NE(error.message().find("builtin:outdoor"), std::string::npos);
    }
}

}  // namespace
}  // namespace pbrbake::probe
