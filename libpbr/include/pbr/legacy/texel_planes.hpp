#pragma once
// The maths of specular_gloss.hpp over many texels, held a plane a channel: float, and bit for bit what its
// functions give, on every CPU. And what texels tell of each other, which one alone can't.

#include <array>
#include <cstddef>
#include <span>

#include "pbr/legacy/specular_gloss.hpp"

namespace pbr {

/// A colour a texel: R, G and B of texel i are planes[0][i], planes[1][i] and planes[2][i].
using ColourPlanes = std::array<const float*, 3>;

/// What texels reflect, or half the intervals that these numbers stand for.
struct ReflectedPlanes {
    ColourPlanes diffuse, f0;
};

/// Where materials are written to; their metallic is an argument.
struct MaterialPlanes {
    std::array<float*, 3> base_color, dielectric_f0;
};

/// estimate_metallic of `count` texels, with the same domain. Outputs may not overlap inputs.
void estimate_metallic(const ReflectedPlanes& reflected, const MetallicPrior<float>& prior,
                       const ReflectedPlanes& half_steps, DiffuseCoupling coupling, std::size_t count,
                       float* metallic, float* confidence);

/// largest_metallic of `count` texels, with the same domain. Outputs may not overlap inputs.
void largest_metallic(const ReflectedPlanes& reflected, float largest_error, std::size_t count,
                      float* metallic);

/// material_with_residual of `count` texels, with the same domain. Outputs may not overlap inputs.
void material_with_residual(const ReflectedPlanes& reflected, const float* metallic, float dielectric_f0,
                            const ColourPlanes& diffuse_tolerance, DiffuseCoupling coupling,
                            float largest_error, std::size_t count, const MaterialPlanes& materials);

/// material_without_residual of `count` texels, with the same domain. Outputs may not overlap inputs.
void material_without_residual(const ReflectedPlanes& reflected, const float* metallic, float dielectric_f0,
                               float largest_f0, DiffuseCoupling coupling, std::size_t count,
                               const MaterialPlanes& materials);

/// Of metallic_of_alike: the squared distance in diffuse and f0 at which a weight is 1/4, and the weight of a
/// texel itself.
inline constexpr float kAlike2 = .05f * .05f, kOwnWeight = 1e-3f;

/// What texels near by say of the metallic of `count` texels: a joint bilateral filter (Petschnigg et al.
/// 2004, "Digital photography with flash and no-flash image pairs") with confidence as a weight. The mean of
/// metallic over the texels that are `apart` from each, places in the planes that must be readable, and over
/// itself. Weights are confidence likeness^2, likeness = kAlike2 / (kAlike2 + squared distance in diffuse and
/// f0): rational instead of Gaussian; squared, so that what is nothing like a texel doesn't outweigh it by
/// its numbers. Metallic and confidence in [0, 1]. Relative error below 1e-5 for up to 24 texels apart. means
/// may not overlap inputs.
void metallic_of_alike(const ReflectedPlanes& reflected, const float* metallic, const float* confidence,
                       std::span<const std::ptrdiff_t> apart, std::size_t count, float* means);

}  // namespace pbr
