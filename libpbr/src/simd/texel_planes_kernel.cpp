// Metallic and materials, a lane a texel: the operations of specular_gloss.hpp in their order, never fused,
// so that any vector width gives the bits of the scalar functions. These do what is left of a row.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/simd/texel_planes_kernel.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "pbr/legacy/texel_planes.hpp"

HWY_BEFORE_NAMESPACE();
namespace pbr {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;
constexpr D d;

HWY_INLINE V set(float value) { return hn::Set(d, value); }
HWY_INLINE V clamp(V value, V low, V high) { return hn::Min(hn::Max(value, low), high); }
/// In [0, 1], where NaN counts as 0.
HWY_INLINE V unit(V x) { return hn::IfThenElseZero(hn::Gt(x, hn::Zero(d)), hn::Min(x, set(1))); }
HWY_INLINE V max_channel(const V (&colour)[3]) { return hn::Max(colour[0], hn::Max(colour[1], colour[2])); }
HWY_INLINE V mean_channel(const ColourPlanes& planes, std::size_t i) {
    const V sum = hn::Add(hn::Add(hn::LoadU(d, planes[0] + i), hn::LoadU(d, planes[1] + i)),
                          hn::LoadU(d, planes[2] + i));
    return hn::Div(sum, set(3));
}

/// See pbr::metallic_root.
HWY_INLINE V root_of(V diffuse, V f0, float f) {
    const V excess = hn::Sub(f0, set(f));
    const V b = hn::Sub(hn::Add(diffuse, f0), set(2 * f));
    const V root = hn::Sqrt(hn::Add(hn::Mul(b, b), hn::Mul(set(4 * f), excess)));
    const V rising = hn::Div(hn::Mul(set(2), excess), hn::Add(b, root));
    const V falling = hn::Div(hn::Sub(root, b), set(2 * f));
    const V m = hn::Min(hn::IfThenElse(hn::Gt(b, hn::Zero(d)), rising, falling), set(1));
    return hn::IfThenElseZero(hn::Gt(excess, hn::Zero(d)), m);
}

HWY_INLINE V heavy_tailed_odds(V x) {
    const V one = set(1);
    return hn::Mul(x, hn::Add(one, hn::Mul(x, hn::Add(one, x))));
}

/// How far f0 is from a dielectric's and from that of the root's metal.
struct Misfit {
    V excess;  ///< mean square beyond the usual dielectric_f0
    V strays;  ///< sum of squares
    V worst;
};

HWY_INLINE Misfit misfit(const V (&diffuse)[3], const V (&f0)[3], V root, float f) {
    Misfit found{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    const V dielectric = hn::Mul(set(f), hn::Sub(set(1), root));
    for (int c = 0; c < 3; ++c) {
        const V excess = hn::Max(hn::Zero(d), hn::Sub(f0[c], set(f)));
        found.excess = hn::Add(found.excess, hn::Div(hn::Mul(excess, excess), set(3)));
        const V base = hn::Sub(hn::Add(diffuse[c], f0[c]), dielectric);
        const V stray = hn::Sub(hn::Sub(f0[c], dielectric), hn::Mul(base, root));
        found.strays = hn::Add(found.strays, hn::Mul(stray, stray));
        found.worst = hn::Max(found.worst, hn::Abs(stray));
    }
    return found;
}

HWY_INLINE void estimate_at(std::size_t i, const ReflectedPlanes& reflected,
                            const MetallicPrior<float>& prior, const ReflectedPlanes& half_steps, float left,
                            float* metallic, float* confidence) {
    constexpr float kSharpest = 1e-6f, kWater = .02f, kDoubt = .02f, kCertain = 1000;
    const V one = set(1), zero = hn::Zero(d);
    const float f = prior.dielectric_f0;
    V diffuse[3], f0[3];
    for (std::size_t c = 0; c < 3; ++c) {
        diffuse[c] = unit(hn::Div(hn::LoadU(d, reflected.diffuse[c] + i), set(left)));
        f0[c] = unit(hn::LoadU(d, reflected.f0[c] + i));
    }
    const V q_diffuse = hn::Max(hn::Div(mean_channel(half_steps.diffuse, i), set(left)), set(kSharpest));
    const V q_f0 = hn::Max(mean_channel(half_steps.f0, i), set(kSharpest));
    const V mean_diffuse = hn::Div(hn::Add(hn::Add(diffuse[0], diffuse[1]), diffuse[2]), set(3));
    const V mean_f0 = hn::Div(hn::Add(hn::Add(f0[0], f0[1]), f0[2]), set(3));

    const V root = root_of(mean_diffuse, mean_f0, f);
    const Misfit found = misfit(diffuse, f0, root, f);
    const V q2 = hn::Mul(q_f0, q_f0);
    const V x =
        hn::Div(found.excess, hn::Mul(set(2), hn::Add(q2, set(prior.f0_tolerance * prior.f0_tolerance))));
    const V y = hn::Div(found.strays, hn::Mul(set(2), hn::Add(q2, set(kDoubt * kDoubt))));
    const V odds =
        hn::Div(hn::Mul(set(prior.metal_odds), heavy_tailed_odds(x)), hn::Add(one, heavy_tailed_odds(y)));
    const V sure = hn::Mul(set(1 + 1 / kCertain), hn::Div(odds, hn::Add(one, odds)));
    const V m = hn::Mul(root, hn::Min(one, sure));

    const V reach = hn::Add(q_f0, set(prior.f0_tolerance));
    const V highest = root_of(hn::Max(zero, hn::Sub(mean_diffuse, q_diffuse)), hn::Add(mean_f0, reach), f);
    const V lowest = root_of(hn::Add(mean_diffuse, q_diffuse), hn::Sub(mean_f0, reach), f);
    const V departure =
        hn::IfThenElseZero(hn::Gt(mean_f0, set(f)), hn::Div(found.worst, hn::Add(set(kDoubt), reach)));
    const V shortfall = hn::Div(hn::Max(zero, hn::Sub(hn::Sub(set(f), reach), mean_f0)), set(.1f * f));
    const V plausible =
        hn::Div(hn::Min(one, hn::Div(mean_f0, set(kWater))), hn::Add(one, hn::Mul(shortfall, shortfall)));
    const V told = hn::Max(zero, hn::Sub(hn::Sub(one, hn::Sub(highest, lowest)), hn::Sub(root, m)));
    hn::StoreU(m, d, metallic + i);
    hn::StoreU(hn::Div(hn::Mul(told, plausible), hn::Add(one, hn::Mul(departure, departure))), d,
               confidence + i);
}

/// Returns how many texels were done.
std::size_t estimate_all(const ReflectedPlanes& reflected, const MetallicPrior<float>& prior,
                         const ReflectedPlanes& half_steps, DiffuseCoupling coupling, std::size_t count,
                         float* metallic, float* confidence) {
    const float left = coupling == DiffuseCoupling::fresnel ? 1 - prior.dielectric_f0 : 1;
    const std::size_t lanes = hn::Lanes(d);
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes)
        estimate_at(i, reflected, prior, half_steps, left, metallic, confidence);
    return i;
}

/// See pbr::largest_metallic.
HWY_INLINE void limit_at(std::size_t i, const ReflectedPlanes& reflected, float largest_error,
                         float* metallic) {
    const V one = set(1), zero = hn::Zero(d), error = set(largest_error);
    V diffuse[3], f0[3], share[3];
    for (std::size_t c = 0; c < 3; ++c) {
        diffuse[c] = unit(hn::LoadU(d, reflected.diffuse[c] + i));
        f0[c] = unit(hn::LoadU(d, reflected.f0[c] + i));
    }
    const V rest = hn::Sub(one, max_channel(f0));
    V ratio = zero, brightest = zero, most = one;
    for (int c = 0; c < 3; ++c) {
        const V least = hn::Sub(hn::Min(diffuse[c], rest), error);
        ratio = hn::Max(ratio, hn::IfThenElseZero(hn::Gt(least, zero), hn::Div(least, f0[c])));
    }
    const auto is_diffuse = hn::Gt(ratio, zero);
    for (int c = 0; c < 3; ++c) {
        const V highest = hn::Min(hn::Add(diffuse[c], error), hn::Sub(rest, error));
        share[c] = hn::Min(f0[c], hn::Div(highest, ratio));
        brightest = hn::Max(brightest, hn::Mul(share[c], ratio));
    }
    for (int c = 0; c < 3; ++c) {
        most = hn::Min(most, hn::Div(hn::Add(hn::Sub(one, f0[c]), share[c]), hn::Add(one, ratio)));
        const V behind = hn::Sub(brightest, hn::Mul(share[c], ratio));
        const V room = hn::Mul(brightest, hn::Sub(hn::Sub(one, brightest), f0[c]));
        most = hn::IfThenElse(hn::Gt(behind, zero), hn::Min(most, hn::Div(room, behind)), most);
    }
    hn::StoreU(hn::IfThenElse(is_diffuse, hn::Max(most, zero), one), d, metallic + i);
}

/// Returns how many texels were done.
std::size_t limit_all(const ReflectedPlanes& reflected, float largest_error, std::size_t count,
                      float* metallic) {
    const std::size_t lanes = hn::Lanes(d);
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes) limit_at(i, reflected, largest_error, metallic);
    return i;
}

