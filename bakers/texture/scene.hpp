#pragma once
// A glTF document whose materials were baked one by one, put together again.

#include <string>
#include <vector>

#include "bakers/baker.hpp"

namespace pbrbake::texture {

/// Suffix of the document of a baked material that a scene is made of.
inline constexpr const char* kPartDocument = "material.json";

/// Whether a bake as the user wrote it stands for a whole glTF document: its source is one, of which it picks
/// no material, and glTF is what it writes.
bool is_scene(const Json& bake);

/// What a scene reads at first.
std::vector<Read> scene_reads(const Json& bake);

/// Files that stay in use, relative to the source's folder: buffers, and pictures of other materials.
std::vector<Read> scene_files(const Inputs& inputs);

/// Suffixes of the documents that it will write; of "source" alone, what parts there are makes no difference.
std::vector<std::string> scene_documents(const Inputs& inputs);

/// "source" with the k-th specular-glossiness material replaced by the glTF material of "part.k". All else is
/// as it was, but that textures, images and bytes of buffers which nothing uses any more are gone, and that
/// files which stay in use are written beside the document. Throws Error(unreadable_input).
Product bake_scene(const Inputs& inputs, const std::string& product_file);

}  // namespace pbrbake::texture
