#pragma once
// The maths of specular_gloss.hpp over many texels, held a plane a channel: float, and bit for bit what its
// functions give, on every CPU.

#include <array>
#include <cstddef>

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

/// material_with_residual of `count` texels, with the same domain. Outputs may not overlap inputs.
void material_with_residual(const ReflectedPlanes& reflected, const float* metallic, float dielectric_f0,
                            const ColourPlanes& diffuse_tolerance, DiffuseCoupling coupling,
                            std::size_t count, const MaterialPlanes& materials);

}  // namespace pbr
