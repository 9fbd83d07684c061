#include "bakers/parse/base64.hpp"

#include <array>
#include <cstdint>

#include "bakers/parse/text.hpp"

namespace pbrbake::parse {
namespace {

constexpr std::uint8_t kNoDigit = 64;

constexpr std::array<std::uint8_t, 256> kValues = [] {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::array<std::uint8_t, 256> values{};
    values.fill(kNoDigit);
    for (std::size_t i = 0; i < kDigits.size(); ++i)
        values[static_cast<unsigned char>(kDigits[i])] = static_cast<std::uint8_t>(i);
    return values;
}();

/// Without its padding, if that makes the last four digits whole.
std::string_view digits_of(std::string_view text) {
    if (text.size() % 4 != 0) return text;
    for (int i = 0; i < 2 && text.ends_with('='); ++i) text.remove_suffix(1);
    return text;
}

}  // namespace

std::vector<std::byte> decode_base64(std::string_view text, const std::string& place) {
    const std::string_view digits = digits_of(text);
    if (digits.size() % 4 == 1)
        throw malformed(place, 0,
                        "found " + std::to_string(digits.size()) +
                            " digits of base64, whose last stands for no byte: it is cut short");
    std::vector<std::byte> bytes;
    bytes.reserve(digits.size() / 4 * 3 + 2);
    std::uint32_t held = 0;
    int bits = 0;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        const std::uint8_t value = kValues[static_cast<unsigned char>(digits[i])];
        if (value == kNoDigit)
            throw malformed(place, 0,
                            "found " + quoted(digits.substr(i, 1)) + " after " + std::to_string(i) +
                                " digits of base64; allowed: A to Z, a to z, 0 to 9, + and /");
        held = held << 6 | value;
        bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        bytes.push_back(static_cast<std::byte>(held >> bits & 255));
    }
    return bytes;
}

}  // namespace pbrbake::parse
