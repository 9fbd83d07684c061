#pragma once
// A comparison as a page to look at.

#include <string>

#include "bakers/verify/compare.hpp"

namespace pbrbake::verify {

/// The page (HTML, one file): a line a product, failures first; of the first kMostShown that differ also
/// their figures, and A, B and the difference side by side, of the level that differs most. Reads those
/// products again.
std::string comparison_page(const Comparison& comparison);
inline constexpr std::size_t kMostShown = 8;

}  // namespace pbrbake::verify
