#pragma once
// A material composed at compile time: the standard material and the effects it needs. T is float or double.
//
//     Material<float> plain(authored);
//     Material varnished(authored, ClearCoat<float>{.strength = 1, .alpha = .01f});
//     Vec3<float> f = varnished.f(wo, wi);
//
// An effect is a plain struct with any of the hooks below; a hook that no effect has leaves no code, and an
// effect that is absent no member: Material<T> is the bare lobes to the bit, and has the size of its Surface.
//
//     void    prepare(Surface<T>&)                                    once: changes the base's parameters
//     Vec3<T> diffuse(const Surface<T>&, const Reflection<T>&)        in place of Disney diffuse
//     T       specular_DV(const Surface<T>&, const Reflection<T>&)    in place of isotropic GGX
//     Vec3<T> specular_factor(const Surface<T>&, const Reflection<T>&)      times the specular lobe
//     Vec3<T> lobe(const Surface<T>&, const Reflection<T>&)           added to it
//     Vec3<T> over(const Reflection<T>&, const Vec3<T>& below)        a layer on all that comes before it
//
// All hooks are const. Effects stand in the order of their layers, the lowest first. Effects that come with
// the library are in pbr/brdf/material_effects.hpp.

#include <cassert>
#include <tuple>

#include "pbr/brdf/standard_material.hpp"

namespace pbr {

/// The effect changes the parameters of the base.
template <class Effect, class T>
concept PreparesSurface = requires(const Effect& e, Surface<T>& s) {
    e.prepare(s);
};
/// The effect has a diffuse lobe of its own.
template <class Effect, class T>
concept ReplacesDiffuse = requires(const Effect& e, const Surface<T>& s, const Reflection<T>& r) {
    e.diffuse(s, r);
};
/// The effect has a D V of its own.
template <class Effect, class T>
concept ReplacesSpecular = requires(const Effect& e, const Surface<T>& s, const Reflection<T>& r) {
    e.specular_DV(s, r);
};
/// The effect has a factor for the specular lobe.
template <class Effect, class T>
concept ScalesSpecular = requires(const Effect& e, const Surface<T>& s, const Reflection<T>& r) {
    e.specular_factor(s, r);
};
/// The effect has a lobe that is added.
template <class Effect, class T>
concept AddsLobe = requires(const Effect& e, const Surface<T>& s, const Reflection<T>& r) {
    e.lobe(s, r);
};
/// The effect is a layer on what comes before it.
template <class Effect, class T>
concept CoversSurface = requires(const Effect& e, const Reflection<T>& r, const Vec3<T>& f) {
    e.over(r, f);
};

/// The standard material with effects. At most one effect replaces the diffuse lobe, at most one the specular
/// one; each effect has a hook (one that is misspelt does not compile).
template <class T, class... Effects>
class Material {
    static_assert((ReplacesDiffuse<Effects, T> + ... + 0) <= 1, "two effects replace the diffuse lobe");
    static_assert((ReplacesSpecular<Effects, T> + ... + 0) <= 1, "two effects replace the specular lobe");
    static_assert(((PreparesSurface<Effects, T> || ReplacesDiffuse<Effects, T> ||
                    ReplacesSpecular<Effects, T> || ScalesSpecular<Effects, T> || AddsLobe<Effects, T> ||
                    CoversSurface<Effects, T>)&&...),
                  "an effect has no hook");

  public:
    /// The material that its artist authored. Parameters in [0, 1], smoothness below 1.
    explicit Material(const StandardMaterial<T>& authored, const Effects&... effects)
        : surface_(surface_from_material(authored)), effects_(effects...) {
        assert(surface_.alpha > T(0));
        each([this](const auto& effect) {
            if constexpr (PreparesSurface<decltype(effect), T>) effect.prepare(surface_);
        });
    }

    /// What the lobes take, after every effect prepared it.
    const Surface<T>& surface() const { return surface_; }

    /// The BRDF, 1/sr, without the cosine; 1/pi is inside. wo, wi unit vectors away from the surface; 0 where
    /// either is not above it. Not negative, and finite where its lobes are (in float: alpha >= 1e-4 and
    /// cosines >= 1e-20; or alpha >= 3e-15, the least that a smoothness below 1 gives, and cosines >= 1e-4).
    /// Error as that of its lobes, and a rounding each.
    Vec3<T> f(const Vec3<T>& wo, const Vec3<T>& wi) const {
        if (wo.z <= T(0) || wi.z <= T(0)) return Vec3<T>(0);
        const Reflection<T> r = reflection(wo, wi);
        Vec3<T> f = diffuse(r) + specular(r);
        each([&](const auto& effect) {
            if constexpr (AddsLobe<decltype(effect), T>) f += effect.lobe(surface_, r);
            if constexpr (CoversSurface<decltype(effect), T>) f = effect.over(r, f);
        });
        return f;
    }

    /// The diffuse lobe under all layers, 1/sr. r of directions above the surface.
    Vec3<T> diffuse(const Reflection<T>& r) const {
        if constexpr ((ReplacesDiffuse<Effects, T> || ...)) {
            Vec3<T> f(0);
            each([&](const auto& effect) {
                if constexpr (ReplacesDiffuse<decltype(effect), T>) f = effect.diffuse(surface_, r);
            });
            return f;
        } else {
            return f_standard_diffuse(surface_, r);
        }
    }

    /// The specular lobe under all layers, 1/sr. r of directions above the surface.
    Vec3<T> specular(const Reflection<T>& r) const {
        T DV{};
        if constexpr ((ReplacesSpecular<Effects, T> || ...)) {
            each([&](const auto& effect) {
                if constexpr (ReplacesSpecular<decltype(effect), T>) DV = effect.specular_DV(surface_, r);
            });
        } else {
            DV = DV_standard_specular(surface_, r);
        }
        Vec3<T> f = F_schlick(surface_.f0, Vec3<T>(surface_.f90), r.LoH) * DV;
        each([&](const auto& effect) {
            if constexpr (ScalesSpecular<decltype(effect), T>) f *= effect.specular_factor(surface_, r);
        });
        return f;
    }

  private:
    /// Calls visit(effect) for every effect in order.
    template <class Visit>
    void each(const Visit& visit) const {
        std::apply([&](const Effects&... effects) { (visit(effects), ...); }, effects_);
    }

    Surface<T> surface_;
    [[no_unique_address]] std::tuple<Effects...> effects_;
};

/// Material(authored, effects...) is a Material<T, Effects...>.
template <class T, class... Effects>
Material(const StandardMaterial<T>&, const Effects&...) -> Material<T, Effects...>;

}  // namespace pbr