/// See pbr::left_for_diffuse.
HWY_INLINE V left_for(const V (&diffuse)[3], const V (&f0)[3], V metallic, V rest) {
    const V one = set(1), zero = hn::Zero(d);
    V left = one;
    for (int c = 0; c < 3; ++c) {
        const V b = hn::Sub(one, hn::Div(f0[c], rest));
        const V q = hn::Div(hn::Mul(metallic, diffuse[c]), hn::Mul(rest, rest));
        const V root = hn::Sqrt(hn::Add(hn::Mul(b, b), hn::Mul(set(4), q)));
        const V falling = hn::IfThenElseZero(hn::Gt(q, zero), hn::Div(hn::Mul(set(2), q), hn::Sub(root, b)));
        left = hn::Min(left, hn::IfThenElse(hn::Gt(b, zero), hn::Div(hn::Add(b, root), set(2)), falling));
    }
    return left;
}

/// See pbr::left_needed; 0 where metallic is 0.
HWY_INLINE V left_needed(const V (&least)[3], const V (&f0)[3], V metallic, V rest) {
    V needed = hn::Zero(d);
    for (int c = 0; c < 3; ++c) {
        const V ratio = hn::Max(set(1), hn::Div(metallic, f0[c]));
        const auto is_lit = hn::And(hn::Gt(least[c], hn::Zero(d)), hn::Gt(metallic, hn::Zero(d)));
        needed = hn::Max(needed, hn::IfThenElseZero(is_lit, hn::Mul(hn::Div(least[c], rest), ratio)));
    }
    return needed;
}

