// glTF 2.0: 3.6.1 "Buffers and Buffer Views", 3.8.4 "Images", 4.4 "Binary glTF Layout"; RFC 2397 for data
// URIs.

#include "bakers/parse/gltf_file.hpp"

#include <algorithm>
#include <optional>

#include "bakers/parse/base64.hpp"
#include "bakers/parse/source_paths.hpp"
#include "bakers/parse/text.hpp"

namespace pbrbake::parse {
namespace {

constexpr std::string_view kMagic = "glTF";

/// The chunks of a binary glTF, one after the other.
class Chunks {
  public:
    Chunks(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {
        constexpr std::size_t kHeader = 12;
        constexpr std::uint32_t kVersion = 2;
        if (bytes_.size() < kHeader) refuse("is cut short in its header");
        if (word(4) != kVersion)
            refuse("is of version " + std::to_string(word(4)) + "; allowed: " + std::to_string(kVersion));
        if (word(8) > bytes_.size() || word(8) < kHeader) refuse_claim(word(8), bytes_.size(), "in all");
        bytes_ = bytes_.substr(0, word(8));
        at_ = kHeader;
    }

    /// The next chunk, if it is of the type; else it stays the next one.
    std::optional<std::string_view> next(std::string_view type) {
        constexpr std::size_t kHeader = 8;
        if (at_ == bytes_.size()) return {};
        if (bytes_.size() - at_ < kHeader) refuse("is cut short in the header of a chunk");
        if (bytes_.substr(at_ + 4, 4) != type) return {};
        const std::size_t size = word(at_), left = bytes_.size() - at_ - kHeader;
        if (size > left) refuse_claim(size, left, "of " + std::string(type.substr(0, type.find('\0'))));
        const std::string_view chunk = bytes_.substr(at_ + kHeader, size);
        at_ += kHeader + size;
        return chunk;
    }

    [[noreturn]] void refuse(const std::string& why) const {
        throw malformed(file_, 0, "is a binary glTF that " + why);
    }

  private:
    [[noreturn]] void refuse_claim(std::size_t claimed, std::size_t left, const std::string& of) const {
        refuse("claims " + std::to_string(claimed) + " bytes " + of + ", but has " + std::to_string(left));
    }

    std::uint32_t word(std::size_t at) const {
        std::uint32_t value = 0;
        for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes_[at + i]);
        return value;
    }

    std::string_view bytes_;
    std::size_t at_ = 0;
    const std::string& file_;
};

/// "image/png" and the payload of "data:image/png;base64,…".
struct DataUri {
    std::string_view type, payload;
};

DataUri data_uri(std::string_view uri, const JsonFields& owner) {
    const std::size_t comma = uri.find(',');
    std::string_view head = uri.substr(0, comma);
    if (comma == uri.npos || !head.ends_with(";base64"))
        throw malformed(owner.place() + "/uri", 0,
                        "found " + quoted(uri) + "; allowed: \"data:TYPE;base64,…\"");
    head.remove_prefix(std::string_view("data:").size());
    return {head.substr(0, head.find(';')), uri.substr(comma + 1)};
}

/// A file that a document names: its path, if that stays in the folder.
std::string file_of(const std::string& uri, const JsonFields& owner) {
    std::string path = path_of_uri(uri);
    if (const auto refusal = path_refusal(path))
        throw malformed(owner.place() + "/uri", 0, parse::quoted(path) + " " + *refusal);
    return path;
}

const JsonFields& element(const std::vector<JsonFields>& list, std::size_t index, const char* what,
                          const std::string& file) {
    if (index >= list.size())
        throw malformed(file, 0,
                        "has " + std::to_string(list.size()) + " " + what + ", and none of index " +
                            std::to_string(index));
    return list[index];
}

void check_type(std::string_view type, const std::string& place) {
    if (type != "image/png" && type != "image/jpeg")
        throw malformed(place, 0, "found " + quoted(type) + "; allowed: image/png, image/jpeg");
}

std::uint64_t bytes_of(const JsonFields& fields, const char* key, std::uint64_t least) {
    if (!fields.has(key) && least == 0) return 0;
    const Json* value = fields.has(key) ? &fields.json()[key] : nullptr;
    if (!value || !value->is_number_unsigned() || value->get<std::uint64_t>() < least)
        fields.refuse(key, "a whole number from " + std::to_string(least) + " on");
    return value->get<std::uint64_t>();
}

/// The part of a buffer that a view is.
GltfBytes view_bytes(const GltfFile& gltf, const GltfView& view, const std::string& file) {
    GltfBytes bytes = gltf_buffer(gltf, view.buffer, file);
    bytes.offset = view.offset;
    bytes.size = view.size;
    const std::span<const std::byte> own = bytes.own();
    if (!own.empty()) {
        const auto part =
            own.subspan(static_cast<std::size_t>(view.offset), static_cast<std::size_t>(view.size));
        if (bytes.decoded.empty())
            bytes.chunk = part;
        else
            bytes.decoded = {part.begin(), part.end()};
    }
    return bytes;
}

}  // namespace

bool is_binary_gltf(std::span<const std::byte> bytes) {
    return std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()).starts_with(kMagic);
}

