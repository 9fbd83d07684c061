#include "bakers/texture/detect.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace pbrbake::texture {
namespace {

/// Pearson's, of pairs added one at a time.
struct Correlation {
    double n = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
    void add(double a, double b) {
        ++n;
        x += a;
        y += b;
        xx += a * a;
        yy += b * b;
        xy += a * b;
    }
    std::optional<double> value() const {
        constexpr double kFlat = 1e-6;  // variance: well below a code's
        if (n == 0) return {};
        const double vx = xx / n - x * x / (n * n), vy = yy / n - y * y / (n * n);
        if (vx < kFlat || vy < kFlat) return {};
        return (xy / n - x * y / (n * n)) / std::sqrt(vx * vy);
    }
};

double luminance(const Colour& colour) {
    return static_cast<double>(.2126f * colour.x + .7152f * colour.y + .0722f * colour.z);
}

std::string short_text(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", value);
    return text.data();
}

constexpr double kTelling = .5;             ///< correlations beyond are worth a word
constexpr double kLeastExponent = 2;        ///< half of the map wider than any painted lobe
constexpr double kLargestExponent = 65536;  ///< alpha .0055, narrower than any engine's

void doubt_gloss(const GlossReading& gloss, Doubts& doubts) {
    const bool is_assumed = gloss.reason.starts_with("model");
    if (!doubts.gloss_correlation || !is_assumed || *doubts.gloss_correlation > -kTelling) return;
    doubts.warnings.push_back("gloss is low where specular is bright (correlation " +
                              short_text(*doubts.gloss_correlation) +
                              "), as a roughness map's values are; if it is one, state gloss_is "
                              "perceptual_roughness, else smoothness");
}

void doubt_exponents(Doubts& doubts) {
    if (!doubts.exponent_median) return;
    if (*doubts.exponent_median < kLeastExponent)
        doubts.warnings.push_back("half of the exponents are below " + short_text(kLeastExponent) +
                                  " (median " + short_text(*doubts.exponent_median) +
                                  "); power_scale may be too small, or gloss_is not an exponent");
    if (*doubts.exponent_max > kLargestExponent)
        doubts.warnings.push_back("exponents reach " + short_text(*doubts.exponent_max) +
                                  "; power_scale may be too large");
}

}  // namespace

Doubts find_doubts(const Sources& sources) {
    constexpr int kSide = 256;
    constexpr float kMirror = 1e30f;  // the largest float over any power_scale: no number to doubt
    const GlossIs is = sources.gloss().is;
    const bool has_exponents = is == GlossIs::power || is == GlossIs::power_log2;
    const int step_x = std::max(1, sources.width() / kSide), step_y = std::max(1, sources.height() / kSide);
    Correlation gloss, occlusion;
    std::vector<double> exponents;
    for (int y = step_y / 2; y < sources.height(); y += step_y)
        for (int x = step_x / 2; x < sources.width(); x += step_x) {
            const LegacyTexel texel = sources.texel(x, y);
            const float smoothness = 1 - texel.perceptual_roughness;
            if (sources.has_gloss() && sources.has_specular())
                gloss.add(static_cast<double>(smoothness), luminance(texel.reflected.f0));
            if (sources.has_occlusion())
                occlusion.add(static_cast<double>(sources.occlusion(x, y)),
                              luminance(texel.reflected.diffuse));
            const float n = sources.has_gloss() && has_exponents ? sources.exponent_at(x, y) : kMirror;
            if (n < kMirror) exponents.push_back(static_cast<double>(n));
        }
    Doubts doubts{gloss.value(), occlusion.value(), {}, {}, {}};
    if (!exponents.empty()) {
        const auto middle = exponents.begin() + static_cast<std::ptrdiff_t>(exponents.size() / 2);
        std::ranges::nth_element(exponents, middle);
        doubts.exponent_median = *middle;
        doubts.exponent_max = *std::ranges::max_element(exponents);
    }
    doubt_gloss(sources.gloss(), doubts);
    doubt_exponents(doubts);
    if (doubts.occlusion_correlation.value_or(0) > kTelling)
        doubts.warnings.push_back("diffuse is dark where occlusion is (correlation " +
                                  short_text(*doubts.occlusion_correlation) +
                                  "); it may be baked into diffuse already, and would count twice");
    return doubts;
}

}  // namespace pbrbake::texture
