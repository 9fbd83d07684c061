// KTX2 products read back. Every offset and length is held against the file's size before it is used.

#include <algorithm>
#include <bit>

#include "bakers/io/codec.hpp"
#include "bakers/io/component.hpp"
#include "bakers/io/decoded.hpp"
#include "bakers/io/keys.hpp"
#include "bakers/io/ktx2_format.hpp"

namespace pbrbake::io {
namespace {

/// [offset, offset + size) of the file.
Bytes section(Bytes file, std::uint64_t offset, std::uint64_t size, const char* what,
              const std::string& where) {
    if (offset > file.size() || size > file.size() - offset)
        throw unreadable(where,
                         std::string("is truncated or malformed: its ") + what + " runs past the file's end");
    return file.subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(size));
}

ktx2::Format check_header(const ktx2::Header& header, const std::string& where) {
    const auto refuse = [&](const std::string& what) {
        throw unreadable(where, what + ": not a KTX2 file of ours");
    };
    const auto format = ktx2::format_of(header.vk_format);
    if (!format) refuse("has vkFormat " + std::to_string(header.vk_format));
    if (header.type_size != format->component_bytes())
        refuse("has typeSize " + std::to_string(header.type_size));
    if (header.layers != 0) refuse("is an array");
    if (header.depth != 0 && (header.faces != 1 || header.levels != 1))
        refuse("is a volume with faces or levels");
    if (header.faces != 1 && header.faces != 6) refuse("has " + std::to_string(header.faces) + " faces");
    if (header.supercompression != 0 || header.sgd_size != 0 || header.sgd_offset != 0)
        refuse("is supercompressed");
    check_limits(header.width, header.height, std::max(header.faces, header.depth) * 4. * format->channels,
                 where, {});
    if (header.faces == 6 && header.width != header.height) refuse("has faces that are not square");
    const auto most = static_cast<std::uint32_t>(std::bit_width(std::max(header.width, header.height)));
    if (header.levels < 1 || header.levels > most) refuse("has " + std::to_string(header.levels) + " levels");
    return *format;
}

std::map<std::string, std::string> read_key_values(Bytes data, const std::string& where) {
    std::map<std::string, std::string> entries;
    const Error malformed = unreadable(where, "has malformed key/value data");
    for (std::size_t at = 0; at < data.size();) {
        if (data.size() - at < 4) throw malformed;
        const std::size_t size = load<std::uint32_t>(data, at);
        at += 4;
        if (size < 2 || size > data.size() - at) throw malformed;
        const std::string pair = text_at(data, at, size);
        const auto end = pair.find('\0');
        if (end == std::string::npos || end == 0) throw malformed;
        std::string value = pair.substr(end + 1);
        if (!value.empty() && value.back() == '\0') value.pop_back();
        if (!entries.emplace(pair.substr(0, end), std::move(value)).second) throw malformed;
        at = std::min(data.size(), at + (size + 3) / 4 * 4);
    }
    return entries;
}

std::vector<std::string> take_channels(std::map<std::string, std::string>& entries, int stored,
                                       const std::string& where) {
    const auto entry = entries.find(kChannelsKey);
    if (entry == entries.end()) {
        std::vector<std::string> names{"R", "G", "B", "A"};
        names.resize(static_cast<std::size_t>(stored));
        return names;
    }
    std::vector<std::string> names = split_channels(entry->second);
    const auto count = static_cast<int>(names.size());
    if (count != stored && !(count == 3 && stored == 4))
        throw unreadable(where, std::string(kChannelsKey) + " names " + std::to_string(count) +
                                    " channels; it has " + std::to_string(stored));
    entries.erase(entry);
    return names;
}

Level read_level(Bytes data, int width, int height, std::size_t count, std::size_t channels,
                 const ktx2::Format& format) {
    Level level{width, height, {}};
    level.texels.reserve(count * channels);
    const std::size_t bytes = format.component_bytes();
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t c = 0; c < channels; ++c) {
            const std::size_t at = i * format.texel_bytes() + c * bytes;
            level.texels.push_back(
                load_component(data, at, format.pixel, c < 3 ? format.transfer : Transfer::linear));
        }
    return level;
}

}  // namespace

ReadBack read_ktx2_product(Bytes file, const std::string& where) {
    section(file, 0, sizeof(ktx2::Header), "header", where);
    const auto header = load<ktx2::Header>(file, 0);
    const ktx2::Format format = check_header(header, where);
    const Bytes index =
        section(file, sizeof(ktx2::Header), header.levels * sizeof(ktx2::LevelEntry), "level index", where);
    const Bytes dfd = section(file, header.dfd_offset, header.dfd_size, "data format descriptor", where);
    if (dfd.size() < 4 || load<std::uint32_t>(dfd, 0) != dfd.size())
        throw unreadable(where, "has a malformed data format descriptor");
    const Bytes kvd = section(file, header.kvd_offset, header.kvd_size, "key/value data", where);

    ReadBack back;
    back.format = "ktx2";
    back.info.pixel = format.pixel;
    back.image.transfer = format.transfer;
    back.info.metadata = read_key_values(kvd, where);
    back.image.channels = take_channels(back.info.metadata, format.channels, where);
    back.info.metadata.erase("KTXwriter");
    back.info.metadata.erase("KTXorientation");
    back.image.is_volume = header.depth != 0;
    back.image.faces = static_cast<int>(std::max(header.faces, header.depth));
    for (std::uint32_t l = 0; l < header.levels; ++l) {
        const auto entry = load<ktx2::LevelEntry>(index, l * sizeof(ktx2::LevelEntry));
        const std::uint32_t width = std::max(1u, header.width >> l),
                            height = std::max(1u, header.height >> l);
        const std::uint64_t count = static_cast<std::uint64_t>(back.image.faces) * width * height;
        if (entry.size != count * format.texel_bytes() || entry.uncompressed_size != entry.size)
            throw unreadable(where, "level " + std::to_string(l) + " has the wrong size");
        const Bytes data = section(file, entry.offset, entry.size, "texels", where);
        back.image.levels.push_back(read_level(data, static_cast<int>(width), static_cast<int>(height),
                                               static_cast<std::size_t>(count), back.image.channels.size(),
                                               format));
    }
    return back;
}

}  // namespace pbrbake::io
