#pragma once
// Legacy specular maps are not f0: they are told by material names and statistics before they are believed.

#include <string>

#include "bakers/texture/maps.hpp"

namespace pbrbake::texture {

/// A word of file names and what surfaces called so reflect at normal incidence, linear Rec. 709.
struct SurfaceWord {
    std::string_view word;
    bool is_metal;
    Colour f0;
};

/// The surface that a path's file name speaks of, or null. Words stand alone or beside digits, '_' and '-'.
const SurfaceWord* surface_word(const std::string& path);

/// What brings diffuse and f0 of a set to scale, a texel at a time.
struct Calibration {
    enum class Kind { none, metal, dielectric, statistics };

    Kind kind = Kind::none;
    std::string surface = "any", word;  ///< what is known about the whole set, and the word that told it
    double scale = 1;                   ///< on f0: of a metal in the mean, else of every texel
    Colour metal{0};                    ///< Kind::metal: f0 of a texel as bright as the mean
    double brightness = 0;              ///< Kind::metal: mean of diffuse + f0 over the set
    double trust = 1;     ///< in what diffuse and f0 tell of metal: 1, or .5 where they are doubtful
    std::string warning;  ///< why specular was scaled, or is doubtful; or ""

    /// The texel as it is converted: f0 at most 1; a metal has no diffuse, and the picture of both maps.
    pbr::Reflected<float> operator()(const pbr::Reflected<float>& texel) const;
};

/// "none", "metal", "dielectric", "statistics".
std::string_view kind_name(Calibration::Kind kind);

/// Finds a set's calibration; looks at all texels where the job asks for one, or where a name contradicts
/// maps that are said to be f0.
Calibration find_calibration(const Sources& sources, Context& context);

/// Which way green points: correlation of d(slope x)/dy with d(slope y)/dx, as if y went up, over up to 512
/// pairs of rows.
/// Slopes of a height field are free of curl, so it is > 0 where green is up, < 0 where it is down; 0 of a
/// flat map.
double green_correlation(const Sources& sources, Context& context);

}  // namespace pbrbake::texture
