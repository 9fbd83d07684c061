#pragma once
// From luminance to pixel value: what a camera's settings make of a scene. T is float or double.
//
// A picture is luminance times the exposure, a plain multiplier in 1/nit; 1 is where the sensor saturates.
// After Lagarde & de Rousiers 2014, 5.1, and ISO 12232.
//
// Sunny 16, worked: f/16, 1/100 s, ISO 100 is EV 14.64. A meter takes 3200 nit for the mean of such a scene
// and 64,000 lx for its light; the sensor saturates at 1.2 * 2^14.64 = 30,720 nit. A grey card (18 %) in
// 100,000 lx of sun has .18 * 100,000 / pi = 5730 nit: pixel value .187.

#include <algorithm>
#include <cassert>
#include <cmath>

#include "pbr/light/photometric_units.hpp"
#include "pbr/light/unit_conversions.hpp"

namespace pbr {

/// The share of light that the lens passes on to the sensor, with the pi/4 of the aperture's disk: q = pi/4 *
/// .9 * .98
/// * cos^4(10 degrees) = .652 (ISO 2720:1974: transmittance, vignetting, off-axis angle), which everyone
/// rounds so.
inline constexpr double kLensAttenuation = 0.65;

/// What is set on a camera. All > 0.
template <class T>
struct CameraSettings {
    T f_number;   ///< focal length / diameter of the aperture, N
    T shutter_s;  ///< exposure time, t
    T iso;        ///< sensitivity, S
};

/// log2(N^2/t 100/S) (ISO 2720:1974; Lagarde & de Rousiers 2014, eq. in 5.1). Absolute error below 4 ulp of
/// the result, or of 1 if that is more.
template <class T>
Ev100<T> ev100_from_settings(const CameraSettings<T>& camera) {
    assert(camera.f_number > T(0) && camera.shutter_s > T(0) && camera.iso > T(0));
    return Ev100<T>(std::log2(camera.f_number * camera.f_number / camera.shutter_s * (T(100) / camera.iso)));
}

/// The luminance that saturates the sensor. Saturation-based speed is S = 78 lx s / H (ISO 12232:2006) and a
/// scene exposes the sensor by H = q L t/N^2, so that L = 78/(S q) N^2/t, 78/65 * 2^EV = 1.2 * 2^EV nit. -Inf
/// gives 0. Relative error as exp2's and two roundings.
template <class T>
Nits<T> saturation_luminance(Ev100<T> ev) {
    return Nits<T>(T(78 / (100 * kLensAttenuation)) * std::exp2(ev.value()));
}

/// Exposure by saturation, 1/nit: 1 / saturation_luminance, what Frostbite uses. A meter's mean
/// (ev100_from_luminance) becomes K/120 = .104. ISO 12232 itself reckons with 10/78 = .128, 18 % over sqrt 2,
/// half a stop of headroom for highlights; the rest is q and K, which don't quite agree (q K = 8.1, not 10).
/// An EV of -Inf gives +Inf.
template <class T>
T exposure_by_saturation(Ev100<T> ev) {
    return T(1) / saturation_luminance(ev).value();
}

/// The luminance that becomes middle grey by standard output sensitivity, S = 10 lx s / H for the exposure H
/// of pixel value 118 of 255, 18 % in sRGB (ISO 12232:2006): 10/(S q) N^2/t = .1538 * 2^EV nit.
template <class T>
Nits<T> standard_output_luminance(Ev100<T> ev) {
    return Nits<T>(T(10 / (100 * kLensAttenuation)) * std::exp2(ev.value()));
}

/// Exposure by standard output sensitivity, 1/nit: .18 / standard_output_luminance. Brighter than the one by
/// saturation by .18 * 78/10 = 1.404, half a stop; it clips at 55.6/(S q) N^2/t. An EV of -Inf gives +Inf.
template <class T>
T exposure_by_standard_output(Ev100<T> ev) {
    constexpr T kMiddleGrey = T(0.18);
    return kMiddleGrey / standard_output_luminance(ev).value();
}

/// How an automatic exposure may move.
template <class T>
struct AutoExposure {
    Stops<T> compensation;  ///< what a photographer dials: +1 makes the picture twice as bright
    Ev100<T> darkest;       ///< the metered value stays in [darkest, brightest]
    Ev100<T> brightest;
};

/// The EV to expose a scene of this average luminance with: what a meter shows, clamped, less the
/// compensation (as it comes after the clamp, it works at either end of the range too). average >= 0; a black
/// scene gives darkest - compensation. darkest <= brightest.
template <class T>
Ev100<T> auto_ev100(Nits<T> average, const AutoExposure<T>& settings) {
    assert(average.value() >= T(0) && settings.darkest <= settings.brightest);
    return std::clamp(ev100_from_luminance(average), settings.darkest, settings.brightest) -
           settings.compensation;
}

}  // namespace pbr
