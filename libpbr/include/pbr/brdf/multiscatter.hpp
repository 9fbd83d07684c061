#pragma once
// What single-scattering GGX loses between its facets, given back. T is float or double, Colour is T or a GLM
// vector of it.
//
// E(mu) is the directional albedo of the lobe without Fresnel at cosine mu (dfg_ggx in pbr/ibl/dfg.hpp, or
// the table baked from it), E_avg its cosine-weighted mean over the hemisphere. Three ways, from the exact
// lobe to the cheapest:
//
//     Kulla-Conty     a diffuse-like lobe of its own, reciprocal; a white furnace gives exactly 1
//     Turquin         a factor on the lobe that exists; 1 in the furnace too, but not reciprocal
//     Fdez-Aguera     for image-based light: one table look-up, no E_avg
//
// With f0 = 1 all three return what arrived; with colour they differ by how often light is counted as
// coloured. Against Kulla-Conty's albedo at f0 .2 to .9, NoV .1 to 1: Turquin's is off by at most 1.9 % at
// alpha .5 and 23 % too bright at alpha 1 (f0 .5, NoV 1), Fdez-Aguera's by 1.6 % and 9.5 % (too dark there).

#include <numbers>

#include "pbr/brdf/fresnel.hpp"

namespace pbr {

/// Cosine-weighted mean of Schlick's Fresnel over the hemisphere, f0 + (f90 - f0) / 21: 2 integral (1 - mu)^5
/// mu dmu = 1/21. Reflectances in [0, 1]. Exact to 2 roundings.
template <class Colour>
constexpr Colour average_schlick(const Colour& f0, const Colour& f90) {
    return f0 + (f90 - f0) / Colour(21);
}

/// Kulla-Conty's lobe for facets that absorb nothing, (1 - E_o)(1 - E_i) / (pi (1 - E_avg)), 1/sr; 1/pi is
/// inside (Kulla & Conty 2017, "Revisiting physically based shading at Imageworks", after Kelemen &
/// Szirmay-Kalos 2001). E in [0, 1], of wo and wi at one alpha; its albedo is exactly 1 - E_o. E_avg = 1 (a
/// mirror) has nothing to return: 0.
template <class T>
constexpr T f_multiscatter(T E_o, T E_i, T E_avg) {
    const T lost = T(1) - E_avg;
    return lost > T(0) ? (T(1) - E_o) * (T(1) - E_i) / (std::numbers::pi_v<T> * lost) : T(0);
}

/// The colour of Kulla-Conty's lobe, F_avg^2 E_avg / (1 - F_avg (1 - E_avg)): a path that leaves at the
/// second bounce or later met at least two facets, so that the series starts with F^2 E_avg. (The course
/// slides print F_avg to the first power, which reflects from the wall once too rarely; the square is what
/// Hill 2018, "A multi-faceted exploration", derives and renderers use.) F_avg, E_avg in [0, 1]: 1 at F_avg =
/// 1, 0 at 0.
template <class Colour, class T>
constexpr Colour multiscatter_colour(const Colour& F_avg, T E_avg) {
    return F_avg * F_avg * E_avg / (Colour(1) - F_avg * (T(1) - E_avg));
}

/// Turquin's factor on the single-scattering lobe, 1 + f0 (1 - E) / E, E of wo (Turquin 2019, "Practical
/// multiple scattering compensation for microfacet models"). f0 in [0, 1], E in (0, 1]: at least 1; the
/// albedo of f0 = 1 becomes 1. GGX has E > .30 everywhere. Not reciprocal, as it sees wo alone.
template <class Colour, class T>
constexpr Colour multiscatter_factor_turquin(const Colour& f0, T E_o) {
    return Colour(1) + f0 * ((T(1) - E_o) / E_o);
}

/// Fdez-Aguera's albedo of single and multiple scattering (Fdez-Aguera 2019, "A multiple-scattering
/// microfacet model for real-time image-based lighting", JCGT 8(1)). `single` multiplies prefiltered
/// radiance, `multiple` irradiance / pi; what a diffuse base may return is its colour times (1 - single -
/// multiple).
template <class Colour>
struct MultiscatterAlbedo {
    Colour single;
    Colour multiple;
};

/// single = f0 (E - Fc) + f90 Fc, multiple = (1 - E) single F_avg / (1 - F_avg (1 - E)). E and Fc as
/// DirectionalAlbedo has them; reflectances in [0, 1]. Their sum is 1 at f0 = f90 = 1, and in [0, 1] always.
template <class Colour, class T>
constexpr MultiscatterAlbedo<Colour> multiscatter_albedo_fdez_aguera(const Colour& f0, const Colour& f90, T E,
                                                                     T Fc) {
    const Colour single = f0 * (E - Fc) + f90 * Fc, F_avg = average_schlick(f0, f90);
    return {single, single * F_avg * (T(1) - E) / (Colour(1) - F_avg * (T(1) - E))};
}

/// E_avg of height-correlated GGX, 2 integral E(mu, alpha) mu dmu over [0, 1]. alpha in [0, 1]: 1 at 0,
/// .40913710 at 1, falling in between. Absolute error below 2e-8 (quadrature of dfg_ggx at 1e-8).
double average_albedo_ggx(double alpha);

}  // namespace pbr
