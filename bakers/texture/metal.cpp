#include "bakers/texture/metal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace pbrbake::texture {
namespace {

constexpr std::int64_t kRows = 16;
constexpr float kSure = .95f;  ///< texels this sure keep their own estimate

/// Weighted mean of the sure neighbours that look alike, 5 x 5: the texel's doubt is filled from them. A
/// joint bilateral filter (Petschnigg et al. 2004) with confidence as a weight; rational instead of Gaussian.
float neighbours_metallic(const TextureParams& params, const MapLevel& level,
                          const std::vector<float>& metallic, const std::vector<float>& confidence, int x,
                          int y) {
    constexpr int kReach = 2;
    constexpr float kAlike = .05f;  // of diffuse and f0, the distance at which likeness is half
    const auto place = [&](int at, int size) {
        if (at >= 0 && at < size) return at;
        return params.wrap == Wrap::repeat ? (at % size + size) % size : std::clamp(at, 0, size - 1);
    };
    std::array<int, 2 * kReach + 1> columns{};
    for (int dx = -kReach; dx <= kReach; ++dx)
        columns[static_cast<std::size_t>(dx + kReach)] = place(x + dx, level.width);
    const std::size_t centre = static_cast<std::size_t>(y) * level.width + x;
    const Colour diffuse = level.diffuse[centre], f0 = level.f0[centre];
    float sum = metallic[centre] * 1e-3f, weights = 1e-3f;
    for (int dy = -kReach; dy <= kReach; ++dy) {
        const std::size_t row = static_cast<std::size_t>(place(y + dy, level.height)) * level.width;
        for (const int column : columns) {
            const std::size_t i = row + column;
            if (confidence[i] <= 0 || i == centre) continue;
            const Colour d = level.diffuse[i] - diffuse, s = level.f0[i] - f0;
            const float far = glm::dot(d, d) + glm::dot(s, s);
            const float weight = confidence[i] / (1 + far / (kAlike * kAlike));
            sum += weight * metallic[i];
            weights += weight;
        }
    }
    return sum / weights;
}

void regularise(const TextureParams& params, const std::vector<float>& confidence, MapLevel& level,
                Context& context) {
    const std::vector<float> estimate = level.metallic;
    context.parallel_for(level.height, kRows, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = static_cast<int>(begin); y < end; ++y)
            for (int x = 0; x < level.width; ++x) {
                const std::size_t i = static_cast<std::size_t>(y) * level.width + x;
                if (confidence[i] >= kSure) continue;
                const float doubt = 1 - confidence[i] / kSure;
                level.metallic[i] +=
                    doubt * (neighbours_metallic(params, level, estimate, confidence, x, y) - estimate[i]);
            }
    });
}

}  // namespace

std::vector<float> estimate_metal(const TextureParams& params,
                                  const std::vector<pbr::Quantisation<float>>& steps,
                                  pbr::DiffuseCoupling coupling, const Findings& findings, MapLevel& level,
                                  Context& context) {
    std::vector<float> confidence(level.texels());
    level.metallic.resize(level.texels());
    // A surface that its name or the job tells is no estimate.
    constexpr float kTold = .9f, kGuessedScale = .5f;
    if (findings.surface != "any") {
        std::ranges::fill(level.metallic, findings.surface == "metal" ? 1.f : 0.f);
        std::ranges::fill(confidence, kTold);
        return confidence;
    }
    const pbr::MetallicPrior<float> prior{static_cast<float>(params.dielectric_f0),
                                          static_cast<float>(params.f0_tolerance), .01f};
    const auto scale = static_cast<float>(findings.specular_scale);
    const float trust = findings.calibration == "statistics" ? kGuessedScale : 1.f;
    context.parallel_for(level.height, kRows, [&](std::int64_t begin, std::int64_t end) {
        const std::size_t last = static_cast<std::size_t>(end) * level.width;
        for (std::size_t i = static_cast<std::size_t>(begin) * level.width; i < last; ++i) {
            pbr::Quantisation<float> step = steps[i];
            step.f0 *= scale;
            const auto found =
                pbr::estimate_metallic<float>({level.diffuse[i], level.f0[i]}, prior, step, coupling);
            level.metallic[i] = found.metallic;
            confidence[i] = found.confidence * trust;
        }
    });
    if (params.regularise) regularise(params, confidence, level, context);
    return confidence;
}

}  // namespace pbrbake::texture
