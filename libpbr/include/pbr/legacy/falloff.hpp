#pragma once
// How lights of older renderers fade with distance and angle: the laws as their formats define them.
//
// A law says what share of a light's intensity number is left. It holds no 1/pi and no unit: what 1 is worth
// in lux is for the caller to say. Distances are in any one unit. Everything here is deterministic to the bit
// (numerics/elementary.hpp).

#include <limits>

namespace pbr {

/// What brings a law to 0 at its range.
enum class FalloffWindow {
    none,             ///< nothing: the light reaches everywhere
    cut,              ///< 1 up to the range, 0 from there on
    ramp,             ///< sat((range - d) / (range - begin)) ^ exponent: Quake's and old three.js's
    smoothstep,       ///< 3 t^2 - 2 t^3 of that ramp: OpenGEX's "smooth"
    smootherstep,     ///< 6 t^5 - 15 t^4 + 10 t^3 of it: Source's hard falloff
    quartic,          ///< sat(1 - (d / range)^4): KHR_lights_punctual's
    quartic_squared,  ///< its square: Unreal Engine 4's, Frostbite's and three.js's
};

/// A law of distance: 1 / (constant + linear d + quadratic d^2), or 1 / max(d^power, floor) where `power` >
/// 0, times a window. All coefficients >= 0 and finite; range in [0, +Inf], begin in [0, range).
struct Falloff {
    double constant = 1;
    double linear = 0;
    double quadratic = 0;
    double power = 0;
    double floor = 0;
    FalloffWindow window = FalloffWindow::none;
    double begin = 0;
    double range = std::numeric_limits<double>::infinity();
    double exponent = 1;  ///< of the ramp
};

/// Share of the intensity left at a distance >= 0. +Inf on the pole of a law without constant; 0 beyond the
/// range, everywhere if that is 0. All three coefficients 0 count as the constant 1: 1/0 is no light anyone
/// meant, and Source's compiler reads it so. A range of FLT_MAX or more has no window. Relative error 1e-14.
double falloff_at(const Falloff& law, double distance);

/// Whether the law has no decline at all: constant everywhere, a light that no physical light can be.
bool is_constant_fill(const Falloff& law);

/// Whether the law ends somewhere: a window and a range below FLT_MAX.
bool has_range(const Falloff& law);

/// The distance beyond which the law stays at or below `share` (> 0): its range if that comes first, +Inf if
/// it never does, 0 if it is nowhere above. Bisected to 1e-12 of itself.
double falloff_reach(const Falloff& law, double share);

/// How a spot fades from its axis.
enum class SpotLaw {
    hard,          ///< 1 inside the outer cone
    cosine_power,  ///< cos(angle)^exponent inside the outer cone: OpenGL, Collada
    cosine_ramp,   ///< ((cos a - cos outer) / (cos inner - cos outer))^exponent: Source; 2 is glTF's
    smoothstep,    ///< 3 t^2 - 2 t^3 of that ramp in cosines: three.js
};

/// A law of angle. Half-angles in rad, 0 <= inner <= outer <= pi.
struct SpotFalloff {
    SpotLaw law = SpotLaw::hard;
    double inner_rad = 0;
    double outer_rad = 0;
    double exponent = 1;  ///< of cosine_power and cosine_ramp, >= 0
};

/// Share of the intensity on the axis left at an angle whose cosine is given, in [-1, 1]. 0 outside the outer
/// cone; inner = outer is a hard edge. cosine_power is 0 where the cosine is negative, unless its exponent is 0. Error 1e-14.
double spot_falloff_at(const SpotFalloff& law, double cosine);

/// x^p of x >= 0 with bits that no CPU changes; p in [0, 1e4]. 0^0 is 1. Relative error 1e-13 for x in
/// [1e-3, 1e3], growing with p |ln x|; below 1e-300 it is 0.
double power_exact(double x, double p);

}  // namespace pbr
