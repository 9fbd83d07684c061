// Rounding to what a pixel type can store.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

#include "bakers/io/io.hpp"
#include "bakers/io/rgbe.hpp"
#include "bakers/unorm8.hpp"

namespace pbrbake::io {
namespace {

/// The largest magnitude that `pixel` stores: half rounds what is below 65,520 down to 65,504.
double limit_of(PixelType pixel) {
    switch (pixel) {
        case PixelType::half:
            return std::nextafter(65520., 0.);
        case PixelType::float32:
            return HUGE_VAL;
        case PixelType::unorm16:
        case PixelType::unorm8:
            return 1;
        case PixelType::rgbe:
            return 0x1p126;  // the exponent's byte ends at 2^127
    }
    return 0;
}

/// The largest finite value, or magnitude where values are signed; 0 if there is none. Floats of one sign are
/// ordered as their bits are, and a maximum of integers is found many at once.
float peak_of(std::span<const float> values, bool is_signed) {
    constexpr std::int32_t kInfinity = 0x7f800000, kMagnitude = 0x7fffffff;
    const std::int32_t kept = is_signed ? kMagnitude : -1;
    std::int32_t peak = 0;
    for (const float value : values) {
        const std::int32_t bits = std::bit_cast<std::int32_t>(value) & kept;
        peak = std::max(peak, bits < kInfinity ? bits : 0);
    }
    return std::bit_cast<float>(peak);
}

/// Scales and rounds to halves, to even where two are as near; no value may scale to 65,520 or more but
/// infinities. Both roundings are found and one is chosen, so that many values are rounded at once.
void round_to_half(std::span<float> values, float scale) {
    constexpr std::uint32_t kMagnitude = 0x7fffffff, kInfinity = 0x7f800000;
    constexpr std::uint32_t kSmallestNormal = 113u << 23;  // 2^-14
    for (float& value : values) {
        const auto bits = std::bit_cast<std::uint32_t>(value * scale);
        const std::uint32_t magnitude = bits & kMagnitude;
        const std::uint32_t normal = (magnitude + 0xfff + (magnitude >> 13 & 1)) & ~0x1fffu;
        // Floats beside 1/2 are as far apart as the halves below 2^-14.
        const float shifted = std::bit_cast<float>(std::min(magnitude, kSmallestNormal)) + 0.5f;
        const auto subnormal = std::bit_cast<std::uint32_t>(shifted - 0.5f);
        const std::uint32_t rounded = magnitude < kSmallestNormal ? subnormal : normal;
        value = std::bit_cast<float>((bits & ~kMagnitude) | (magnitude > kInfinity ? magnitude : rounded));
    }
}

void round_to_unorm16(std::span<float> values, float scale) {
    for (float& value : values)
        if (!std::isnan(value))
            value = static_cast<float>(
                std::nearbyint(std::clamp(static_cast<double>(value * scale), 0., 1.) * 65535) / 65535);
}

/// Rounds texels to RGBE. With 8 bits a flat region would be off by up to .4 % everywhere; so what rounding
/// took or gave is carried to the next texel, as long as that has a step as large, and means are kept.
void round_to_rgbe(std::vector<float>& texels, std::size_t channels) {
    const std::size_t kept = std::min<std::size_t>(channels, 3);
    std::array<float, 3> carried{};
    for (std::size_t i = 0; i < texels.size(); i += channels) {
        float* texel = &texels[i];
        const float step = std::max({texel[0], texel[kept / 2], texel[kept - 1]}) / 128;
        std::array<float, 3> wanted{};
        for (std::size_t c = 0; c < kept; ++c)
            wanted[c] = texel[c] + (texel[c] > 0 && std::abs(carried[c]) <= step ? carried[c] : 0);
        const std::array<float, 3> stored = from_rgbe(rgbe_of(wanted.data(), kept));
        for (std::size_t c = 0; c < kept; ++c) {
            carried[c] = wanted[c] - stored[c];
            texel[c] = stored[c];
        }
    }
}

void round_to_unorm8(Level& level, const Image& image, float scale) {
    const std::size_t channels = image.channels.size();
    for (std::size_t c = 0; c < channels; ++c) {
        const Transfer transfer = channel_transfer(image, c);
        for (std::size_t i = c; i < level.texels.size(); i += channels) {
            float& value = level.texels[i];
            if (!std::isnan(value)) value = from_unorm8(unorm8_of(value * scale, transfer), transfer);
        }
    }
}

void round_to(PixelType pixel, const Image& image, float scale, Level& level) {
    switch (pixel) {
        case PixelType::half:
            return round_to_half(level.texels, scale);
        case PixelType::float32:
            return;
        case PixelType::unorm16:
            return round_to_unorm16(level.texels, scale);
        case PixelType::unorm8:
            return round_to_unorm8(level, image, scale);
        case PixelType::rgbe:
            for (float& value : level.texels) value *= scale;
            return round_to_rgbe(level.texels, image.channels.size());
    }
}

}  // namespace

double quantise(std::vector<Image>& images, PixelType pixel) {
    const bool is_signed = pixel == PixelType::half || pixel == PixelType::float32;
    double peak = 0;
    for (const Image& image : images)
        for (const Level& level : image.levels)
            peak = std::max(peak, static_cast<double>(peak_of(level.texels, is_signed)));

    double scale = 1;
    while (peak * scale > limit_of(pixel)) scale /= 2;

    for (Image& image : images)
        for (Level& level : image.levels) round_to(pixel, image, static_cast<float>(scale), level);
    return scale;
}

}  // namespace pbrbake::io
