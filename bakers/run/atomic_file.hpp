#pragma once
// Files that are old, new or absent, never torn.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace pbrbake::run {

/// Writes a file under a unique temporary name beside it (".X.ext.<pid>-<n>.tmp"), flushes it to disk, and
/// renames it into place; then flushes the folder. Makes the folder if it is absent. The temporary is removed
/// on failure. Where the file system knows files without a name (Linux's O_TMPFILE), it gets that name once
/// it is complete, and a killed process leaves nothing behind; elsewhere it may leave a temporary, which may
/// be deleted. Throws Error(unwritable_output) naming the file and the step that failed.
void write_atomically(const std::filesystem::path& file, std::span<const std::byte> bytes);
void write_atomically(const std::filesystem::path& file, std::string_view text);

}  // namespace pbrbake::run
