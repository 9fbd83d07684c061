#pragma once
// What an ICC profile says, as far as it is asked.

#include <string>

#include "bakers/io/file_bytes.hpp"

namespace pbrbake::io {

/// Whether a profile (ICC.1:2022) is sRGB's: by its primaries, adapted to D50, and its curves, within .002
/// and .004; a grey one by its curve; one that has neither, or is malformed, by its description. An empty one
/// isn't.
bool is_srgb_profile(Bytes profile, const std::string& description);

}  // namespace pbrbake::io
