#pragma once
// What the LD kernels of all targets share with their callers.

#include <hwy/base.h>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "pbr/ibl/moment_tree.hpp"
#include "pbr/ibl/patches.hpp"
#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/frame.hpp"
#include "src/simd/patch_kernel.hpp"

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

/// Fills a group with 1 to kLdGroup directions, the last of them in unused places, its sums 0, and returns a
/// cone around them.
Cone ld_fill_group(std::span<const glm::dvec3> directions, LdGroup& group);

/// The order of points for texels of an angle, `nearest_angle` from the axis of the lobe.
int ld_order_index(double texel_angle, double alpha, double nearest_angle);

/// A node of a tree.
struct MomentNode {
    const MomentCone* cone;
    const Moments* moments;
};

/// One direction, and its sums: r, g, b and the weights' own.
struct LdSingle {
    glm::dvec3 n;
    double sum[4];
};

/// Adds k weight radiance of all points to a group's sums, k = normalisation mu+ / f^2.
void ld_add_points(const PatchPoints& points, double alpha, double normalisation, LdGroup& group);

/// The same of nodes, k expanded to third order about each node's centre.
void ld_add_nodes(std::span<const MomentNode> nodes, double alpha, double normalisation, LdGroup& group);

/// The same for one direction, points side by side: a list of them, or a block of an equirect.
void ld_add_points(const PatchPoints& points, double alpha, double normalisation, LdSingle& single);
void ld_add_points(const LatLongPatch& patch, double alpha, double normalisation, LdSingle& single);
void ld_add_nodes(std::span<const MomentNode> nodes, double alpha, double normalisation, LdSingle& single);

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
