// DDS products against Microsoft's documents, against OpenImageIO where it can read them, and against damage.

#include <gtest/gtest.h>

#include <half.h>

#include <cstring>

#include "tests/bakers/io/dds_checker.hpp"
#include "tests/bakers/io/fixtures.hpp"

namespace pbrbake::io::test {
namespace {

std::string joined(const std::vector<std::string>& breaches) {
    std::string text;
    for (const std::string& breach : breaches) text += breach + "\n";
    return text;
}

std::vector<std::pair<std::string, Image>> shapes() {
    return {{"cube", marked_image(16, 5, 6, {"R", "G", "B"})},
            {"cube_npot", marked_image(20, 3, 6, {"R", "G", "B"})},
            {"rgba", marked_image(8, 4, 1, {"R", "G", "B", "A"})},
            {"rg", marked_image(9, 3, 1, {"R", "G"})},
            {"r", marked_image(5, 1, 1, {"R"})}};
}

constexpr std::array<PixelType, 3> kPixels{PixelType::half, PixelType::float32, PixelType::unorm16};

TEST(Dds, EveryShapeKeepsToTheDocuments) {
    for (const auto& [name, image] : shapes())
        for (const PixelType pixel : kPixels) {
            SCOPED_TRACE(name);
            FileInfo info;
            info.pixel = pixel;
            EXPECT_EQ(joined(check_dds(encode("dds", image, info))), "");
        }
}

TEST(Dds, CheckerFindsEveryChangedByteOfTheHeader) {
    const Buffer whole = encode("dds", marked_image(4, 2, 6, {"R", "G", "B"}), {});
    for (std::size_t at = 0; at < 148; ++at) {
        Buffer changed = whole;
        changed[at] ^= std::byte{0x55};
        EXPECT_NE(joined(check_dds(changed)), "") << "byte " << at;
    }
    EXPECT_NE(joined(check_dds(Buffer(whole.begin(), whole.end() - 1))), "");
}

TEST(Dds, ReadsBackWhatWasWritten) {
    TempDir dir;
    for (auto& [name, image] : shapes())
        for (const PixelType pixel : kPixels) {
            SCOPED_TRACE(name);
            std::vector<Image> images{image};
            quantise(images, pixel);
            FileInfo info;
            info.pixel = pixel;
            write_file(dir / "a.dds", encode("dds", images[0], info));
            const ReadBack back = read_product(dir / "a.dds");
            EXPECT_EQ(back.format, "dds");
            EXPECT_EQ(back.info.pixel, pixel);
            EXPECT_EQ(back.image.faces, image.faces);
            ASSERT_EQ(back.image.levels.size(), image.levels.size());
            const std::size_t channels = image.channels.size(), stored = back.image.channels.size();
            EXPECT_EQ(stored, channels == 3 ? 4 : channels);
            for (std::size_t l = 0; l < image.levels.size(); ++l)
                for (std::size_t i = 0; i < images[0].levels[l].texels.size() / channels; ++i)
                    for (std::size_t c = 0; c < stored; ++c)
                        EXPECT_EQ(back.image.levels[l].texels[i * stored + c],
                                  c < channels ? images[0].levels[l].texels[i * channels + c] : 1.f);
        }
}

TEST(Dds, StoresAFaceWithAllItsLevelsBeforeTheNext) {
    const Image image = marked_image(4, 2, 6, {"R"});
    const Buffer file = encode("dds", image, {});
    std::size_t at = 148;
    for (int face = 0; face < 6; ++face)
        for (int level = 0; level < 2; ++level)
            for (int y = 0; y < 4 >> level; ++y)
                for (int x = 0; x < 4 >> level; ++x, at += 2) {
                    std::uint16_t bits = 0;
                    std::memcpy(&bits, file.data() + at, 2);
                    EXPECT_EQ(bits, half(*image.texel(level, face, y, x)).bits());
                }
    EXPECT_EQ(at, file.size());
}

TEST(Dds, ReaderSurvivesEveryChangedByte) {
    TempDir dir;
    const auto path = dir / "a.dds";
    const Buffer whole = encode("dds", marked_image(4, 2, 6, {"R", "G", "B"}), {});
    for (std::size_t at = 0; at < 148; ++at)
        for (const int value : {0, 1, 0x7F, 0x80, 0xFF}) {
            Buffer changed = whole;
            changed[at] = static_cast<std::byte>(value);
            write_file(path, changed);
            try {
                read_product(path);
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ExitCode::unreadable_input) << "byte " << at;
            }
        }
    write_file(path, Buffer(whole.begin(), whole.end() - 1));
    EXPECT_THROW(read_product(path), Error);
}

TEST(Dds, AnotherReaderAgreesWhereItCanRead) {
    if (!have_program("oiiotool")) GTEST_SKIP() << "oiiotool (package openimageio-tools) is not installed";
    // OpenImageIO refuses DX10 headers with floats; a refusal that names the format shows it parsed the
    // header.
    TempDir dir;
    FileInfo info;
    info.pixel = PixelType::unorm16;
    write_file(dir / "a.dds", encode("dds", marked_image(8, 1, 1, {"R", "G"}), info));
    int status = 0;
    const std::string said = run_program("oiiotool --info '" + (dir / "a.dds").string() + "'", status);
    if (status != 0) GTEST_SKIP() << "OpenImageIO can't read 16-bit DDS: " << said;
    EXPECT_NE(said.find("8 x"), std::string::npos) << said;
}

}  // namespace
}  // namespace pbrbake::io::test
