#include "bakers/verify/metrics.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "pbr/ibl/cubemap.hpp"

namespace pbrbake::verify {
namespace {

constexpr int kHalfShift = 23 - 10;                                          // mantissa bits a half hasn't
constexpr std::uint32_t kHalfBias = std::uint32_t{127 - 15} << 23;           // between the exponents' biases
constexpr float kLeastNormalHalf = 0x1p-14f, kHalfSubnormalSteps = 0x1p24f;  // per unit

/// Bit pattern of a magnitude as an integer that rises with it by one a step.
std::int64_t magnitude_ordinal(float magnitude, PixelType pixel) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(magnitude);
    if (pixel == PixelType::float32) return bits;
    if (magnitude < kLeastNormalHalf) return std::llround(magnitude * kHalfSubnormalSteps);
    return (bits - kHalfBias) >> kHalfShift;
}

std::int64_t ordinal(float value, PixelType pixel) {
    if (pixel == PixelType::unorm16) return std::llround(double{value} * 65535);
    if (pixel == PixelType::unorm8) return std::llround(double{value} * 255);
    const std::int64_t magnitude = magnitude_ordinal(std::abs(value), pixel);
    return value < 0 ? -magnitude : magnitude;
}

/// What the figures are made of.
struct Sums {
    double abs = 0, squared = 0, reference = 0, weight = 0, a = 0, b = 0, abs_b = 0;
};

double share(double error, double of) {
    return error == 0 ? 0 : of > 0 ? error / of : std::numeric_limits<double>::infinity();
}

}  // namespace

std::uint64_t ulp_distance(float a, float b, PixelType pixel, float brightest) {
    if (a == b) return 0;
    if (pixel == PixelType::rgbe) {
        const double step = std::ldexp(1.0, std::ilogb(std::max(brightest, 1e-38f)) - 7);
        return static_cast<std::uint64_t>(std::llround(std::abs(double{a} - b) / step));
    }
    return static_cast<std::uint64_t>(std::abs(ordinal(a, pixel) - ordinal(b, pixel)));
}

double quantile(std::vector<float>& values, double share) {
    if (values.empty()) return 0;
    const double at = share * static_cast<double>(values.size() - 1);
    const auto lower = static_cast<std::ptrdiff_t>(at);
    std::nth_element(values.begin(), values.begin() + lower, values.end());
    const double low = values[static_cast<std::size_t>(lower)];
    if (at == static_cast<double>(lower)) return low;
    const double high = *std::min_element(values.begin() + lower + 1, values.end());
    return low + (at - static_cast<double>(lower)) * (high - low);
}

ErrorFigures error_figures(const Samples& samples, PixelType pixel, double scale) {
    ErrorFigures figures;
    Sums sums;
    std::vector<float> magnitudes, relative;
    magnitudes.reserve(samples.a.size());
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < samples.a.size(); ++i) {
        const float a = samples.a[i], b = samples.b[i];
        figures.non_finite_a += !std::isfinite(a);
        figures.non_finite_b += !std::isfinite(b);
        if (!std::isfinite(a) || !std::isfinite(b)) continue;
        ++figures.values;
        const double difference = std::abs(double{a} - b), weight = samples.weight[i];
        if (difference > 0) {
            ++figures.differing;
            places.push_back(i);
            figures.max_ulp =
                std::max(figures.max_ulp,
                         ulp_distance(a, b, pixel, samples.brightest.empty() ? b : samples.brightest[i]));
            figures.max_abs = std::max(figures.max_abs, difference);
        }
        sums.abs += difference;
        sums.squared += difference * difference;
        sums.reference += std::abs(b);
        sums.weight += weight;
        sums.a += weight * a;
        sums.b += weight * b;
        sums.abs_b += weight * std::abs(b);
        magnitudes.push_back(std::abs(b));
    }
    if (figures.values == 0) return figures;
    const double count = static_cast<double>(figures.values);
    figures.max_abs /= scale;
    figures.mean_abs = sums.abs / count / scale;
    figures.rms = std::sqrt(sums.squared / count) / scale;
    figures.reference_mean = sums.reference / count / scale;
    figures.relative_rms = share(figures.rms, figures.reference_mean);
    figures.energy_a = sums.a / sums.weight / scale;
    figures.energy_b = sums.b / sums.weight / scale;
    figures.energy_reference = sums.abs_b / sums.weight / scale;
    figures.energy_change = share(std::abs(figures.energy_a - figures.energy_b), figures.energy_reference);
    if (places.empty()) return figures;

    double typical = quantile(magnitudes, 0.5);
    if (typical == 0) typical = sums.reference / count;
    relative.assign(figures.values - places.size(), 0.f);  // those that are equal
    for (const std::size_t i : places) {
        const double error = share(std::abs(double{samples.a[i]} - samples.b[i]),
                                   std::max<double>(std::abs(samples.b[i]), typical));
        if (error > figures.relative_max) {
            figures.relative_max = error;
            figures.worst = i;
        }
        relative.push_back(static_cast<float>(std::min(error, 1e30)));
    }
    figures.relative_p50 = quantile(relative, 0.5);
    figures.relative_p95 = quantile(relative, 0.95);
    figures.relative_p99 = quantile(relative, 0.99);
    return figures;
}

ErrorFigures joined_figures(std::span<const ErrorFigures> parts) {
    ErrorFigures sum;
    double squared = 0, reference = 0;
    for (const ErrorFigures& part : parts) {
        const double count = static_cast<double>(part.values);
        sum.values += part.values;
        sum.differing += part.differing;
        sum.non_finite_a += part.non_finite_a;
        sum.non_finite_b += part.non_finite_b;
        sum.max_ulp = std::max(sum.max_ulp, part.max_ulp);
        sum.max_abs = std::max(sum.max_abs, part.max_abs);
        sum.mean_abs += part.mean_abs * count;
        squared += part.rms * part.rms * count;
        reference += part.reference_mean * count;
        sum.relative_p50 = std::max(sum.relative_p50, part.relative_p50);
        sum.relative_p95 = std::max(sum.relative_p95, part.relative_p95);
        sum.relative_p99 = std::max(sum.relative_p99, part.relative_p99);
        sum.relative_max = std::max(sum.relative_max, part.relative_max);
        sum.energy_a += part.energy_a;
        sum.energy_b += part.energy_b;
        sum.energy_reference += part.energy_reference;
    }
    if (sum.values == 0) return sum;
    const double count = static_cast<double>(sum.values), faces = static_cast<double>(parts.size());
    sum.mean_abs /= count;
    sum.rms = std::sqrt(squared / count);
    sum.reference_mean = reference / count;
    sum.relative_rms = share(sum.rms, sum.reference_mean);
    sum.energy_a /= faces;  // the faces of a cube are of one solid angle
    sum.energy_b /= faces;
    sum.energy_reference /= faces;
    sum.energy_change = share(std::abs(sum.energy_a - sum.energy_b), sum.energy_reference);
    return sum;
}

std::vector<double> texel_weights(const Level& level, bool is_cube) {
    std::vector<double> list(static_cast<std::size_t>(level.width) * level.height, 1.0);
    if (is_cube)
        for (int y = 0; y < level.height; ++y)
            for (int x = 0; x < level.width; ++x)
                list[static_cast<std::size_t>(y) * level.width + x] =
                    pbr::cubemap_texel_solid_angle(level.width, x, y);
    return list;
}

}  // namespace pbrbake::verify
