#pragma once
// manifest.json: what lies in a job's output folder.

#include <filesystem>
#include <span>

#include "bakers/run/run.hpp"

namespace pbrbake::run {

std::filesystem::path manifest_file(const job::Job& job);

/// Writes the manifest of a job whose bakes were tried as `reports` say. An entry of the manifest that is
/// there is kept if its bake was not tried, is still in the job unchanged, and its files are those that it
/// lists. Writes nothing, and returns false, if there is nothing to list and no manifest to bring up to date.
/// Throws Error(unwritable_output).
bool write_manifest(const job::Job& job, std::span<const BakeReport> reports);

}  // namespace pbrbake::run
