#pragma once
// What two certificates of the same bake say of it.

#include <string>

#include "bakers/baker.hpp"

namespace pbrbake::verify {

/// The first figure that the certificates of two records don't agree on, in words, or "". Figures are paired
/// by metric, level and evidence; what one certificate alone holds is not compared. Two values agree if their
/// distance is within `most` of the larger one, or both are below 1e-6. Nothing is said of records of
/// different kind, parameters, or inputs: other bakes have other errors.
std::string certificate_difference(const Json& a, const Json& b, double most);

}  // namespace pbrbake::verify
