#pragma once
// Words for messages: lists, and "did you mean …?".

#include <string>
#include <string_view>
#include <vector>

namespace pbrbake::job {

/// The words with the separator between them.
std::string joined(const std::vector<std::string>& words, std::string_view separator = ", ");

/// The candidate nearest to `word` by edit distance, or "" if none is near: more than a third of the letters
/// differ.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// `; did you mean "size"?`, or "" if no candidate is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace pbrbake::job
