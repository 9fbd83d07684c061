#pragma once
// A look at an EXR's headers before OpenEXR sees them, since it takes memory for whatever they claim.

#include <string>

#include "bakers/io/file_bytes.hpp"
#include "bakers/io/io.hpp"

namespace pbrbake::io {

/// As many of a file's first bytes as are looked at: no header is longer.
inline constexpr std::uint64_t kMostHeaderBytes = std::uint64_t{16} << 20;

/// `head`: the first bytes of a file of `size`, all or kMostHeaderBytes. Throws Error(unreadable_input) for
/// headers that end early, attributes longer than the head, sides or tables
/// over the limits, and pictures that can't fit into the file's bytes at their compression's best
/// ratio.
void preflight_exr(Bytes head, std::uint64_t size, const std::string& where, const ReadLimits& limits);

}  // namespace pbrbake::io
