#pragma once
// JSON text to values and back, strictly: no comments, no duplicate keys, bounded size and depth.

#include <filesystem>
#include <string>
#include <string_view>

#include "bakers/baker.hpp"

namespace pbrbake::job {

/// Bounds on a JSON text, so that hostile files end early.
inline constexpr std::size_t kLargestText = std::size_t{16} << 20;  ///< bytes
inline constexpr int kDeepestNesting = 32;
/// Of a source, which may embed pictures; as io's kMaxTextBytes.
inline constexpr std::size_t kLargestSource = std::size_t{512} << 20;

/// Throws Error(invalid_job, "file:line:column", …), or "file#pointer" for a key given twice.
Json parse_json(std::string_view text, const std::string& file, int deepest = kDeepestNesting);

/// A file's bytes. Throws Error(unreadable_input) naming it if it is absent, not a file, or larger than
/// `largest` bytes.
std::string read_text(const std::filesystem::path& file, std::size_t largest = kLargestText);

/// Two spaces an indent and a newline at the end; strings that aren't UTF-8 get replacement characters.
std::string to_text(const Json& value);
/// The same on one line, without the newline.
std::string to_line(const Json& value);

}  // namespace pbrbake::job
