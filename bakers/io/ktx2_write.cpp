// KTX2 products. No packaged library writes KTX2: this writer follows the specification, and tests hold it
// against a checker of our own and a parser that isn't ours.

#include <algorithm>
#include <bit>
#include <map>

#include "bakers/io/codec.hpp"
#include "bakers/io/component.hpp"
#include "bakers/io/keys.hpp"
#include "bakers/io/ktx2_format.hpp"

namespace pbrbake::io {
namespace {

static_assert(std::endian::native == std::endian::little, "KTX2 is little-endian, and so is what we write");

/// Bytes appended in file order.
class Writer {
  public:
    template <class T>
    void put(const T& value) {
        const auto* bytes = reinterpret_cast<const std::byte*>(&value);
        bytes_.insert(bytes_.end(), bytes, bytes + sizeof value);
    }
    void put_text(const std::string& text) {
        const auto* bytes = reinterpret_cast<const std::byte*>(text.c_str());
        bytes_.insert(bytes_.end(), bytes, bytes + text.size() + 1);  // with its NUL
    }
    void align(std::size_t to) { bytes_.resize((bytes_.size() + to - 1) / to * to); }
    void append(const std::vector<std::byte>& more) { bytes_.insert(bytes_.end(), more.begin(), more.end()); }
    std::size_t size() const { return bytes_.size(); }
    std::vector<std::byte>& bytes() { return bytes_; }

