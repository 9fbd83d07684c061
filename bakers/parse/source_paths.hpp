#pragma once
// Paths that a source names: which of them may be followed.

#include <optional>
#include <string>
#include <string_view>

namespace pbrbake::parse {

/// Why a map's path doesn't name a picture in the tree of its file's folder, in words; nothing if it does: a
/// downloaded file must not choose what is read.
std::optional<std::string> path_refusal(const std::string& path);

/// A URI reference as a path: "%20" is a blank.
std::string path_of_uri(std::string_view uri);

}  // namespace pbrbake::parse
