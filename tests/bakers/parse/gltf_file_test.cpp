// Binary glTF, data URIs and buffer views: what they hold, and each way they can lie.

#include "bakers/parse/gltf_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bakers/parse/base64.hpp"
#include "bakers/parse/materials.hpp"

namespace pbrbake::parse {
namespace {

using testing::HasSubstr;
using namespace std::string_literals;

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

std::string text_of(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The error that an action ends with.
template <class Action>
std::string refusal(const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::unreadable_input);
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        return error.what();
    }
    ADD_FAILURE() << "was read";
    return "";
}

TEST(Base64, ReadsTheVectorsOfRfc4648) {
    const auto decoded = [](const char* text) { return text_of(decode_base64(text, "")); };
    EXPECT_EQ(decoded(""), "");
    EXPECT_EQ(decoded("Zg=="), "f");
    EXPECT_EQ(decoded("Zm8="), "fo");
    EXPECT_EQ(decoded("Zm9v"), "foo");
    EXPECT_EQ(decoded("Zm9vYg=="), "foob");
    EXPECT_EQ(decoded("Zm9vYmE="), "fooba");
    EXPECT_EQ(decoded("Zm9vYmFy"), "foobar");
    EXPECT_EQ(decoded("Zm9vYmE"), "fooba");  // padding left out
    EXPECT_EQ(decoded("+/+/"), "\xfb\xff\xbf");
}

TEST(Base64, NamesWhatIsNone) {
    const auto refused = [](const char* text) {
        return refusal([&] { decode_base64(text, "a.gltf#/images/0/uri"); });
    };
    EXPECT_EQ(
        refused("Zm9vY"),
        "a.gltf#/images/0/uri: found 5 digits of base64, whose last stands for no byte: it is cut short");
    EXPECT_EQ(
        refused("Zm9\nYmFy"),
        "a.gltf#/images/0/uri: found '?' after 3 digits of base64; allowed: A to Z, a to z, 0 to 9, + and /");
    for (const char* text : {"Zm9-", "Zm9_", "Z===", "=", "Zg==Zg==", "Zm 9", "Zm9\xc3\xa4"})
        EXPECT_THAT(refused(text), HasSubstr("base64")) << text;
}

std::string word(std::size_t value) {
    std::string text;
    for (int i = 0; i < 4; ++i) text += static_cast<char>(value >> 8 * i & 255);
    return text;
}

std::string chunk(const std::string& type, std::string bytes) {
    bytes.resize((bytes.size() + 3) / 4 * 4, type == "JSON" ? ' ' : '\0');
    return word(bytes.size()) + type + bytes;
}

std::string glb(const std::string& chunks) { return "glTF" + word(2) + word(12 + chunks.size()) + chunks; }

TEST(BinaryGltf, HoldsJsonAndABuffer) {
    const std::string file = glb(chunk("JSON", R"({"asset": {}})") + chunk("BIN\0"s, "abcd")) + "rubbish";
    const GltfFile gltf = parse_gltf(bytes_of(file), "a.glb");
    EXPECT_TRUE(gltf.json.contains("asset"));
    EXPECT_EQ(text_of(gltf.chunk), "abcd");
    const std::string without = glb(chunk("JSON", "{}")),
                      unknown = glb(chunk("JSON", "{}") + chunk("ABCD", "x"));
    EXPECT_TRUE(parse_gltf(bytes_of(without), "a.glb").chunk.empty());
    EXPECT_TRUE(parse_gltf(bytes_of(unknown), "a.glb").chunk.empty());
    EXPECT_TRUE(parse_gltf(bytes_of("{}"), "text.glb").json.is_object());
}

TEST(BinaryGltf, NamesWhatIsWrong) {
    const auto refused = [](const std::string& file) {
        return refusal([&] { parse_gltf(bytes_of(file), "a.glb"); });
    };
    const std::string json = chunk("JSON", "{}"), whole = glb(json);
    EXPECT_EQ(refused("glTF"), "a.glb: is a binary glTF that is cut short in its header");
    EXPECT_EQ(refused("glTF" + word(1) + whole.substr(8)),
              "a.glb: is a binary glTF that is of version 1; allowed: 2");
    EXPECT_EQ(refused(whole.substr(0, whole.size() - 1)),
              "a.glb: is a binary glTF that claims 24 bytes in all, but has 23");
    EXPECT_THAT(refused("glTF" + word(2) + word(8) + json), HasSubstr("claims 8 bytes in all"));
    EXPECT_EQ(refused(glb("")), "a.glb: is a binary glTF that doesn't begin with a chunk of JSON");
    EXPECT_EQ(refused(glb(chunk("BIN\0"s, "ab"))),
              "a.glb: is a binary glTF that doesn't begin with a chunk of JSON");
    EXPECT_THAT(refused(glb("\2\0\0"s)), HasSubstr("cut short in the header of a chunk"));
    EXPECT_EQ(refused(glb(word(400) + "JSON{}")),
              "a.glb: is a binary glTF that claims 400 bytes of JSON, but has 2");
    EXPECT_EQ(refused(glb(json + word(0xffffffff) + "BIN\0"s)),
              "a.glb: is a binary glTF that claims 4294967295 bytes of BIN, but has 0");
    EXPECT_THAT(refused(glb(chunk("JSON", "{]"))), HasSubstr("a.glb:1:2: not JSON"));
    EXPECT_THAT(refused("glTG" + whole.substr(4)), HasSubstr("a.glb"));  // another magic: no JSON either
}

/// A document with one image and, if any, its view of a buffer of 8 bytes.
std::string with_image(const std::string& image, const std::string& view = "",
                       const std::string& buffer = R"({"byteLength": 8})") {
    return R"({"asset": {}, "images": [)" + image + R"(], "bufferViews": [)" + view + R"(], "buffers": [)" +
           buffer + "]}";
}

const std::string kViewed = R"({"bufferView": 0, "mimeType": "image/png"})";

TEST(GltfPictures, AreInBuffersOrUris) {
    const auto picture = [](const std::string& file) {
        return gltf_picture(parse_gltf(bytes_of(file), "a"), 0, "a");
    };
    EXPECT_EQ(text_of(picture(with_image(R"({"uri": "data:image/png;base64,Zm9v"})")).own()), "foo");
    EXPECT_EQ(picture(with_image(R"({"uri": "maps/a%20b.png"})")).path, "maps/a b.png");
    const std::string view = R"({"buffer": 0, "byteOffset": 2, "byteLength": 3})";
    const std::string binary = glb(chunk("JSON", with_image(kViewed, view)) + chunk("BIN\0"s, "01234567"));
    EXPECT_EQ(text_of(picture(binary).own()), "234");
    const std::string inner =
        R"({"uri": "data:application/octet-stream;base64,MDEyMzQ1Njc=", "byteLength": 8})";
    EXPECT_EQ(text_of(picture(with_image(kViewed, view, inner)).own()), "234");
    const GltfBytes outer = picture(with_image(kViewed, view, R"({"uri": "a.bin", "byteLength": 8})"));
    EXPECT_EQ(outer.path, "a.bin");
    EXPECT_EQ(outer.offset, 2u);
    EXPECT_EQ(outer.size, 3u);
}

TEST(GltfPictures, NameWhatIsWrong) {
    const auto refused = [](const std::string& json, const std::string& buffer = "01234567") {
        const std::string file = glb(chunk("JSON", json) + chunk("BIN\0"s, buffer));
        return refusal([&] { gltf_picture(parse_gltf(bytes_of(file), "a.glb"), 0, "a.glb"); });
    };
    const auto view = [](const std::string& rest) { return R"({"buffer": 0, )" + rest + "}"; };
    EXPECT_EQ(refused(with_image(kViewed, view(R"("byteOffset": 6, "byteLength": 3)"))),
              "a.glb#/bufferViews/0: found bytes 6 to 6 + 3; its buffer has 8");
    EXPECT_THAT(refused(with_image(kViewed, view(R"("byteOffset": 18446744073709551615, "byteLength": 2)"))),
                HasSubstr("its buffer has 8"));
    EXPECT_THAT(refused(with_image(kViewed, view(R"("byteLength": 0)"))),
                HasSubstr("/byteLength: found '0'; allowed: a whole number from 1 on"));
    EXPECT_THAT(refused(with_image(kViewed, view(R"("byteOffset": -1, "byteLength": 1)"))),
                HasSubstr("/byteOffset"));
    EXPECT_THAT(refused(with_image(kViewed, view(R"("byteLength": 8)")), "0123"),
                HasSubstr("a.glb#/buffers/0: claims 8 bytes, but has 4"));
    EXPECT_THAT(refused(with_image(kViewed, R"({"buffer": 3, "byteLength": 1})")),
                HasSubstr("/buffer: found '3'"));
    EXPECT_THAT(refused(with_image(kViewed, R"({"byteLength": 1})")), HasSubstr("/buffer: found nothing"));
    EXPECT_THAT(refused(with_image(kViewed)), HasSubstr("/images/0/bufferView: found '0'"));
    EXPECT_EQ(
        refused(with_image(R"({"bufferView": 0, "mimeType": "text/plain"})", view(R"("byteLength": 8)"))),
        "a.glb#/images/0/mimeType: found 'text/plain'; allowed: image/png, image/jpeg");
    EXPECT_EQ(refused(with_image(R"({"uri": "data:text/plain;base64,Zm9v"})")),
              "a.glb#/images/0/uri: found 'text/plain'; allowed: image/png, image/jpeg");
    EXPECT_THAT(refused(with_image(R"({"uri": "data:image/png,foo"})")),
                HasSubstr("allowed: \"data:TYPE;base64,"));
    EXPECT_THAT(refused(with_image(R"({"uri": "data:image/png;base64"})")),
                HasSubstr("allowed: \"data:TYPE;base64,"));
    EXPECT_THAT(refused(with_image(R"({"uri": "data:image/png;base64,Zm9v!"})")),
                HasSubstr("a.glb#/images/0/uri: "));
    EXPECT_THAT(refused(with_image(R"({"uri": "../a.png"})")), HasSubstr("leads out of the folder"));
    EXPECT_THAT(refused(with_image("{}")), HasSubstr("/images/0/uri: found nothing"));
    EXPECT_THAT(refused(R"({"asset": {}})"), HasSubstr("a.glb: has 0 images, and none of index 0"));
    EXPECT_THAT(
        refused(with_image(kViewed, view(R"("byteLength": 8)"), R"({"uri": "/etc/x", "byteLength": 8})")),
        HasSubstr("a.glb#/buffers/0/uri: '/etc/x' is no file beside this one"));
}

}  // namespace
}  // namespace pbrbake::parse
