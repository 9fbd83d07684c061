#pragma once
// Colour spaces by name, and conversion to the working space.

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "bakers/io/encoding.hpp"

namespace pbrbake::io {

/// The encoding that a name of colour_spaces() stands for; nothing for "auto", "raw" and unknown names.
std::optional<Encoding> encoding_named(std::string_view name);

/// The name of an encoding: one of colour_spaces(), "g1.95_p3d65" of an unnamed power curve, or
/// "chromaticities".
std::string name_of(const Encoding& encoding);

/// The linear encoding with these primaries: a named gamut's when all lie within 5e-4 of it, else
/// Gamut::custom. Throws Error(unreadable_input) on `where` for primaries that span no gamut.
Encoding linear_with(const Chromaticities& primaries, const std::string& where);

/// The gamut of a working space, nothing for names that are none.
std::optional<Gamut> working_gamut(std::string_view name);

/// The chromaticities of a gamut other than Gamut::custom.
const Chromaticities& chromaticities_of(Gamut gamut);

/// RGB triples to linear light in `working`, in place. Equal spaces cost nothing and load no module.
void convert(const Encoding& from, Gamut working, std::span<float> rgb, const std::string& where);

}  // namespace pbrbake::io
