#include "pbr/ibl/ld_harmonic.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "pbr/ibl/ld.hpp"
#include "pbr/ibl/zonal_kernel.hpp"
#include "pbr/numerics/elementary.hpp"

namespace pbr {
namespace {

constexpr double kBrightShare = 1e-3, kBrightOverMean = 20;

struct RowLight {
    std::array<double, 3> sum{};
    std::array<float, 3> largest{};
};

/// Texels, by rows, that hold more than their share of any channel's light.
std::vector<glm::ivec2> bright_texels(const EquirectView& source, const ForEach& each) {
    std::vector<RowLight> rows(static_cast<std::size_t>(source.height));
    each(source.height, [&](int y) {
        RowLight& row = rows[static_cast<std::size_t>(y)];
        const float* texel = source.texel(0, y);
        for (int x = 0; x < source.width; ++x, texel += 3)
            for (std::size_t c = 0; c < 3; ++c) {
                row.sum[c] += static_cast<double>(texel[c]);
                row.largest[c] = std::max(row.largest[c], texel[c]);
            }
    });
    std::array<double, 3> flux{};
    for (int y = 0; y < source.height; ++y)
        for (std::size_t c = 0; c < 3; ++c)
            flux[c] += rows[static_cast<std::size_t>(y)].sum[c] *
                       equirect_texel_solid_angle(source.width, source.height, y);
    std::vector<glm::ivec2> bright;
    for (int y = 0; y < source.height; ++y) {
        const double solid_angle = equirect_texel_solid_angle(source.width, source.height, y);
        std::array<double, 3> threshold;
        bool any = false;
        for (std::size_t c = 0; c < 3; ++c) {
            threshold[c] = std::max(kBrightShare * flux[c] / solid_angle,
                                    kBrightOverMean * flux[c] / (4 * std::numbers::pi));
            any |= rows[static_cast<std::size_t>(y)].largest[c] > threshold[c];
        }
        if (!any) continue;
        for (int x = 0; x < source.width; ++x) {
            const float* texel = source.texel(x, y);
            if (texel[0] > threshold[0] || texel[1] > threshold[1] || texel[2] > threshold[2])
                bright.push_back({x, y});
        }
    }
    return bright;
}

/// Degrees to analyse: up to where |k_l|, which falls like x K1(x) at x = 2 alpha l, is a tenth of the error;
/// and enough for the kink of wide lobes at the horizon, whose tail falls like l^-5/2.
int bands_to_analyse(double alpha, double max_error) {
    const double digits = std::clamp(-log2_exact(max_error) / log2_exact(10), 1.0, 6.0);
    const double for_the_peak = (1.7 + 1.2 * digits) / alpha;
    const double for_the_kink = 32 * std::pow(2.0, digits - 1);
    return static_cast<int>(std::ceil(std::max(for_the_peak, for_the_kink)));
}

}  // namespace

LdHarmonic::LdHarmonic(const EquirectView& source, double smallest_alpha, double max_error,
                       const ForEach& each)
    : max_error_(max_error),
      points_a_row_(pbr::points_a_row(source.height, smallest_alpha, max_error)),
      bright_(pbr::bright_texels(source, each)) {
    assert(smallest_alpha > 0 && smallest_alpha <= 1 && max_error > 0);
    if (!bright_.empty()) bright_blocks_.emplace(source, bright_);
    spectrum_.emplace(source, bands_to_analyse(smallest_alpha, max_error), points_a_row_, each, bright_);
    const std::span<const double, 6> average = spectrum_->coefficient(0, 0);
    mean_ = (average[0] + average[2] + average[4]) / 3 / std::sqrt(4 * std::numbers::pi);
}

LdHarmonic::Level::Level(const LdHarmonic& of, double alpha, const ForEach& each)
    : alpha_(alpha), bright_(of.bright_blocks_ ? &*of.bright_blocks_ : nullptr) {
    const std::vector<double> kernel = GgxZonalKernel(alpha).coefficients(of.bands());
    bands_ = band_limit(of, kernel);
    grid_.emplace(*of.spectrum_, std::span(kernel).first(static_cast<std::size_t>(bands_) + 1), each);
}

int LdHarmonic::Level::band_limit(const LdHarmonic& of, std::span<const double> kernel) {
    if (!(of.mean_ > 0)) return 0;
    const double scale = 12 * std::numbers::pi * of.mean_ * of.mean_;  // sphere times channels
    const double allowed = 0.01 * of.max_error_ * of.max_error_ * scale;
    double lost = 0;
    int bands = of.bands();
    for (; bands > 0; --bands) {
        const double k = kernel[static_cast<std::size_t>(bands)];
        const double more = lost + k * k * of.spectrum_->power(bands);
        if (more > allowed) break;
        lost = more;
    }
    truncation_error_ = std::sqrt(lost / scale);
    return bands;
}

std::uint64_t LdHarmonic::Level::integrate(std::span<const glm::dvec3> directions,
                                           std::span<float> rgb_out) const {
    std::uint64_t evaluations = 0;
    std::vector<double> bright;
    if (bright_) {
        bright.resize(directions.size() * 3);
        ld_partial(*bright_, alpha_, directions, bright, evaluations);
    }
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const std::array<float, 3> soft = grid_->sample(directions[i]);
        for (std::size_t c = 0; c < 3; ++c) {
            const double apart = bright_ ? bright[i * 3 + c] : 0;
            rgb_out[i * 3 + c] = std::max(0.0f, static_cast<float>(static_cast<double>(soft[c]) + apart));
        }
    }
    return evaluations;
}

}  // namespace pbr