GltfFile parse_gltf(std::span<const std::byte> bytes, const std::string& file) {
    GltfFile gltf;
    if (!is_binary_gltf(bytes)) {
        gltf.json = parse_json_source(decode_text(bytes, file, gltf.diagnostics), file);
        return gltf;
    }
    using namespace std::string_view_literals;
    Chunks chunks({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file);
    const auto json = chunks.next("JSON"sv);
    if (!json) chunks.refuse("doesn't begin with a chunk of JSON");
    gltf.json = parse_json_source(*json, file);
    if (const auto chunk = chunks.next("BIN\0"sv)) gltf.chunk = std::as_bytes(std::span(*chunk));
    return gltf;
}

bool is_embedded(const JsonFields& image) {
    if (image.has("bufferView")) return true;
    const std::string uri = image.text({"uri"}, "");
    if (uri.empty()) image.refuse("uri", "a picture's file or data, or a bufferView in its place");
    return uri.starts_with("data:");
}

GltfView gltf_view(const JsonFields& view, const std::vector<JsonFields>& buffers) {
    const auto buffer = view.index("buffer", buffers.size());
    if (!buffer) view.refuse("buffer", "the index of a buffer");
    const std::uint64_t offset = bytes_of(view, "byteOffset", 0), size = bytes_of(view, "byteLength", 1),
                        whole = bytes_of(buffers[*buffer], "byteLength", 1);
    if (offset > whole || size > whole - offset)
        throw malformed(view.place(), 0,
                        "found bytes " + std::to_string(offset) + " to " + std::to_string(offset) + " + " +
                            std::to_string(size) + "; its buffer has " + std::to_string(whole));
    return {*buffer, offset, size};
}

GltfBytes gltf_buffer(const GltfFile& gltf, std::size_t index, const std::string& file) {
    const std::vector<JsonFields> buffers = JsonFields(gltf.json, file).objects("buffers");
    const JsonFields& buffer = element(buffers, index, "buffers", file);
    const std::uint64_t size = bytes_of(buffer, "byteLength", 1);
    const std::string uri = buffer.text({"uri"}, "");
    if (!uri.empty() && !uri.starts_with("data:")) return {file_of(uri, buffer), 0, size, {}, {}};
    GltfBytes bytes;
    if (!uri.empty())
        bytes.decoded = decode_base64(data_uri(uri, buffer).payload, buffer.place() + "/uri");
    else if (index == 0)
        bytes.chunk = gltf.chunk;
    const std::size_t held = bytes.own().size();
    if (held < size)
        throw malformed(buffer.place(), 0,
                        "claims " + std::to_string(size) + " bytes, but has " + std::to_string(held));
    bytes.decoded.resize(std::min(bytes.decoded.size(), static_cast<std::size_t>(size)));
    bytes.chunk = bytes.chunk.first(std::min(bytes.chunk.size(), static_cast<std::size_t>(size)));
    return bytes;
}

GltfBytes gltf_picture(const GltfFile& gltf, std::size_t index, const std::string& file) {
    const JsonFields root(gltf.json, file);
    const std::vector<JsonFields> images = root.objects("images");
    const JsonFields& image = element(images, index, "images", file);
    if (image.has("bufferView")) {
        const std::vector<JsonFields> views = root.objects("bufferViews");
        const std::size_t view = *image.index("bufferView", views.size());
        check_type(image.text({"mimeType"}, ""), image.place() + "/mimeType");
        return view_bytes(gltf, gltf_view(views[view], root.objects("buffers")), file);
    }
    const std::string uri = image.text({"uri"}, "");
    if (!is_embedded(image)) return {file_of(uri, image), 0, 0, {}, {}};
    const DataUri data = data_uri(uri, image);
    check_type(data.type, image.place() + "/uri");
    return {"", 0, 0, decode_base64(data.payload, image.place() + "/uri"), {}};
}

}  // namespace pbrbake::parse