  private:
    std::vector<std::byte> bytes_;
};

/// KDF 1.3, table 5.9: BT.709 = 1, ACEScc (which has AP1's primaries) = 7; tables have none.
std::uint32_t primaries_of(const Image& image, const FileInfo& info) {
    const bool rgb = image.channels.size() >= 3 && image.channels[0] == "R" && image.channels[1] == "G" &&
                     image.channels[2] == "B";
    if (!rgb) return 0;
    const auto space = info.metadata.find(kWorkingSpaceKey);
    return space != info.metadata.end() && space->second == "acescg" ? 7 : 1;
}

/// The basic data format descriptor, KDF 1.3, chapter 5: RGBSDA model, linear or sRGB, a sample a channel;
/// signed float, whose black and white are -1 and 1, or unsigned integers, whose are 0 and all bits. Alpha is
/// linear beside sRGB.
std::vector<std::byte> data_format_descriptor(const ktx2::Format& format, std::uint32_t primaries) {
    constexpr std::uint32_t kVersion = 2, kModelRgbsda = 1, kTransferLinear = 1, kTransferSrgb = 2;
    constexpr std::uint32_t kFloat = 0x80, kSigned = 0x40, kLinear = 0x10, kAlpha = 15;
    const bool is_float = format.pixel == PixelType::half || format.pixel == PixelType::float32;
    const bool is_srgb = format.transfer == Transfer::srgb;
    const auto samples = static_cast<std::uint32_t>(format.channels);
    const std::uint32_t block_size = 24 + 16 * samples, bits = format.component_bytes() * 8;
    Writer out;
    out.put(std::uint32_t{4 + block_size});
    out.put(std::uint32_t{0});  // vendor: Khronos; type: basic
    out.put(kVersion | block_size << 16);
    out.put(kModelRgbsda | primaries << 8 | (is_srgb ? kTransferSrgb : kTransferLinear) << 16);
    out.put(std::uint32_t{0});  // a block is 1 x 1 x 1 x 1
    out.put(format.texel_bytes());
    out.put(std::uint32_t{0});
    for (std::uint32_t i = 0; i < samples; ++i) {
        const std::uint32_t channel = i == 3 ? kAlpha : i;
        out.put(i * bits | (bits - 1) << 16 |
                (channel | (is_float ? kFloat | kSigned : 0) | (is_srgb && i == 3 ? kLinear : 0)) << 24);
        out.put(std::uint32_t{0});  // sample position
        out.put(is_float ? std::bit_cast<std::uint32_t>(-1.f) : 0u);
        out.put(is_float ? std::bit_cast<std::uint32_t>(1.f) : (1u << bits) - 1);
    }
    return std::move(out.bytes());
}

/// "Key/Value Data": sorted by code point, which for UTF-8 is the order of bytes and so of std::map.
std::vector<std::byte> key_value_data(const Image& image, const FileInfo& info) {
    std::map<std::string, std::string> entries = info.metadata;
    for (const auto& [key, value] : entries)
        if (key.starts_with("KTX") || key.starts_with("ktx"))
            throw unwritable("metadata '" + key + "': KTX2 keeps keys that begin with KTX for itself");
    // The only one that cube maps may have, and what our 2D pictures are; slices go inwards.
    entries["KTXorientation"] = image.is_volume ? "rdi" : "rd";
    entries["KTXwriter"] = "pbrbake " PBRBAKE_VERSION;
    entries[kChannelsKey] = join_channels(image.channels);
    Writer out;
    for (const auto& [key, value] : entries) {
        out.put(static_cast<std::uint32_t>(key.size() + 1 + value.size() + 1));
        out.put_text(key);
        out.put_text(value);
        out.align(4);
    }
    return std::move(out.bytes());
}

/// One level's texels: faces, rows, tightly packed; missing channels become 1 (alpha).
void put_level(const Image& image, const Level& level, const ktx2::Format& format,
               std::vector<std::byte>& file) {
    const std::size_t count = level.numbers() / image.channels.size(), begin = file.size();
    file.resize(begin + count * format.texel_bytes());
    store_texels(image, level, 0, count, static_cast<std::size_t>(format.channels), format.pixel,
                 file.data() + begin);
}

}  // namespace

std::vector<std::byte> encode_ktx2(const Image& image, const FileInfo& info) {
    const auto format = ktx2::format_for(image.channel_count(), info.pixel, image.transfer);
    if (!format)
        throw unwritable("ktx2 holds up to 4 channels; the image has " +
                         std::to_string(image.channels.size()) + ": use exr");
    const Level& base = image.levels.front();
    const std::size_t levels = image.levels.size();
    const std::vector<std::byte> dfd = data_format_descriptor(*format, primaries_of(image, info));
    const std::vector<std::byte> kvd = key_value_data(image, info);

    ktx2::Header header{};
    header.identifier = ktx2::kIdentifier;
    header.vk_format = format->vk_format;
    header.type_size = format->component_bytes();
    header.width = static_cast<std::uint32_t>(base.width);
    header.height = static_cast<std::uint32_t>(base.height);
    header.depth = image.is_volume ? static_cast<std::uint32_t>(image.faces) : 0;
    header.faces = image.is_volume ? 1 : static_cast<std::uint32_t>(image.faces);
    header.levels = static_cast<std::uint32_t>(levels);
    header.dfd_offset = static_cast<std::uint32_t>(sizeof(ktx2::Header) + levels * sizeof(ktx2::LevelEntry));
    header.dfd_size = static_cast<std::uint32_t>(dfd.size());
    header.kvd_offset = header.dfd_offset + header.dfd_size;
    header.kvd_size = static_cast<std::uint32_t>(kvd.size());

    Writer out;
    out.put(header);
    out.bytes().resize(header.dfd_offset);
    out.append(dfd);
    out.append(kvd);
    for (std::size_t l = levels; l-- > 0;) {  // smallest first
        out.align(format->alignment());
        ktx2::LevelEntry entry{};
        entry.offset = out.size();
        put_level(image, image.levels[l], *format, out.bytes());
        entry.size = entry.uncompressed_size = out.size() - entry.offset;
        std::memcpy(out.bytes().data() + sizeof(ktx2::Header) + l * sizeof entry, &entry, sizeof entry);
    }
    return std::move(out.bytes());
}

}  // namespace pbrbake::io
