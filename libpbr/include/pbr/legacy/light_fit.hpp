#pragma once
// Physical lights that come nearest to a legacy law, and by how many stops they miss it.
//
// The model is what a photometric renderer can do: an intensity in candela, an emitter with a size, and a
// window that ends it. The law I / (c + q d^2) needs no fit: it is the disk of radius sqrt(c / q) seen on its
// axis, with I / q candela (illuminance of a disk on its axis, pi L r^2 / (d^2 + r^2): Lagarde & de Rousiers
// 2014, 4.7.2). Fits are least squares of stops over distances spaced evenly, found on grids that zoom in:
// deterministic to the bit.

#include <array>
#include <limits>

#include "pbr/legacy/falloff.hpp"

namespace pbr {

/// What shines. Each law is the illuminance of a receiver that faces it, for 1 cd, at a distance d.
enum class EmitterShape {
    point,      ///< 1 / d^2
    sphere,     ///< 1 / d^2 from its centre; on and in it that of its surface
    disk,       ///< 1 / (d^2 + r^2), seen on its axis
    rectangle,  ///< a square of side 2 r seen on its axis: s atan(s) / r^2, s = r / sqrt(d^2 + r^2)
};

/// Which window ends the light: Frostbite's and Unreal's square, or glTF's.
enum class LightWindow { quartic_squared, quartic };

/// A light a photometric renderer can make. `radius` is the source's (half the side of a square), 0 for a
/// point; attenuation_radius is +Inf where nothing ends it. Intensity >= 0.
struct PhysicalLight {
    EmitterShape shape = EmitterShape::point;
    LightWindow window = LightWindow::quartic_squared;
    double intensity = 0;
    double radius = 0;
    double attenuation_radius = std::numeric_limits<double>::infinity();
};

/// Illuminance of a receiver at a distance > 0 that faces the light. In lux where the intensity is in candela
/// and lengths are in metres. Relative error 1e-14.
double illuminance_at(const PhysicalLight& light, double distance);

/// Distances from a light at which it matters. 0 < near < far.
struct DistanceSpan {
    double near;
    double far;
};

/// Difference of two lights over distances, in stops: log2 of their ratio.
struct StopsError {
    double rms;
    double max;     ///< largest magnitude anywhere in the span
    double max_at;  ///< the distance of that
};

/// How far `light` is from `intensity` times the law. rms: over `count` distances at the middles of equal
/// parts of the span. max: over all of the span, its ends included; peaks are found on a grid of 256
/// equal ratios of distance and climbed to 1e-6 of its step. Where one is dark and the other not, the
/// difference counts as kDarkStops.
StopsError stops_between(const PhysicalLight& light, const Falloff& law, double intensity,
                         const DistanceSpan& span, int count);

/// What stops are counted between light and none: half's range of normal numbers is 30.
inline constexpr double kDarkStops = 32;

/// [.05, .9] of the law's reach: its range, or the distance at which `intensity` times the law has sunk to
/// `threshold`, whichever is nearer. near = far = 0 where the law reaches nowhere or everywhere.
DistanceSpan distances_that_matter(const Falloff& law, double intensity, double threshold);

/// A light, and its error over the span that it was fitted to.
struct LightFit {
    PhysicalLight light;
    StopsError error;
    bool is_exact;  ///< the law itself, by its form
};

/// The light of a shape and window that is nearest to `intensity` (> 0) times the law. Exact for c + q d^2
/// and its special cases as a point or disk, also under a window of the same form. The radius of a sphere is
/// 0: outside it is a point. Error: the grid ends at 1e-7 of its parameters. Not for is_constant_fill.
LightFit fit_light(const Falloff& law, double intensity, EmitterShape shape, LightWindow window,
                   const DistanceSpan& span);

/// How far two spots of the same intensity on the axis are apart.
struct SpotError {
    double rms_share;   ///< of the difference over the sphere of directions within the wider cone
    double max_share;   ///< of the intensity on the axis
    double flux_stops;  ///< log2 of fitted over legacy flux
};

/// The spot of physical lights, glTF's and Frostbite's sat((cos a - cos outer) / (cos inner - cos outer))^2,
/// against a law of angle, at `count` directions in the middles of equal solid angles. inner <= outer in rad,
/// in [0, pi]. All 0 for a law whose outer angle is 0.
SpotError spot_difference(const SpotFalloff& law, double inner_rad, double outer_rad, int count);

/// That spot, fitted to a law of angle, intensity on the axis kept.
struct SpotFit {
    double inner_rad;
    double outer_rad;  ///< at most pi / 2, as in glTF
    SpotError error;
    bool is_exact;
};

/// The nearest spot by least squares over solid angle. An outer angle of 0 gives a cone of 0 and no error.
/// Error: cones are found to 1e-6 rad; rms_share is below .05 for cosine_power from exponent 2 up, .12 at 1,
/// .17 at .15, where a hard rim at pi / 2 is asked of a square. cosine_ramp with exponent 2, no axis_power
/// and up to pi / 2 is exact.
SpotFit fit_spot(const SpotFalloff& law);

}  // namespace pbr
