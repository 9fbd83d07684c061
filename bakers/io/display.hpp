#pragma once
// What a camera saw, as a display shows it: for pages; nothing here goes into a product.

#include <span>
#include <string_view>

namespace pbrbake::io {

/// RGB triples of linear light in a working space (lin_rec709 | acescg), 1 what saturates the sensor, to
/// values that an sRGB display takes, [0, 1], in place: ACES 1's output transform for SDR video (Academy
/// S-2014-004), as OpenColorIO has it. Throws Error(unreadable_input) where OpenColorIO's module is absent.
void to_display(std::string_view working_space, std::span<float> rgb);

}  // namespace pbrbake::io
