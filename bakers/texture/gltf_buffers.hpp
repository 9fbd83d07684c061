#pragma once
// Buffers of a glTF document, cut down to what its buffer views cover.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bakers/baker.hpp"

namespace pbrbake::texture {

/// The members called "bufferView" of a document but for those in extras, whoever has them: accessors, images
/// and extensions.
std::vector<Json*> view_users(Json& document);

/// Whether view_users knows all that refers to the bytes of a document: there is no extension but those known
/// to name views so, or to name none.
bool names_views_plainly(const Json& document);

/// Bytes of a buffer that stay, and where they go.
struct Stretch {
    std::uint64_t from, to, size;
};

/// What the views of a buffer cover, in order and without overlaps, moved together. Each stretch moves by a
/// multiple of 8 bytes, so that what was aligned to its component (glTF 2.0, 3.6.2.4) still is. Throws
/// Error(unreadable_input) for views beyond their buffers.
std::vector<Stretch> covered_stretches(const Json& document, std::size_t buffer, const std::string& file);

/// Has a document's buffer and its views describe the stretches alone.
void describe_stretches(const std::vector<Stretch>& stretches, std::size_t buffer, Json& document);

/// The bytes of the stretches, with 0 between them. `bytes` reaches as far as they do.
std::string stretch_bytes(const std::vector<Stretch>& stretches, std::span<const std::byte> bytes);

}  // namespace pbrbake::texture
