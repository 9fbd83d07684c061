#include "bakers/texture/convert.hpp"

#include <algorithm>
#include <cmath>

#include "bakers/texture/calibrate.hpp"
#include "bakers/texture/metal.hpp"

namespace pbrbake::texture {
namespace {

constexpr std::int64_t kRows = 16;
constexpr float kAllLight = 1.001f;  ///< a code's rounding is no sin
/// Of diffuse albedo, linear: a half interval is wider near white, where an 8-bit code isn't worth more.
constexpr float kLeastTolerance = 1e-6f, kLargestTolerance = .5f / 255;

/// What a texel alone tells; the sums need an order and are made afterwards.
struct Read {
    std::vector<pbr::Quantisation<float>> steps;
    std::vector<std::uint8_t> clamped;
};

Read read_level(const Sources& sources, MapLevel& level, Context& context) {
    level.width = sources.width();
    level.height = sources.height();
    const std::size_t texels = level.texels();
    level.diffuse.resize(texels);
    level.f0.resize(texels);
    level.perceptual_roughness.resize(texels);
    if (sources.has_normal()) level.normal.resize(texels);
    if (sources.has_occlusion()) level.occlusion.resize(texels);
    if (sources.has_opacity()) level.opacity.resize(texels);
    Read read{std::vector<pbr::Quantisation<float>>(texels), std::vector<std::uint8_t>(texels)};
    context.parallel_for(level.height, kRows, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = static_cast<int>(begin); y < end; ++y)
            for (int x = 0; x < level.width; ++x) {
                const std::size_t i = static_cast<std::size_t>(y) * level.width + x;
                const LegacyTexel texel = sources.texel(x, y);
                level.diffuse[i] = texel.reflected.diffuse;
                level.f0[i] = texel.reflected.f0;
                level.perceptual_roughness[i] = texel.perceptual_roughness;
                read.steps[i] = texel.quantisation;
                read.clamped[i] = texel.f0_clamped;
                if (sources.has_normal()) level.normal[i] = sources.normal(x, y);
                if (sources.has_occlusion()) level.occlusion[i] = sources.occlusion(x, y);
                if (sources.has_opacity()) level.opacity[i] = sources.opacity(x, y);
            }
    });
    context.count("texels", texels);
    return read;
}

void turn_normals_up(const TextureParams& params, MapLevel& level, Findings& findings) {
    if (level.normal.empty()) return;
    findings.green_correlation = green_correlation(level);
    constexpr double kTelling = .1;
    findings.green_down = params.normal_green == Green::down ||
                          (params.normal_green == Green::automatic && findings.green_correlation < -kTelling);
    if (findings.green_down)
        for (Colour& normal : level.normal) normal.y = -normal.y;
}

}  // namespace

Converted convert(const Sources& sources, Context& context) {
    Converted result;
    MapLevel& level = result.level;
    const TextureParams& params = sources.params();
    const Read read = read_level(sources, level, context);
    Findings& findings = result.findings;
    turn_normals_up(params, level, findings);
    calibrate(params, level, findings);
    result.confidence = estimate_metal(params, read.steps, sources.coupling(), findings, level, context);

    result.tolerance.resize(level.texels());
    for (std::size_t i = 0; i < level.texels(); ++i) {
        result.tolerance[i] =
            glm::clamp(read.steps[i].diffuse, Colour(kLeastTolerance), Colour(kLargestTolerance));
        findings.f0_clamped += read.clamped[i];
        findings.over_unity += pbr::max_channel(level.diffuse[i] + level.f0[i]) > kAllLight ? 1 : 0;
        findings.low_confidence += result.confidence[i] < .5f ? 1 : 0;
        findings.metallic += static_cast<double>(level.metallic[i]);
        findings.confidence += static_cast<double>(result.confidence[i]);
    }
    for (double* sum : {&findings.f0_clamped, &findings.over_unity, &findings.low_confidence,
                        &findings.metallic, &findings.confidence})
        *sum /= static_cast<double>(level.texels());
    findings.alpha = sources.has_opacity() && params.opacity.empty() ? "opacity" : "nothing";
    return result;
}

}  // namespace pbrbake::texture
