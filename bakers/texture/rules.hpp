#pragma once
// Rules by names, over what the job states (schemas/texture_rules.schema.json).

#include <optional>
#include <string>
#include <vector>

#include "bakers/texture/texture.hpp"
#include "pbr/numerics/vector.hpp"

namespace pbrbake::texture {

/// A set as its rules leave it.
struct RuledSet {
    TextureParams params;
    std::optional<pbr::Vec3<float>> f0;  ///< of the surface that a rule states, linear Rec. 709
    std::vector<std::string> matched;    ///< patterns of the rules that were followed
};

/// What tells a set's name: the path of diffuse, else base_color, else specular, else its material's name.
const std::string& name_of_set(const TextureParams& params);

/// Follows every rule that matches, in order; a later one overrides an earlier one. Throws
/// Error(unreadable_input) naming file and pointer for fields and values that no rule has.
RuledSet apply_rules(const TextureParams& params, const Inputs& inputs);

}  // namespace pbrbake::texture
