#include "bakers/texture/convert.hpp"

#include <algorithm>
#include <cmath>

#include "bakers/texture/difference.hpp"

namespace pbrbake::texture {
namespace {

constexpr float kAllLight = 1.001f;  ///< a code's rounding is no sin
/// Of diffuse albedo, linear: a half interval is wider near white, where an 8-bit code isn't worth more.
constexpr float kLeastTolerance = 1e-6f, kLargestTolerance = .5f / 255;

}  // namespace

Survey survey(const Sources& sources, Context& context) {
    Survey result{find_calibration(sources, context), false, 0, find_doubts(sources)};
    if (!sources.has_normal()) return result;
    const TextureParams& params = sources.params();
    result.green_correlation = green_correlation(sources, context);
    constexpr double kTelling = .1;
    result.green_down = params.normal_green == Green::down ||
                        (params.normal_green == Green::automatic && result.green_correlation < -kTelling);
    return result;
}

Converter::Converter(const Sources& sources, const Survey& survey, int most_rows)
    : sources_(sources),
      survey_(survey),
      estimate_(sources, survey.calibration),
      metal_(sources.width(), most_rows + 2 * kMetalReach, sources.params().wrap),
      line_(static_cast<std::size_t>(sources.width())) {
    MapLevel& level = rows_.level;
    level.width = sources.width();
    level.height = most_rows;
    const std::size_t texels = level.texels();
    level.diffuse.resize(texels);
    level.f0.resize(texels);
    level.metallic.resize(texels);
    level.perceptual_roughness.resize(texels);
    if (sources.has_normal()) level.normal.resize(texels);
    if (sources.has_occlusion()) level.occlusion.resize(texels);
    if (sources.has_opacity()) level.opacity.resize(texels);
    if (sources.has_emissive()) level.emissive.resize(texels);
    rows_.confidence.resize(texels);
    rows_.tolerance.resize(texels);
    const auto asks_for_albedo = [](ExtraMap map) { return map != ExtraMap::confidence; };
    if (std::ranges::any_of(sources.params().maps, asks_for_albedo)) rows_.albedo.resize(texels);
}

const Rows& Converter::convert(int begin, int own_end, int end, std::vector<Findings>& findings) {
    MapLevel& level = rows_.level;
    rows_.first = begin;
    level.height = end - begin;
    const int reach = estimate_.regularises() ? kMetalReach : 0;
    for (int y = begin - reach; y < end + reach; ++y) {
        const bool is_own = y >= begin && y < end;
        Findings* found = y >= begin && y < own_end ? &findings[static_cast<std::size_t>(y)] : nullptr;
        read(y, y - begin + kMetalReach, is_own, found);
    }
    for (int y = begin; y < end; ++y) {
        float* metallic = level.metallic.data() + static_cast<std::size_t>(y - begin) * level.width;
        if (reach > 0) metal_.regularise(y - begin + kMetalReach, metallic);
        if (y >= own_end) continue;
        Findings& found = findings[static_cast<std::size_t>(y)];
        for (int x = 0; x < level.width; ++x) found.metallic += static_cast<double>(metallic[x]);
    }
    return rows_;
}

int Converter::place(int y) const {
    const int height = sources_.height();
    return sources_.params().wrap == Wrap::repeat ? (y % height + height) % height
                                                  : std::clamp(y, 0, height - 1);
}

/// Reads row y into a slot of the mask's rows; an own row into the maps too.
void Converter::read(int y, int slot, bool is_own, Findings* findings) {
    sources_.row(place(y), line_.data());
    const auto f0_scale = static_cast<float>(survey_.calibration.scale);
    if (findings) *findings = {};
    for (int x = 0; x < sources_.width(); ++x) {
        LegacyTexel& texel = line_[static_cast<std::size_t>(x)];
        const pbr::Reflected<float> reflected = survey_.calibration(texel.reflected);
        texel.quantisation.f0 *= f0_scale;
        const pbr::MetallicEstimate<float> estimate = texel.metallic >= 0
                                                          ? pbr::MetallicEstimate<float>{texel.metallic, 1}
                                                          : estimate_(reflected, texel.quantisation);
        if (estimate_.regularises()) metal_.set(slot, x, reflected, estimate);
        if (!is_own) continue;
        const std::size_t i = static_cast<std::size_t>(y - rows_.first) * rows_.level.width + x;
        read_own(x, y, texel, reflected);
        rows_.level.metallic[i] = estimate.metallic;
        rows_.confidence[i] = estimate.confidence;
        if (!findings) continue;
        findings->f0_clamped += texel.f0_clamped;
        findings->over_unity += pbr::max_channel(reflected.diffuse + reflected.f0) > kAllLight ? 1 : 0;
        findings->low_confidence += estimate.confidence < .5f ? 1 : 0;
        findings->confidence += static_cast<double>(estimate.confidence);
    }
    if (estimate_.regularises()) metal_.close(slot);
}

void Converter::read_own(int x, int y, const LegacyTexel& texel, const pbr::Reflected<float>& reflected) {
    MapLevel& level = rows_.level;
    const std::size_t i = static_cast<std::size_t>(y - rows_.first) * level.width + x;
    level.diffuse[i] = reflected.diffuse;
    level.f0[i] = reflected.f0;
    level.perceptual_roughness[i] = texel.perceptual_roughness;
    rows_.tolerance[i] =
        glm::clamp(texel.quantisation.diffuse, Colour(kLeastTolerance), Colour(kLargestTolerance));
    if (!rows_.albedo.empty())
        rows_.albedo[i] = source_albedo(sources_, survey_.calibration, texel, reflected).total();
    if (sources_.has_normal()) {
        level.normal[i] = sources_.normal(x, y);
        if (survey_.green_down) level.normal[i].y = -level.normal[i].y;
    }
    if (sources_.has_occlusion()) level.occlusion[i] = sources_.occlusion(x, y);
    if (sources_.has_opacity()) level.opacity[i] = sources_.opacity(x, y);
    if (sources_.has_emissive()) level.emissive[i] = sources_.emissive(x, y);
}

}  // namespace pbrbake::texture
