// KTX2 products against the specification, against a parser that isn't ours, and against damage.

#include <gtest/gtest.h>

#include <half.h>

#include <array>
#include <cstring>

#include "bakers/formats.hpp"
#include "tests/bakers/io/fixtures.hpp"
#include "tests/bakers/io/ktx2_checker.hpp"

namespace pbrbake::io::test {
namespace {

FileInfo info_with(PixelType pixel) {
    FileInfo info;
    info.pixel = pixel;
    info.metadata = {
        {"pbrbake:scale", "0.5"}, {"pbrbake:working_space", "acescg"}, {"zeta", "ü"}, {"Alpha", ""}};
    return info;
}

std::string joined(const std::vector<std::string>& breaches) {
    std::string text;
    for (const std::string& breach : breaches) text += breach + "\n";
    return text;
}

/// One of every shape and format that is written.
std::vector<std::pair<std::string, Image>> shapes() {
    Image volume = marked_image(6, 1, 5, {"x", "y"}), srgb = marked_image(8, 4, 1, {"R", "G", "B", "A"});
    volume.is_volume = true;
    srgb.transfer = Transfer::srgb;
    return {{"cube", marked_image(16, 5, 6, {"R", "G", "B"})},
            {"cube_npot", marked_image(20, 3, 6, {"R", "G", "B"})},
            {"cube_one", marked_image(1, 1, 6, {"R", "G", "B"})},
            {"rgba", marked_image(8, 4, 1, {"R", "G", "B", "A"})},
            {"rg", marked_image(9, 3, 1, {"scale", "bias"})},
            {"r", marked_image(5, 3, 1, {"Y"})},
            {"table", marked_image(6, 1, 1, {"x", "y", "energy"})},
            {"volume", volume},
            {"srgb", srgb}};
}

constexpr std::array kPixels{PixelType::half, PixelType::float32, PixelType::unorm16, PixelType::unorm8};

TEST(Ktx2, EveryShapeKeepsToTheSpecification) {
    for (const auto& [name, image] : shapes())
        for (const PixelType pixel : kPixels) {
            SCOPED_TRACE(name + " " + std::string(pixel_name(pixel)));
            EXPECT_EQ(joined(check_ktx2(encode("ktx2", image, info_with(pixel)))), "");
        }
}

TEST(Ktx2, CheckerFindsEveryChangedByteOfStructure) {
    // Which bytes carry structure: all but texels and the free text of keys and values.
    const Buffer whole = encode("ktx2", marked_image(4, 2, 6, {"R", "G", "B"}), {});
    std::uint32_t kvd_offset = 0;
    std::memcpy(&kvd_offset, whole.data() + 56, 4);
    for (std::size_t at = 0; at < kvd_offset; ++at) {
        if (at == 24 * 2 + 80 + 13) continue;  // primaries have several right values
        Buffer changed = whole;
        changed[at] ^= std::byte{0x55};
        EXPECT_NE(joined(check_ktx2(changed)), "") << "byte " << at;
    }
    Buffer longer = whole;
    longer.push_back(std::byte{0});
    EXPECT_NE(joined(check_ktx2(longer)), "");
    EXPECT_NE(joined(check_ktx2(Buffer(whole.begin(), whole.end() - 1))), "");
}

TEST(Ktx2, StoresFacesInOrderSmallestLevelFirstAlphaOne) {
    const Image image = marked_image(4, 3, 6, {"R", "G", "B"});
    const Buffer file = encode("ktx2", image, {});
    std::uint64_t last_offset = ~std::uint64_t{0};
    for (std::size_t l = 0; l < 3; ++l) {
        std::uint64_t offset = 0;
        std::memcpy(&offset, file.data() + 80 + 24 * l, 8);
        EXPECT_LT(offset, last_offset);
        last_offset = offset;
        const int size = 4 >> l;
        for (int face = 0; face < 6; ++face)
            for (int y = 0; y < size; ++y)
                for (int x = 0; x < size; ++x) {
                    std::uint16_t bits[4];
                    std::memcpy(
                        bits,
                        file.data() + offset + 8 * static_cast<std::size_t>((face * size + y) * size + x), 8);
                    const float* texel = image.texel(static_cast<int>(l), face, y, x);
                    for (int c = 0; c < 3; ++c) EXPECT_EQ(bits[c], half(texel[c]).bits());
                    EXPECT_EQ(bits[3], half(1.f).bits());
                }
    }
}

TEST(Ktx2, RefusesReservedKeysAndTooManyChannels) {
    FileInfo info;
    info.metadata["KTXswizzle"] = "rgba";
    EXPECT_THROW(encode("ktx2", marked_image(2, 1, 1, {"R"}), info), Error);
    EXPECT_THROW(encode("ktx2", marked_image(2, 1, 1, {"a", "b", "c", "d", "e"}), {}), Error);
}

TEST(Ktx2, ReaderSurvivesEveryChangedByte) {
    TempDir dir;
    const auto path = dir / "a.ktx2";
    const Buffer whole = encode("ktx2", marked_image(4, 2, 6, {"R", "G", "B"}), {});
    for (std::size_t at = 0; at < whole.size(); ++at)
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
}

TEST(Ktx2, AnotherParserAgrees) {
    const std::filesystem::path external = std::filesystem::path(PBRBAKE_SOURCE_DIR) / "tests" / "external";
    if (!have_program("node")) GTEST_SKIP() << "node (package nodejs) is not installed";
    if (!std::filesystem::exists(external / "node_modules" / "ktx-parse"))
        GTEST_SKIP() << "ktx-parse is not installed: npm ci --prefix tests/external";
    TempDir dir;
    std::string command = "node '" + (external / "check_ktx2.mjs").string() + "'";
    for (const auto& [name, image] : shapes())
        for (const PixelType pixel : kPixels) {
            const auto path = dir / (name + "_" + std::string(pixel_name(pixel)) + ".ktx2");
            write_file(path, encode("ktx2", image, info_with(pixel)));
            command += " '" + path.string() + "'";
        }
    int status = 0;
    const std::string output = run_program(command, status);
    EXPECT_EQ(status, 0) << output;
    EXPECT_NE(output.find("36 files"), std::string::npos) << output;

    Buffer broken = encode("ktx2", marked_image(4, 2, 6, {"R", "G", "B"}), {});
    broken[36] = std::byte{5};  // faceCount
    write_file(dir / "broken.ktx2", broken);
    run_program(
        "node '" + (external / "check_ktx2.mjs").string() + "' '" + (dir / "broken.ktx2").string() + "'",
        status);
    EXPECT_NE(status, 0);
}

}  // namespace
}  // namespace pbrbake::io::test
