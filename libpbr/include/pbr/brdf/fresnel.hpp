#pragma once
// Fresnel reflectance.

namespace pbr {

/// (1 - c)^5, Schlick's weight. c in [0, 1]; values a rounding outside are clamped, so the result is in [0,
/// 1].
template <class T>
constexpr T schlick_weight(T cosine) {
    const T m = cosine < T(0) ? T(1) : cosine > T(1) ? T(0) : T(1) - cosine;
    const T m2 = m * m;
    return m2 * m2 * m;
}

/// Schlick's approximation with f90 at grazing incidence: f0 + (f90 - f0)(1 - LoH)^5 (Schlick 1994, "An
/// inexpensive BRDF model for physically-based rendering", eq. 24; f90 as in Lagarde & de Rousiers 2014,
/// listing 2). Colour is a floating-point type or a GLM vector; reflectances in [0, 1]; exact at LoH = 1
/// (f0), within a rounding at LoH = 0 (f90).
template <class Colour, class T>
constexpr Colour F_schlick(const Colour& f0, const Colour& f90, T LoH) {
    return f0 + (f90 - f0) * schlick_weight(LoH);
}

}  // namespace pbr
