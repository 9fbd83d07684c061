// quantise: rounding to the pixel type and the one power of two that makes everything fit.

#include <gtest/gtest.h>
#include <half.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "tests/bakers/io/fixtures.hpp"

namespace pbrbake::io::test {
namespace {

std::vector<Image> images_of(std::vector<std::vector<float>> rows) {
    std::vector<Image> images;
    for (std::vector<float>& row : rows) {
        Image image;
        image.channels = {"Y"};
        image.levels.push_back({static_cast<int>(row.size()), 1, std::move(row)});
        images.push_back(std::move(image));
    }
    return images;
}

const std::vector<float>& row(const std::vector<Image>& images, std::size_t i = 0) {
    return images[i].levels[0].texels;
}

TEST(Quantise, KeepsWhatHalfHolds) {
    auto images = images_of({{0, 1, .5f, 65504, -65504, 6.103515625e-5f}});
    const auto before = row(images);
    EXPECT_EQ(quantise(images, PixelType::half), 1);
    EXPECT_EQ(row(images), before);
}

TEST(Quantise, RoundsHalfToNearestEven) {
    auto images = images_of({{2049, 2051, 1.00048828125f}});
    EXPECT_EQ(quantise(images, PixelType::half), 1);
    EXPECT_EQ(row(images), (std::vector<float>{2048, 2052, 1}));
}

TEST(Quantise, RoundsAsImathDoesAtEveryExponent) {
    std::vector<float> values;
    for (std::uint32_t bits = 0; bits < 0x477fe000; bits += 997)  // up to 65,504
        for (const float sign : {1.f, -1.f}) values.push_back(sign * std::bit_cast<float>(bits));
    auto images = images_of({values});
    ASSERT_EQ(quantise(images, PixelType::half), 1);
    for (std::size_t i = 0; i < values.size(); ++i)
        ASSERT_EQ(std::bit_cast<std::uint32_t>(row(images)[i]),
                  std::bit_cast<std::uint32_t>(static_cast<float>(half(values[i]))))
            << values[i];
}

TEST(Quantise, ScalesOnlyWhenRoundingWouldOverflow) {
    auto below = images_of({{std::nextafter(65520.f, 0.f)}});
    EXPECT_EQ(quantise(below, PixelType::half), 1);
    EXPECT_EQ(row(below)[0], 65504.f);
    auto at = images_of({{65520.f}});
    EXPECT_EQ(quantise(at, PixelType::half), .5);
    EXPECT_EQ(row(at)[0], 32768.f);  // 32,760 lies halfway between halves 16 apart
}

TEST(Quantise, OneScaleForAllImages) {
    auto images = images_of({{1, 2}, {5e6f, 0}});
    const double scale = quantise(images, PixelType::half);
    EXPECT_EQ(scale, 1. / 128);
    EXPECT_EQ(row(images)[0], 1.f / 128);
    EXPECT_LE(row(images, 1)[0], 65504.f);
    EXPECT_NEAR(row(images, 1)[0] / scale, 5e6, 5e6 / 2048);
}

TEST(Quantise, FloatIsLeftAlone) {
    auto images = images_of({{3e38f, 1e-40f}});
    EXPECT_EQ(quantise(images, PixelType::float32), 1);
    EXPECT_EQ(row(images), (std::vector<float>{3e38f, 1e-40f}));
}

TEST(Quantise, UnormRoundsToItsStepsAndClipsBelowZero) {
    auto wide = images_of({{0, 1, -3}});
    EXPECT_EQ(quantise(wide, PixelType::unorm16), 1);
    EXPECT_EQ(row(wide), (std::vector<float>{0, 1, 0}));
    auto images = images_of({{0, 1, .5f}});
    EXPECT_EQ(quantise(images, PixelType::unorm8), 1);
    EXPECT_EQ(row(images), (std::vector<float>{0, 1, static_cast<float>(128 / 255.)}));
    auto large = images_of({{1.5f, .75f}});
    EXPECT_EQ(quantise(large, PixelType::unorm16), .5);
    EXPECT_NEAR(row(large)[0], .75, 1 / 131070.);
}

TEST(Quantise, NaNStaysNaN) {
    auto images = images_of({{std::numeric_limits<float>::quiet_NaN(), 1}});
    for (const PixelType pixel :
         {PixelType::half, PixelType::unorm16, PixelType::unorm8, PixelType::float32}) {
        EXPECT_EQ(quantise(images, pixel), 1);
        EXPECT_TRUE(std::isnan(row(images)[0]));
    }
}

}  // namespace
}  // namespace pbrbake::io::test
