// DDS products. OpenImageIO reads some DDS and writes none: this writer follows Microsoft's documents, and
// tests hold it against a checker of our own, and against OpenImageIO where that can read.

#include <bit>
#include <cstring>

#include "bakers/io/codec.hpp"
#include "bakers/io/component.hpp"
#include "bakers/io/dds_format.hpp"

namespace pbrbake::io {
namespace {

static_assert(std::endian::native == std::endian::little, "DDS is little-endian, and so is what we write");

/// The narrowest format with at least the image's channels; three are widened to four. There always is one:
/// io checks channels and pixel type before.
dds::Format format_for(int channels, PixelType pixel, Transfer transfer) {
    if (pixel != PixelType::unorm8) transfer = Transfer::linear;
    for (const dds::Format& format : dds::kFormats)
        if (format.pixel == pixel && format.transfer == transfer && format.channels >= channels)
            return format;
    throw unwritable("dds holds up to 4 channels");
}

dds::Header header_of(const Image& image, const dds::Format& format) {
    const Level& base = image.levels.front();
    const bool is_cube = image.is_cube(), has_levels = image.levels.size() > 1;
    dds::Header header{};
    header.magic = dds::kMagic;
    header.size = 124;
    header.flags =
        dds::kFlags | (has_levels ? dds::kFlagLevels : 0) | (image.is_volume ? dds::kFlagDepth : 0);
    header.height = static_cast<std::uint32_t>(base.height);
    header.width = static_cast<std::uint32_t>(base.width);
    header.pitch = header.width * format.texel_bytes();
    header.depth = image.is_volume ? static_cast<std::uint32_t>(image.faces) : 0;
    header.levels = static_cast<std::uint32_t>(image.levels.size());
    header.format.size = sizeof(dds::PixelFormat);
    header.format.flags = dds::kPixelFourCc;
    header.format.four_cc = dds::kFourCcDx10;
    header.caps = dds::kCapsTexture | (is_cube || has_levels || image.is_volume ? dds::kCapsComplex : 0) |
                  (has_levels ? dds::kCapsMipmap : 0);
    header.caps2 = is_cube ? dds::kCaps2Cube : image.is_volume ? dds::kCaps2Volume : 0;
    header.dxgi_format = format.dxgi_format;
    header.dimension = image.is_volume ? dds::kDimension3d : dds::kDimension2d;
    header.misc = is_cube ? dds::kMiscCube : 0;
    header.array_size = 1;  // of cubes
    return header;
}

}  // namespace

std::vector<std::byte> encode_dds(const Image& image, const FileInfo& info) {
    const dds::Format format = format_for(image.channel_count(), info.pixel, image.transfer);
    const dds::Header header = header_of(image, format);
    std::size_t texels = 0;
    for (const Level& level : image.levels) texels += level.numbers() / image.channels.size();
    std::vector<std::byte> file(sizeof header + texels * format.texel_bytes());
    std::memcpy(file.data(), &header, sizeof header);
    std::byte* out = file.data() + sizeof header;
    // A face holds all its levels, then comes the next face. Direct3D's faces have OpenGL's order and turn in
    // memory.
    for (int face = 0; face < image.faces; ++face)
        for (const Level& level : image.levels) {
            const std::size_t count = static_cast<std::size_t>(level.width) * level.height;
            store_texels(image, level, static_cast<std::size_t>(face) * count, count,
                         static_cast<std::size_t>(format.channels), format.pixel, out);
            out += count * format.texel_bytes();
        }
    return file;
}

}  // namespace pbrbake::io