HWY_INLINE void material_at(std::size_t i, const ReflectedPlanes& reflected, const float* metallic,
                            float dielectric_f0, const ColourPlanes& tolerances, bool coupled,
                            float largest_error, const MaterialPlanes& materials) {
    constexpr float kLeastTold = 1e-5f;
    const V one = set(1), zero = hn::Zero(d), f = set(dielectric_f0);
    const V m = hn::LoadU(d, metallic + i), rest = hn::Sub(one, m);
    const auto is_part = hn::Gt(m, zero), is_mixed = hn::Gt(rest, zero);
    const V usual_left = set(coupled ? 1 - dielectric_f0 : 1);
    V f0s[3], diffuse[3], least[3], most[3];
    for (std::size_t c = 0; c < 3; ++c) f0s[c] = hn::LoadU(d, reflected.f0[c] + i);
    const V light = hn::Sub(one, max_channel(f0s));
    for (std::size_t c = 0; c < 3; ++c) {
        const V own = hn::LoadU(d, reflected.diffuse[c] + i), tolerance = hn::LoadU(d, tolerances[c] + i);
        const V error = hn::Max(tolerance, set(largest_error)), brighter = hn::Add(own, error);
        least[c] = hn::Sub(hn::Min(own, light), error);
        most[c] = coupled ? hn::Max(own, hn::Min(brighter, hn::Sub(light, error))) : brighter;
        const V base = clamp(hn::Div(hn::Sub(f0s[c], hn::Mul(f, rest)), m), zero, one);
        const V ideal = hn::Mul(hn::Mul(base, rest), usual_left);
        const V wanted =
            clamp(ideal, hn::Max(zero, hn::Sub(own, tolerance)), hn::Min(hn::Add(own, tolerance), most[c]));
        diffuse[c] = hn::IfThenElse(is_part, wanted, own);
    }
    V own_left = one, left = one;
    if (coupled) {
        left = own_left = left_for(diffuse, f0s, m, rest);
        const V needed = hn::AllFalse(d, is_part) ? zero : left_needed(least, f0s, m, rest);
        if (!hn::AllFalse(d, hn::Gt(needed, left))) {
            const V raised = hn::Max(left, hn::Min(needed, left_for(most, f0s, m, rest)));
            left = hn::IfThenElse(hn::Gt(needed, left), raised, left);
        }
    }
    const V per_base = hn::Mul(rest, left);
    const auto is_lit = hn::Gt(per_base, zero), is_raised = hn::Gt(left, own_left);
    const bool raises = !hn::AllFalse(d, is_raised);
    const V told = hn::Min(one, hn::Div(hn::Mul(rest, rest), set(kLeastTold * kLeastTold)));
    const V untold = hn::Mul(f, hn::Sub(one, told));
    for (int c = 0; c < 3; ++c) {
        const V f0 = f0s[c];
        const V wanted = hn::IfThenElseZero(is_lit, hn::Div(diffuse[c], per_base));
        V lowest = hn::Max(zero, hn::Div(hn::Sub(f0, rest), m));
        if (raises) {
            const V dim =
                hn::Min(hn::Div(hn::Add(hn::Sub(f0, rest), per_base), m), hn::Div(most[c], per_base));
            lowest = hn::IfThenElse(is_raised, hn::Max(lowest, dim), lowest);
        }
        lowest = hn::IfThenElseZero(is_part, lowest);
        const V highest = hn::IfThenElse(is_part, hn::Min(one, hn::Div(f0, m)), one);
        const V base = clamp(wanted, hn::Min(lowest, highest), highest);
        const V residual = clamp(hn::Div(hn::Sub(f0, hn::Mul(base, m)), rest), zero, one);
        const V dielectric = hn::Add(hn::Mul(residual, told), untold);
        const auto channel = static_cast<std::size_t>(c);
        hn::StoreU(hn::IfThenElse(is_mixed, base, f0), d, materials.base_color[channel] + i);
        hn::StoreU(hn::IfThenElse(is_mixed, dielectric, f), d, materials.dielectric_f0[channel] + i);
    }
}

