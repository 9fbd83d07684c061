#pragma once
// Sources and bakes that the tests of probes share.

#include <cstddef>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

#include "bakers/context.hpp"
#include "bakers/probe/params.hpp"
#include "bakers/probe/probe.hpp"
#include "pbr/ibl/environment.hpp"
#include "pbr/numerics/sequence.hpp"

namespace pbrbake::probe {

/// A small probe of four levels by `fis`.
inline ProbeParams defaults() {
    ProbeParams params{};
    params.source = "test";
    params.colour_space = "auto";
    params.size = 32;
    params.levels = 4;
    params.integrator = Integrator::fis;
    params.samples = {64};
    params.level_bias = 1;
    return params;
}

/// An equirect of a function of direction (in the picture's own frame).
template <class F>
Inputs equirect(int width, const F& f) {
    SourceImage source;
    source.image.channels = {"R", "G", "B"};
    source.image.levels.push_back(
        {width, width / 2, std::vector<float>(static_cast<std::size_t>(width) * (width / 2) * 3)});
    for (int y = 0; y < width / 2; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::dvec3 value = f(pbr::equirect_direction((x + 0.5) / width, (y + 0.5) / (width / 2)));
            for (int c = 0; c < 3; ++c) source.image.texel(0, 0, y, x)[c] = static_cast<float>(value[c]);
        }
    return {{"source", std::move(source)}};
}

/// Channels tell the axes apart.
inline glm::dvec3 axes_picture(const glm::dvec3& d) { return {2 + d.x, 2 + d.y, 2 + d.z}; }

/// White noise from 0 to 1.
inline Inputs noise_cube(int size) {
    SourceImage source;
    source.image.channels = {"R", "G", "B"};
    source.image.faces = 6;
    source.image.levels.push_back(
        {size, size, std::vector<float>(static_cast<std::size_t>(size) * size * 18)});
    std::vector<float>& texels = source.image.levels[0].texels;
    for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = static_cast<float>(pbr::random_unit(5, i));
    return {{"source", std::move(source)}};
}

inline Product bake_probe(const ProbeParams& params, const Inputs& inputs, int threads = 2) {
    Context context(threads, {});
    return bake(params, inputs, context);
}

}  // namespace pbrbake::probe
