// A picture as a C header, for engines that embed their tables: an array and its sizes, C99 and C++.

#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>

#include "bakers/io/codec.hpp"
#include "bakers/io/component.hpp"
#include "bakers/io/keys.hpp"

namespace pbrbake::io {
namespace {

/// The name as C has it: letters, digits and underscores, no digit first.
std::string identifier(const std::string& name) {
    std::string text;
    for (const char c : name) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        text += plain ? c : '_';
    }
    return text.empty() || (text.front() >= '0' && text.front() <= '9') ? "table_" + text : text;
}

/// The bits of a half or unorm16, or the shortest literal of a float that reads back as it was.
std::string literal(float value, PixelType pixel) {
    if (pixel != PixelType::float32) {
        std::array<std::byte, 2> bytes{};
        store_component(bytes.data(), value, pixel, Transfer::linear);
        std::uint16_t bits = 0;
        std::memcpy(&bits, bytes.data(), sizeof bits);
        return std::to_string(bits);
    }
    std::array<char, 32> buffer{};
    const auto end = std::to_chars(buffer.begin(), buffer.end(), value).ptr;
    std::string text(buffer.data(), end);
    if (text.find_first_of(".e") == std::string::npos) text += ".0";
    return text + "f";
}

/// A comment line; ends in a quote, so that no backslash goes on to the next one.
std::string comment(const std::string& key, std::string value) {
    for (char& c : value)
        if (static_cast<unsigned char>(c) < ' ') c = ' ';
    return "// " + key + " \"" + value + "\"\n";
}

std::string numbers(const Image& image, PixelType pixel) {
    constexpr std::size_t kLongestLine = 100;
    std::string text, line;
    for (const float value : image.levels.front().texels) {
        const std::string number = literal(value, pixel) + ",";
        if (line.size() + number.size() > kLongestLine) {
            text += line + "\n";
            line.clear();
        }
        line += number;
    }
    return text + line + "\n";
}

}  // namespace

std::vector<std::byte> encode_c_header(const Image& image, const FileInfo& info) {
    const Level& level = image.levels.front();
    const std::string name = identifier(info.name), guard = "PBRBAKE_" + name + "_H";
    const bool is_float = info.pixel == PixelType::float32;
    const std::string row = image.is_volume ? "(z * " + name + "_height + y)" : "y";
    std::string file = std::string("// Texel (x, y") + (image.is_volume ? ", z" : "") + "), channel c, is " +
                       name + "_texels[(" + row + " * " + name + "_width + x) * " + name +
                       "_channels + c]: " +
                       (is_float                        ? "floats"
                        : info.pixel == PixelType::half ? "the bits of 16-bit floats"
                                                        : "0 to 65535 for 0 to 1") +
                       ", times pbrbake:scale.\n";
    file += comment("channels", join_channels(image.channels));
    for (const auto& [key, value] : info.metadata) file += comment(key, value);
    file += "#ifndef " + guard + "\n#define " + guard + "\n\n";
    if (!is_float) file += "#include <stdint.h>\n\n";
    file += "enum {\n    " + name + "_width = " + std::to_string(level.width) + ",\n    " + name +
            "_height = " + std::to_string(level.height) + ",\n    " +
            (image.is_volume ? name + "_depth = " + std::to_string(image.faces) + ",\n    " : "") + name +
            "_channels = " + std::to_string(image.channels.size()) + "\n};\n\n";
    file += std::string("static const ") + (is_float ? "float " : "uint16_t ") + name + "_texels[" +
            std::to_string(level.texels.size()) + "] = {\n" + numbers(image, info.pixel) + "};\n\n#endif\n";
    const auto* bytes = reinterpret_cast<const std::byte*>(file.data());
    return {bytes, bytes + file.size()};
}

}  // namespace pbrbake::io
