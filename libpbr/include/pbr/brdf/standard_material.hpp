#pragma once
// Frostbite's standard material: what artists author, and the two lobes it stands for. T is float or double.

#include "pbr/brdf/disney_diffuse.hpp"
#include "pbr/brdf/fresnel.hpp"
#include "pbr/brdf/ggx.hpp"
#include "pbr/brdf/reflection.hpp"
#include "pbr/brdf/roughness.hpp"
#include "pbr/numerics/vector.hpp"

namespace pbr {

/// The authored parameters (Lagarde & de Rousiers 2014, 3.2.2), each in [0, 1].
template <class T>
struct StandardMaterial {
    Vec3<T> base_color;  ///< linear: diffuse albedo of dielectrics, f0 of metals
    T smoothness;        ///< 1 - perceptual roughness
    T metal_mask;        ///< 0 dielectric, 1 metal
    T reflectance;       ///< of dielectrics, f0 = .16 reflectance^2; .5 is the common .04
};

/// What the lobes take.
template <class T>
struct Surface {
    Vec3<T> diffuse_albedo;
    Vec3<T> f0;
    T f90;
    T perceptual_roughness;
    T alpha;
};

/// The surface of a material: diffuse albedo base_color (1 - metal_mask), f0 from reflectance towards
/// base_color by metal_mask, f90 with micro-occlusion (Lagarde & de Rousiers 2014, 3.2.2 and listing 2).
/// Parameters in [0, 1]; every member is in [0, 1]. White at full roughness, diffuse and specular together
/// return up to 1.117 of what arrived at reflectance .5, 1.231 at reflectance 1, both at NoV = 0: Frostbite's
/// energy factor doesn't quite do.
/// Smoothness 1 gives alpha 0, a mirror, which no lobe here takes. Absolute error below 4 ulp of 1.
template <class T>
Surface<T> surface_from_material(const StandardMaterial<T>& material) {
    const T dielectric = T(1) - material.metal_mask;
    const Vec3<T> f0 = Vec3<T>(f0_from_reflectance(material.reflectance) * dielectric) +
                       material.base_color * material.metal_mask;
    const T perceptual_roughness = perceptual_roughness_from_smoothness(material.smoothness);
    return {material.base_color * dielectric, f0, f90_from_f0(f0), perceptual_roughness,
            alpha_from_perceptual_roughness(perceptual_roughness)};
}

/// The diffuse lobe, 1/sr: Disney's as Frostbite renormalised it times the albedo; 1/pi is inside. Domain and
/// error as f_disney_diffuse.
template <class T>
Vec3<T> f_standard_diffuse(const Surface<T>& surface, const Reflection<T>& r) {
    return surface.diffuse_albedo * f_disney_diffuse(r.NoL, r.NoV, r.LoH, surface.perceptual_roughness);
}

/// The microsurface of the specular lobe, D V without Fresnel, 1/sr. surface.alpha in (0, 1]; +Inf where NoL
/// and NoV are both 0. Relative error below 16 ulp.
template <class T>
T DV_standard_specular(const Surface<T>& surface, const Reflection<T>& r) {
    return D_ggx(r.NoH, r.sin2, surface.alpha) * V_smith_ggx_correlated(r.NoL, r.NoV, surface.alpha);
}

}  // namespace pbr
