#pragma once
// Which channel of a set is gloss, and what its values stand for.

#include "bakers/texture/texture.hpp"

namespace pbrbake::texture {

/// Where gloss is, what it is, and why that was taken. Constant gloss is gloss_factor everywhere.
struct GlossReading {
    GlossIn in = GlossIn::none;
    GlossIs is = GlossIs::automatic;  ///< not automatic where there is gloss
    std::string field;                ///< of Inputs; "": none, or constant
    int channel = 0;
    std::string reason;   ///< "stated by gloss_is", "the file's name says rough"
    std::string warning;  ///< of what was assumed; may be ""
};

/// What a map's file name says its values are, by words as of surface_word: rough and roughness, gloss,
/// glossiness, smooth and smoothness; else automatic.
GlossIs gloss_named(const std::string& path);

/// Throws Error where the job states a channel that isn't there.
GlossReading find_gloss(const TextureParams& params, const Inputs& inputs);

}  // namespace pbrbake::texture
