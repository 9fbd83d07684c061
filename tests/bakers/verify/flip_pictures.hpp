#pragma once
// Pictures given by formulas, so that another implementation of FLIP can be shown the same.

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>

namespace pbrbake::test {

/// In [0, 1), from a place and a channel.
inline double hashed(int x, int y, int c) {
    std::uint32_t h = static_cast<std::uint32_t>(x) * 0x9E3779B1u ^
                      static_cast<std::uint32_t>(y) * 0x85EBCA77u ^
                      static_cast<std::uint32_t>(c) * 0xC2B2AE3Du;
    h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
    h = (h ^ (h >> 12)) * 0x297A2D39u;
    return (h ^ (h >> 15)) / 4294967296.0;
}

constexpr int kPictureWidth = 96, kPictureHeight = 64;

/// Coloured bars under a gradient, and the same moved by a pixel and less saturated. Linear, in [0, 1].
inline glm::dvec3 bars(int x, int y, bool test) {
    const int bar = (test ? x + 1 : x) / 12 % 4;
    const double shade = 0.15 + 0.8 * y / kPictureHeight, chroma = test ? 0.8 : 1.0;
    const std::array<glm::dvec3, 4> colours{
        {{0.9, 0.2, 0.1}, {0.1, 0.6, 0.2}, {0.1, 0.2, 0.8}, {0.7, 0.7, 0.6}}};
    const glm::dvec3 colour = colours[static_cast<std::size_t>(bar)];
    const double grey = (colour.x + colour.y + colour.z) / 3;
    return shade * (grey + chroma * (colour - grey));
}

/// A soft sky with a sun of 2e4, and the same with noise and the sun at half. Mean about 5.
inline glm::dvec3 sky(int x, int y, bool test) {
    const double dx = (x - 61.5) / 9, dy = (y - 20.5) / 9;
    const double sun = 2e4 * std::exp(-40 * (dx * dx + dy * dy)) * (test ? 0.5 : 1.0);
    const double haze = 3 * std::exp(-0.4 * std::sqrt(dx * dx + dy * dy));
    glm::dvec3 value =
        glm::dvec3(0.3, 0.5, 0.9) * (0.2 + 1.0 * y / kPictureHeight) + glm::dvec3(1, 0.9, 0.7) * (sun + haze);
    if (test)
        for (int c = 0; c < 3; ++c) value[c] *= 0.85 + 0.3 * hashed(x, y, c);
    return value;
}

/// A dark room with a few small lamps, and the same with the lamps spread over their neighbours.
inline glm::dvec3 lamps(int x, int y, bool test) {
    const bool lit = x % 16 == 8 && y % 16 == 8;
    const bool near = std::abs(x % 16 - 8) + std::abs(y % 16 - 8) == 1;
    const double lamp = test ? (lit ? 400.0 : near ? 100.0 : 0.0) : (lit ? 800.0 : 0.0);
    return glm::dvec3(0.04, 0.03, 0.02) * (1 + 0.5 * std::sin(0.3 * x) * std::cos(0.2 * y)) +
           glm::dvec3(1, 0.8, 0.5) * lamp;
}

}  // namespace pbrbake::test