/// Returns how many texels were done.
std::size_t material_all(const ReflectedPlanes& reflected, const float* metallic, float dielectric_f0,
                         const ColourPlanes& tolerance, DiffuseCoupling coupling, float largest_error,
                         std::size_t count, const MaterialPlanes& materials) {
    const std::size_t lanes = hn::Lanes(d);
    const bool coupled = coupling == DiffuseCoupling::fresnel;
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes)
        material_at(i, reflected, metallic, dielectric_f0, tolerance, coupled, largest_error, materials);
    return i;
}

/// See pbr::material_without_residual.
HWY_INLINE void grey_material_at(std::size_t i, const ReflectedPlanes& reflected, const float* metallic,
                                 float dielectric_f0, float largest_f0, bool coupled,
                                 const MaterialPlanes& materials) {
    const V one = set(1), zero = hn::Zero(d), usual = set(dielectric_f0);
    const V m = hn::LoadU(d, metallic + i), rest = hn::Sub(one, m), rest2 = hn::Mul(rest, rest);
    const V weight = hn::Add(rest2, hn::Mul(m, m));
    const V told = hn::Div(rest2, hn::Add(rest2, set(1e-3f)));
    const auto is_mixed = hn::Gt(rest, zero);
    V base[3], f = usual;
    for (int turn = 0; turn < kGreyTurns; ++turn) {
        const V left = coupled ? hn::Sub(one, f) : one, dielectric = hn::Mul(f, rest);
        V unexplained = zero;
        for (std::size_t c = 0; c < 3; ++c) {
            const V diffuse = hn::LoadU(d, reflected.diffuse[c] + i), f0 = hn::LoadU(d, reflected.f0[c] + i);
            const V own = hn::IfThenElseZero(hn::Gt(left, zero), hn::Div(diffuse, left));
            const V metal = hn::Mul(m, hn::Sub(f0, dielectric));
            base[c] = clamp(hn::Div(hn::Add(hn::Mul(rest, own), metal), weight), zero, one);
            unexplained = hn::Add(unexplained, hn::Div(hn::Sub(f0, hn::Mul(base[c], m)), set(3)));
        }
        if (largest_f0 <= 0) break;
        const V found = clamp(hn::Div(unexplained, rest), zero, set(largest_f0));
        f = hn::Add(usual, hn::Mul(hn::Sub(hn::IfThenElse(is_mixed, found, usual), usual), told));
    }
    for (std::size_t c = 0; c < 3; ++c) {
        hn::StoreU(base[c], d, materials.base_color[c] + i);
        hn::StoreU(f, d, materials.dielectric_f0[c] + i);
    }
}

