#pragma once
// The light that goes with a texture: what a renderer sets its intensity, shape and colour from.

#include "bakers/ies/profile.hpp"

namespace pbrbake::ies {

/// X.light.json; schemas/light_profile.schema.json describes it. `source` is the file's name without its
/// folder.
Json light_json(const IesParams& params, const Luminaire& luminaire, const std::string& source);

/// A glTF document with one node that carries the light as EXT_lights_ies, the profile embedded as LM-63. The
/// node's rotation holds `aim` and rotate_deg; a lumen override is the multiplier. A squash can't be said
/// there.
Json gltf_json(const IesParams& params, const Luminaire& luminaire, const std::string& source);

/// The colour temperature that the file tells, K; nothing if it doesn't.
std::optional<double> colour_temperature_k(const parse::PhotometricFile& file, std::size_t lamp_set);

}  // namespace pbrbake::ies
