#pragma once
// The colour of a light from its colour temperature, and back.
//
// Artists state a lamp's colour in kelvin: of a black body for flames and filaments, or of daylight, which is
// a little greener (6500 K of a black body is not D65). Between them lies the tint, Duv. Intensity is stated
// apart, so colours here have luminance 1.

#include <glm/vec3.hpp>

#include "pbr/light/colour.hpp"

namespace pbr {

/// Spectral radiance of a black body by Planck's law, W/(m^2 sr m): 2 h c^2 / (lambda^5 (e^(h c/(lambda k T))
/// - 1)), SI 2019 constants. wavelength_m > 0, temperature_k in [0, 1e200]; 0 K gives 0. By expm1, so that
/// neither the tail at T
/// -> 0 overflows nor the Rayleigh-Jeans end cancels. Relative error (2 + h c/(lambda k T)) 2^-52: rounding
/// of the exponent; denormal results have fewer digits.
double planck_radiance(double wavelength_m, double temperature_k);

/// Chromaticity of a black body, CIE 1931, by the sum over 360-830 nm. temperature_k in [1e-300, +Inf]:
/// towards 0 it tends to the spectral locus at 830 nm, +Inf is the Rayleigh-Jeans end (.2399, .2340). Error
/// 1e-7, the table's digits.
Chromaticity planckian_chromaticity(double temperature_k);

/// Chromaticity of a phase of daylight (CIE 15:2004, eq. 3.3 and 3.4). temperature_k in [4000, 25,000],
/// clamped to it. The cubics meet at 7000 K within 5e-7. D65 is 6504 K: see daylight_temperature; the formula
/// is 1.3e-4 of y off its published (.3127, .3290).
Chromaticity daylight_chromaticity(double temperature_k);

/// The temperature to use for daylight's nominal one: times 1.4388/1.4380, as c2 of Planck's law was
/// corrected after D50, D55, D65 and D75 had got their names (CIE 15:2004, 3.1).
constexpr double daylight_temperature(double nominal_k) { return nominal_k * (1.4388 / 1.4380); }

/// Black bodies that correlated_temperature looks among.
inline constexpr double kCoolestBlackBody_k = 800;
inline constexpr double kHottestBlackBody_k = 100'000;

/// A colour by the nearest black body. duv is the distance from it in CIE 1960 (u, v), > 0 above the locus
/// (green), < 0 below (pink) (ANSI C78.377-2017). White lamps have |duv| < .02; beyond .05 the temperature
/// means little (CIE 15:2004, 9.5).
struct CorrelatedTemperature {
    double temperature_k;
    double duv;
};

/// The correlated colour temperature: of the black body nearest in (u, v), found on the exact locus. One
/// outside [800, 100,000] K is clamped to it, duv is then the distance from that end. For |duv| <= .05,
/// from_correlated_temperature undoes it to 1e-9 of xy. For colours far away with several nearest points, the
/// one of the nearest of a grid wins.
CorrelatedTemperature correlated_temperature(const Chromaticity& c);

/// Steps off the locus at a temperature by duv along its normal in (u, v). temperature_k in [800, 100,000].
Chromaticity from_correlated_temperature(const CorrelatedTemperature& t);

/// Linear Rec. 709 (D65) of luminance 1 of a black body: rgb_into_gamut of its colour. Inside the gamut from
/// 1901 K up; below, blue is 0 and the rest paler: at 1000 K 8.3 % of white is mixed in. Domain as
/// planckian_chromaticity.
glm::dvec3 rgb_from_temperature(double temperature_k);

/// A fit of the locus for run time (Krystek 1985, "An algorithm to calculate correlated colour temperature",
/// eq. 1 and 2). temperature_k in [1000, 15,000]: within 1.4e-4 in (u, v); at 40,000 K 1.6e-3. float is
/// within 1e-6 of double.
template <class T>
glm::vec<2, T, glm::defaultp> planckian_uv_krystek(T temperature_k) {
    const T t = temperature_k, t2 = t * t;
    const T u = (T(0.860117757) + T(1.54118254e-4) * t + T(1.28641212e-7) * t2) /
                (T(1) + T(8.42420235e-4) * t + T(7.08145163e-7) * t2);
    const T v = (T(0.317398726) + T(4.22806245e-5) * t + T(4.20481691e-8) * t2) /
                (T(1) - T(2.89741816e-5) * t + T(1.61456053e-7) * t2);
    return {u, v};
}

}  // namespace pbr
