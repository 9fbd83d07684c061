#pragma once
// A study as one HTML page: plots with hover, tables, pictures, how to repeat it.

#include <string>

#include "bakers/verify/study_pictures.hpp"

namespace pbrbake::verify {

/// The page: one file, nothing from a network. `command` is what to type to make it again.
/// `more` is HTML that goes before the account of the method: effects_html, or nothing.
std::string study_page(const Study& study, const PictureBook& pictures, const std::string& command,
                       const std::string& more);

}  // namespace pbrbake::verify
