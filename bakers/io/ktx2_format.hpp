#pragma once
// The part of KTX 2.0 that we write: uncompressed float, 16-bit and 8-bit textures, 2D, cube and 3D.
// Section titles refer to the KTX File Format Specification 2.0, and KDF to the Khronos Data Format
// Specification 1.3.

#include <array>
#include <cstdint>
#include <optional>

#include "bakers/io/component.hpp"

namespace pbrbake::io::ktx2 {

inline constexpr std::array<char, 12> kIdentifier{'\xAB', 'K',    'T',  'X',  ' ',    '2',
                                                  '0',    '\xBB', '\r', '\n', '\x1A', '\n'};

/// The fixed part of the file, "File Structure": identifier, header and index. The level index follows it.
struct Header {
    std::array<char, 12> identifier;
    std::uint32_t vk_format, type_size, width, height, depth, layers, faces, levels, supercompression;
    std::uint32_t dfd_offset, dfd_size, kvd_offset, kvd_size;
    std::uint64_t sgd_offset, sgd_size;
};
static_assert(sizeof(Header) == 80, "has no padding, so that it is stored as it is in memory");

struct LevelEntry {
    std::uint64_t offset, size, uncompressed_size;
};

/// One of the formats.
struct Format {
    std::uint32_t vk_format;
    int channels;
    PixelType pixel;
    Transfer transfer = Transfer::linear;
    std::uint32_t component_bytes() const { return io::component_bytes(pixel); }
    std::uint32_t texel_bytes() const { return component_bytes() * static_cast<std::uint32_t>(channels); }
    /// lcm(texel block size, 4), "mipPadding": sizes are powers of two.
    std::uint32_t alignment() const { return texel_bytes() < 4 ? 4 : texel_bytes(); }
};

/// VK_FORMAT_R16_SFLOAT, R16G16, R16G16B16A16, R32, R32G32 and R32G32B32A32_SFLOAT; R16_UNORM, R16G16 and
/// R16G16B16A16_UNORM; R8, R8G8 and R8G8B8A8_UNORM, and the same as SRGB.
inline constexpr std::array<Format, 15> kFormats{{{70, 1, PixelType::unorm16},
                                                  {77, 2, PixelType::unorm16},
                                                  {91, 4, PixelType::unorm16},
                                                  {76, 1, PixelType::half},
                                                  {83, 2, PixelType::half},
                                                  {97, 4, PixelType::half},
                                                  {100, 1, PixelType::float32},
                                                  {103, 2, PixelType::float32},
                                                  {109, 4, PixelType::float32},
                                                  {9, 1, PixelType::unorm8},
                                                  {16, 2, PixelType::unorm8},
                                                  {37, 4, PixelType::unorm8},
                                                  {15, 1, PixelType::unorm8, Transfer::srgb},
                                                  {22, 2, PixelType::unorm8, Transfer::srgb},
                                                  {43, 4, PixelType::unorm8, Transfer::srgb}}};

/// The narrowest format with at least `channels`; three are widened to four.
std::optional<Format> format_for(int channels, PixelType pixel, Transfer transfer);
std::optional<Format> format_of(std::uint32_t vk_format);

}  // namespace pbrbake::io::ktx2
