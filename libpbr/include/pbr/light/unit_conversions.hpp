#pragma once
// Between luminous power, intensity, luminance, illuminance and exposure value. T is float or double.
//
//     Phi (lm)  --/ solid angle-->  I (cd)  --/ facing area-->  L (cd/m^2)  --K-->  EV100
//
// Surfaces are matte emitters: luminance is the same in every direction, so that a square metre sends out pi
// L lumens. That pi is in these functions and in no shader: what a renderer reads is a luminance or an
// intensity. Conversions of one step are exact to 4 roundings; their inverses undo them to as many.

#include <cmath>
#include <numbers>

#include "pbr/light/photometric_units.hpp"

namespace pbr {

/// Calibration of a reflected-light meter, K, cd s / (m^2 ISO); ISO 2720:1974 allows 10.6 to 13.4, Canon,
/// Nikon and Sekonic use this one.
inline constexpr double kReflectedMeterK = 12.5;

/// Calibration of an incident-light meter with a flat receptor, C, lx s / ISO; ISO 2720:1974 allows 240 to
/// 400.
inline constexpr double kIncidentMeterC = 250;

namespace detail {

/// a/b, and 0 where a is 0 even if b is 0: no light from nothing is no light. a, b >= 0; +Inf if b alone is
/// 0.
template <class T>
constexpr T quotient(T a, T b) {
    return a == T(0) ? T(0) : a / b;
}

}  // namespace detail

/// The intensity of a source that spreads its power evenly over a solid angle, I = Phi / Omega: a point light
/// over solid_angle_whole_sphere, a spot over solid_angle_cone of its outer half-angle or, so that its
/// penumbra is counted, over solid_angle_of_spot (light/punctual.hpp), a frustum over solid_angle_pyramid
/// (Lagarde & de Rousiers 2014, 4.4). power and angle >= 0; +Inf over no angle, 0 without power.
template <class T>
constexpr Candelas<T> intensity_from_power(Lumens<T> power, Steradians<T> angle) {
    return Candelas<T>(detail::quotient(power.value(), angle.value()));
}

/// The inverse: Phi = I Omega.
template <class T>
constexpr Lumens<T> power_from_intensity(Candelas<T> intensity, Steradians<T> angle) {
    return Lumens<T>(intensity.value() * angle.value());
}

/// Frostbite's intensity of a spot light, Phi / pi whatever its cone, so that narrowing the cone masks light
/// instead of gathering it (Lagarde & de Rousiers 2014, 4.4). A cone of half-angle 60 degrees is where it is
/// also the truth; 1000 lm at 30 degrees are 318 cd here and 1188 cd in an honest reflector.
template <class T>
constexpr Candelas<T> intensity_of_frostbite_spot(Lumens<T> power) {
    return Candelas<T>(power.value() / std::numbers::pi_v<T>);
}

/// The inverse: pi I.
template <class T>
constexpr Lumens<T> power_of_frostbite_spot(Candelas<T> intensity) {
    return Lumens<T>(intensity.value() * std::numbers::pi_v<T>);
}

/// What the conversions need to know of a matte light's shape, m^2.
template <class T>
struct Emitter {
    T area_m2;         ///< that emits
    T facing_area_m2;  ///< seen from where it looks largest: of a disk from its front, of a tube from its
                       ///< side
};

/// A sphere. radius >= 0, m. (Areas of all four shapes: Lagarde & de Rousiers 2014, 4.7, luminous power of
/// area lights.)
template <class T>
constexpr Emitter<T> emitter_sphere(T radius_m) {
    const T section = std::numbers::pi_v<T> * radius_m * radius_m;
    return {T(4) * section, section};
}

/// A disk that emits from one side. radius >= 0, m.
template <class T>
constexpr Emitter<T> emitter_disk(T radius_m) {
    const T area = std::numbers::pi_v<T> * radius_m * radius_m;
    return {area, area};
}

/// A rectangle that emits from one side. width, height >= 0, m.
template <class T>
constexpr Emitter<T> emitter_rectangle(T width_m, T height_m) {
    return {width_m * height_m, width_m * height_m};
}

/// A tube with hemispheres on its ends: a cylinder of `length_m` between their centres, so that its area is
/// 2 pi r (length + 2 r) and length 0 is the sphere. radius, length >= 0, m.
template <class T>
constexpr Emitter<T> emitter_tube(T radius_m, T length_m) {
    const T pi_r = std::numbers::pi_v<T> * radius_m;
    return {T(2) * pi_r * (length_m + T(2) * radius_m), T(2) * radius_m * length_m + pi_r * radius_m};
}

/// L = Phi / (pi A). power >= 0; +Inf without area, 0 without power.
template <class T>
constexpr Nits<T> luminance_from_power(Lumens<T> power, const Emitter<T>& shape) {
    return Nits<T>(detail::quotient(power.value(), std::numbers::pi_v<T> * shape.area_m2));
}

/// Phi = pi A L.
template <class T>
constexpr Lumens<T> power_from_luminance(Nits<T> luminance, const Emitter<T>& shape) {
    return Lumens<T>(std::numbers::pi_v<T> * shape.area_m2 * luminance.value());
}

/// The intensity seen from where the shape looks largest, far away: I = L A_facing.
template <class T>
constexpr Candelas<T> intensity_from_luminance(Nits<T> luminance, const Emitter<T>& shape) {
    return Candelas<T>(luminance.value() * shape.facing_area_m2);
}

/// L = I / A_facing. intensity >= 0; +Inf without area, 0 without intensity.
template <class T>
constexpr Nits<T> luminance_from_intensity(Candelas<T> intensity, const Emitter<T>& shape) {
    return Nits<T>(detail::quotient(intensity.value(), shape.facing_area_m2));
}

/// The intensity seen from where the shape looks largest, Phi A_facing / (pi A): Phi/4pi for a sphere, Phi/pi
/// for a disk or rectangle. power >= 0; 0 from a shape without area.
template <class T>
constexpr Candelas<T> intensity_from_power(Lumens<T> power, const Emitter<T>& shape) {
    const T pi_area = std::numbers::pi_v<T> * shape.area_m2;
    return Candelas<T>(detail::quotient(power.value() * shape.facing_area_m2, pi_area));
}

/// The inverse: the power of a shape of which this intensity is seen from where it looks largest. intensity
/// >= 0; 0 from a shape without area.
template <class T>
constexpr Lumens<T> power_from_intensity(Candelas<T> intensity, const Emitter<T>& shape) {
    const T pi_area = std::numbers::pi_v<T> * shape.area_m2;
    return Lumens<T>(detail::quotient(intensity.value() * pi_area, shape.facing_area_m2));
}

/// The luminance for which a reflected-light meter shows this exposure value: 2^EV K/100 = 2^(EV - 3) nit
/// (ISO 2720:1974; Lagarde & de Rousiers 2014, 4.3). -Inf gives 0; from EV 128 on float is +Inf. Error as
/// exp2's.
template <class T>
Nits<T> luminance_from_ev100(Ev100<T> ev) {
    return Nits<T>(std::exp2(ev.value()) * T(kReflectedMeterK / 100));
}

/// log2(L 100/K). luminance >= 0 (below: NaN); no luminance gives -Inf.
template <class T>
Ev100<T> ev100_from_luminance(Nits<T> luminance) {
    return Ev100<T>(std::log2(luminance.value() * T(100 / kReflectedMeterK)));
}

/// The illuminance for which an incident-light meter shows this exposure value: 2^EV C/100 = 2.5 2^EV lx (ISO
/// 2720:1974). -Inf gives 0.
template <class T>
Lux<T> illuminance_from_ev100(Ev100<T> ev) {
    return Lux<T>(std::exp2(ev.value()) * T(kIncidentMeterC / 100));
}

/// log2(E 100/C). illuminance >= 0 (below: NaN); no illuminance gives -Inf.
template <class T>
Ev100<T> ev100_from_illuminance(Lux<T> illuminance) {
    return Ev100<T>(std::log2(illuminance.value() * T(100 / kIncidentMeterC)));
}

}  // namespace pbr
