#pragma once
// A profile to look at: SVG, and a page of its own. Coordinates have two digits, and no C library function
// that differs between machines is in them: the same bytes everywhere.

#include "bakers/ies/profile.hpp"

namespace pbrbake::ies {

/// Intensity in the planes C0-C180 and C90-C270, nadir below.
std::string polar_svg(const Profile& profile);

/// Both hemispheres as seen along the axis, equal areas for equal solid angles, intensity as lightness.
std::string sphere_svg(const Profile& profile);

/// Figures, diagnostics and both pictures in one self-contained file.
std::string page_html(const IesParams& params, const Luminaire& luminaire, const std::string& source);

}  // namespace pbrbake::ies
