#pragma once
// One face of a level in memory: what differences are looked for in.

#include <array>
#include <vector>

#include "bakers/image.hpp"

namespace pbrbake::verify {

/// Of a cube map's faces, in their order.
inline constexpr std::array<const char*, 6> kFaceNames{"+X", "-X", "+Y", "-Y", "+Z", "-Z"};

struct Face {
    int width = 0, height = 0, channels = 0;
    std::vector<float> texels;

    float at(int x, int y, int c) const {
        return texels[(static_cast<std::size_t>(y) * width + x) * channels + c];
    }
    float& at(int x, int y, int c) {
        return texels[(static_cast<std::size_t>(y) * width + x) * channels + c];
    }
    /// Bilinear at continuous texel coordinates, clamped to the picture.
    float between(double x, double y, int c) const;
};

Face face_of(const Image& image, int level, int face);

/// Means of 2 x 2 texels until no side is above `side`; odd sides are left as they are.
Face shrunk(Face face, int side);

/// The middle of a face, no side above `side`.
Face window_of(const Face& face, int side);

/// One of the eight ways to lay a square onto itself: bit 0 mirrors u, bit 1 mirrors v, bit 2 swaps them
/// first, and needs a square.
Face turned(const Face& face, int way);

/// Mean over values of |a - b| / max(|a|, |b|, typical of the channel): 0 for equal faces, at most 2. One
/// bright texel is one texel. `margin` texels along the edges are left out; values that aren't finite count
/// as equal.
double distance(const Face& a, const Face& b, const std::vector<double>& typical, int margin = 0);

}  // namespace pbrbake::verify
