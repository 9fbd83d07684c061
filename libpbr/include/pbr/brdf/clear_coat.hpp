#pragma once
// Clear coat: a thin dielectric layer of ior 1.5 with its own alpha over a base. T is float or double.
//
// The coat's lobe is GGX with the height-correlated visibility, the same that the DFG tables and probes hold,
// so that baked albedos apply to it. Kelemen's V = 1 / (4 LoH^2), which Filament takes for speed, is here for
// who must match it: energy is conserved too, but the white lobe's albedo lies up to .11 below the tables'.

#include "pbr/brdf/fresnel.hpp"
#include "pbr/brdf/ggx.hpp"
#include "pbr/brdf/reflection.hpp"

namespace pbr {

/// Reflectance of the coat at normal incidence: f0_from_ior(1.5), polyurethane.
template <class T>
inline constexpr T kClearCoatF0 = T(0.04);

/// Kelemen's visibility 1 / (4 LoH^2) (Kelemen & Szirmay-Kalos 2001, "A microfacet based coupled
/// specular-matte BRDF model with importance sampling"). LoH in (0, 1]; +Inf at 0. Relative error below 2
/// ulp.
template <class T>
constexpr T V_kelemen(T LoH) {
    return T(0.25) / (LoH * LoH);
}

/// Reflectance of the coat times its strength, how much of the surface it covers. cosine and strength in [0,
/// 1]; between .04 strength and strength. Relative error below 8 ulp.
template <class T>
constexpr T F_clear_coat(T cosine, T strength) {
    return strength * F_schlick(kClearCoatF0<T>, T(1), cosine);
}

/// The coat's own lobe D V F strength, 1/sr, white. alpha in (0, 1], of the coat; strength in [0, 1]. 0 at
/// strength 0; +Inf where NoL and NoV are both 0. Relative error below 24 ulp.
template <class T>
T f_clear_coat(const Reflection<T>& r, T alpha, T strength) {
    return D_ggx(r.NoH, r.sin2, alpha) * V_smith_ggx_correlated(r.NoL, r.NoV, alpha) *
           F_clear_coat(r.LoH, strength);
}

/// What the coat leaves to the base: (1 - F(NoL)) (1 - F(NoV)), once through on the way in and once on the
/// way out. In [0, 1], reciprocal, 1 at strength 0, 0 at strength 1 and grazing. Light reflected back down
/// inside the coat is lost, and a rough coat shadows as much as a sharp one though it reflects less: over a
/// white Lambertian base the whole has an albedo of .90 to 1 for sharp coats, down to .12 for alpha 1 at
/// grazing view; never above 1.
template <class T>
constexpr T clear_coat_transmission(T NoL, T NoV, T strength) {
    return (T(1) - F_clear_coat(NoL, strength)) * (T(1) - F_clear_coat(NoV, strength));
}

/// The same as Filament has it, 1 - F(LoH) (Filament, "Physically based rendering in Filament", the section
/// on clear coat). Known to be poor: near grazing view a sharp coat reflects all and yet leaves nearly all to
/// the base; over white the whole reaches 1.7. cosine and strength in [0, 1]: 1 at strength 0, 0 at LoH = 0
/// and strength 1.
template <class T>
constexpr T clear_coat_transmission_filament(T LoH, T strength) {
    return T(1) - F_clear_coat(LoH, strength);
}

/// f0 of a base that lies under the coat instead of air: ((sqrt f0 - sqrt fc) / (1 - sqrt f0 sqrt fc))^2, fc
/// = f0 of the coat against air. Follows from f0_from_ior by writing out the ratio of indices; with fc = .04
/// it's Filament's (1 - 5 sqrt f0)^2 / (5 - sqrt f0)^2 (same source). f0 in [0, 1]: fc at 0, 0 at f0 = fc, 1
/// at 1. Absolute error below 4 ulp of 1. Real for dielectrics; for metals the same is done by convention.
template <class T>
T f0_under_clear_coat(T f0, T coat_f0 = kClearCoatF0<T>) {
    const T base = std::sqrt(f0), coat = std::sqrt(coat_f0);
    const T r = (base - coat) / (T(1) - base * coat);
    return r * r;
}

}  // namespace pbr
