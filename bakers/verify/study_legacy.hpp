#pragma once
// The suite's cases of legacy textures and lights.

#include "bakers/verify/study.hpp"

namespace pbrbake::verify {

/// Conversions of generated texture sets and of lights with old falloffs; their sources are written into
/// `folder`, which must exist.
std::vector<StudyCase> legacy_cases(Depth depth, const std::filesystem::path& folder);

/// What can be tried on a texture bake (a job's): storage, the solver's options, and of a Phong lobe the
/// fits.
std::vector<Series> texture_series(const Json& bake);

}  // namespace pbrbake::verify
