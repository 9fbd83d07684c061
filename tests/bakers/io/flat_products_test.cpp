// 16-bit PNG and Radiance HDR products, read back through OpenImageIO.

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "tests/bakers/io/fixtures.hpp"

namespace pbrbake::io::test {
namespace {

Image picture(int width, int height, const std::vector<std::string>& channels) {
    Image image;
    image.channels = channels;
    Level level{width, height, {}};
    for (int i = 0; i < width * height * static_cast<int>(channels.size()); ++i)
        level.texels.push_back(static_cast<float>(std::fmod(i * .37, 1)));
    image.levels.push_back(std::move(level));
    return image;
}

ReadBack round_trip(const char* format, Image image, PixelType pixel, Image& quantised) {
    TempDir dir;
    std::vector<Image> images{std::move(image)};
    quantise(images, pixel);
    quantised = images[0];
    FileInfo info;
    info.pixel = pixel;
    write_file(dir / "a", encode(format, images[0], info));
    return read_product(dir / "a");
}

TEST(Png16, ReadsBackExactly) {
    for (const auto& channels : std::vector<std::vector<std::string>>{{"Y"}, {"R", "G"}, {"R", "G", "B"}}) {
        Image quantised;
        const ReadBack back = round_trip("png", picture(9, 5, channels), PixelType::unorm16, quantised);
        EXPECT_EQ(back.format, "png");
        EXPECT_EQ(back.info.pixel, PixelType::unorm16);
        const std::size_t stored = back.image.channels.size(), kept = channels.size();
        ASSERT_EQ(stored, kept == 1 ? 1u : 3u);
        for (std::size_t i = 0; i < 45; ++i)
            for (std::size_t c = 0; c < stored; ++c)
                EXPECT_NEAR(back.image.levels[0].texels[i * stored + c],
                            c < kept ? quantised.levels[0].texels[i * kept + c] : 0, 1e-7);
    }
}

TEST(EightBits, ReadBackExactlyInEveryContainer) {
    for (const char* format : {"png", "ktx2", "dds"})
        for (const Transfer transfer : {Transfer::linear, Transfer::srgb})
            for (const auto& channels :
                 std::vector<std::vector<std::string>>{{"R", "G", "B"}, {"R", "G", "B", "A"}}) {
                SCOPED_TRACE(format);
                Image image = picture(16, 16, channels), quantised;
                image.transfer = transfer;
                const ReadBack back = round_trip(format, image, PixelType::unorm8, quantised);
                EXPECT_EQ(back.info.pixel, PixelType::unorm8);
                EXPECT_EQ(back.image.transfer, transfer);
                const std::size_t kept = channels.size(), stored = back.image.channels.size();
                for (std::size_t i = 0; i < 256; ++i)
                    for (std::size_t c = 0; c < kept; ++c)
                        EXPECT_EQ(back.image.levels[0].texels[i * stored + c],
                                  quantised.levels[0].texels[i * kept + c]);
            }
}

TEST(EightBits, RoundToTheNearestCodeOfTheirOwnScale) {
    // Independent of the table: the standard's curve in long double, and alpha without it.
    const auto encoded = [](long double v) {
        return v <= .0031308L ? v * 12.92L : 1.055L * std::pow(v, 1 / 2.4L) - .055L;
    };
    Image image;
    image.channels = {"R", "G", "B", "A"};
    image.transfer = Transfer::srgb;
    Level level{1000, 1, {}};
    for (int i = 0; i < 4000; ++i) level.texels.push_back(static_cast<float>(i) / 3999);
    image.levels.push_back(level);
    std::vector<Image> images{image};
    EXPECT_EQ(quantise(images, PixelType::unorm8), 1);
    for (std::size_t i = 0; i < 4000; ++i) {
        const long double in = level.texels[i], out = images[0].levels[0].texels[i];
        if (i % 4 == 3) {
            EXPECT_LE(std::abs(out - in), .5L / 255 + 1e-7L);
            continue;
        }
        EXPECT_LE(std::abs(encoded(out) - encoded(in)), .5L / 255 + 1e-6L) << i;
    }
}

TEST(Hdr, ReadsBackExactlyCodedAndFlat) {
    for (const int width : {3, 8, 300}) {
        Image image = picture(width, 4, {"R", "G", "B"});
        for (int i = 0; i < width / 2 * 3; ++i)
            image.levels[0].texels[static_cast<std::size_t>(i)] = .25f;  // a long run
        image.levels[0].texels[1] = 3e6f;
        Image quantised;
        const ReadBack back = round_trip("hdr", image, PixelType::rgbe, quantised);
        EXPECT_EQ(back.format, "hdr");
        EXPECT_EQ(back.image.levels[0].texels, quantised.levels[0].texels);
    }
}

TEST(Hdr, RoundingKeepsMeansAndStaysWithinAStep) {
    Image image = picture(256, 1, {"Y"});
    for (float& value : image.levels[0].texels) value = .7031f;  // between two mantissas
    std::vector<Image> images{image};
    EXPECT_EQ(quantise(images, PixelType::rgbe), 1);
    const auto& texels = images[0].levels[0].texels;
    EXPECT_NEAR(std::accumulate(texels.begin(), texels.end(), 0.) / 256, .7031, .7031 * 5e-5);
    for (const float value : texels) EXPECT_NEAR(value, .7031, .7031 / 128);
}

TEST(FlatProducts, RefuseCubesAndLevels) {
    for (const char* format : {"png", "hdr"}) {
        FileInfo info;
        info.pixel = std::string(format) == "png" ? PixelType::unorm16 : PixelType::rgbe;
        EXPECT_THROW(encode(format, marked_image(4, 1, 6, {"R"}), info), Error);
        EXPECT_THROW(encode(format, marked_image(4, 2, 1, {"R"}), info), Error);
    }
}

}  // namespace
}  // namespace pbrbake::io::test
