#pragma once
// Pictures that tests of environments share.

#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <numbers>
#include <vector>

#include "pbr/ibl/environment.hpp"
#include "pbr/numerics/sequence.hpp"

namespace pbr {

/// An equirect of a function of direction in the picture's own frame.
template <class F>
std::vector<float> picture_of(int width, int height, const F& f) {
    std::vector<float> rgb;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::dvec3 value = f(equirect_direction((x + 0.5) / width, (y + 0.5) / height));
            for (int c = 0; c < 3; ++c) rgb.push_back(static_cast<float>(value[c]));
        }
    return rgb;
}

/// Independent texels in [0, 1).
inline std::vector<float> noise_picture(int width, int height, std::uint64_t seed = 1) {
    std::vector<float> rgb(static_cast<std::size_t>(width) * height * 3);
    for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = static_cast<float>(random_unit(seed, i));
    return rgb;
}
inline std::vector<float> noise_cube(int size, std::uint64_t seed = 5) {
    return noise_picture(size, 6 * size, seed);
}

/// A uniform direction.
inline glm::dvec3 random_direction(std::uint64_t seed, int i) {
    const double z = 2 * random_unit(seed, i, 0) - 1, phi = 2 * std::numbers::pi * random_unit(seed, i, 1);
    const double s = std::sqrt(1 - z * z);
    return {s * std::cos(phi), s * std::sin(phi), z};
}

}  // namespace pbr
