#include "bakers/texture/metal.hpp"

#include <algorithm>
#include <array>

namespace pbrbake::texture {
namespace {

constexpr float kSure = .95f;  ///< texels this sure keep their own estimate
constexpr int kRun = 64;       ///< texels that are filled at a time

}  // namespace

MetalEstimator::MetalEstimator(const Sources& sources, const Calibration& calibration)
    : prior_{static_cast<float>(sources.params().dielectric_f0),
             static_cast<float>(sources.params().f0_tolerance), .01f},
      coupling_(sources.coupling()),
      regularises_(sources.params().regularise && calibration.surface == "any" &&
                   sources.params().model != Model::metallic_roughness) {
    constexpr float kGuessedScale = .5f;
    if (calibration.surface != "any") told_ = calibration.surface == "metal" ? 1.f : 0.f;
    if (calibration.kind == Calibration::Kind::statistics) trust_ = kGuessedScale;
}

pbr::MetallicEstimate<float> MetalEstimator::operator()(const pbr::Reflected<float>& reflected,
                                                        const pbr::Quantisation<float>& step) const {
    // A surface that its name or the job tells is no estimate.
    constexpr float kTold = .9f;
    if (told_ >= 0) return {told_, kTold};
    pbr::MetallicEstimate<float> found = pbr::estimate_metallic<float>(reflected, prior_, step, coupling_);
    found.confidence *= trust_;
    return found;
}

MetalRows::MetalRows(int width, int rows, Wrap wrap)
    : width_(width),
      rows_(rows),
      pitch_(width + 2 * kMetalReach),
      wrap_(wrap),
      values_(static_cast<std::size_t>(planes) * rows * pitch_) {}

void MetalRows::set(int row, int x, const pbr::Reflected<float>& reflected,
                    const pbr::MetallicEstimate<float>& estimate) {
    for (int c = 0; c < 3; ++c) {
        plane(diffuse + c, row)[x] = reflected.diffuse[c];
        plane(f0 + c, row)[x] = reflected.f0[c];
    }
    plane(metallic, row)[x] = estimate.metallic;
    plane(confidence, row)[x] = estimate.confidence;
}

void MetalRows::close(int row) {
    const auto place = [&](int x) {
        return wrap_ == Wrap::repeat ? (x % width_ + width_) % width_ : std::clamp(x, 0, width_ - 1);
    };
    for (int p = 0; p < planes; ++p) {
        float* values = plane(p, row);
        for (int i = 1; i <= kMetalReach; ++i) {
            values[-i] = values[place(-i)];
            values[width_ - 1 + i] = values[place(width_ - 1 + i)];
        }
    }
}

void MetalRows::regularise(int row, float* out) const {
    const float* sure = plane(confidence, row);
    std::copy_n(plane(metallic, row), width_, out);
    for (int begin = 0; begin < width_; ++begin) {
        if (sure[begin] >= kSure) continue;
        int end = begin + 1;
        while (end < width_ && end - begin < kRun && sure[end] < kSure) ++end;
        regularise_run(row, begin, end, out);
        begin = end - 1;
    }
}

/// Weighted mean of the sure neighbours that look alike: a joint bilateral filter (Petschnigg et al. 2004)
/// with confidence as a weight; rational instead of Gaussian. Planes and runs, so that compilers vectorise.
void MetalRows::regularise_run(int row, int begin, int end, float* out) const {
    constexpr float kAlike2 = .05f * .05f;  // squared distance in diffuse and f0 at which a weight is 1/4
    constexpr float kOwn = 1e-3f;
    constexpr float kLeast = 1e-6f;
    const int count = end - begin;
    std::array<float, kRun> sum, weights;
    const float* own = plane(metallic, row) + begin;
    for (int i = 0; i < count; ++i) {
        sum[static_cast<std::size_t>(i)] = own[i] * kOwn;
        weights[static_cast<std::size_t>(i)] = kOwn;
    }
    std::array<const float*, 6> here;
    for (int c = 0; c < 6; ++c) here[static_cast<std::size_t>(c)] = plane(c, row) + begin;
    for (int dy = -kMetalReach; dy <= kMetalReach; ++dy) {
        const float* near = plane(confidence, row + dy) + begin;
        if (std::all_of(near - kMetalReach, near + count + kMetalReach, [](float c) { return c <= 0; }))
            continue;
        for (int dx = -kMetalReach; dx <= kMetalReach; ++dx) {
            if (dx == 0 && dy == 0) continue;
            std::array<const float*, planes> there;
            for (int p = 0; p < planes; ++p)
                there[static_cast<std::size_t>(p)] = plane(p, row + dy) + begin + dx;
            for (int i = 0; i < count; ++i) {
                float far = 0;
                for (std::size_t c = 0; c < 6; ++c) {
                    const float d = there[c][i] - here[c][i];
                    far += d * d;
                }
                // Squared, so that what is nothing like this texel doesn't outweigh it by its numbers.
                const float likeness = kAlike2 / (kAlike2 + far);
                const float weight = there[confidence][i] * likeness * likeness;
                sum[static_cast<std::size_t>(i)] += weight * there[metallic][i];
                weights[static_cast<std::size_t>(i)] += weight;
            }
        }
    }
    const float* sure = plane(confidence, row) + begin;
    for (int i = 0; i < count; ++i) {
        const float doubt = 1 - sure[i] / kSure;
        const float mean = sum[static_cast<std::size_t>(i)] / weights[static_cast<std::size_t>(i)];
        // The base colour of so much metal would reflect more than f0, unless diffuse is dimmed.
        float most = 1;
        for (std::size_t c = 0; c < 3; ++c) {
            const float d = here[diffuse + c][i], s = here[f0 + c][i];
            most = std::min(most, (s + kLeast) / (s + d + kLeast));
        }
        out[begin + i] = std::min(own[i] + doubt * (mean - own[i]), std::max(most, own[i]));
    }
}

}  // namespace pbrbake::texture
