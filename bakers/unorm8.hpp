#pragma once
// Codes of 8 bits, linear or sRGB, and the linear numbers they stand for.

#include <array>
#include <bit>
#include <cstdint>

#include "bakers/image.hpp"

namespace pbrbake {

/// IEC 61966-2-1, of encoded values in [0, 1]. By the C library's pow: for what is rounded or compared.
double srgb_to_linear(double encoded);

/// Values of the codes, and where sRGB codes end. Rounded to float, they don't depend on the C library's pow.
class Unorm8Table {
  public:
    Unorm8Table();
    float linear(std::uint8_t code) const { return linear_[code]; }
    float srgb(std::uint8_t code) const { return srgb_[code]; }

    /// The sRGB code nearest to a value in (0, 1).
    std::uint8_t srgb_code(float value) const {
        const auto bits = std::bit_cast<std::uint32_t>(value);
        if (bits < kLeastBits) return 0;
        const std::uint8_t code = first_codes_[(bits - kLeastBits) >> kStretchBits];
        return static_cast<std::uint8_t>(code + (ends_[code] <= value));
    }

  private:
    /// Bit patterns of positive floats rise with their values; 2^16 of them are one stretch, 2^-7 of a
    /// binade.
    static constexpr int kStretchBits = 16;
    static constexpr auto kLeastBits = std::bit_cast<std::uint32_t>(0x1p-13f);  // below the end of code 0

    std::array<float, 256> linear_, srgb_;
    std::array<float, 256> ends_;  ///< of sRGB codes; the last code's never
    /// Codes that end at or below the first float of each stretch, from kLeastBits on: stretches are so short
    /// that at most one code ends within.
    std::array<std::uint8_t, 13 << (23 - kStretchBits)> first_codes_;
};
extern const Unorm8Table kUnorm8;

/// The code nearest to a linear value: in the code's own scale, so an sRGB code is the one whose encoded
/// value is nearest. NaN is 0.
inline std::uint8_t unorm8_of(float linear, Transfer transfer) {
    if (!(linear > 0)) return 0;
    if (linear >= 1) return 255;
    if (transfer == Transfer::srgb) return kUnorm8.srgb_code(linear);
    // Rounds to nearest even as nearbyint does, without a call: a double this large has no fraction.
    constexpr double kWhole = 0x1p52;
    return static_cast<std::uint8_t>(static_cast<double>(linear) * 255 + kWhole - kWhole);
}

/// The linear value of a code; unorm8_of gives the code back.
inline float from_unorm8(std::uint8_t code, Transfer transfer) {
    return transfer == Transfer::linear ? kUnorm8.linear(code) : kUnorm8.srgb(code);
}

/// The transfer of channel `index` of an image.
inline Transfer channel_transfer(const Image& image, std::size_t index) {
    return index < 3 ? image.transfer : Transfer::linear;
}

}  // namespace pbrbake
