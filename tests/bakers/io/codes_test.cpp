// Pictures read as the codes of their files, and what files say of their colours that isn't followed.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/bakers/io/fixtures.hpp"

namespace pbrbake::io::test {
namespace {

using testing::HasSubstr;

class CodedSource : public testing::Test {
  protected:
    SourceImage read(const std::string& name, const Buffer& bytes, bool as_codes,
                     const std::string& colour_space = "auto") {
        write_file(dir_ / name, bytes);
        return read_source({dir_ / name, colour_space, "lin_rec709", true, {}, as_codes});
    }

    /// Reads both ways; the codes stand for the floats.
    SourceImage read_both(const std::string& name, const Buffer& bytes,
                          const std::string& colour_space = "auto") {
        SCOPED_TRACE(name + " as " + colour_space);
        const SourceImage floats = read(name, bytes, false, colour_space),
                          codes = read(name, bytes, true, colour_space);
        const std::vector<float>& texels = floats.image.levels[0].texels;
        const std::size_t channels = floats.image.channels.size();
        EXPECT_EQ(codes.image.channels, floats.image.channels);
        EXPECT_EQ(codes.image.levels[0].width, floats.image.levels[0].width);
        EXPECT_EQ(codes.image.levels[0].height, floats.image.levels[0].height);
        EXPECT_EQ(codes.codes.size(), texels.size());
        EXPECT_TRUE(codes.image.levels[0].texels.empty());
        EXPECT_EQ(codes.colour_space, floats.colour_space);
        for (std::size_t i = 0; i < std::min(texels.size(), codes.codes.size()); ++i)
            EXPECT_NEAR(i % channels == 3 ? codes.codes[i] / 255.f : codes.linear[codes.codes[i]], texels[i],
                        2e-6)
                << i;
        return codes;
    }

    TempDir dir_;
};

Buffer bytes_of(std::initializer_list<int> values) {
    Buffer out;
    return put_bytes(out, values);
}

TEST_F(CodedSource, StandsForTheFloatsOfEveryEightBitFile) {
    read_both("a.tga", targa(3, 2, {10, 128, 250}, true));
    read_both("rgb.png", png(2, 1, 2, bytes_of({0, 1, 2, 253, 254, 255})));
    read_both("rgb.png", png(2, 1, 2, bytes_of({0, 1, 2, 253, 254, 255})), "raw");
    read_both("rgb.png", png(2, 1, 2, bytes_of({0, 1, 2, 253, 254, 255})), "g22_rec709");
    read_both("rgba.png", png(1, 1, 6, bytes_of({200, 100, 50, 7})));
    read_both("grey.jpg", grey_jpeg());
    read_both("turned.tif", tiff(2, 1, 1, bytes_of({1, 2, 3, 200, 100, 50}), 6));
}

TEST_F(CodedSource, PalettesAndGreyWithAlphaBecomeColours) {
    const SourceImage palette =
        read_both("p.png", png(2, 1, 3, bytes_of({1, 0}), bytes_of({9, 8, 7, 200, 100, 50})));
    EXPECT_THAT(palette.codes, testing::ElementsAre(200, 100, 50, 9, 8, 7));
    const SourceImage grey = read_both("la.png", png(2, 1, 4, bytes_of({90, 255, 40, 3})));
    EXPECT_THAT(grey.codes, testing::ElementsAre(90, 90, 90, 255, 40, 40, 40, 3));
    EXPECT_EQ(grey.image.channel_count(), 4);
    const SourceImage plain = read_both("l.png", png(1, 1, 0, bytes_of({90})));
    EXPECT_EQ(plain.image.channel_count(), 3);
}

TEST_F(CodedSource, WhatIsNoCodeStaysFloats) {
    const SourceImage deep = read("d.png", png(1, 1, 2, bytes_of({1, 0, 2, 0, 255, 255})), true, "raw");
    EXPECT_TRUE(deep.codes.empty());
    EXPECT_EQ(deep.bits, 16);
    EXPECT_NEAR(deep.image.levels[0].texels[0], 256 / 65535., 1e-7);
    // Channels of another gamut mix.
    const Buffer adobe = png(1, 1, 6, bytes_of({200, 100, 50, 128}));
    const SourceImage floats = read("a.png", adobe, false, "adobergb"),
                      mixed = read("a.png", adobe, true, "adobergb");
    EXPECT_TRUE(mixed.codes.empty());
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(mixed.image.levels[0].texels[i], floats.image.levels[0].texels[i], 2e-6);
}

TEST_F(CodedSource, GammaChunksAreBelieved) {
    Buffer gamma_1, gamma_22;
    put_be(gamma_1, 100000, 4);
    put_be(gamma_22, 45455, 4);
    const Buffer plain = png(1, 1, 0, bytes_of({128}));
    const SourceImage linear = read_both("g1.png", png_with(plain, "gAMA", gamma_1));
    EXPECT_EQ(linear.colour_space, "lin_rec709");
    EXPECT_THAT(linear.colour_doubt, testing::AllOf(HasSubstr("8-bit"), HasSubstr("colour_space")));
    EXPECT_EQ(read("g1.png", png_with(plain, "gAMA", gamma_1), true, "lin_rec709").colour_doubt, "");
    const SourceImage power = read_both("g22.png", png_with(plain, "gAMA", gamma_22));
    EXPECT_EQ(power.colour_space, "g22_rec709");
    EXPECT_EQ(power.colour_doubt, "");
    // Of 16 bits, linear codes are usual.
    const Buffer deep = png(1, 1, 0, bytes_of({128, 0}));
    EXPECT_EQ(read("g1.png", png_with(deep, "gAMA", gamma_1), true).colour_doubt, "");
}

TEST_F(CodedSource, ProfilesThatAreNotFollowedAreNamed) {
    const Buffer p3 = jpeg_with_icc(grey_jpeg(), icc_profile("Display P3")),
                 srgb = jpeg_with_icc(grey_jpeg(), icc_profile("sRGB IEC61966-2.1"));
    for (const bool as_codes : {false, true}) {
        EXPECT_THAT(read("p3.jpg", p3, as_codes).colour_doubt,
                    testing::AllOf(HasSubstr("ICC profile \"Display P3\""), HasSubstr("colour_space")));
        EXPECT_EQ(read("p3.jpg", p3, as_codes, "srgb").colour_doubt, "");
        EXPECT_EQ(read("srgb.jpg", srgb, as_codes).colour_doubt, "");
        EXPECT_FALSE(read("srgb.jpg", srgb, as_codes).colour_space_assumed);
        EXPECT_EQ(read("none.jpg", grey_jpeg(), as_codes).colour_doubt, "");
        EXPECT_TRUE(read("none.jpg", grey_jpeg(), as_codes).colour_space_assumed);
    }
}

}  // namespace
}  // namespace pbrbake::io::test
