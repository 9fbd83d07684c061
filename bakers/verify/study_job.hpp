#pragma once
// One bake as a job of its own.

#include <filesystem>
#include <string>

#include "bakers/job/job.hpp"

namespace pbrbake::verify {

/// A job that bakes `bake` (a job's, without name) into folder/name.ext, by the door that one-shot commands
/// come in by: paths are trusted. `around` holds what a job has besides bakes (working_space, limits), or
/// nothing. Throws job::JobError.
job::Job single_bake_job(const Json& around, Json bake, const std::string& name,
                         const std::filesystem::path& folder);

/// A bake as reports show it: of absolute paths the file's name alone.
Json without_folders(Json bake);

/// A bake with some properties replaced; null ones are left to the schema's defaults.
Json with_overrides(Json bake, const Json& overrides);

}  // namespace pbrbake::verify
