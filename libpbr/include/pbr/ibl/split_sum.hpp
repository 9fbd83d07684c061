#pragma once
// The split sum at run time: LD (ibl/ld.hpp) times DFG (ibl/dfg.hpp), specular and diffuse.
//
// Exact under a constant environment. Elsewhere the lobe is taken as if seen along its normal, which shortens
// reflections at grazing view. Colour is T or a GLM vector of T.

#include <numbers>

namespace pbr {

/// Specular radiance from a table of scale = E - Fc and bias = Fc: LD (f0 scale + f90 bias) (Karis 2013;
/// Lagarde & de Rousiers 2014, 4.9.2 and listing 24). LD in cd/m² or W/(m² sr), the rest in [0, 1]. No factor
/// of pi anywhere. Looked up along the mirror direction under a clamped cosine sky turned every way, its rms
/// error is .011 to .22 of the radiance at alpha .1 (NoV .9 to .1), .14 to .66 at alpha .5, and .73 at alpha
/// 1, NoV .3; ibl/dominant_direction.hpp takes some of it back.
template <class Colour, class T>
constexpr Colour split_sum_specular(const Colour& LD, const Colour& f0, const Colour& f90, T scale, T bias) {
    return LD * (f0 * scale + f90 * bias);
}

/// The same from a table of Fc and E, Filament's form: LD (f0 (E - Fc) + f90 Fc). With f90 = 1 it is LD
/// mix(Fc, E, f0). E is what compensation for multiple scattering needs, hence this form.
template <class Colour, class T>
constexpr Colour split_sum_specular_from_albedo(const Colour& LD, const Colour& f0, const Colour& f90, T Fc,
                                                T E) {
    return LD * (f0 * (E - Fc) + f90 * Fc);
}

/// Diffuse radiance of Disney's model, split like the specular term: diffuse_colour albedo LD, with LD =
/// irradiance / pi (the alpha = 1 level of a probe, or evaluate_irradiance / pi) and `albedo` that of the
/// white lobe, albedo_disney_diffuse or the baked term (Lagarde & de Rousiers 2014, 4.9.2, eqs. 59-62). The
/// only 1/pi here is the one in LD. Under a sky of radiance 1 + w.e, e any unit vector, it is off by up to
/// .021 of the mean at perceptual roughness 0, .094 at .5 and .132 at 1 (NoV .1; .027 at NoV .5): what the
/// lobe leans.
template <class Colour, class T>
constexpr Colour split_sum_diffuse(const Colour& LD, const Colour& diffuse_colour, T albedo) {
    return LD * diffuse_colour * albedo;
}

/// Diffuse radiance from irradiance E in lx or W/m²: the 1/pi is applied here.
template <class Colour, class T>
constexpr Colour split_sum_diffuse_from_irradiance(const Colour& irradiance, const Colour& diffuse_colour,
                                                   T albedo) {
    return irradiance * diffuse_colour * (albedo / std::numbers::pi_v<T>);
}

}  // namespace pbr
