#include "bakers/io/unorm8.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace pbrbake::io {
namespace {

/// IEC 61966-2-1.
double srgb_to_linear(double encoded) {
    return encoded <= .04045 ? encoded / 12.92 : std::pow((encoded + .055) / 1.055, 2.4);
}

/// Bit patterns of positive floats rise with their values; 2^16 of them are one stretch, 2^-7 of a binade.
constexpr int kStretchBits = 16;
constexpr auto kLeastBits = std::bit_cast<std::uint32_t>(0x1p-13f);  // below the end of code 0

/// Values of the codes, and where each code ends. Rounded to float, they don't depend on the C library's pow.
struct SrgbTable {
    std::array<float, 256> values;
    std::array<float, 256> ends;  ///< the last code's never
    /// Codes that end at or below the first float of each stretch of kStretch bit patterns, from 2^-13 on:
    /// stretches are so short that at most one code ends within.
    std::array<std::uint8_t, 13 << (23 - kStretchBits)> first_codes;
    SrgbTable() {
        for (int code = 0; code < 256; ++code) {
            values[code] = static_cast<float>(srgb_to_linear(code / 255.));
            ends[code] = code < 255 ? static_cast<float>(srgb_to_linear((code + .5) / 255)) : HUGE_VALF;
        }
        for (std::uint32_t i = 0; i < first_codes.size(); ++i) {
            const auto first = std::bit_cast<float>(kLeastBits + (i << kStretchBits));
            first_codes[i] = static_cast<std::uint8_t>(std::ranges::upper_bound(ends, first) - ends.begin());
        }
    }
};

const SrgbTable kSrgb;

}  // namespace

std::uint8_t unorm8_of(float linear, Transfer transfer) {
    if (!(linear > 0)) return 0;
    if (linear >= 1) return 255;
    if (transfer == Transfer::linear) {
        // Rounds to nearest even as nearbyint does, without a call: a double this large has no fraction.
        constexpr double kWhole = 0x1p52;
        return static_cast<std::uint8_t>(static_cast<double>(linear) * 255 + kWhole - kWhole);
    }
    const auto bits = std::bit_cast<std::uint32_t>(linear);
    if (bits < kLeastBits) return 0;
    const std::uint8_t code = kSrgb.first_codes[(bits - kLeastBits) >> kStretchBits];
    return static_cast<std::uint8_t>(code + (kSrgb.ends[code] <= linear));
}

float from_unorm8(std::uint8_t code, Transfer transfer) {
    return transfer == Transfer::linear ? static_cast<float>(code / 255.) : kSrgb.values[code];
}

}  // namespace pbrbake::io
