#include "bakers/texture/metal.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "bakers/texture/pack.hpp"

namespace pbrbake::texture {
namespace {

constexpr float kSure = .95f;  ///< texels this sure keep their own estimate
/// Texels that are done at a time, the sure ones between too, and some twice at a row's end: vectors are
/// full.
constexpr int kRun = 32;

/// Lowers metallic to the largest that may be, a run at a time; where all of a run is 0 there is nothing to
/// do.
void lower(const pbr::ReflectedPlanes& reflected, float largest_error, std::size_t count, float* metallic) {
    std::array<float, kRun> largest;
    for (std::size_t begin = 0; begin < count; begin += kRun) {
        const std::size_t size = std::min<std::size_t>(kRun, count - begin);
        float* values = metallic + begin;
        if (std::all_of(values, values + size, [](float m) { return m <= 0; })) continue;
        const auto from = [begin](const pbr::ColourPlanes& planes) {
            return pbr::ColourPlanes{planes[0] + begin, planes[1] + begin, planes[2] + begin};
        };
        pbr::largest_metallic({from(reflected.diffuse), from(reflected.f0)}, largest_error, size,
                              largest.data());
        for (std::size_t i = 0; i < size; ++i) values[i] = std::min(values[i], largest[i]);
    }
}

}  // namespace

MetalEstimator::MetalEstimator(const Sources& sources, const Calibration& calibration)
    : trust_(static_cast<float>(calibration.trust)),
      prior_{static_cast<float>(sources.params().dielectric_f0),
             static_cast<float>(sources.params().f0_tolerance), .01f},
      coupling_(sources.coupling()),
      largest_error_(sources.visible_error()),
      has_residual_(layout_of(sources).has_residual),
      is_stated_(sources.params().model == Model::metallic_roughness),
      regularises_(sources.params().regularise && calibration.surface == "any" && !is_stated_) {
    if (calibration.surface != "any") told_ = calibration.surface == "metal" ? 1.f : 0.f;
}

void MetalEstimator::operator()(const LegacyRow& row, float* metallic, float* confidence) const {
    constexpr float kTold = .9f;
    const std::size_t count = row.texels();
    if (is_stated_) {
        std::ranges::copy(row.metallic, metallic);
        std::fill_n(confidence, count, 1.f);
    } else if (told_ >= 0) {  // a surface that its name or the job tells is no estimate
        std::fill_n(metallic, count, told_);
        std::fill_n(confidence, count, kTold);
    } else {
        pbr::estimate_metallic({row.diffuse.from(0), row.f0.from(0)}, prior_,
                               {row.diffuse_step.from(0), row.f0_step.from(0)}, coupling_, count, metallic,
                               confidence);
        for (std::size_t i = 0; i < count; ++i) confidence[i] *= trust_;
        if (has_residual_) limit(row, metallic, confidence);
    }
}

/// Metal that a texel's material can't have was no metal for sure.
void MetalEstimator::limit(const LegacyRow& row, float* metallic, float* confidence) const {
    std::vector<float> estimates(metallic, metallic + row.texels());
    lower({row.diffuse.from(0), row.f0.from(0)}, largest_error_, row.texels(), metallic);
    for (std::size_t i = 0; i < row.texels(); ++i)
        confidence[i] = std::max(0.f, confidence[i] - (estimates[i] - metallic[i]));
}

void limit_metallic(float largest_error, std::size_t begin, std::size_t count, MapLevel& level) {
    lower({std::as_const(level.diffuse).from(begin), std::as_const(level.f0).from(begin)}, largest_error,
          count, level.metallic.data() + begin);
}

MetalRows::MetalRows(int width, int rows, Wrap wrap)
    : width_(width),
      rows_(rows),
      pitch_(width + 2 * kMetalReach),
      wrap_(wrap),
      values_(static_cast<std::size_t>(planes) * rows * pitch_) {}

void MetalRows::set(int row, const LegacyRow& texels, const float* own, const float* sure) {
    const auto fill = [&](int p, const float* values) {
        float* to = plane(p, row);
        std::copy_n(values, width_, to);
        for (int i = 1; i <= kMetalReach; ++i) {
            const bool repeats = wrap_ == Wrap::repeat;
            to[-i] = to[repeats ? (width_ * kMetalReach - i) % width_ : 0];
            to[width_ - 1 + i] = to[repeats ? (i - 1) % width_ : width_ - 1];
        }
    };
    for (int c = 0; c < 3; ++c) {
        fill(diffuse + c, texels.diffuse.channels[static_cast<std::size_t>(c)].data());
        fill(f0 + c, texels.f0.channels[static_cast<std::size_t>(c)].data());
    }
    fill(metallic, own);
    fill(confidence, sure);
}

void MetalRows::regularise(int row, float* out) const {
    const float* sure = plane(confidence, row);
    std::copy_n(plane(metallic, row), width_, out);
    for (int begin = 0; begin < width_; ++begin) {
        if (sure[begin] >= kSure) continue;
        const int first = std::max(0, std::min(begin, width_ - kRun)), end = std::min(first + kRun, width_);
        regularise_run(row, first, end, out);
        begin = end - 1;
    }
}

/// The less sure a texel is, the more it takes of what its neighbours that look alike say.
void MetalRows::regularise_run(int row, int begin, int end, float* out) const {
    constexpr int kWidth = 2 * kMetalReach + 1;
    const int count = end - begin;
    std::array<std::ptrdiff_t, kWidth * kWidth> apart;
    std::size_t neighbours = 0;
    for (int dy = -kMetalReach; dy <= kMetalReach; ++dy) {
        const float* near = plane(confidence, row + dy) + begin;
        if (std::all_of(near - kMetalReach, near + count + kMetalReach, [](float c) { return c <= 0; }))
            continue;
        for (int dx = -kMetalReach; dx <= kMetalReach; ++dx)
            if (dx != 0 || dy != 0) apart[neighbours++] = std::ptrdiff_t{dy} * pitch_ + dx;
    }
    std::array<const float*, 6> here;
    for (int c = 0; c < 6; ++c) here[static_cast<std::size_t>(c)] = plane(c, row) + begin;
    const float *own = plane(metallic, row) + begin, *sure = plane(confidence, row) + begin;
    std::array<float, kRun> means;
    pbr::metallic_of_alike({{here[0], here[1], here[2]}, {here[3], here[4], here[5]}}, own, sure,
                           std::span(apart).first(neighbours), static_cast<std::size_t>(count), means.data());
    for (int i = 0; i < count; ++i) {
        if (sure[i] >= kSure) continue;
        const float doubt = 1 - sure[i] / kSure;
        const float mean = means[static_cast<std::size_t>(i)];
        out[begin + i] = own[i] + doubt * (mean - own[i]);
    }
}

}  // namespace pbrbake::texture
