// DDS products read back. Sizes are held against the file's before memory is taken.

#include <algorithm>
#include <bit>
#include <optional>

#include "bakers/io/codec.hpp"
#include "bakers/io/component.hpp"
#include "bakers/io/dds_format.hpp"
#include "bakers/io/decoded.hpp"

namespace pbrbake::io {
namespace {

std::optional<dds::Format> format_of(std::uint32_t dxgi_format) {
    for (const dds::Format& format : dds::kFormats)
        if (format.dxgi_format == dxgi_format) return format;
    return {};
}

dds::Format check_header(const dds::Header& header, const std::string& where) {
    const auto refuse = [&](const std::string& what) {
        throw unreadable(where, what + ": not a DDS file of ours");
    };
    if (header.size != 124 || header.format.size != sizeof(dds::PixelFormat))
        refuse("has a malformed header");
    if ((header.format.flags & dds::kPixelFourCc) == 0 || header.format.four_cc != dds::kFourCcDx10)
        refuse("has no DX10 header");
    const auto format = format_of(header.dxgi_format);
    if (!format) refuse("has DXGI format " + std::to_string(header.dxgi_format));
    const bool is_cube = (header.misc & dds::kMiscCube) != 0,
               is_volume = header.dimension == dds::kDimension3d;
    if ((header.dimension != dds::kDimension2d && !is_volume) || header.array_size != 1)
        refuse("is an array or 1D");
    if (is_volume && (is_cube || header.levels > 1 || header.depth < 1))
        refuse("is a volume with faces or levels, or without slices");
    check_limits(header.width, header.height,
                 (is_cube     ? 6
                  : is_volume ? header.depth
                              : 1) *
                     4. * format->channels,
                 where, {});
    if (is_cube && header.width != header.height) refuse("has faces that are not square");
    const auto most = static_cast<std::uint32_t>(std::bit_width(std::max(header.width, header.height)));
    if (header.levels > most) refuse("has " + std::to_string(header.levels) + " levels");
    return *format;
}

}  // namespace

ReadBack read_dds_product(Bytes file, const std::string& where) {
    if (file.size() < sizeof(dds::Header)) throw unreadable(where, "is shorter than a DDS header");
    const auto header = load<dds::Header>(file, 0);
    const dds::Format format = check_header(header, where);
    const std::uint32_t levels = std::max(1u, header.levels);
    ReadBack back;
    back.format = "dds";
    back.info.pixel = format.pixel;
    back.image.transfer = format.transfer;
    back.image.is_volume = header.dimension == dds::kDimension3d;
    back.image.faces = back.image.is_volume                  ? static_cast<int>(header.depth)
                       : (header.misc & dds::kMiscCube) != 0 ? 6
                                                             : 1;
    back.image.channels = {"R", "G", "B", "A"};
    back.image.channels.resize(static_cast<std::size_t>(format.channels));

    std::uint64_t texels = 0;
    for (std::uint32_t l = 0; l < levels; ++l)
        texels += std::uint64_t{std::max(1u, header.width >> l)} * std::max(1u, header.height >> l);
    if (file.size() - sizeof header !=
        texels * static_cast<std::uint64_t>(back.image.faces) * format.texel_bytes())
        throw unreadable(where, "is truncated, or has more bytes than its texels take");
    const auto channels = static_cast<std::size_t>(format.channels);
    for (std::uint32_t l = 0; l < levels; ++l) {
        Level level{static_cast<int>(std::max(1u, header.width >> l)),
                    static_cast<int>(std::max(1u, header.height >> l)),
                    {}};
        level.texels.reserve(static_cast<std::size_t>(back.image.faces) * level.width * level.height *
                             channels);
        back.image.levels.push_back(std::move(level));
    }
    std::size_t at = sizeof header;
    for (int face = 0; face < back.image.faces; ++face)
        for (Level& level : back.image.levels)
            for (std::size_t i = 0; i < static_cast<std::size_t>(level.width) * level.height * channels;
                 ++i, at += format.component_bytes())
                level.texels.push_back(
                    load_component(file, at, format.pixel, channel_transfer(back.image, i % channels)));
    return back;
}

}  // namespace pbrbake::io
