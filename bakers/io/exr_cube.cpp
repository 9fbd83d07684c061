#include "bakers/io/exr_cube.hpp"

#include <ImfEnvmap.h>

#include <array>
#include <cmath>

namespace pbrbake::io {
namespace {

using Imath::V2f;
using Imath::V3f;

/// Our faces (image.hpp): the direction of the face's middle, and of growing s (x) and t (y), as OpenGL
/// samples them.
struct Axes {
    V3f middle, s, t;
};
const std::array<Axes, 6> kAxes{{
    {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
    {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
    {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
    {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
    {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
    {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}},
}};

}  // namespace

ExrFace exr_face(int face, int size) {
    if (size == 1) return {face, 0, 0};
    // Two texels a side show the face's turn: OpenEXR puts their centres on the corners of the cube.
    const Imath::Box2i window({0, 0}, {1, 11});
    const auto cube_face = static_cast<Imf::CubeMapFace>(face);
    const Axes& axes = kAxes[static_cast<std::size_t>(face)];
    const auto place = [&](float s, float t) {
        const V3f wanted = axes.middle + axes.s * s + axes.t * t;
        for (const V2f& in_face : {V2f(0, 0), V2f(1, 0), V2f(0, 1), V2f(1, 1)})
            if ((Imf::CubeMap::direction(cube_face, window, in_face) - wanted).length() < .5f)
                return Imf::CubeMap::pixelPosition(cube_face, window, in_face);
        return V2f(0, 0);
    };
    const V2f corner = place(-1, -1), right = place(1, -1) - corner, down = place(-1, 1) - corner;
    // Scaled from 2 texels a side to `size`.
    const auto index = [&](float x, float y) {
        return static_cast<std::ptrdiff_t>(std::lround(y)) * size +
               static_cast<std::ptrdiff_t>(std::lround(x));
    };
    const float last = static_cast<float>(size - 1);
    const float row = corner.y - static_cast<float>(2 * face);  // 0 or 1 inside the face
    ExrFace map;
    map.origin = static_cast<std::ptrdiff_t>(face) * size * size + index(corner.x * last, row * last);
    map.along_x = index(right.x, right.y);
    map.along_y = index(down.x, down.y);
    return map;
}

}  // namespace pbrbake::io
