#pragma once
// Radiance's pixel: three mantissas of 8 bits and one exponent, value = mantissa 2^(exponent - 136). Readers
// differ in whether they add half a mantissa step; this is what most do (OpenImageIO, stb_image, three.js),
// Radiance itself adds.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace pbrbake::io {

/// Nearest RGBE of up to three channels; one channel is spread to three, a missing third is 0, negatives are
/// 0.
inline std::array<std::uint8_t, 4> rgbe_of(const float* texel, std::size_t channels) {
    const auto positive = [](float value) { return value > 0 ? static_cast<double>(value) : 0; };
    std::array<double, 3> rgb{};
    for (std::size_t c = 0; c < 3; ++c)
        rgb[c] = channels == 1 ? positive(texel[0]) : c < channels ? positive(texel[c]) : 0;
    const double peak = std::max({rgb[0], rgb[1], rgb[2]});
    if (peak < 0x1p-127) return {};
    int exponent = 0;
    std::frexp(peak, &exponent);
    if (std::ldexp(peak, 8 - exponent) >= 255.5) ++exponent;  // would round to 256
    const auto mantissa = [&](double value) {
        return static_cast<std::uint8_t>(std::nearbyint(std::ldexp(value, 8 - exponent)));
    };
    return {mantissa(rgb[0]), mantissa(rgb[1]), mantissa(rgb[2]), static_cast<std::uint8_t>(exponent + 128)};
}

inline std::array<float, 3> from_rgbe(const std::array<std::uint8_t, 4>& pixel) {
    if (pixel[3] == 0) return {};
    const auto value = [&](std::uint8_t mantissa) {
        return static_cast<float>(std::ldexp(mantissa, pixel[3] - 136));
    };
    return {value(pixel[0]), value(pixel[1]), value(pixel[2])};
}

}  // namespace pbrbake::io
