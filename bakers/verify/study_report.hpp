#pragma once
// A study as one HTML page: plots with hover, tables, pictures, how to repeat it.

#include <string>

#include "bakers/verify/study_pictures.hpp"

namespace pbrbake::verify {

/// The page: one file, nothing from a network. `command` is what to type to make it again.
std::string study_page(const Study& study, const PictureBook& pictures, const std::string& command);

}  // namespace pbrbake::verify
