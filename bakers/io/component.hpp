#pragma once
// Texels as KTX2 and DDS store them: numbers of half, float, unorm16 or unorm8, little-endian.

#include <half.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "bakers/image.hpp"
#include "bakers/io/file_bytes.hpp"
#include "bakers/unorm8.hpp"

namespace pbrbake::io {

inline std::uint16_t unorm16_of(float value) {
    return static_cast<std::uint16_t>(std::nearbyint(std::clamp(static_cast<double>(value), 0., 1.) * 65535));
}

/// Bytes of a number.
constexpr std::uint32_t component_bytes(PixelType pixel) {
    return pixel == PixelType::float32 ? 4 : pixel == PixelType::unorm8 ? 1 : 2;
}

/// Writes component_bytes(pixel) bytes; `transfer` is for unorm8.
inline void store_component(std::byte* out, float value, PixelType pixel, Transfer transfer) {
    if (pixel == PixelType::unorm8) {
        *out = static_cast<std::byte>(unorm8_of(value, transfer));
        return;
    }
    if (pixel == PixelType::float32) {
        std::memcpy(out, &value, sizeof value);
        return;
    }
    const std::uint16_t bits = pixel == PixelType::half ? half(value).bits() : unorm16_of(value);
    std::memcpy(out, &bits, sizeof bits);
}

/// Writes `count` texels of a level, from texel `first` on: `stored` numbers each, of which those that the
/// image doesn't have are 1. The first three have the image's transfer.
void store_texels(const Image& image, const Level& level, std::size_t first, std::size_t count,
                  std::size_t stored, PixelType pixel, std::byte* out);

inline float load_component(Bytes bytes, std::size_t at, PixelType pixel, Transfer transfer) {
    if (pixel == PixelType::unorm8) return from_unorm8(static_cast<std::uint8_t>(bytes[at]), transfer);
    if (pixel == PixelType::float32) return load<float>(bytes, at);
    const auto bits = load<std::uint16_t>(bytes, at);
    return pixel == PixelType::half ? static_cast<float>(half(half::FromBits, bits))
                                    : static_cast<float>(bits / 65535.);
}

}  // namespace pbrbake::io
