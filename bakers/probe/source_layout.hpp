#pragma once
// How a source's pictures make up an environment: an equirect, or a cube map's faces in one picture or six.

#include <string>
#include <vector>

#include "bakers/baker.hpp"
#include "bakers/probe/params.hpp"

namespace pbrbake::probe {

/// What stands in a source's name for px, nx, py, ny, pz and nz, the six faces in our order.
inline constexpr std::string_view kFacePattern = "{face}";

/// The files of a job's source: one, or six where its name has kFacePattern.
std::vector<Read> source_files(const ProbeParams& params);

/// The environment of a job: an equirect, or a cube map of six faces. Its own picture where that is one of
/// these as it is; else `storage`, into which faces are copied. Throws Error(unreadable_input) that names the
/// file, its size and what is allowed.
const SourceImage& environment_source(const ProbeParams& params, const Inputs& inputs, SourceImage& storage);

}  // namespace pbrbake::probe