/// Returns how many texels were done.
std::size_t grey_material_all(const ReflectedPlanes& reflected, const float* metallic, float dielectric_f0,
                              float largest_f0, DiffuseCoupling coupling, std::size_t count,
                              const MaterialPlanes& materials) {
    const std::size_t lanes = hn::Lanes(d);
    const bool coupled = coupling == DiffuseCoupling::fresnel;
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes)
        grey_material_at(i, reflected, metallic, dielectric_f0, largest_f0, coupled, materials);
    return i;
}

HWY_INLINE V alike_at(std::size_t i, const ReflectedPlanes& reflected, const float* metallic,
                      const float* confidence, std::span<const std::ptrdiff_t> apart) {
    const auto at = [i](const float* plane) HWY_ATTR { return hn::LoadU(d, plane + i); };
    const V alike2 = set(kAlike2);
    V here[6];
    for (std::size_t c = 0; c < 3; ++c) {
        here[c] = at(reflected.diffuse[c]);
        here[c + 3] = at(reflected.f0[c]);
    }
    V sum = hn::Mul(at(metallic), set(kOwnWeight)), weights = set(kOwnWeight);
    for (const std::ptrdiff_t there : apart) {
        V far = hn::Zero(d);
        for (std::size_t c = 0; c < 6; ++c) {
            const float* plane = c < 3 ? reflected.diffuse[c] : reflected.f0[c - 3];
            const V off = hn::Sub(at(plane + there), here[c]);
            far = hn::Add(far, hn::Mul(off, off));
        }
        const V likeness = hn::Div(alike2, hn::Add(alike2, far));
        const V weight = hn::Mul(hn::Mul(at(confidence + there), likeness), likeness);
        sum = hn::Add(sum, hn::Mul(weight, at(metallic + there)));
        weights = hn::Add(weights, weight);
    }
    return hn::Div(sum, weights);
}

