#pragma once
// What a baked set is as a glTF 2.0 material, and the document of that material over the files of a bake.

#include <optional>
#include <set>
#include <string>

#include "bakers/texture/pack.hpp"

namespace pbrbake::texture {

/// {"images": names, "material": a material whose textures are indices of them}. A dielectric f0 beside .04
/// is KHR_materials_specular where it has a texture or a colour, KHR_materials_ior where it is one grey.
/// `factors` is the one texel of a set without pictures. A specular-gloss layout is
/// KHR_materials_pbrSpecularGlossiness, whose factors are 1.
Json gltf_material(const TextureParams& params, const Layout& layout, float specular_unit,
                   const std::optional<Unpacked>& factors);

/// The document of gltf_material's result; its URIs are PNG files beside `file`, "X.gltf".
Json gltf_document(const TextureParams& params, const Json& gltf, const std::string& file);

/// A file's name as a URI reference (RFC 3986, section 3.3): other bytes than unreserved ones as %XX.
std::string uri_of(const std::string& file);

/// Adds the names of the extensions in a value and inside it.
void find_extensions(const Json& json, std::set<std::string>& names);

}  // namespace pbrbake::texture
