#pragma once
// The effects a Material is composed of. T is float or double.
//
// Energy, for a white furnace, is stated at each; what is not said to be reciprocal is. Where an effect needs
// a directional albedo, it takes a function albedo(cosine, alpha) -> T: a baked table's look-up, or any fit
// of it.

#include <algorithm>

#include "pbr/brdf/chan.hpp"
#include "pbr/brdf/charlie.hpp"
#include "pbr/brdf/clear_coat.hpp"
#include "pbr/brdf/eon.hpp"
#include "pbr/brdf/ggx_anisotropic.hpp"
#include "pbr/brdf/hammon.hpp"
#include "pbr/brdf/lambert.hpp"
#include "pbr/brdf/multiscatter.hpp"
#include "pbr/brdf/standard_material.hpp"

namespace pbr {

/// A coat over everything before it. strength in [0, 1], alpha in (0, 1] the coat's own.
template <class T>
struct ClearCoat {
    T strength;
    T alpha;

    /// The base meets the coat instead of air: f0, and with it f90, change by `strength`.
    void prepare(Surface<T>& surface) const {
        for (int c = 0; c < 3; ++c)
            surface.f0[c] +=
                strength * (f0_under_clear_coat(std::clamp(surface.f0[c], T(0), T(1))) - surface.f0[c]);
        surface.f90 = f90_from_f0(surface.f0);
    }
    /// The coat's lobe, and what its transmission leaves of `below`; 1/sr.
    Vec3<T> over(const Reflection<T>& r, const Vec3<T>& below) const {
        return below * clear_coat_transmission(r.NoL, r.NoV, strength) +
               Vec3<T>(f_clear_coat(r, alpha, strength));
    }
};

/// A layer of fibres over everything before it, as KHR_materials_sheen has it. colour in [0, 1] a channel,
/// alpha in (0, 1] the fibres' own, albedo(cosine, alpha) that of the white lobe with V_charlie
/// (albedo_charlie). From alpha .07 up the albedo stays at most 1 if that of what is below does. Narrower
/// fibres alone return more than arrived at grazing view, over black as over white: at most 1.103 at alpha
/// .05, 1.335 at .03, 2.129 at .01. Hold alpha to .07 or more.
template <class T, class Albedo>
struct Cloth {
    Vec3<T> colour;
    T alpha;
    Albedo albedo;

    /// The fibres' lobe, and what their albedo leaves of `below` on the way in or out, whichever is less;
    /// 1/sr.
    Vec3<T> over(const Reflection<T>& r, const Vec3<T>& below) const {
        const T brightest = std::max({colour.x, colour.y, colour.z});
        const T shadow = brightest * std::max(albedo(r.NoL, alpha), albedo(r.NoV, alpha));
        const T lobe = D_charlie(r.NoH, alpha) * V_charlie(r.NoL, r.NoV, alpha);
        return below * std::max(T(0), T(1) - shadow) + colour * lobe;
    }
};

/// Specular stretched along the tangent, Burley's convention. anisotropy in [0, 1].
template <class T>
struct Anisotropy {
    T anisotropy;

    /// D V of the anisotropic lobe, 1/sr.
    T specular_DV(const Surface<T>& surface, const Reflection<T>& r) const {
        const AnisotropicAlpha<T> alpha = anisotropic_alpha(surface.alpha, anisotropy);
        return D_ggx_anisotropic(r.wm, alpha) * V_smith_ggx_anisotropic_correlated(r.wo, r.wi, alpha);
    }
};

/// Turquin's energy compensation: cheap, a white metal's albedo is 1, not reciprocal. albedo(cosine, alpha)
/// is E.
template <class T, class Albedo>
struct EnergyCompensation {
    Albedo albedo;

    /// The factor on the specular lobe, >= 1.
    Vec3<T> specular_factor(const Surface<T>& surface, const Reflection<T>& r) const {
        return multiscatter_factor_turquin(surface.f0, albedo(r.NoV, surface.alpha));
    }
};

/// Kulla & Conty's lobe of multiple scattering: a white metal's albedo is 1. albedo(cosine, alpha) is E,
/// E_avg its mean at the surface's alpha.
template <class T, class Albedo>
struct MultipleScattering {
    Albedo albedo;
    T E_avg;

    /// The lobe that single scattering lacks, 1/sr.
    Vec3<T> lobe(const Surface<T>& surface, const Reflection<T>& r) const {
        const Vec3<T> F_avg = average_schlick(surface.f0, Vec3<T>(surface.f90));
        return multiscatter_colour(F_avg, E_avg) *
               f_multiscatter(albedo(r.NoV, surface.alpha), albedo(r.NoL, surface.alpha), E_avg);
    }
};

/// Lambert in place of Disney diffuse: albedo rho.
template <class T>
struct LambertDiffuse {
    /// 1/sr.
    Vec3<T> diffuse(const Surface<T>& surface, const Reflection<T>&) const {
        return surface.diffuse_albedo * f_lambert<T>();
    }
};

/// EON in place of Disney diffuse: conserves energy. diffuse_roughness in [0, 1].
template <class T>
struct EonDiffuse {
    T diffuse_roughness;

    /// 1/sr.
    Vec3<T> diffuse(const Surface<T>& surface, const Reflection<T>& r) const {
        return f_eon(surface.diffuse_albedo, diffuse_roughness, r.NoL, r.NoV, r.LoV);
    }
};

/// Chan's fit in place of Disney diffuse, on the specular lobe's alpha; energy as f_chan.
template <class T>
struct ChanDiffuse {
    /// 1/sr.
    Vec3<T> diffuse(const Surface<T>& surface, const Reflection<T>& r) const {
        return surface.diffuse_albedo * f_chan(r.NoL, r.NoV, r.NoH, r.LoH, surface.alpha);
    }
};

/// Hammon's fit in place of Disney diffuse, on the specular lobe's alpha; energy as f_hammon.
template <class T>
struct HammonDiffuse {
    /// 1/sr.
    Vec3<T> diffuse(const Surface<T>& surface, const Reflection<T>& r) const {
        return f_hammon(surface.diffuse_albedo, r.NoL, r.NoV, r.NoH, r.LoV, surface.alpha);
    }
};

}  // namespace pbr
