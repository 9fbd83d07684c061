#pragma once
// Light is neither negative nor infinite: the two halves of the rule in image.hpp, before and after colour
// conversion.

#include <span>

#include "bakers/image.hpp"

namespace pbrbake::io {

/// NaN and -Inf become 0, +Inf what `infinity` says: the largest finite value of its channel (0 if that is
/// negative or there is none), or the largest float. `rgb` holds triples. Adds to repairs.non_finite.
void repair_non_finite(std::span<float> rgb, Repairs& repairs, Infinity infinity = Infinity::peak);

/// Negative channels become 0; adds to repairs.negative and lowers repairs.lowest. `rgb` must be finite.
void repair_negative(std::span<float> rgb, Repairs& repairs);

}  // namespace pbrbake::io
