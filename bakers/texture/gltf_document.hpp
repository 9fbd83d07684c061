#pragma once
// NAME.material.gltf: a glTF 2.0 document of one material over the files that a bake writes.

#include "bakers/parse/materials.hpp"

namespace pbrbake::texture {

/// `gltf` is that of material_json: names of images, and a material whose textures are indices of them. URIs
/// are the files' names beside `first_file`, a PNG. What `source` says of opacity, emission and sides goes
/// into the material; null: nothing.
Json gltf_document(const Json& gltf, const std::string& first_file, const parse::LegacyMaterial* source);

}  // namespace pbrbake::texture
