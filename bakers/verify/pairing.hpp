#pragma once
// Which product of A is to be held against which of B.

#include <filesystem>
#include <string>
#include <vector>

#include "bakers/baker.hpp"

namespace pbrbake::verify {

/// A file of a product in a folder, manifest or record.
struct ListedFile {
    std::string name;  ///< relative to the folder: "probes/room.ktx2"
    std::filesystem::path path;
    Json entry;              ///< its product's record; null without one
};

/// Two files, one of which may be missing (an empty path).
struct Pair {
    std::string name;
    std::filesystem::path a, b;
    Json entry_a, entry_b;  ///< records; null without one
    std::string note;       ///< why files of different names are held together; else ""
};

/// Pairs of two product files, or of two sets: folders (searched with all below), manifests and records in
/// any mixture. A folder's files are those its manifests list, and where there is none, all with a product's
/// extension and what their records list. Files of sets are paired by name, else by the bake's name, else by
/// what was baked (kind and parameters, if no two are alike); the rest is missing on one side. Sorted by
/// name. Throws Error(unreadable_input) for what isn't there or is no manifest or record, Error(usage) for a
/// file against a set.
std::vector<Pair> pairs_of(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace pbrbake::verify
