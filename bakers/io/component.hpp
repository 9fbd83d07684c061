#pragma once
// One number of a texel as KTX2 and DDS store it: half, float or unorm16, little-endian.

#include <half.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "bakers/image.hpp"
#include "bakers/io/file_bytes.hpp"

namespace pbrbake::io {

inline std::uint16_t unorm16_of(float value) {
    return static_cast<std::uint16_t>(std::nearbyint(std::clamp(static_cast<double>(value), 0., 1.) * 65535));
}

/// Writes 2 bytes (half, unorm16) or 4 (float32).
inline void store_component(std::byte* out, float value, PixelType pixel) {
    if (pixel == PixelType::float32) {
        std::memcpy(out, &value, sizeof value);
        return;
    }
    const std::uint16_t bits = pixel == PixelType::half ? half(value).bits() : unorm16_of(value);
    std::memcpy(out, &bits, sizeof bits);
}

inline float load_component(Bytes bytes, std::size_t at, PixelType pixel) {
    if (pixel == PixelType::float32) return load<float>(bytes, at);
    const auto bits = load<std::uint16_t>(bytes, at);
    return pixel == PixelType::half ? static_cast<float>(half(half::FromBits, bits))
                                    : static_cast<float>(bits / 65535.);
}

}  // namespace pbrbake::io
