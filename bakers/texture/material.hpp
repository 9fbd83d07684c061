#pragma once
// What a set's record and its material file say.

#include "bakers/texture/convert.hpp"
#include "bakers/texture/pack.hpp"

namespace pbrbake::texture {

/// "set" of the record: what was found out, and how to read the images.
Json properties_json(const TextureParams& params, const Layout& layout, const Survey& survey,
                     const Findings& findings, const Sources& sources, float specular_unit);

/// NAME.material.json, schemas/material.schema.json: what each channel holds, or the factors of a set without
/// pictures; what the renderer applies besides; and with packing gltf and specular_gloss the glTF material.
Json material_json(const TextureParams& params, const Layout& layout, float specular_unit,
                   const std::optional<Unpacked>& factors);

/// "factors" of a record, and back.
Json factors_json(const Unpacked& factors);
Unpacked factors_from(const Json& json, const Layout& layout);

}  // namespace pbrbake::texture
