#pragma once
// A light's numbers made sound: what is negative, zero or out of order becomes what was meant, with a flag.

#include <string>
#include <vector>

#include "bakers/parse/lights.hpp"

namespace pbrbake::light {

/// Adds a flag of a light.
void flag(std::vector<parse::Diagnostic>& flags, parse::Severity severity, std::string code, int line,
          std::string message);

/// Negative coefficients become 0, all three 0 stay the constant 1 that they count as, a range below 0 is 0.
void clean_falloff(pbr::Falloff& law, int line, std::vector<parse::Diagnostic>& flags);

/// An inner angle beyond the outer one becomes the outer one, a hard edge. Half-angles below 0 become 0.
/// False where the cone is open to all directions: then it is no spot.
bool clean_spot(pbr::SpotFalloff& spot, int line, std::vector<parse::Diagnostic>& flags);

}  // namespace pbrbake::light
