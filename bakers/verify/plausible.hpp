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

/// The ranges held against the largest level of a set that the texture baker made, of any packing. Empty for
/// any other record, and for materials without pictures. Reads the set's images from the folder of `file`;
/// throws Error(unreadable_input) where one is gone.
std::vector<RangeCheck> check_ranges(const std::filesystem::path& file, const Json& record);

/// Pictures that make a set, whoever made them; "": none. Colours are decoded as the files tell, else as sRGB
/// where they are of 8 bits; metallic as it is stored. Those of other sizes are read at the nearest texel.
struct SetFiles {
    std::filesystem::path base_color, metallic_roughness, metallic;  ///< glTF's blue; red
    std::filesystem::path diffuse, specular;                         ///< of specular-gloss; f0

    bool is_specular_gloss() const { return !specular.empty(); }
    bool is_set() const { return is_specular_gloss() || !metallic_roughness.empty() || !metallic.empty(); }
};

/// The ranges held against such a set: diffuse and specular, or base_color and one of the masks. Throws
/// Error(unreadable_input).
std::vector<RangeCheck> check_ranges(const SetFiles& files);

}  // namespace pbrbake::verify
