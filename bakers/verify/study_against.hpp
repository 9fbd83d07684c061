#pragma once
// Whether two studies agree.

#include <string>

#include "bakers/baker.hpp"

namespace pbrbake::verify {

/// How the ratios of time of two studies' documents (study_json) differ, as a line for people: how many
/// settings both have, how many of them agree within `most`, and where they are furthest apart. Settings are
/// paired by case, series and step; bases, which are 1 in both, don't count.
std::string ratio_agreement(const Json& now, const Json& before, double most);

}  // namespace pbrbake::verify
