#pragma once
// What file names tell.

#include <string>
#include <string_view>
#include <vector>

namespace pbrbake::texture {

/// The words of a path's file name in lower case: runs of letters, parted by digits, '_', '-' and the rest.
std::vector<std::string> words_of(const std::string& path);

/// Whether a pattern fits a whole path, upper and lower case alike: '*' is any run of characters, '?' any
/// one. A pattern without '/' is held against the file name alone.
bool matches(std::string_view pattern, std::string_view path);

}  // namespace pbrbake::texture
