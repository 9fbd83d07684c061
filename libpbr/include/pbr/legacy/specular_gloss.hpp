#pragma once
// Diffuse and specular colour to base colour and metal mask, and back, losing neither. T is float or double.
//
// Both are ways to write what a surface reflects: a diffuse albedo and an f0, each a colour (`Reflected`). A
// metallic material holds five numbers of the six,
//
//     diffuse = base (1 - metallic)            f0 = dielectric_f0 (1 - metallic) + base metallic
//
// so which metallic is meant is told by the sixth where dielectric_f0 is taken as known, and by nothing where
// the surface is black and reflects as a dielectric does. Known converters solve the quadratic that follows
// and jump from 0 to 1 there. Here metallic is an estimate that is continuous in its data, says how sure it
// is, and leaves what it doesn't explain in a dielectric_f0 of any colour, so that diffuse and f0 come back
// whatever metallic is.

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "pbr/numerics/vector.hpp"

namespace pbr {

/// Whether the stored diffuse colour is dimmed by what the surface reflects.
enum class DiffuseCoupling {
    none,    ///< diffuse albedo is the stored colour: legacy shaders, Frostbite
    fresnel  ///< times 1 - max f0 (KHR_materials_pbrSpecularGlossiness) or, of a metallic material, 1 - max
             ///< dielectric_f0 (glTF 2.0, appendix B, and KHR_materials_specular, at normal incidence)
};

/// What a surface reflects: diffuse albedo, and reflectance at normal incidence.
template <class T>
struct Reflected {
    Vec3<T> diffuse;
    Vec3<T> f0;
};

/// A metallic material whose dielectric may be any: KHR_materials_specular and KHR_materials_ior hold it as
/// specularColor times an ior's f0.
template <class T>
struct MetallicMaterial {
    Vec3<T> base_color;
    T metallic;
    Vec3<T> dielectric_f0;
};

/// The largest channel.
template <class T>
constexpr T max_channel(const Vec3<T>& colour) {
    return std::max(colour.x, std::max(colour.y, colour.z));
}

/// The mean of the channels.
template <class T>
constexpr T mean_channel(const Vec3<T>& colour) {
    return (colour.x + colour.y + colour.z) / T(3);
}

/// What diffuse and specular colours in [0, 1] reflect. Exact to 2 roundings.
template <class T>
constexpr Reflected<T> reflected_from_specular(const Vec3<T>& diffuse, const Vec3<T>& specular,
                                               DiffuseCoupling coupling) {
    return {coupling == DiffuseCoupling::fresnel ? diffuse * (T(1) - max_channel(specular)) : diffuse,
            specular};
}

/// The diffuse colour that reflected_from_specular turns into `reflected`; at most 1. f0 = 1 leaves no
/// diffuse light: 0. Relative error 4 ulp / (1 - max f0).
template <class T>
constexpr Vec3<T> diffuse_colour(const Reflected<T>& reflected, DiffuseCoupling coupling) {
    if (coupling == DiffuseCoupling::none) return reflected.diffuse;
    const T rest = T(1) - max_channel(reflected.f0);
    return rest > T(0) ? glm::min(reflected.diffuse / rest, Vec3<T>(1)) : Vec3<T>(0);
}

/// What a metallic material with members in [0, 1] reflects. Exact to 4 roundings.
template <class T>
constexpr Reflected<T> reflected_from_metallic(const MetallicMaterial<T>& material,
                                               DiffuseCoupling coupling) {
    const T dielectric = T(1) - material.metallic;
    const T left = coupling == DiffuseCoupling::fresnel ? T(1) - max_channel(material.dielectric_f0) : T(1);
    return {material.base_color * (dielectric * left),
            material.dielectric_f0 * dielectric + material.base_color * material.metallic};
}

/// What is known before looking at a texel.
template <class T>
struct MetallicPrior {
    T dielectric_f0 = T(.04);  ///< what dielectrics here reflect
    T f0_tolerance =
        T(.02);  ///< how far they may stray from it; 0: the source was made from a metallic material
    /// How likely metal is, relative to a dielectric, where both fit; metals as dark as dielectrics hardly
    /// exist.
    T metal_odds = T(.01);
};

/// Half the width of the interval that each stored number stands for, in linear reflectance: what rounding to
/// its code has lost. Less than 1e-6 is taken as 1e-6.
template <class T>
struct Quantisation {
    Vec3<T> diffuse;
    Vec3<T> f0;
};

/// A metal mask's value, and how well the data determine it.
template <class T>
struct MetallicEstimate {
    T metallic;    ///< [0, 1]
    T confidence;  ///< [0, 1]: 1 less the range of metallic that the intervals allow, less what contradicts
};

/// The metallic of channel means: the root in [0, 1] of dielectric_f0 m^2 + (diffuse + f0 - 2 dielectric_f0)
/// m + dielectric_f0 - f0 = 0, 0 where f0 <= dielectric_f0. diffuse, f0 in [0, 1], dielectric_f0 in (0, 1).
/// Jumps where f0 passes dielectric_f0 while diffuse < dielectric_f0: from 0 to 1 - diffuse / dielectric_f0.
/// The relation is linear in (diffuse, f0), so any weighted mean of channels has the same root where the
/// channels agree. Absolute error below 8 ulp / dielectric_f0.
template <class T>
T metallic_root(T diffuse, T f0, T dielectric_f0) {
    const T excess = f0 - dielectric_f0;
    if (!(excess > T(0))) return T(0);
    const T b = diffuse + f0 - T(2) * dielectric_f0;
    const T root = std::sqrt(b * b + T(4) * dielectric_f0 * excess);
    // The form whose terms have one sign.
    const T m = b > T(0) ? T(2) * excess / (b + root) : (root - b) / (T(2) * dielectric_f0);
    return std::min(m, T(1));
}

/// e^x - 1 with a heavy tail, for x >= 0: odds that one number tells are never beyond recall. Exact to 4
/// roundings.
template <class T>
constexpr T heavy_tailed_odds(T x) {
    return x * (T(1) + x * (T(1) + x));
}

/// A metallic estimate that is continuous in its data. The root of the channel means, times the odds that the
/// surface isn't a dielectric after all. These are metal_odds t(x) : 1 + t(y), t = heavy_tailed_odds. x says
/// how far f0 is from the usual dielectric's: 1/2 mean((f0 - dielectric_f0)+^2) / (quantisation^2 +
/// f0_tolerance^2). y says how far the colours are from that metal's, as a grey f0 over a saturated diffuse
/// colour is: 1/2 sum(e^2) / (quantisation^2 + .02^2), with e a channel's departure of f0 from the material
/// of the root. Odds of 1000 are certainty. So metallic is 0 where f0 is the dielectric's, and the root where
/// f0 is far from it and has the colours that the root says.
///
/// Confidence is 1 minus the range of the root over diffuse -+ quantisation, f0 -+ (quantisation +
/// f0_tolerance): 0 for black with f0 = dielectric_f0; and minus what the odds took from the root. It falls
/// as 1 / (1 + e^2), with e of the worst channel in units of .02 plus its interval; again with e what f0 is
/// short of any dielectric's, in tenths of dielectric_f0; and as f0 / .02 below water's f0, which no surface
/// has. Reflectances in [0, 1]; NaN channels count as 0.
template <class T>
MetallicEstimate<T> estimate_metallic(const Reflected<T>& reflected, const MetallicPrior<T>& prior,
                                      const Quantisation<T>& quantisation, DiffuseCoupling coupling) {
    constexpr T kSharpest = T(1e-6), kWater = T(.02), kDoubt = T(.02), kCertain = T(1000);
    const auto finite = [](T x) { return x > T(0) ? std::min(x, T(1)) : T(0); };
    const T f = prior.dielectric_f0;
    // With coupling, the base colour's own diffuse is what is left of it after the dielectric's reflection.
    const T left = coupling == DiffuseCoupling::fresnel ? T(1) - f : T(1);
    Vec3<T> diffuse, f0;
    for (int c = 0; c < 3; ++c) {
        diffuse[c] = finite(reflected.diffuse[c] / left);
        f0[c] = finite(reflected.f0[c]);
    }
    const T q_diffuse = std::max(mean_channel(quantisation.diffuse) / left, kSharpest);
    const T q_f0 = std::max(mean_channel(quantisation.f0), kSharpest);
    const T d = mean_channel(diffuse), s = mean_channel(f0);

    const T root = metallic_root(d, s, f);
    T squares = 0, strays = 0, worst = 0;
    for (int c = 0; c < 3; ++c) {
        const T excess = std::max(T(0), f0[c] - f);
        squares += excess * excess / T(3);
        const T base = diffuse[c] + f0[c] - f * (T(1) - root);
        const T stray = f0[c] - f * (T(1) - root) - base * root;
        strays += stray * stray;
        worst = std::max(worst, std::abs(stray));
    }
    const T x = squares / (T(2) * (q_f0 * q_f0 + prior.f0_tolerance * prior.f0_tolerance));
    const T y = strays / (T(2) * (q_f0 * q_f0 + kDoubt * kDoubt));
    const T odds = prior.metal_odds * heavy_tailed_odds(x) / (T(1) + heavy_tailed_odds(y));
    const T m = root * std::min(T(1), (T(1) + T(1) / kCertain) * (odds / (T(1) + odds)));

    const T reach = q_f0 + prior.f0_tolerance;
    const T highest = metallic_root(std::max(T(0), d - q_diffuse), s + reach, f);
    const T lowest = metallic_root(d + q_diffuse, s - reach, f);
    const T departure = s > f ? worst / (kDoubt + reach) : T(0);
    const T shortfall = std::max(T(0), f - reach - s) / (T(.1) * f);
    const T plausible = std::min(T(1), s / kWater) / (T(1) + shortfall * shortfall);
    const T told = std::max(T(0), T(1) - (highest - lowest) - (root - m));
    return {m, told * plausible / (T(1) + departure * departure)};
}

/// The largest metallic that a material with members in [0, 1] and a dielectric_f0 of any colour may have to
/// reflect `reflected` under DiffuseCoupling::fresnel, with diffuse off by up to `largest_error`; every
/// smaller one does too. Diffuse D above what f0 S leaves, 1 - max S, counts as that. 1 without diffuse
/// light.
///
/// The dielectric leaves L = 1 - max dielectric_f0 of the base colour D / ((1 - m) L). A channel k lets
/// L^2 - (1 - S_k / (1 - m)) L - m D_k / (1 - m)^2 be at most 0; base colours of at most 1 and S / m ask for
/// L >= D / (1 - m) and L >= m D / ((1 - m) S). Both are linear in m: with x = max D, t = max D / S,
///
///     m (x - D_k) <= x (1 - x - S_k)          m (1 + t) <= 1 - S_k + D_k / t          for every k.
///
/// So a grey surface has S / (S + D). Exact for no error, to 16 ulp (1 + 1 / t); with one, no more than it
/// allows. Continuous where the error is above 0. NaN channels count as 0.
template <class T>
T largest_metallic(const Reflected<T>& reflected, T largest_error) {
    const auto finite = [](T x) { return x > T(0) ? std::min(x, T(1)) : T(0); };
    Vec3<T> f0;
    for (int c = 0; c < 3; ++c) f0[c] = finite(reflected.f0[c]);
    const T rest = T(1) - max_channel(f0);
    T ratio = 0;  // t; infinite without f0, of which metal takes nothing then
    for (int c = 0; c < 3; ++c) {
        const T least = std::min(finite(reflected.diffuse[c]), rest) - largest_error;
        if (least > T(0)) ratio = std::max(ratio, least / f0[c]);
    }
    if (!(ratio > T(0))) return T(1);
    // The other channels as bright as t and the error allow, D / t of each.
    Vec3<T> share;
    T brightest = 0, most = T(1);
    for (int c = 0; c < 3; ++c) {
        const T highest = std::min(finite(reflected.diffuse[c]) + largest_error, rest - largest_error);
        share[c] = std::min(f0[c], highest / ratio);
        brightest = std::max(brightest, share[c] * ratio);
    }
    for (int c = 0; c < 3; ++c) {
        most = std::min(most, (T(1) - f0[c] + share[c]) / (T(1) + ratio));
        const T behind = brightest - share[c] * ratio;
        if (behind > T(0)) most = std::min(most, brightest * (T(1) - brightest - f0[c]) / behind);
    }
    return std::max(most, T(0));
}

/// What a coupled material of metallic in [0, 1) that reflects `reflected` leaves of base colour for diffuse
/// light: left = 1 - max dielectric_f0 with dielectric_f0 = (f0 - metallic diffuse / (rest left)) / rest is a
/// quadratic a channel, and the smallest root is the one that all channels allow.
template <class T>
T left_for_diffuse(const Reflected<T>& reflected, T metallic) {
    const T rest = T(1) - metallic;
    T left = T(1);
    for (int c = 0; c < 3; ++c) {
        const T b = T(1) - reflected.f0[c] / rest, q = metallic * reflected.diffuse[c] / (rest * rest);
        const T root = std::sqrt(b * b + T(4) * q);
        left = std::min(left, b > T(0) ? (b + root) / T(2) : q > T(0) ? T(2) * q / (root - b) : T(0));
    }
    return left;
}

/// How much of it diffuse light of no less than `least` needs, below 0 as 0: base_color is at most 1 and
/// f0 / metallic.
template <class T>
T left_needed(const Vec3<T>& least, const Vec3<T>& f0, T metallic) {
    T needed = T(0);
    for (int c = 0; c < 3; ++c) {
        const T ratio = metallic > T(0) ? std::max(T(1), metallic / f0[c]) : T(1);
        if (least[c] > T(0)) needed = std::max(needed, least[c] / (T(1) - metallic) * ratio);
    }
    return needed;
}

/// Metallic material of a given metallic that reflects `reflected`. Its diffuse light is brought towards that
/// of the base colour which explains f0 with the given dielectric_f0, but by no more than
/// `diffuse_tolerance`; the material's dielectric_f0 is what of f0 the base colour then leaves. With
/// coupling, f0 is exact, and diffuse within the tolerance or `largest_error`, for metallic up to
/// largest_metallic of that error, if all is no more than all light. Else, and without coupling where no such
/// material has members in [0, 1], f0 comes first. metallic in [0, 1]; 1 has base_color = f0 and the given
/// dielectric_f0, to which materials pass over from 1 - 1e-5 on: what tells theirs is rounding by then.
/// Absolute error of both below 32 ulp of 1, and in double 4e-6 from there on, besides the tolerance.
/// Continuous in all arguments.
template <class T>
MetallicMaterial<T> material_with_residual(const Reflected<T>& reflected, T metallic, T dielectric_f0,
                                           const Vec3<T>& diffuse_tolerance, DiffuseCoupling coupling,
                                           T largest_error = T(0)) {
    constexpr T kLeastTold = T(1e-5);
    const T rest = T(1) - metallic, light = T(1) - max_channel(reflected.f0);
    if (!(rest > T(0))) return {reflected.f0, T(1), Vec3<T>(dielectric_f0)};
    const bool coupled = coupling == DiffuseCoupling::fresnel, is_part = metallic > T(0);
    const T usual_left = coupled ? T(1) - dielectric_f0 : T(1);
    Vec3<T> diffuse = reflected.diffuse, least = diffuse, most = diffuse;
    for (int c = 0; is_part && c < 3; ++c) {
        const T own = reflected.diffuse[c], tolerance = diffuse_tolerance[c];
        const T error = std::max(tolerance, largest_error);
        least[c] = std::min(own, light) - error;
        most[c] = coupled ? std::max(own, std::min(own + error, light - error)) : own + error;
        const T base = std::clamp((reflected.f0[c] - dielectric_f0 * rest) / metallic, T(0), T(1));
        const T ideal = base * rest * usual_left;
        diffuse[c] = std::clamp(ideal, std::max(T(0), own - tolerance), std::min(own + tolerance, most[c]));
    }
    T own_left = T(1), left = T(1);
    if (coupled) {
        left = own_left = left_for_diffuse<T>({diffuse, reflected.f0}, metallic);
        // A channel may need more, and others give it by more diffuse light of their own, as the error
        // allows.
        const T needed = is_part ? left_needed(least, reflected.f0, metallic) : T(0);
        if (needed > left)
            left = std::max(left, std::min(needed, left_for_diffuse<T>({most, reflected.f0}, metallic)));
    }
    const T per_base = rest * left;  // diffuse light
    const T told = std::min(T(1), rest * rest / (kLeastTold * kLeastTold));
    MetallicMaterial<T> material{Vec3<T>(0), metallic, Vec3<T>(dielectric_f0)};
    for (int c = 0; c < 3; ++c) {
        const T f0 = reflected.f0[c];
        const T wanted = per_base > T(0) ? diffuse[c] / per_base : T(0);
        // Below, dielectric_f0 would have to be above 1, or above 1 - left.
        T lowest = is_part ? std::max(T(0), (f0 - rest) / metallic) : T(0);
        if (left > own_left)
            lowest = std::max(lowest, std::min((f0 - rest + per_base) / metallic, most[c] / per_base));
        const T highest = is_part ? std::min(T(1), f0 / metallic) : T(1);
        const T base = std::clamp(wanted, std::min(lowest, highest), highest);
        const T residual = std::clamp((f0 - base * metallic) / rest, T(0), T(1));
        material.base_color[c] = base;
        material.dielectric_f0[c] = residual * told + dielectric_f0 * (T(1) - told);
    }
    return material;
}

/// How often material_without_residual goes from base colour to dielectric_f0 and back.
inline constexpr int kGreyTurns = 3;

/// The same for targets that hold a grey dielectric_f0 up to `largest_f0`, 0 for none but the prior's own:
/// base colour by least squares of diffuse and f0, every channel alike. Continuous in all arguments.
template <class T>
MetallicMaterial<T> material_without_residual(const Reflected<T>& reflected, T metallic, T dielectric_f0,
                                              T largest_f0, DiffuseCoupling coupling) {
    const T rest = T(1) - metallic, weight = rest * rest + metallic * metallic;
    MetallicMaterial<T> material{Vec3<T>(0), metallic, Vec3<T>(dielectric_f0)};
    for (int turn = 0; turn < kGreyTurns; ++turn) {
        const T f = material.dielectric_f0.x;
        const T left = coupling == DiffuseCoupling::fresnel ? T(1) - f : T(1);
        T unexplained = 0;
        for (int c = 0; c < 3; ++c) {
            const T from_diffuse = left > T(0) ? reflected.diffuse[c] / left : T(0);
            const T base = (rest * from_diffuse + metallic * (reflected.f0[c] - f * rest)) / weight;
            material.base_color[c] = std::clamp(base, T(0), T(1));
            unexplained += (reflected.f0[c] - material.base_color[c] * metallic) / T(3);
        }
        if (largest_f0 <= T(0)) break;
        // Of a metal's texel nothing is left to tell its dielectric by.
        const T told = rest * rest / (rest * rest + T(1e-3));
        const T found = rest > T(0) ? std::clamp(unexplained / rest, T(0), largest_f0) : dielectric_f0;
        material.dielectric_f0 = Vec3<T>(dielectric_f0 + (found - dielectric_f0) * told);
    }
    return material;
}

}  // namespace pbr
