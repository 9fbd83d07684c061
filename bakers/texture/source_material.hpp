#pragma once
// `source`: a material of another format, or the base name of pictures, that fills in a set's fields.

#include "bakers/parse/materials.hpp"
#include "bakers/texture/texture.hpp"

namespace pbrbake::texture {

/// The material that a set's source file holds; nothing where the set has no source, or a base name.
std::optional<parse::LegacyMaterial> source_material(const TextureParams& params, const Inputs& inputs);

/// What was tolerated in that material, with its file and line.
std::vector<std::string> source_warnings(const TextureParams& params, const Inputs& inputs);

/// The parameters once the pictures are known: a gloss in the alpha of a picture that has none is 1. Throws
/// Error(unreadable_input) for a normal map that is grey, so a height map.
TextureParams settled(const TextureParams& params, const Inputs& inputs);

}  // namespace pbrbake::texture
