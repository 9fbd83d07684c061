#include "bakers/io/exr_preflight.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "bakers/io/decoded.hpp"

namespace pbrbake::io {
namespace {

constexpr std::uint32_t kTiledFlag = 0x200, kNonImageFlag = 0x800, kMultiPartFlag = 0x1000;
/// The offset table holds 8 bytes a chunk; a chunk's own header 8 bytes or more, its data at least one.
constexpr double kLeastChunkBytes = 8 + 8 + 1;

/// What matters here of one part's header.
struct Part {
    std::int64_t width = 0, height = 0;
    double texel_bytes = 0;
    int compression = -1;
    std::string type;
    struct Tiles {
        std::uint32_t width = 0, height = 0;
        int mode = 0;  // 0 one level, 1 mipmap, 2 ripmap
    };
    std::optional<Tiles> tiles;
};

/// Walks the bytes; every step checks that the file has them.
class Walk {
  public:
    Walk(Bytes file, const std::string& where) : file_(file), where_(where) {}

    template <class T>
    T number() {
        need(sizeof(T));
        const T value = load<T>(file_, at_);
        at_ += sizeof(T);
        return value;
    }
    std::string name() {
        const std::size_t begin = at_;
        do need(1);
        while (file_[at_++] != std::byte{0});
        return text_at(file_, begin, at_ - 1 - begin);
    }
    Bytes block(std::size_t size) {
        need(size);
        at_ += size;
        return file_.subspan(at_ - size, size);
    }

