// HDR, PNG, TIFF, TGA and JPEG sources: known texels, what the file tells of its colours, and what it may
// claim.

#include <gtest/gtest.h>

#include <bit>
#include <chrono>
#include <cmath>

#include "tests/bakers/io/fixtures.hpp"

namespace pbrbake::io::test {
namespace {

/// IEC 61966-2-1, equations 5 and 6.
double srgb_to_linear(double v) { return v <= .04045 ? v / 12.92 : std::pow((v + .055) / 1.055, 2.4); }

class ForeignSource : public testing::Test {
  protected:
    SourceImage read(const std::string& name, const Buffer& bytes, const std::string& colour_space = "auto") {
        write_file(dir_ / name, bytes);
        return read_source({dir_ / name, colour_space});
    }
    std::string refusal(const std::string& name, const Buffer& bytes, ReadLimits limits = {}) {
        write_file(dir_ / name, bytes);
        ReadRequest request{dir_ / name};
        request.limits = limits;
        std::string message;
        EXPECT_EQ(code_of_reading(request, &message), 4);
        return message;
    }
    TempDir dir_;
};

void expect_texel(const SourceImage& source, int x, int y, double r, double g, double b, double tolerance) {
    const float* texel = source.image.texel(0, 0, y, x);
    EXPECT_NEAR(texel[0], r, tolerance) << "at " << x << ", " << y;
    EXPECT_NEAR(texel[1], g, tolerance) << "at " << x << ", " << y;
    EXPECT_NEAR(texel[2], b, tolerance) << "at " << x << ", " << y;
}

TEST_F(ForeignSource, ReadsFlatRgbe) {
    const SourceImage source = read("a.hdr", flat_hdr(4, 2, {128, 64, 32, 129}));
    ASSERT_EQ(source.image.levels.at(0).width, 4);
    ASSERT_EQ(source.image.levels.at(0).height, 2);
    EXPECT_EQ(source.image.faces, 1);
    EXPECT_EQ(source.image.channels, (std::vector<std::string>{"R", "G", "B"}));
    expect_texel(source, 3, 1, 1, .5, .25, 0);
    EXPECT_EQ(source.colour_space, "lin_rec709");
    EXPECT_TRUE(source.colour_space_assumed);
    EXPECT_EQ(source.units, "relative");
}

TEST_F(ForeignSource, ReadsCodedRgbe) {
    const SourceImage source = read("a.hdr", coded_hdr(64, 32, {255, 128, 1, 140}));
    expect_texel(source, 63, 31, 255 * 16, 128 * 16, 16, 0);
}

TEST_F(ForeignSource, ReadsEightBitTiffAsSrgb) {
    Buffer samples;
    for (int i = 0; i < 2; ++i) put_bytes(samples, {255, 188, 10, 0, 0, 0});
    const SourceImage source = read("a.tif", tiff(2, 2, 1, samples));
    expect_texel(source, 0, 1, 1, srgb_to_linear(188 / 255.), srgb_to_linear(10 / 255.), 1e-6);
    EXPECT_EQ(source.colour_space, "srgb");
    EXPECT_TRUE(source.colour_space_assumed);
}

TEST_F(ForeignSource, ReadsSixteenBitTiffRaw) {
    Buffer samples;
    for (const int value : {65535, 32768, 1}) put_le(samples, static_cast<std::uint64_t>(value), 2);
    const SourceImage source = read("a.tif", tiff(1, 1, 2, samples), "raw");
    expect_texel(source, 0, 0, 1, 32768 / 65535., 1 / 65535., 1e-7);
    EXPECT_EQ(source.colour_space, "raw");
    EXPECT_FALSE(source.colour_space_assumed);
}

TEST_F(ForeignSource, ReadsFloatTiffAsLinear) {
    const SourceImage source = read("a.tiff", tiff(2, 1, 4, float_samples({1e9f, .5f, 0, 1, 2, 3})));
    expect_texel(source, 0, 0, 1e9, .5, 0, 0);
    expect_texel(source, 1, 0, 1, 2, 3, 0);
    EXPECT_EQ(source.colour_space, "lin_rec709");
}

TEST_F(ForeignSource, ReadsTargaPlainAndCoded) {
    const SourceImage plain = read("a.tga", targa(2, 2, {255, 128, 0, 0, 0, 255}, false));
    expect_texel(plain, 0, 0, 1, srgb_to_linear(128 / 255.), 0, 1e-6);
    expect_texel(plain, 1, 1, 0, 0, 1, 1e-6);
    const SourceImage coded = read("b.tga", targa(100, 3, {255, 0, 255}, true));
    expect_texel(coded, 99, 2, 1, 0, 1, 1e-6);
    EXPECT_TRUE(coded.colour_space_assumed);
}

TEST_F(ForeignSource, ReadsGreyJpegAsRgb) {
    const SourceImage source = read("a.jpg", grey_jpeg());
    ASSERT_EQ(source.image.levels.at(0).width, 8);
    const double linear = srgb_to_linear(192 / 255.);
    expect_texel(source, 5, 5, linear, linear, linear, 1e-6);
}

TEST_F(ForeignSource, ReadsPngAndKnowsItByItsBytes) {
    const Buffer png = encode_png8(2, 1, {255, 0, 51, 1, 2, 3});
    const SourceImage source = read("misnamed.jpg", png);
    expect_texel(source, 0, 0, 1, 0, srgb_to_linear(.2), 1e-6);
    expect_texel(source, 1, 0, srgb_to_linear(1 / 255.), srgb_to_linear(2 / 255.), srgb_to_linear(3 / 255.),
                 1e-6);
}

TEST_F(ForeignSource, BelievesColourChunksOfPng) {
    const Buffer png = encode_png8(1, 1, {128, 128, 128});
    Buffer intent;
    put_bytes(intent, {0});
    const SourceImage srgb = read("s.png", png_with(png, "sRGB", intent));
    EXPECT_EQ(srgb.colour_space, "srgb");
    EXPECT_FALSE(srgb.colour_space_assumed);

    Buffer gamma;
    const SourceImage g22 = read("g.png", png_with(png, "gAMA", put_be(gamma, 45455, 4)));
    EXPECT_EQ(g22.colour_space, "g22_rec709");
    EXPECT_FALSE(g22.colour_space_assumed);
    EXPECT_NEAR(*g22.image.texel(0, 0, 0, 0), std::pow(128 / 255., 1 / .45455), 1e-6);

    Buffer linear;
    const SourceImage lin = read("l.png", png_with(png, "gAMA", put_be(linear, 100000, 4)));
    EXPECT_EQ(lin.colour_space, "lin_rec709");
    EXPECT_NEAR(*lin.image.texel(0, 0, 0, 0), 128 / 255., 1e-7);

    Buffer wide;
    for (const std::uint64_t xy : {31270, 32900, 68000, 32000, 26500, 69000, 15000, 6000})
        put_be(wide, xy, 4);
    Buffer gamma_two;
    const Buffer with_gamma = png_with(png, "gAMA", put_be(gamma_two, 50000, 4));
    const SourceImage p3 = read("p.png", png_with(with_gamma, "cHRM", wide, false));
    EXPECT_EQ(p3.colour_space, "g2_p3d65");
    EXPECT_NEAR(*p3.image.texel(0, 0, 0, 0), std::pow(128 / 255., 2), 1e-5);  // grey stays grey

    const SourceImage silent = read("n.png", png_with(png, "", {}));
    EXPECT_EQ(silent.colour_space, "srgb");
    EXPECT_TRUE(silent.colour_space_assumed);
}

TEST_F(ForeignSource, JobOverrulesFile) {
    Buffer intent;
    put_bytes(intent, {0});
    const Buffer png = png_with(encode_png8(1, 1, {128, 128, 128}), "sRGB", intent);
    const SourceImage source = read("a.png", png, "lin_rec709");
    EXPECT_EQ(source.colour_space, "lin_rec709");
    EXPECT_FALSE(source.colour_space_assumed);
    EXPECT_NEAR(*source.image.texel(0, 0, 0, 0), 128 / 255., 1e-7);
}

TEST_F(ForeignSource, TurnsPicturesUprightAsExifSays) {
    // Stored: row 0 is 1 2 3, row 1 is 4 5 6. Exif 2.32, 4.6.4 A: where row 0 and column 0 are shown.
    std::vector<float> stored;
    for (int i = 1; i <= 6; ++i) stored.insert(stored.end(), 3, static_cast<float>(i));
    const std::vector<std::vector<float>> shown{{1, 2, 3, 4, 5, 6}, {3, 2, 1, 6, 5, 4}, {6, 5, 4, 3, 2, 1},
                                                {4, 5, 6, 1, 2, 3}, {1, 4, 2, 5, 3, 6}, {4, 1, 5, 2, 6, 3},
                                                {6, 3, 5, 2, 4, 1}, {3, 6, 2, 5, 1, 4}};
    for (int orientation = 1; orientation <= 8; ++orientation) {
        SCOPED_TRACE(orientation);
        const SourceImage source = read("a.tif", tiff(3, 2, 4, float_samples(stored), orientation));
        EXPECT_EQ(source.image.levels[0].width, orientation < 5 ? 3 : 2);
        std::vector<float> red;
        for (std::size_t i = 0; i < 6; ++i) red.push_back(source.image.levels[0].texels[3 * i]);
        EXPECT_EQ(red, shown[static_cast<std::size_t>(orientation - 1)]);
    }
}

TEST_F(ForeignSource, AbsentModuleIsNamedWithWhereItWasLookedFor) {
    // A copy of this program in a tree without modules, asked to read an HDR.
    std::filesystem::create_directories(dir_ / "bin");
    std::filesystem::copy_file("/proc/self/exe", dir_ / "bin/tests");
    int status = 0;
    std::string command = (dir_ / "bin/tests").string();
    command += " --gtest_filter=ForeignSource.ReadsFlatRgbe";
    const std::string output = run_program(command, status);
    if (status == 0) GTEST_SKIP() << "the modules are installed, so none is absent";
    EXPECT_NE(output.find((dir_ / "lib/pbrbake/pbrbake_oiio.so").string()), std::string::npos) << output;
    EXPECT_NE(output.find("needed to read HDR"), std::string::npos) << output;
}

TEST_F(ForeignSource, HashIsOfTheFile) {
    const Buffer bytes = flat_hdr(4, 2, {128, 64, 32, 129});
    EXPECT_EQ(read("a.hdr", bytes).hash, hash_bytes(bytes.data(), bytes.size()));
    EXPECT_EQ(read("a.hdr", bytes).hash, hash_file(dir_ / "a.hdr"));
}

TEST_F(ForeignSource, RefusesHeaderOnlyHdrQuickly) {
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_NE(refusal("a.hdr", hdr_header(200000, 200000)).find("65536 a side"), std::string::npos);
    ReadLimits wide;
    wide.max_side = 1 << 30;
    EXPECT_NE(refusal("a.hdr", hdr_header(200000, 200000), wide).find("the limit is 4294967296"),
              std::string::npos);
    wide.max_decoded_bytes = std::uint64_t{1} << 50;
    EXPECT_NE(refusal("a.hdr", hdr_header(200000, 200000), wide).find("can't hold"), std::string::npos);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
}

TEST_F(ForeignSource, RefusesTargaThatClaimsMoreThanItHas) {
    Buffer header;
    put_bytes(header, {0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xFF, 0x3F, 0xFF, 0x3F, 24, 0x20});
    EXPECT_NE(refusal("a.tga", header).find("can't hold"), std::string::npos);
}

TEST_F(ForeignSource, AcceptsPicturesThatCompressWell) {
    const std::vector<std::uint8_t> black(std::size_t{2048} * 1024 * 3, 0);
    const SourceImage source = read("black.png", encode_png8(2048, 1024, black));
    expect_texel(source, 2047, 1023, 0, 0, 0, 0);
    const SourceImage dark = read("black.hdr", coded_hdr(127, 64, {0, 0, 0, 0}));
    expect_texel(dark, 126, 63, 0, 0, 0, 0);
}

TEST_F(ForeignSource, RefusesWhatItDoesNotKnow) {
    Buffer text;
    put_text(text, "hello, this is no picture");
    EXPECT_NE(refusal("a.txt", text).find("EXR, HDR"), std::string::npos);
    EXPECT_NE(refusal("empty.hdr", {}).find("is empty"), std::string::npos);
    std::string message;
    EXPECT_EQ(code_of_reading({dir_ / "absent.exr"}, &message), 4);
    EXPECT_NE(message.find("absent.exr"), std::string::npos);
    EXPECT_EQ(code_of_reading({dir_ / "."}, &message), 4);
}

TEST_F(ForeignSource, RefusesUnknownColourSpacesByName) {
    write_file(dir_ / "a.hdr", flat_hdr(1, 1, {128, 128, 128, 129}));
    std::string message;
    EXPECT_EQ(code_of_reading({dir_ / "a.hdr", "sepia"}, &message), 3);
    EXPECT_NE(message.find("lin_rec709"), std::string::npos);
    EXPECT_EQ(code_of_reading({dir_ / "a.hdr", "auto", "sepia"}, &message), 3);
}

TEST_F(ForeignSource, KeepsAlphaWhereItIsAskedFor) {
    Image image;
    image.channels = {"R", "G", "B", "A"};
    image.transfer = Transfer::srgb;
    image.levels.push_back({2, 1, {1, .5f, 0, .25f, .1f, .2f, .3f, 0}});
    std::vector<Image> images{image};
    quantise(images, PixelType::unorm8);
    FileInfo info;
    info.pixel = PixelType::unorm8;
    TempDir dir;
    write_file(dir / "a.png", encode("png", images[0], info));
    ReadRequest request{dir / "a.png"};
    EXPECT_EQ(read_source(request).image.channels.size(), 3u);
    request.with_alpha = true;
    const SourceImage source = read_source(request);
    EXPECT_EQ(source.bits, 8);
    EXPECT_EQ(source.image.channels, image.channels);
    for (std::size_t i = 0; i < 8; ++i)  // a colour that alpha hides keeps its value
        EXPECT_NEAR(source.image.levels[0].texels[i], images[0].levels[0].texels[i], 2e-7) << i;
}

}  // namespace
}  // namespace pbrbake::io::test
