#pragma once
// Between radiant and luminous power.

#include "pbr/light/cie_1931.hpp"
#include "pbr/light/photometric_units.hpp"

namespace pbr {

/// The luminous efficacy of monochromatic radiation of 540 THz (555 nm), lm/W: exact, as it defines the
/// candela (BIPM, The International System of Units, 9th ed., 2.3.1). The most that any
/// light can have is 3e-6 of itself more, at the peak of V.
inline constexpr double kLuminousEfficacy_lm_per_W = 683;

/// Luminous power of a source by its radiant power and efficacy. By watts from the plug an efficacy of the
/// lamp: incandescent 15, fluorescent 60, LED 100 lm/W, about.
template <class T>
constexpr Lumens<T> power_from_watts(Watts<T> radiant, LumensPerWatt<T> efficacy) {
    return Lumens<T>(radiant.value() * efficacy.value());
}

/// The inverse. efficacy > 0.
template <class T>
constexpr Watts<T> watts_from_power(Lumens<T> power, LumensPerWatt<T> efficacy) {
    return Watts<T>(power.value() / efficacy.value());
}

/// Luminous power of a spectrum: 683 times the integral of V(lambda) density(wavelength in nm), which is in
/// W/nm (ISO/CIE 23539:2023, 5.2). Error as tristimulus. Likewise luminance from radiance, illuminance from
/// irradiance.
template <class Density>
Lumens<double> power_of_spectrum(const Density& watts_per_nm) {
    return Lumens<double>(kLuminousEfficacy_lm_per_W * tristimulus(watts_per_nm).y);
}

/// Luminous efficacy of a black body's radiation, all wavelengths counted. temperature_k in (0, 1e70];
/// underflows to 0 below 25 K and tends to 0 towards infinity. 16.4 lm/W at 2856 K, at most 95.4 at 6600 K.
/// Exact to 1e-9
/// for the table's V.
LumensPerWatt<double> efficacy_of_black_body(double temperature_k);

}  // namespace pbr
