#pragma once
// From a photometric file to the web of candela that it describes.

#include <string_view>

#include "bakers/parse/photometry.hpp"

namespace pbrbake::parse {

/// Throws malformed() unless the angles of a parsed file ascend strictly, lie in their type's ranges and span
/// a solid angle. Called by the parsers.
void check_angles(const PhotometricFile& file, std::string_view name, int vertical_line, int horizontal_line);

/// What the horizontal angles stand for; `diagnostics` is told of open rings and of spans that no format
/// allows.
pbr::HorizontalCover horizontal_cover(const PhotometricFile& file, std::vector<Diagnostic>& diagnostics);

/// Candela a unit of `values`. LM-63: multiplier x ballast factor, and field 12 up to 1991 alone. EULUMDAT:
/// flux of lamp set `lamp_set` (from 0) / 1000 x conversion factor.
double candela_scale(const PhotometricFile& file, std::size_t lamp_set = 0);

/// Lamp flux that the file declares, lm; nothing for absolute photometry.
std::optional<double> declared_flux_lm(const PhotometricFile& file, std::size_t lamp_set = 0);

/// Electrical power, W.
double watts(const PhotometricFile& file, std::size_t lamp_set = 0);

/// The web in candela. Negative intensities become 0, and are diagnosed.
pbr::PhotometricWeb make_web(const PhotometricFile& file, std::size_t lamp_set,
                             std::vector<Diagnostic>& diagnostics);

/// The factor of a tilt table at an angle: linear between its angles, its ends beyond them.
double tilt_factor(const TiltTable& table, double deg);

/// The luminous opening, metres. LM-63's length and EULUMDAT's width lie along C0, the others along C90: that
/// is the standards' habit, not every maker's.
struct LuminousOpening {
    std::string_view shape =
        "point";  ///< point, rectangle, box, disk, ellipse, cylinder, sphere, ellipsoid, …
    double along_c0_m = 0, along_c90_m = 0, height_m = 0;
};

/// Decodes signs and zeros of the dimensions by the file's edition.
LuminousOpening luminous_opening(const PhotometricFile& file);

}  // namespace pbrbake::parse
