#pragma once
// A look at an EXR's headers before OpenEXR sees them, since it takes memory for whatever they claim.

#include <string>

#include "bakers/io/file_bytes.hpp"
#include "bakers/io/io.hpp"

namespace pbrbake::io {

/// Throws Error(unreadable_input) for headers that end early, attributes longer than the file, sides or
/// tables over the limits, and pictures that can't fit into the file's bytes at their compression's best
/// ratio.
void preflight_exr(Bytes file, const std::string& where, const ReadLimits& limits);

}  // namespace pbrbake::io
