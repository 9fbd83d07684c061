// EXR products: what is written is read back, is the same bytes each time, and other programs understand it.

#include <gtest/gtest.h>

#include "tests/bakers/io/fixtures.hpp"

namespace pbrbake::io::test {
namespace {

FileInfo info_with(PixelType pixel) {
    FileInfo info;
    info.pixel = pixel;
    info.metadata = {{"pbrbake:scale", "0.5"}, {"pbrbake:working_space", "lin_rec709"}};
    return info;
}

void expect_same(const Image& a, const Image& b) {
    EXPECT_EQ(a.channels, b.channels);
    EXPECT_EQ(a.faces, b.faces);
    ASSERT_EQ(a.levels.size(), b.levels.size());
    for (std::size_t l = 0; l < a.levels.size(); ++l) {
        EXPECT_EQ(a.levels[l].width, b.levels[l].width);
        EXPECT_EQ(a.levels[l].height, b.levels[l].height);
        EXPECT_EQ(a.levels[l].texels, b.levels[l].texels) << "level " << l;
    }
}

std::string refusal(std::string_view format, const Image& image, const FileInfo& info = {}) {
    try {
        encode(format, image, info);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::unwritable_output);
        return error.message();
    }
    ADD_FAILURE() << "was written";
    return {};
}

class Products : public testing::TestWithParam<std::string> {};

TEST_P(Products, RoundTrip) {
    TempDir dir;
    const std::vector<Image> images{marked_image(16, 1, 1, {"R", "G", "B"}),
                                    marked_image(16, 5, 1, {"R", "G", "B", "A"}),
                                    marked_image(13, 1, 1, {"scale", "bias"}),
                                    marked_image(13, 4, 1, {"zeta", "alpha", "mid"}),
                                    marked_image(7, 1, 1, {"Y"}),
                                    marked_image(16, 1, 6, {"R", "G", "B"}),
                                    marked_image(16, 3, 6, {"R", "G", "B"}),
                                    marked_image(16, 5, 6, {"R", "G", "B"}),
                                    marked_image(1, 1, 6, {"R", "G", "B"})};
    for (const PixelType pixel : {PixelType::half, PixelType::float32})
        for (const Image& image : images) {
            SCOPED_TRACE(image.channels.front() + " of " + std::to_string(image.levels.size()) + " levels");
            const auto path = dir / ("a." + GetParam());
            write_file(path, encode(GetParam(), image, info_with(pixel)));
            const ReadBack back = read_product(path);
            expect_same(back.image, image);
            EXPECT_EQ(back.format, GetParam());
            EXPECT_EQ(back.info.pixel, pixel);
            EXPECT_EQ(back.info.metadata, info_with(pixel).metadata);
        }
}

TEST_P(Products, SameArgumentsSameBytes) {
    const Image image = marked_image(64, 7, 6, {"R", "G", "B"});
    EXPECT_EQ(encode(GetParam(), image, info_with(PixelType::half)),
              encode(GetParam(), image, info_with(PixelType::half)));
}

TEST_P(Products, RefusesPixelTypesItCannotHold) {
    FileInfo info;
    info.pixel = PixelType::rgbe;
    EXPECT_NE(refusal(GetParam(), marked_image(2, 1, 1, {"R"}), info).find("pixel type rgbe"),
              std::string::npos);
}

TEST_P(Products, RefusesMisshapenImages) {
    Image image = marked_image(4, 3, 1, {"R"});
    image.levels[1].texels.pop_back();
    EXPECT_NE(refusal(GetParam(), image).find("level 1 holds 3"), std::string::npos);
    image = marked_image(4, 3, 1, {"R"});
    image.levels.erase(image.levels.begin() + 1);
    EXPECT_NE(refusal(GetParam(), image).find("halve"), std::string::npos);
    image = marked_image(4, 1, 1, {"R", "R"});
    EXPECT_NE(refusal(GetParam(), image).find("twice"), std::string::npos);
    image = marked_image(1, 1, 1, {"R"});
    image.levels.push_back(image.levels[0]);
    EXPECT_NE(refusal(GetParam(), image).find("beyond 1 x 1"), std::string::npos);
    EXPECT_NE(refusal(GetParam(), Image{}).find("no channels"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Formats, Products, testing::Values("exr", "ktx2"),
                         [](const auto& parameter) { return parameter.param; });

TEST(Encode, RefusesUnknownFormatsByName) {
    EXPECT_NE(refusal("gif", marked_image(2, 1, 1, {"R"})).find("exr, ktx2"), std::string::npos);
}

TEST(ExrProduct, RefusesCubesWhoseLevelsOpenExrCannotLayOut) {
    EXPECT_NE(refusal("exr", marked_image(100, 4, 6, {"R", "G", "B"})).find("divisible by 8"),
              std::string::npos);
}

TEST(ExrProduct, StatesPrimariesAndNoDate) {
    if (!have_program("exrheader")) GTEST_SKIP() << "exrheader (package openexr) is not installed";
    TempDir dir;
    FileInfo info = info_with(PixelType::half);
    info.metadata["pbrbake:units"] = "cd/m^2";
    write_file(dir / "a.exr", encode("exr", marked_image(16, 3, 6, {"R", "G", "B"}), info));
    int status = 0;
    const std::string header = run_program("exrheader '" + (dir / "a.exr").string() + "'", status);
    ASSERT_EQ(status, 0) << header;
    for (const char* line : {"cube-face map", "mip-map", "tile size 64 by 64", "red   (0.64 0.33)",
                             "whiteLuminance (type float): 2", "pbrbake:scale (type string): \"0.5\"",
                             "pbrbake:levels (type string): \"3\""})
        EXPECT_NE(header.find(line), std::string::npos) << line << " not in\n" << header;
    for (const char* word : {"capDate", "DateTime"}) EXPECT_EQ(header.find(word), std::string::npos) << word;
}

TEST(ExrProduct, EveryLevelIsReadByOtherPrograms) {
    if (!have_program("oiiotool")) GTEST_SKIP() << "oiiotool (package openimageio-tools) is not installed";
    TempDir dir;
    const std::string path = (dir / "a.exr").string();
    Image image = marked_image(16, 3, 6, {"R", "G", "B"});
    for (Level& level : image.levels)
        for (float& value : level.texels)
            value = .75f;  // so that the levels that fill up the chain are known too
    write_file(path, encode("exr", image, info_with(PixelType::half)));
    std::string command = "oiiotool --no-autopremult";
    for (int level = 0; level < 7; ++level)  // 16 x 96 … 1 x 6, 1 x 3, 1 x 1
        command += " '" + path + "' --selectmip " + std::to_string(level) + " --printstats";
    int status = 0;
    const std::string output = run_program(command, status);
    ASSERT_EQ(status, 0) << output;
    std::size_t levels = 0;
    for (std::size_t at = 0;
         (at = output.find("Constant Color: 0.750000 0.750000 0.750000", at)) != std::string::npos; ++at)
        ++levels;
    if (levels != 7) {  // its words differ between versions; its errors don't
        EXPECT_EQ(output.find("rror"), std::string::npos) << output;
        EXPECT_EQ(output.find("NanCount: 1"), std::string::npos) << output;
    }
}

TEST(ExrProduct, ReadsFilesThatOthersWrote) {
    TempDir dir;
    write_exr(dir / "a.exr",
              {.channels = {"B", "G", "R", "depth"}, .value = [](const std::string& name, int x, int) {
                   return static_cast<float>(x) + (name == "R" ? 10.f : name == "depth" ? 20.f : 0.f);
               }});
    const ReadBack back = read_product(dir / "a.exr");
    EXPECT_EQ(back.image.channels, (std::vector<std::string>{"R", "G", "B", "depth"}));
    EXPECT_EQ(back.image.texel(0, 0, 1, 3)[0], 13.f);
    EXPECT_EQ(back.image.texel(0, 0, 1, 3)[3], 23.f);
}

}  // namespace
}  // namespace pbrbake::io::test
