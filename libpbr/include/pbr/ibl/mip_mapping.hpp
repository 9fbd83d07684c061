#pragma once
// Which level of a prefiltered cube map holds which roughness: the mappings of engines, each with its
// inverse. The linear one is in brdf/roughness.hpp. T is float or double.
//
// `top_level` is the last level that holds a lobe, counted from 0 (levels - 1): perceptual roughness 1. All
// mappings but Unreal's take perceptual_roughness in [0, 1] onto [0, top_level], increasing; inverses go back
// within 8 ulp of 1, apart from where the slope of the mapping vanishes, as said at each.

#include <algorithm>
#include <cmath>

namespace pbr {

/// Frostbite's: sqrt(perceptual_roughness) of the way (Lagarde & de Rousiers 2014, eq. 63). Spends levels on
/// smooth surfaces.
template <class T>
T level_frostbite(T perceptual_roughness, T top_level) {
    return top_level * std::sqrt(perceptual_roughness);
}

/// Inverse of level_frostbite; level in [0, top_level], top_level > 0.
template <class T>
T perceptual_roughness_frostbite(T level, T top_level) {
    return (level / top_level) * (level / top_level);
}

/// Filament's: p (2 - p) of the way (shaders/src/light_indirect.fs, perceptualRoughnessToLod; a fit to log2
/// for five levels). The slope vanishes at p = 1, so there a rounding of the level is its square root in p:
/// 4e-4 in float, 2e-8 in double.
template <class T>
T level_filament(T perceptual_roughness, T top_level) {
    return top_level * perceptual_roughness * (T(2) - perceptual_roughness);
}

/// Inverse of level_filament, 1 - sqrt(1 - level / top_level), written without cancellation at 0 (cmgen's
/// lodToPerceptualRoughness). level in [0, top_level], top_level > 0.
template <class T>
T perceptual_roughness_filament(T level, T top_level) {
    const T x = level / top_level;
    return x / (T(1) + std::sqrt(std::max(T(0), T(1) - x)));
}

/// Unity's: p (1.7 - .7 p) of the way (render-pipelines core, ImageBasedLighting.hlsl,
/// PerceptualRoughnessToMipmapLevel).
template <class T>
T level_unity(T perceptual_roughness, T top_level) {
    return top_level * perceptual_roughness * (T(1.7) - T(0.7) * perceptual_roughness);
}

/// Inverse of level_unity: the smaller root of .7 p^2 - 1.7 p + x = 0, x = level / top_level
/// (MipmapLevelToPerceptualRoughness, there with cancellation at 0). level in [0, top_level], top_level > 0.
template <class T>
T perceptual_roughness_unity(T level, T top_level) {
    const T x = level / top_level;
    return T(2) * x / (T(1.7) + std::sqrt(std::max(T(0), T(1.7) * T(1.7) - T(2.8) * x)));
}

/// Unreal's: max_mip - 2 + 1.2 log2(perceptual_roughness), so that a level counted from the 1x1 end means one
/// roughness whatever the cube's size (ReflectionEnvironmentShared.ush,
/// ComputeReflectionCaptureMipFromRoughness: roughest level 1 from the last but one, scale 1.2). `max_mip` is
/// log2 of the cube's size, 7 for 128. Roughness 1 lies on level max_mip - 2, 4x4 texels. Clamped to 0:
/// roughness below 2^((2 - max_mip)/1.2), .0557 for max_mip 7, shares level 0 with the mirror.
template <class T>
T level_unreal(T perceptual_roughness, T max_mip) {
    if (!(perceptual_roughness > T(0))) return T(0);
    return std::max(T(0), max_mip - T(2) + T(1.2) * std::log2(perceptual_roughness));
}

/// Inverse of level_unreal above level 0: 2^((level + 2 - max_mip) / 1.2). At level 0 the largest roughness
/// that maps there; above max_mip - 2 it exceeds 1, and engines clamp.
template <class T>
T perceptual_roughness_unreal(T level, T max_mip) {
    return std::exp2((level + T(2) - max_mip) / T(1.2));
}

}  // namespace pbr