  private:
    void need(std::size_t size) const {
        if (size > file_.size() - at_)
            throw unreadable(where_, file_.size() == kMostHeaderBytes
                                         ? "has a header of more than " + std::to_string(kMostHeaderBytes) +
                                               " bytes, or a malformed one"
                                         : "is truncated: its header runs past the file's end");
    }
    Bytes file_;
    const std::string& where_;
    std::size_t at_ = 0;
};

/// Bytes of a texel in the file: pixel types 0 uint, 1 half, 2 float; subsampled channels count a fraction.
double channel_bytes(Bytes value, const std::string& where) {
    Walk walk(value, where);
    double bytes = 0;
    for (std::string name = walk.name(); !name.empty(); name = walk.name()) {
        const auto type = walk.number<std::int32_t>();
        walk.block(4);
        const auto x = walk.number<std::int32_t>(), y = walk.number<std::int32_t>();
        if (x < 1 || y < 1) throw unreadable(where, "channel '" + name + "' has a sampling below 1");
        bytes += (type == 1 ? 2. : 4.) / x / y;
    }
    return bytes;
}

void take_attribute(const std::string& name, const std::string& type, Bytes value, const std::string& where,
                    Part& part) {
    Walk walk(value, where);
    if (name == "dataWindow" && type == "box2i") {
        const auto x0 = walk.number<std::int32_t>(), y0 = walk.number<std::int32_t>();
        const auto x1 = walk.number<std::int32_t>(), y1 = walk.number<std::int32_t>();
        part.width = std::int64_t{x1} - x0 + 1;
        part.height = std::int64_t{y1} - y0 + 1;
    } else if (name == "channels" && type == "chlist") {
        part.texel_bytes = channel_bytes(value, where);
    } else if (name == "compression" && type == "compression") {
        part.compression = walk.number<std::uint8_t>();
    } else if (name == "tiles" && type == "tiledesc") {
        Part::Tiles tiles;
        tiles.width = walk.number<std::uint32_t>();
        tiles.height = walk.number<std::uint32_t>();
        tiles.mode = walk.number<std::uint8_t>() & 0xF;
        part.tiles = tiles;
    } else if (name == "type" && type == "string") {
        part.type = text_at(value, 0, value.size());
    }
}

/// The next part's header; nothing at the empty one that ends a multi-part file's list.
std::optional<Part> next_part(Walk& walk, const std::string& where) {
    Part part;
    bool empty = true;
    for (std::string name = walk.name(); !name.empty(); name = walk.name()) {
        empty = false;
        const std::string type = walk.name();
        const auto size = walk.number<std::int32_t>();
        if (size < 0) throw unreadable(where, "attribute '" + name + "' has a negative size");
        take_attribute(name, type, walk.block(static_cast<std::size_t>(size)), where, part);
    }
    if (empty) return {};
    return part;
}

double scanlines_in_chunk(int compression) {
    switch (compression) {
        case 3:  // ZIP
        case 5:
            return 16;  // PXR24
        case 4:         // PIZ
        case 6:         // B44
        case 7:         // B44A
        case 8:
            return 32;  // DWAA
        case 9:
            return 256;  // DWAB
        default:
            return 1;
    }
}

/// The largest ratio of raw to stored bytes, 0 where none is known. RLE: two bytes a run of at most 128. ZIP,
/// ZIPS: deflate's 1032; PXR24 first drops a byte of every float's four.
double best_ratio(int compression) {
    switch (compression) {
        case 0:
            return 1;
        case 1:
            return 64;
        case 2:
        case 3:
            return 1032;
        case 5:
            return 1032 * 4 / 3.;
        default:
            return 0;
    }
}

double chunk_count(const Part& part) {
    const double w = static_cast<double>(part.width), h = static_cast<double>(part.height);
    if (!part.tiles) return std::ceil(h / scanlines_in_chunk(part.compression));
    // Of level 0; further levels take at most three times as many again, so the bound holds memory all the
    // same.
    return std::ceil(w / part.tiles->width) * std::ceil(h / part.tiles->height);
}

void check_part(const Part& part, std::uint64_t file_size, const std::string& where,
                const ReadLimits& limits) {
    check_limits(part.width, part.height, kRgbBytes, where, limits);
    const double size = static_cast<double>(file_size);
    const double texels = static_cast<double>(part.width) * static_cast<double>(part.height);
    const double raw_bytes = texels * part.texel_bytes;
    if (part.tiles) {
        // Whole tiles are buffered, however small the picture.
        constexpr double kAlwaysAllowed = 64 << 20;
        const double tile_bytes = part.texel_bytes * part.tiles->width * part.tiles->height;
        if (part.tiles->width < 1 || part.tiles->height < 1 || part.tiles->mode > 2 ||
            tile_bytes > std::max(kAlwaysAllowed, 4 * raw_bytes))
            throw unreadable(where, "has tiles of " + std::to_string(part.tiles->width) + " x " +
                                        std::to_string(part.tiles->height) + " texels");
    }
    double least = chunk_count(part) * kLeastChunkBytes;
    if (const double ratio = best_ratio(part.compression); ratio > 0)
        least = std::max(least, raw_bytes / ratio);
    if (least > size)
        throw unreadable(where, "claims " + std::to_string(part.width) + " x " + std::to_string(part.height) +
                                    " texels, which can't be in the file's " + std::to_string(file_size) +
                                    " bytes: it is truncated or malformed");
}

}  // namespace

void preflight_exr(Bytes head, std::uint64_t size, const std::string& where, const ReadLimits& limits) {
    Walk walk(head, where);
    walk.block(4);  // magic
    const auto version = walk.number<std::uint32_t>();
    if ((version & 0xFF) != 2) throw unreadable(where, "has EXR version " + std::to_string(version & 0xFF));
    const bool multi_part = version & kMultiPartFlag;
    if (!multi_part && (version & kNonImageFlag))
        throw unreadable(where, "holds deep pixels, which are not read");

    bool first = true;
    while (const auto part = next_part(walk, where)) {
        if (first && part->type.starts_with("deep"))
            throw unreadable(where, "holds deep pixels, which are not read");
        if (!multi_part && (version & kTiledFlag) && !part->tiles)
            throw unreadable(where, "is tiled but states no tile size");
        check_part(*part, size, where, limits);
        first = false;
        if (!multi_part) break;
    }
    if (first) throw unreadable(where, "has an empty header");
}

}  // namespace pbrbake::io