/// Returns how many texels were done.
std::size_t alike_all(const ReflectedPlanes& reflected, const float* metallic, const float* confidence,
                      std::span<const std::ptrdiff_t> apart, std::size_t count, float* means) {
    const std::size_t lanes = hn::Lanes(d);
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes)
        hn::StoreU(alike_at(i, reflected, metallic, confidence, apart), d, means + i);
    return i;
}

}  // namespace HWY_NAMESPACE
}  // namespace pbr
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pbr {
namespace {

HWY_EXPORT(estimate_all);
HWY_EXPORT(limit_all);
HWY_EXPORT(material_all);
HWY_EXPORT(grey_material_all);
HWY_EXPORT(alike_all);

Vec3<float> colour_at(const ColourPlanes& planes, std::size_t i) {
    return {planes[0][i], planes[1][i], planes[2][i]};
}

Reflected<float> reflected_at(const ReflectedPlanes& planes, std::size_t i) {
    return {colour_at(planes.diffuse, i), colour_at(planes.f0, i)};
}

void store(const MetallicMaterial<float>& material, const MaterialPlanes& planes, std::size_t i) {
    for (std::size_t c = 0; c < 3; ++c) {
        planes.base_color[c][i] = material.base_color[static_cast<int>(c)];
        planes.dielectric_f0[c][i] = material.dielectric_f0[static_cast<int>(c)];
    }
}

float alike_of_one(std::ptrdiff_t i, const ReflectedPlanes& reflected, const float* metallic,
                   const float* confidence, std::span<const std::ptrdiff_t> apart) {
    float sum = metallic[i] * kOwnWeight, weights = kOwnWeight;
    for (const std::ptrdiff_t there : apart) {
        float far = 0;
        for (const ColourPlanes* planes : {&reflected.diffuse, &reflected.f0})
            for (const float* plane : *planes) {
                const float off = plane[i + there] - plane[i];
                far += off * off;
            }
        const float likeness = kAlike2 / (kAlike2 + far);
        const float weight = confidence[i + there] * likeness * likeness;
        sum += weight * metallic[i + there];
        weights += weight;
    }
    return sum / weights;
}

}  // namespace

void estimate_metallic(const ReflectedPlanes& reflected, const MetallicPrior<float>& prior,
                       const ReflectedPlanes& half_steps, DiffuseCoupling coupling, std::size_t count,
                       float* metallic, float* confidence) {
    std::size_t i = HWY_DYNAMIC_DISPATCH(estimate_all)(reflected, prior, half_steps, coupling, count,
                                                       metallic, confidence);
    for (; i < count; ++i) {
        const Quantisation<float> half_step{colour_at(half_steps.diffuse, i), colour_at(half_steps.f0, i)};
        const auto found = estimate_metallic<float>(reflected_at(reflected, i), prior, half_step, coupling);
        metallic[i] = found.metallic;
        confidence[i] = found.confidence;
    }
}

void largest_metallic(const ReflectedPlanes& reflected, float largest_error, std::size_t count,
                      float* metallic) {
    std::size_t i = HWY_DYNAMIC_DISPATCH(limit_all)(reflected, largest_error, count, metallic);
    for (; i < count; ++i) metallic[i] = largest_metallic<float>(reflected_at(reflected, i), largest_error);
}

void material_with_residual(const ReflectedPlanes& reflected, const float* metallic, float dielectric_f0,
                            const ColourPlanes& diffuse_tolerance, DiffuseCoupling coupling,
                            float largest_error, std::size_t count, const MaterialPlanes& materials) {
    std::size_t i = HWY_DYNAMIC_DISPATCH(material_all)(reflected, metallic, dielectric_f0, diffuse_tolerance,
                                                       coupling, largest_error, count, materials);
    for (; i < count; ++i)
        store(material_with_residual<float>(reflected_at(reflected, i), metallic[i], dielectric_f0,
                                            colour_at(diffuse_tolerance, i), coupling, largest_error),
              materials, i);
}

void material_without_residual(const ReflectedPlanes& reflected, const float* metallic, float dielectric_f0,
                               float largest_f0, DiffuseCoupling coupling, std::size_t count,
                               const MaterialPlanes& materials) {
    std::size_t i = HWY_DYNAMIC_DISPATCH(grey_material_all)(reflected, metallic, dielectric_f0, largest_f0,
                                                            coupling, count, materials);
    for (; i < count; ++i)
        store(material_without_residual<float>(reflected_at(reflected, i), metallic[i], dielectric_f0,
                                               largest_f0, coupling),
              materials, i);
}

void metallic_of_alike(const ReflectedPlanes& reflected, const float* metallic, const float* confidence,
                       std::span<const std::ptrdiff_t> apart, std::size_t count, float* means) {
    std::size_t i = HWY_DYNAMIC_DISPATCH(alike_all)(reflected, metallic, confidence, apart, count, means);
    for (; i < count; ++i)
        means[i] = alike_of_one(static_cast<std::ptrdiff_t>(i), reflected, metallic, confidence, apart);
}

}  // namespace pbr
#endif
