#pragma once
// What the LD kernels of all targets share with their callers.

#include <hwy/base.h>

namespace pbr {

/// The frame of a texel: columns t, b, n of the matrix that takes samples to the world.
struct TexelFrame {
    float tx, ty, tz, bx, by, bz, nx, ny, nz;
};

/// Output directions that share their points, whatever the vector width.
inline constexpr int kLdGroup = 16;

/// Directions of a group, and its sums: r, g, b and the weights' own.
struct LdGroup {
    HWY_ALIGN_MAX float x[kLdGroup], y[kLdGroup], z[kLdGroup];
    double sum[4][kLdGroup];
};

}  // namespace pbr
