#pragma once
// What a set's record and its material file say.

#include "bakers/texture/convert.hpp"
#include "bakers/texture/pack.hpp"

namespace pbrbake::texture {

/// "set" of the record: what was found out, and how to read the images.
Json properties_json(const TextureParams& params, const Layout& layout, const Survey& survey,
                     const Findings& findings, const Sources& sources, float specular_unit);

/// NAME.material.json: a glTF material for packing gltf and specular_gloss (its texture indices are those of
/// "images"), else a list of what each channel holds.
Json material_json(const TextureParams& params, const Layout& layout, float specular_unit);

}  // namespace pbrbake::texture
