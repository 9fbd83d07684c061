#pragma once
// The part of DDS that we write: uncompressed float, 16-bit and 8-bit textures with a DX10 header, 2D and
// cube with mip levels, 3D without. (Microsoft, "Programming Guide for DDS"; names as there.)

#include <array>
#include <cstdint>

#include "bakers/io/component.hpp"

namespace pbrbake::io::dds {

/// DDS_PIXELFORMAT.
struct PixelFormat {
    std::uint32_t size, flags, four_cc, bit_count, masks[4];
};

/// Magic, DDS_HEADER and DDS_HEADER_DXT10; texels follow.
struct Header {
    std::uint32_t magic;
    std::uint32_t size, flags, height, width, pitch, depth, levels, reserved1[11];
    PixelFormat format;
    std::uint32_t caps, caps2, caps3, caps4, reserved2;
    std::uint32_t dxgi_format, dimension, misc, array_size, misc2;
};
static_assert(sizeof(Header) == 148, "has no padding, so that it is stored as it is in memory");

inline constexpr std::uint32_t kMagic = 0x20534444;       // "DDS "
inline constexpr std::uint32_t kFourCcDx10 = 0x30315844;  // "DX10"
/// DDSD_CAPS, HEIGHT, WIDTH, PITCH, PIXELFORMAT; and MIPMAPCOUNT.
inline constexpr std::uint32_t kFlags = 0x1 | 0x2 | 0x4 | 0x8 | 0x1000, kFlagLevels = 0x20000;
inline constexpr std::uint32_t kPixelFourCc = 0x4;
/// DDSCAPS_TEXTURE; COMPLEX; MIPMAP.
inline constexpr std::uint32_t kCapsTexture = 0x1000, kCapsComplex = 0x8, kCapsMipmap = 0x400000;
/// DDSD_DEPTH and DDSCAPS2_VOLUME.
inline constexpr std::uint32_t kFlagDepth = 0x800000, kCaps2Volume = 0x200000;
/// DDSCAPS2_CUBEMAP and its six faces.
inline constexpr std::uint32_t kCaps2Cube = 0x200 | 0xFC00;
inline constexpr std::uint32_t kDimension2d = 3, kDimension3d = 4, kMiscCube = 0x4;

struct Format {
    std::uint32_t dxgi_format;
    int channels;
    PixelType pixel;
    Transfer transfer = Transfer::linear;
    std::uint32_t component_bytes() const { return io::component_bytes(pixel); }
    std::uint32_t texel_bytes() const { return component_bytes() * static_cast<std::uint32_t>(channels); }
};

/// DXGI_FORMAT_R16_FLOAT, R16G16, R16G16B16A16; R32, R32G32, R32G32B32A32; R16_UNORM, R16G16, R16G16B16A16;
/// R8_UNORM, R8G8, R8G8B8A8, and R8G8B8A8_UNORM_SRGB: sRGB comes in no narrower texel.
inline constexpr std::array<Format, 13> kFormats{{{54, 1, PixelType::half},
                                                  {34, 2, PixelType::half},
                                                  {10, 4, PixelType::half},
                                                  {41, 1, PixelType::float32},
                                                  {16, 2, PixelType::float32},
                                                  {2, 4, PixelType::float32},
                                                  {56, 1, PixelType::unorm16},
                                                  {35, 2, PixelType::unorm16},
                                                  {11, 4, PixelType::unorm16},
                                                  {61, 1, PixelType::unorm8},
                                                  {49, 2, PixelType::unorm8},
                                                  {28, 4, PixelType::unorm8},
                                                  {29, 4, PixelType::unorm8, Transfer::srgb}}};

}  // namespace pbrbake::io::dds
