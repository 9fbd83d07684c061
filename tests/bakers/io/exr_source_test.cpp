// EXR sources: channels, windows, tiles, cube maps, colour and units that the file states, and what it may
// claim.

#include <gtest/gtest.h>

#include <ImfEnvmap.h>
#include <half.h>

#include <array>
#include <cmath>

#include "tests/bakers/io/fixtures.hpp"

namespace pbrbake::io::test {
namespace {

float coded(const std::string& channel, int x, int y) {
    return static_cast<float>(x + 16 * y) + (channel.back() == 'R'   ? 0.f
                                             : channel.back() == 'G' ? .25f
                                                                     : .5f);
}

class ExrSource : public testing::Test {
  protected:
    SourceImage read(const ExrFixture& fixture, ReadRequest request = {}) {
        request.path = dir_ / "a.exr";
        write_exr(request.path, fixture);
        return read_source(request);
    }
    std::string refusal(const ExrFixture& fixture) {
        write_exr(dir_ / "a.exr", fixture);
        std::string message;
        EXPECT_EQ(code_of_reading({dir_ / "a.exr"}, &message), 4);
        return message;
    }
    std::string refusal(const Buffer& bytes) {
        write_file(dir_ / "a.exr", bytes);
        std::string message;
        EXPECT_EQ(code_of_reading({dir_ / "a.exr"}, &message), 4);
        return message;
    }
    TempDir dir_;
};

void expect_coded(const SourceImage& source, int width, int height) {
    ASSERT_EQ(source.image.levels.at(0).width, width);
    ASSERT_EQ(source.image.levels.at(0).height, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float* texel = source.image.texel(0, 0, y, x);
            EXPECT_EQ(texel[0], coded("R", x, y));
            EXPECT_EQ(texel[1], coded("G", x, y));
            EXPECT_EQ(texel[2], coded("B", x, y));
        }
}

TEST_F(ExrSource, ReadsHalfAndFloatScanlinesAndTiles) {
    for (const char* type : {"half", "float"})
        for (const bool tiled : {false, true}) {
            SCOPED_TRACE(type);
            expect_coded(read({.width = 10, .height = 6, .type = type, .tiled = tiled, .value = coded}), 10,
                         6);
        }
}

TEST_F(ExrSource, ReadsUnsignedIntegersAsTheyAre) {
    const SourceImage source =
        read({.type = "uint", .value = [](const std::string&, int, int) { return 7.f; }});
    EXPECT_EQ(*source.image.texel(0, 0, 0, 0), 7.f);
}

TEST_F(ExrSource, SpreadsGreyAndDropsAlpha) {
    const SourceImage grey = read({.channels = {"A", "Y"}, .value = [](const std::string& name, int, int) {
                                       return name == "Y" ? 3.f : 9.f;
                                   }});
    const float* texel = grey.image.texel(0, 0, 1, 1);
    EXPECT_EQ((std::array{texel[0], texel[1], texel[2]}), (std::array{3.f, 3.f, 3.f}));
    expect_coded(read({.channels = {"A", "B", "G", "R"}, .value = coded}), 8, 4);
}

TEST_F(ExrSource, FindsRgbInALayer) {
    expect_coded(read({.channels = {"Z", "beauty.B", "beauty.G", "beauty.R"}, .value = coded}), 8, 4);
}

TEST_F(ExrSource, ReadsTheFirstOfSeveralParts) {
    write_two_part_exr(dir_ / "a.exr", {.value = coded}, 99);
    expect_coded(read_source({dir_ / "a.exr"}), 8, 4);
}

TEST_F(ExrSource, RefusesChannelsThatAreNoColourByName) {
    EXPECT_NE(refusal(ExrFixture{.channels = {"N.X", "Z"}}).find("it has N.X, Z"), std::string::npos);
}

TEST_F(ExrSource, CutsOverscanAndRefusesCrops) {
    expect_coded(read({.overscan = 2, .value = coded}), 8, 4);
    EXPECT_NE(refusal(ExrFixture{.overscan = -1}).find("data window"), std::string::npos);
}

TEST_F(ExrSource, BelievesChromaticities) {
    const auto space = [&](std::vector<double> c) {
        const SourceImage source = read({.chromaticities = std::move(c)});
        EXPECT_FALSE(source.colour_space_assumed);
        return source.colour_space;
    };
    EXPECT_EQ(space({.64, .33, .3, .6, .15, .06, .3127, .329}), "lin_rec709");
    EXPECT_EQ(space({.713, .293, .165, .83, .128, .044, .32168, .33767}), "acescg");
    EXPECT_EQ(space({.708, .292, .17, .797, .131, .046, .3127, .329}), "lin_rec2020");
    EXPECT_EQ(space({.6, .35, .3, .6, .15, .06, .3457, .3585}), "chromaticities");
    EXPECT_NE(refusal(ExrFixture{.chromaticities = {0, 0, 0, 0, 0, 0, 0, 0}}).find("span no gamut"),
              std::string::npos);
}

/// Alpha comes as stored: below 0 it is 0, above 1 it stays, since exponents may be kept there.
TEST_F(ExrSource, KeepsAlphaWhereItIsAskedFor) {
    const auto value = [](const std::string& channel, int x, int y) {
        constexpr std::array kAlpha{.25f, 40.f, -1.f, 1.f};
        return channel.back() == 'A' ? kAlpha[static_cast<std::size_t>(x)] : coded(channel, x, y);
    };
    const std::vector<float> expected{.25f, 40, 0, 1};
    for (const std::vector<std::string>& channels :
         {std::vector<std::string>{"A", "B", "G", "R"}, {"A", "Y"}, {"x.A", "x.B", "x.G", "x.R"}}) {
        ExrFixture fixture{.width = 4, .height = 2, .channels = channels, .type = "float", .value = value};
        EXPECT_EQ(read(fixture).image.channel_count(), 3);
        const SourceImage source = read(fixture, {.with_alpha = true});
        ASSERT_EQ(source.image.channels, (std::vector<std::string>{"R", "G", "B", "A"})) << channels[0];
        for (int y = 0; y < 2; ++y)
            for (int x = 0; x < 4; ++x) {
                const float* texel = source.image.texel(0, 0, y, x);
                EXPECT_EQ(texel[0], coded(channels.back(), x, y));
                EXPECT_EQ(texel[3], expected[static_cast<std::size_t>(x)]);
            }
    }
    EXPECT_EQ(read({.width = 4, .height = 2}, {.with_alpha = true}).image.channel_count(), 3);
}

TEST_F(ExrSource, TellsHalvesFromFloats) {
    EXPECT_TRUE(read({.type = "half"}).is_half);
    EXPECT_FALSE(read({.type = "float"}).is_half);
}

TEST_F(ExrSource, CountsLuminanceWhereTheFileStatesIt) {
    const SourceImage source = read({.white_luminance = 250});
    EXPECT_EQ(source.units, "cd/m^2");
    EXPECT_FLOAT_EQ(*source.image.texel(0, 0, 0, 0), 125.f);
}

TEST_F(ExrSource, UndoesTheScaleOfAProduct) {
    FileInfo info;
    info.metadata["pbrbake:scale"] = "0.25";
    write_file(dir_ / "a.exr", encode("exr", marked_image(4, 1, 1, {"R", "G", "B"}), info));
    const SourceImage source = read_source({dir_ / "a.exr"});
    EXPECT_EQ(source.units, "relative");
    EXPECT_EQ(*source.image.texel(0, 0, 1, 2),
              4.f * *marked_image(4, 1, 1, {"R", "G", "B"}).texel(0, 0, 1, 2));
}

/// The direction of a texel of ours, from the words of image.hpp: faces as OpenGL samples them.
Imath::V3f our_direction(int face, int x, int y, int size) {
    const float s = (static_cast<float>(x) + .5f) / static_cast<float>(size) * 2 - 1;
    const float t = (static_cast<float>(y) + .5f) / static_cast<float>(size) * 2 - 1;
    switch (face) {
        case 0:
            return {1, -t, -s};
        case 1:
            return {-1, -t, s};
        case 2:
            return {s, 1, t};
        case 3:
            return {s, -1, -t};
        case 4:
            return {s, -t, 1};
        default:
            return {-s, -t, -1};
    }
}

/// OpenEXR's direction of a texel of its picture, found by looking through every texel of every face. OpenEXR
/// puts the outermost texel centres on the cube's edges, so its direction is shrunk to where the centre is
/// for us.
std::array<float, 3> exr_direction(int x, int y, int size) {
    const Imath::Box2i window({0, 0}, {size - 1, 6 * size - 1});
    const int face = y / size;
    for (int j = 0; j < size; ++j)
        for (int i = 0; i < size; ++i) {
            const Imath::V2f in_face(static_cast<float>(i), static_cast<float>(j));
            const Imath::V2f at =
                Imf::CubeMap::pixelPosition(static_cast<Imf::CubeMapFace>(face), window, in_face);
            if (std::lround(at.x) != x || std::lround(at.y) != y) continue;
            const Imath::V3f d =
                Imf::CubeMap::direction(static_cast<Imf::CubeMapFace>(face), window, in_face);
            std::array<float, 3> direction{d.x, d.y, d.z};
            for (int axis = 0; axis < 3; ++axis)
                if (axis != face / 2)
                    direction[static_cast<std::size_t>(axis)] *=
                        static_cast<float>(size - 1) / static_cast<float>(size);
            return direction;
        }
    ADD_FAILURE() << "no texel at " << x << ", " << y;
    return {};
}

TEST_F(ExrSource, CubeTexelsKeepTheirDirections) {
    constexpr int kSize = 4;
    // Every texel holds its direction, shifted to be positive: a picture on each face that no turn leaves
    // unchanged.
    const SourceImage source = read({.width = kSize,
                                     .height = 6 * kSize,
                                     .type = "float",
                                     .cube = true,
                                     .value = [](const std::string& channel, int x, int y) {
                                         const auto d = exr_direction(x, y, kSize);
                                         return 2 + d[channel == "R" ? 0 : channel == "G" ? 1 : 2];
                                     }});
    ASSERT_EQ(source.image.faces, 6);
    ASSERT_EQ(source.image.levels.at(0).width, kSize);
    ASSERT_EQ(source.image.levels.at(0).height, kSize);
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x) {
                const Imath::V3f d = our_direction(face, x, y, kSize);
                const float* texel = source.image.texel(0, face, y, x);
                EXPECT_NEAR(texel[0] - 2, d.x, 1e-6) << "face " << face << " at " << x << ", " << y;
                EXPECT_NEAR(texel[1] - 2, d.y, 1e-6) << "face " << face << " at " << x << ", " << y;
                EXPECT_NEAR(texel[2] - 2, d.z, 1e-6) << "face " << face << " at " << x << ", " << y;
            }
}

TEST_F(ExrSource, RefusesCubesOfTheWrongShape) {
    EXPECT_NE(refusal(ExrFixture{.width = 4, .height = 20, .cube = true}).find("not n x 6n"),
              std::string::npos);
}

/// A scanline header that claims a window, with `tail` bytes behind it.
Buffer claiming_header(std::int64_t width, std::int64_t height, int compression, std::size_t tail,
                       std::uint32_t tile = 0) {
    Buffer out;
    put_bytes(out, {0x76, 0x2f, 0x31, 0x01, 2, tile ? 2 : 0, 0, 0});
    const auto attribute = [&](const char* name, const char* type, const Buffer& value) {
        put_le(put_le(put_text(put_le(put_text(out, name), 0, 1), type), 0, 1), value.size(), 4);
        out.insert(out.end(), value.begin(), value.end());
    };
    Buffer channels, window, one, byte, tiles, centre;
    for (const char* name : {"B", "G", "R"}) {
        put_le(put_text(channels, name), 0, 1);
        put_le(put_le(put_le(put_le(channels, 1, 4), 0, 4), 1, 4), 1, 4);
    }
    put_le(channels, 0, 1);
    put_le(put_le(put_le(put_le(window, 0, 4), 0, 4), static_cast<std::uint64_t>(width - 1), 4),
           static_cast<std::uint64_t>(height - 1), 4);
    put_le(one, 0x3F800000, 4);
    put_le(byte, static_cast<std::uint64_t>(compression), 1);
    put_le(put_le(put_le(tiles, tile, 4), tile, 4), 0, 1);
    Buffer line_order;
    put_le(line_order, 0, 1);
    put_le(centre, 0, 8);
    attribute("channels", "chlist", channels);
    attribute("compression", "compression", byte);
    attribute("dataWindow", "box2i", window);
    attribute("displayWindow", "box2i", window);
    attribute("lineOrder", "lineOrder", line_order);
    attribute("pixelAspectRatio", "float", one);
    attribute("screenWindowCenter", "v2f", centre);
    attribute("screenWindowWidth", "float", one);
    if (tile) attribute("tiles", "tiledesc", tiles);
    put_le(out, 0, 1);
    out.resize(out.size() + tail);
    return out;
}

TEST_F(ExrSource, RefusesHugeWindows) {
    EXPECT_NE(refusal(claiming_header(200000, 200000, 3, 64)).find("65536 a side"), std::string::npos);
    EXPECT_NE(refusal(claiming_header(65536, 65536, 3, 64)).find("the limit is 4294967296"),
              std::string::npos);
    EXPECT_NE(refusal(claiming_header(16384, 16384, 3, 64)).find("can't be in the file's"),
              std::string::npos);
    EXPECT_NE(refusal(claiming_header(16384, 16384, 0, 1 << 20)).find("can't be in the file's"),
              std::string::npos);
    EXPECT_NE(refusal(claiming_header(0, 5, 3, 64)).find("claims 0 x 5"), std::string::npos);
}

TEST_F(ExrSource, RefusesTinyAndGiantTiles) {
    EXPECT_NE(refusal(claiming_header(16384, 16384, 4, 4096, 1)).find("can't be in the file's"),
              std::string::npos);
    EXPECT_NE(refusal(claiming_header(16, 16, 4, 4096, 1 << 20)).find("tiles of"), std::string::npos);
}

TEST_F(ExrSource, RefusesDeepPixels) {
    Buffer deep = claiming_header(4, 4, 0, 4096);
    deep[5] = std::byte{8};
    EXPECT_NE(refusal(deep).find("deep"), std::string::npos);
}

}  // namespace
}  // namespace pbrbake::io::test
