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
    constexpr float kSharpest = 1e-6f, kWater = .02f, kDoubt = .02f;
    const V one = set(1), zero = hn::Zero(d);
    const float f = prior.dielectric_f0;
    const auto finite = [&](V x) HWY_ATTR { return hn::IfThenElseZero(hn::Gt(x, zero), hn::Min(x, one)); };
    V diffuse[3], f0[3];
    for (std::size_t c = 0; c < 3; ++c) {
        diffuse[c] = finite(hn::Div(hn::LoadU(d, reflected.diffuse[c] + i), set(left)));
        f0[c] = finite(hn::LoadU(d, reflected.f0[c] + i));
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
    const V m = hn::Mul(root, hn::Div(odds, hn::Add(one, odds)));

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

/// What the dielectric leaves of diffuse light: see pbr::material_with_residual.
HWY_INLINE V left_of(const V (&diffuse)[3], const V (&f0)[3], V metallic, V rest) {
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

HWY_INLINE void material_at(std::size_t i, const ReflectedPlanes& reflected, const float* metallic,
                            float dielectric_f0, const ColourPlanes& tolerance, bool coupled,
                            const MaterialPlanes& materials) {
    const V one = set(1), zero = hn::Zero(d), f = set(dielectric_f0);
    const V m = hn::LoadU(d, metallic + i), rest = hn::Sub(one, m);
    const auto is_part = hn::Gt(m, zero);
    const V usual_left = set(coupled ? 1 - dielectric_f0 : 1);
    V diffuse[3], f0[3];
    for (std::size_t c = 0; c < 3; ++c) {
        f0[c] = hn::LoadU(d, reflected.f0[c] + i);
        const V own = hn::LoadU(d, reflected.diffuse[c] + i), reach = hn::LoadU(d, tolerance[c] + i);
        const V base = clamp(hn::Div(hn::Sub(f0[c], hn::Mul(f, rest)), m), zero, one);
        const V ideal = hn::Mul(hn::Mul(base, rest), usual_left);
        diffuse[c] = hn::IfThenElse(
            is_part, clamp(ideal, hn::Max(zero, hn::Sub(own, reach)), hn::Add(own, reach)), own);
    }
    const V left = coupled ? left_of(diffuse, f0, m, rest) : one;
    const auto is_mixed = hn::Gt(rest, zero);
    for (std::size_t c = 0; c < 3; ++c) {
        const V wanted = hn::IfThenElseZero(hn::Gt(left, zero), hn::Div(diffuse[c], hn::Mul(rest, left)));
        const V lowest = hn::IfThenElseZero(is_part, hn::Max(zero, hn::Div(hn::Sub(f0[c], rest), m)));
        const V highest = hn::IfThenElse(is_part, hn::Min(one, hn::Div(f0[c], m)), one);
        const V base = clamp(wanted, hn::Min(lowest, highest), highest);
        const V residual = clamp(hn::Div(hn::Sub(f0[c], hn::Mul(base, m)), rest), zero, one);
        hn::StoreU(hn::IfThenElse(is_mixed, base, f0[c]), d, materials.base_color[c] + i);
        hn::StoreU(hn::IfThenElse(is_mixed, residual, f), d, materials.dielectric_f0[c] + i);
    }
}

/// Returns how many texels were done.
std::size_t material_all(const ReflectedPlanes& reflected, const float* metallic, float dielectric_f0,
                         const ColourPlanes& tolerance, DiffuseCoupling coupling, std::size_t count,
                         const MaterialPlanes& materials) {
    const std::size_t lanes = hn::Lanes(d);
    const bool coupled = coupling == DiffuseCoupling::fresnel;
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes)
        material_at(i, reflected, metallic, dielectric_f0, tolerance, coupled, materials);
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

void material_with_residual(const ReflectedPlanes& reflected, const float* metallic, float dielectric_f0,
                            const ColourPlanes& diffuse_tolerance, DiffuseCoupling coupling,
                            std::size_t count, const MaterialPlanes& materials) {
    std::size_t i = HWY_DYNAMIC_DISPATCH(material_all)(reflected, metallic, dielectric_f0, diffuse_tolerance,
                                                       coupling, count, materials);
    for (; i < count; ++i)
        store(material_with_residual<float>(reflected_at(reflected, i), metallic[i], dielectric_f0,
                                            colour_at(diffuse_tolerance, i), coupling),
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
