#pragma once
// A luminaire as it hangs in the light's own frame: its web, turned, squashed and scaled as the bake asks.
//
// The light's frame here is that of pbr/light/photometric_web.hpp: it looks down -z, x to the right, y up. An
// aim of -y only changes where a cube map's axes lie and what the record says of directions.

#include <optional>

#include "bakers/ies/params.hpp"
#include "bakers/parse/photometry.hpp"
#include "pbr/light/photometric_web.hpp"

namespace pbrbake::ies {

/// Intensity over polar angle (from the axis) and azimuth (from x towards y), both in degrees.
class Profile {
  public:
    /// `rotate_deg` turns the light about its axis, x towards y.
    Profile(pbr::PhotometricWeb web, double rotate_deg);

    /// The web in the light's frame. Types A and B: before the rotation, which sample() applies.
    const pbr::PhotometricWeb& web() const { return web_; }
    /// Whether the web is type C, so that its angles are the light's own.
    bool is_polar() const { return web_.type() == pbr::Photometry::type_c; }

    /// Intensity, cd. On the rim of the measured range, the mean of both sides: a texture that interpolates
    /// then has the right flux to second order.
    double sample_cd(double polar_deg, double azimuth_deg) const;
    /// The same in a direction of any length but 0.
    double sample_cd(const pbr::Vec3<double>& direction) const;

    /// The share of its light that sample_cd() gives at a polar angle: half on the rim of type C's vertical
    /// range, where that doesn't end in a pole, else all.
    double rim_share(double polar_deg) const;

    /// The largest polar angle that has light, degrees.
    double lit_polar_deg() const;
    /// The largest intensity within a polar angle, cd, of the web's grid points.
    double max_within_cd(double polar_deg) const;

  private:
    pbr::PhotometricWeb web_;
    double rotate_deg_;  ///< of types A and B
};

/// What a bake is of: the parsed file, what it said, and its profile.
struct Luminaire {
    parse::PhotometricFile file;
    std::vector<parse::Diagnostic> diagnostics;
    pbr::PhotometricWeb filed;  ///< candela as the file has them
    Profile profile;            ///< as baked
    double lumen_factor = 1;    ///< profile's candela over the file's: lumens override, tilt
};

/// Reads the bake's inputs. Throws Error(unreadable_input) for malformed files.
Luminaire read_luminaire(const IesParams& params, const Inputs& inputs);

/// Unit vector of the light's frame.
pbr::Vec3<double> direction_of(double polar_deg, double azimuth_deg);

}  // namespace pbrbake::ies
