#pragma once
// A glTF 2.0 document, of either form, and the bytes that it embeds.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/baker.hpp"
#include "bakers/parse/diagnostic.hpp"
#include "bakers/parse/json_fields.hpp"

namespace pbrbake::parse {

/// The JSON of a .gltf or .glb, and the chunk that is a .glb's first buffer. A view into the file's bytes.
struct GltfFile {
    Json json;
    std::span<const std::byte> chunk;
    std::vector<Diagnostic> diagnostics;
};

/// Where an image's or a buffer's bytes are: in a file beside the document, or in the document itself.
struct GltfBytes {
    std::string path;                    ///< of the file, with forward slashes; "": own() are the bytes
    std::uint64_t offset = 0, size = 0;  ///< in the file; a size of 0: to its end
    std::vector<std::byte> decoded;      ///< of a data URI
    std::span<const std::byte> chunk;    ///< of GltfFile::chunk

    std::span<const std::byte> own() const { return decoded.empty() ? chunk : decoded; }
};

/// Whether a file is binary glTF by its first bytes.
bool is_binary_gltf(std::span<const std::byte> bytes);

/// Reads JSON text or the binary container (glTF 2.0, 4.4), whichever the bytes are. `bytes` must outlive the
/// result. Throws Error(unreadable_input) for what is malformed.
GltfFile parse_gltf(std::span<const std::byte> bytes, const std::string& file);

/// Whether an image has no file of its own. Throws Error(unreadable_input) for one that has neither a uri nor
/// a bufferView.
bool is_embedded(const JsonFields& image);

/// Where a buffer view lies.
struct GltfView {
    std::size_t buffer;
    std::uint64_t offset, size;  ///< within the buffer's byteLength
};

/// A buffer view. Throws Error(unreadable_input) for one that is not inside its buffer.
GltfView gltf_view(const JsonFields& view, const std::vector<JsonFields>& buffers);

/// A buffer. Throws Error(unreadable_input) for malformed URIs, and for files outside the document's folder.
GltfBytes gltf_buffer(const GltfFile& gltf, std::size_t index, const std::string& file);

/// The picture of an embedded image, a PNG or JPEG. Throws Error(unreadable_input) for other kinds, malformed
/// URIs, and views that leave their buffer.
GltfBytes gltf_picture(const GltfFile& gltf, std::size_t index, const std::string& file);

}  // namespace pbrbake::parse
