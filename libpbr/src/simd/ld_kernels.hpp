#pragma once
// What the LD kernels of all targets share with their callers.

#include <hwy/base.h>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/frame.hpp"

namespace pbr {

class EnvironmentSampler;
struct MisSamples;

/// The frame of a texel: columns t, b, n of the matrix that takes samples to the world.
struct TexelFrame {
    float tx, ty, tz, bx, by, bz, nx, ny, nz;
};

/// A right-handed frame about n, turned by `turns` about it, its vectors then taken on by `matrix`.
inline TexelFrame turned_frame(const glm::dvec3& n, double turns, const glm::dmat3& matrix = glm::dmat3(1)) {
    const AxisFrame<double> frame = frame_about(n);
    const SinCos turn = sin_cos_pi(2 * turns);
    const glm::dvec3 t = matrix * (frame.x * turn.cos + frame.y * turn.sin);
    const glm::dvec3 b = matrix * (frame.y * turn.cos - frame.x * turn.sin), m = matrix * n;
    const auto f = [](double value) { return static_cast<float>(value); };
    return {f(t.x), f(t.y), f(t.z), f(b.x), f(b.y), f(b.z), f(m.x), f(m.y), f(m.z)};
}

/// Output directions that share their points, whatever the vector width.
inline constexpr int kLdGroup = 16;

/// Directions of a group, and its sums: r, g, b and the weights' own.
struct LdGroup {
    HWY_ALIGN_MAX float x[kLdGroup], y[kLdGroup], z[kLdGroup];
    double sum[4][kLdGroup];
};

/// Samples that are summed side by side, whatever the vector width: what sets of MisSamples are padded to.
inline constexpr int kMisPadding = 16;

/// alpha^2 and the factor of a GgxZonalKernel.
struct MisLobe {
    float alpha2, normalisation;
};

/// LD of one texel from one of the sets of samples: n in the world, and the texel's frame in the picture's
/// own; see simd/ld_mis_kernel.cpp.
void mis_texel(const EnvironmentSampler& environment, const MisSamples& samples, int set, const MisLobe& lobe,
               const glm::dvec3& n, const TexelFrame& in_picture, float* rgb);

}  // namespace pbr
