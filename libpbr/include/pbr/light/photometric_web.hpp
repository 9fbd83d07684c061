#pragma once
// A luminaire's photometric web: luminous intensity over a grid of angles, as goniophotometers measure it.
//
// The luminaire's frame is right-handed. -z is the photometric axis: the nadir of type C, straight ahead of
// types A and B. +x is C0, or H = +90; +y is C90, or V = +90. So a lamp that looks down a viewer's -z with y
// up shows H to the right and V upwards, and C runs anticlockwise as seen from above (from +z).
//
//     type C   vertical g in [0, 180] from the nadir, horizontal C about the axis:
//              (sin g cos C, sin g sin C, -cos g)
//     type A   H about the vertical axis y, V the elevation:   (cos V sin H, sin V, -cos V cos H)
//     type B   V about the sideways axis x, H the elevation:   (sin H, cos H sin V, -cos H cos V)
//
// (IES LM-75-01 for the three types; ANSI/IES LM-63-19, section 5, for their use in files.) All angles are in
// degrees, as files have them. Between grid points intensity is bilinear in the two angles; outside the
// measured range it is zero, neither clamped nor extrapolated.

#include <vector>

#include "pbr/numerics/vector.hpp"

namespace pbr {

/// The three spherical coordinate systems of photometry.
enum class Photometry { type_a, type_b, type_c };

/// What the horizontal angles stand for.
enum class HorizontalCover {
    axial,     ///< type C, one angle: the same in every half-plane
    mirrored,  ///< type C: mirrored in the planes of the first and last angle, which lie 90 or 180 apart;
               ///< types A, B: the first angle is 0, and H stands for |H|
    ring,   ///< type C: a full turn, its last angle 360 after its first, or less and then closed by wrapping
    range,  ///< nothing outside first to last angle
};

/// Two rules that turn a grid of intensities into lumens.
enum class FluxRule {
    exact,  ///< the integral of the bilinear web
    zonal,  ///< mean of a cell's corners times its solid angle (IES LM-41's zonal method): what photometric
            ///< reports print
};

/// Vertical and horizontal angle.
struct PhotometricAngles {
    double vertical_deg;
    double horizontal_deg;
};

/// Angles of a direction of any length but 0 in the luminaire's frame: C in [0, 360), others in [-180, 180].
/// On a polar axis the angle about it is 0. Absolute error <= 1e-13 degrees.
PhotometricAngles photometric_angles(Photometry type, const Vec3<double>& direction);

/// The inverse: a unit vector within 5e-16.
Vec3<double> photometric_direction(Photometry type, const PhotometricAngles& angles);

/// Where an angle lies in a grid: between `lower` and `upper`, `fraction` of the way; outside, lower is -1.
struct GridPlace {
    int lower = -1;
    int upper = -1;
    double fraction = 0;
    /// Whether the angle was measured.
    bool is_inside() const { return lower >= 0; }
};

/// The web. A value type; all methods are pure.
class PhotometricWeb {
  public:
    /// Angles ascend strictly; `candela_cd` holds the vertical run of the first horizontal angle, then of the
    /// second, and so on: one finite number a pair. Vertical lies in [0, 180] for type C, and the angle that
    /// is an elevation in [-90, 90] for types A and B; no list spans more than 360. Asserted.
    PhotometricWeb(Photometry type, HorizontalCover cover, std::vector<double> vertical_deg,
                   std::vector<double> horizontal_deg, std::vector<double> candela_cd);

    /// The coordinate system.
    Photometry type() const { return type_; }
    /// What the horizontal angles stand for.
    HorizontalCover cover() const { return cover_; }
    /// Vertical angles, degrees, ascending.
    const std::vector<double>& vertical_deg() const { return vertical_; }
    /// Horizontal angles, degrees, ascending.
    const std::vector<double>& horizontal_deg() const { return horizontal_; }
    /// Intensity at a grid point, cd.
    double grid_cd(int vertical, int horizontal) const {
        return candela_[static_cast<std::size_t>(horizontal) * vertical_.size() +
                        static_cast<std::size_t>(vertical)];
    }

    /// Place of a vertical angle. An angle within 1e-9 degrees of the range counts as its end. Any finite
    /// angle; that of type B is taken modulo 360.
    GridPlace vertical_place(double vertical_deg) const;
    /// Place of a horizontal angle, by the cover's symmetry. Any finite angle; of types A and C modulo 360.
    GridPlace horizontal_place(double horizontal_deg) const;
    /// Intensity at two places, cd; 0 where either is outside.
    double blend_cd(const GridPlace& vertical, const GridPlace& horizontal) const;

    /// Intensity at a pair of angles, cd.
    double at_cd(double vertical_deg, double horizontal_deg) const {
        return blend_cd(vertical_place(vertical_deg), horizontal_place(horizontal_deg));
    }
    /// Intensity in a direction of any length but 0 in the luminaire's frame, cd.
    double evaluate_cd(const Vec3<double>& direction) const {
        const PhotometricAngles angles = photometric_angles(type_, direction);
        return at_cd(angles.vertical_deg, angles.horizontal_deg);
    }

    /// Luminous flux into all directions, lm. Relative error of the rule's own arithmetic <= 1e-12 where
    /// intensities are not negative.
    double flux_lm(FluxRule rule = FluxRule::exact) const;
    /// The largest intensity, cd; it is at a grid point.
    double max_cd() const;
    /// The first grid point, vertical running fastest, that has it.
    PhotometricAngles max_angles() const;
    /// The mean over the sphere, flux / 4 pi, cd.
    double mean_cd() const;

    /// The same web with symmetry written out: cover is ring for type C (closed), range for A and B.
    PhotometricWeb unfolded() const;
    /// The web turned about its polar axis (type C: z; A: y; B: x), so that what was at
    /// horizontal h (type B: vertical v) is at h + deg.
    PhotometricWeb turned(double deg) const;

  private:
    /// Weight of each elevation's samples in the flux, the other angle's left out.
    std::vector<double> elevation_weights(FluxRule rule) const;
    /// Weight of each azimuth's samples, radians; they sum to the range that was measured.
    std::vector<double> azimuth_weights() const;

    Photometry type_;
    HorizontalCover cover_;
    std::vector<double> vertical_, horizontal_, candela_;
};

/// Two planes through the photometric axis: x-z (C0 and C180; V = 0) and y-z (C90 and C270; H = 0).
enum class AxialPlane { c0, c90 };

/// Intensity in a plane, `deg` from the nadir (A and B: from straight ahead), towards C0 or C90 if positive,
/// cd. deg in [-180, 180].
double in_plane_cd(const PhotometricWeb& web, AxialPlane plane, double deg);

/// The full angle in a plane between the outermost directions whose intensity is `fraction` of the plane's
/// maximum, within 90 degrees of the photometric axis, or of its opposite if the plane's maximum lies there.
/// Beam angle: fraction .5; field angle: .1 (ANSI/IES LS-1-20). In [0, 180] degrees; 0 for a dark plane.
double beam_angle_deg(const PhotometricWeb& web, AxialPlane plane, double fraction);

}  // namespace pbr
