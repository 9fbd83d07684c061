#pragma once
// Whether a PBR texture set stays within what surfaces are known to reflect.

#include <filesystem>
#include <string>
#include <vector>

#include "bakers/baker.hpp"

namespace pbrbake::verify {

/// One physical range held against the texels that it speaks of.
struct RangeCheck {
    std::string what;    ///< "dielectric base colour, sRGB": of luminance, 0 to 255; 30 characters at most
    std::string source;  ///< where the range is from
    double lowest = 0, highest = 0;
    double texels = 0;            ///< share of all texels that it speaks of
    double below = 0, above = 0;  ///< shares of all texels
};

/// The ranges held against the largest level of a set that the texture baker made. Empty for any other
/// record. Reads the set's images from the folder of `file`; throws Error(unreadable_input) where one is
/// gone.
std::vector<RangeCheck> check_ranges(const std::filesystem::path& file, const Json& record);

}  // namespace pbrbake::verify
