#include "bakers/texture/convert.hpp"

#include <algorithm>
#include <cmath>

#include "bakers/texture/difference.hpp"
#include "bakers/texture/pack.hpp"

namespace pbrbake::texture {

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
      has_residual_(layout_of(sources).has_residual),
      metal_(sources.width(), most_rows + 2 * kMetalReach, sources.params().wrap),
      line_(sources.width()),
      metallic_(line_.texels()),
      confidence_(line_.texels()) {
    MapLevel& level = rows_.level;
    level.width = sources.width();
    level.height = sources.height();
    level.rows = most_rows;
    const std::size_t texels = level.texels();
    level.diffuse.resize(texels);
    level.f0.resize(texels);
    level.metallic.resize(texels);
    level.perceptual_roughness.resize(texels);
    if (sources.may_be_dim()) level.f90.resize(texels);
    if (sources.has_normal()) level.normal.resize(texels);
    if (sources.has_occlusion()) level.occlusion.resize(texels);
    if (sources.has_opacity()) level.opacity.resize(texels);
    if (sources.has_emissive()) level.emissive.resize(texels);
    rows_.confidence.resize(texels);
    const auto asks_for_albedo = [](ExtraMap map) { return map != ExtraMap::confidence; };
    if (std::ranges::any_of(sources.params().maps, asks_for_albedo)) rows_.albedo.resize(texels);
}

const Rows& Converter::convert(int begin, int own_end, int end, std::vector<Findings>& findings) {
    MapLevel& level = rows_.level;
    level.first = begin;
    level.rows = end - begin;
    const int reach = estimate_.regularises() ? kMetalReach : 0;
    for (int y = begin - reach; y < end + reach; ++y) {
        const bool is_own = y >= begin && y < end;
        Findings* found = y >= begin && y < own_end ? &findings[static_cast<std::size_t>(y)] : nullptr;
        read(y, y - begin + kMetalReach, is_own, found);
    }
    for (int y = begin; y < end; ++y) {
        float* metallic = level.metallic.data() + level.at(y);
        if (reach > 0) metal_.regularise(y - begin + kMetalReach, metallic);
        if (reach > 0 && has_residual_)
            limit_metallic(sources_.visible_error(), level.at(y), static_cast<std::size_t>(level.width),
                           level);
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
    sources_.read(0, place(y), line_);
    calibrate();
    estimate_(line_, metallic_.data(), confidence_.data());
    if (estimate_.regularises()) metal_.set(slot, line_, metallic_.data(), confidence_.data());
    if (is_own) read_own(y);
    if (findings) *findings = find();
}

void Converter::calibrate() {
    const Calibration& calibration = survey_.calibration;
    if (calibration.kind == Calibration::Kind::none) return;
    const auto f0_scale = static_cast<float>(calibration.scale);
    for (std::size_t i = 0; i < line_.texels(); ++i) {
        const pbr::Reflected<float> reflected = calibration({line_.diffuse[i], line_.f0[i]});
        line_.diffuse.set(i, reflected.diffuse);
        line_.f0.set(i, reflected.f0);
        line_.f0_step.set(i, line_.f0_step[i] * f0_scale);
    }
}

void Converter::read_own(int y) {
    MapLevel& level = rows_.level;
    const std::size_t to = level.at(y), count = line_.texels();
    const auto copy = [&](const std::vector<float>& from, std::vector<float>& map) {
        std::ranges::copy(from, map.begin() + static_cast<std::ptrdiff_t>(to));
    };
    for (std::size_t c = 0; c < 3; ++c) {
        copy(line_.diffuse.channels[c], level.diffuse.channels[c]);
        copy(line_.f0.channels[c], level.f0.channels[c]);
    }
    copy(line_.perceptual_roughness, level.perceptual_roughness);
    copy(metallic_, level.metallic);
    for (std::size_t i = 0; !level.f90.empty() && i < count; ++i)
        level.f90[to + i] = source_f90(sources_, line_.f0[i]);
    copy(confidence_, rows_.confidence);
    for (std::size_t i = 0; !rows_.albedo.empty() && i < count; ++i)
        rows_.albedo.set(to + i, source_albedo(sources_, survey_.calibration, line_[i]).total());
    if (sources_.has_normal()) {
        sources_.read_normals(y, to, level.normal);
        float* ny = level.normal.channels[1].data() + to;
        for (std::size_t i = 0; survey_.green_down && i < count; ++i) ny[i] = -ny[i];
    }
    if (sources_.has_occlusion()) sources_.read_occlusion(y, level.occlusion.data() + to);
    if (sources_.has_opacity()) sources_.read_opacity(y, level.opacity.data() + to);
    if (sources_.has_emissive()) sources_.read_emissive(y, to, level.emissive);
}

Findings Converter::find() const {
    const auto [dr, dg, db] = line_.diffuse.from(0);
    const auto [sr, sg, sb] = line_.f0.from(0);
    int clamped = 0, above = 0, over = 0, low = 0;
    Findings found;
    for (std::size_t i = 0; i < line_.texels(); ++i) {
        const bool is_above = line_.above_one[i] != 0;
        above += is_above;
        clamped += line_.f0_clamped[i];
        over += is_above || std::max(dr[i] + sr[i], std::max(dg[i] + sg[i], db[i] + sb[i])) > kAllLight;
        low += confidence_[i] < .5f;
    }
    for (const float confidence : confidence_) found.confidence += static_cast<double>(confidence);
    found.f0_clamped = clamped;
    found.above_one = above;
    found.over_unity = over;
    found.low_confidence = low;
    return found;
}

}  // namespace pbrbake::texture
