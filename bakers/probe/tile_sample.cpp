#include "bakers/probe/tile_sample.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/sequence.hpp"

namespace pbrbake::probe {
namespace {

/// The 97.5 % quantile of Student's t, by the Cornish-Fisher expansion (Abramowitz & Stegun 26.7.5); 12.7 at
/// one degree of freedom. Within 3 % from two degrees on.
double student_quantile(double degrees) {
    if (degrees <= 1) return 12.706;
    constexpr double x = 1.959964;
    const double x3 = x * x * x, x5 = x3 * x * x, x7 = x5 * x * x;
    return x + (x3 + x) / (4 * degrees) + (5 * x5 + 16 * x3 + 3 * x) / (96 * degrees * degrees) +
           (3 * x7 + 19 * x5 + 17 * x3 - 15 * x) / (384 * degrees * degrees * degrees);
}

/// What all parts that could be drawn add up to.
double sum_of_drawn(const TileSample& sample, std::span<const double> of_drawn) {
    double sum = 0;
    for (std::size_t i = 0; i < of_drawn.size(); ++i) sum += of_drawn[i] / sample.probability[i];
    return of_drawn.empty() ? 0 : sum / static_cast<double>(of_drawn.size());
}

/// Half of its 95 % interval, by Student's t; two or more draws.
double half_width(const TileSample& sample, std::span<const double> of_drawn, double sum) {
    const double count = static_cast<double>(of_drawn.size());
    double variance = 0;
    for (std::size_t i = 0; i < of_drawn.size(); ++i) {
        const double difference = of_drawn[i] / sample.probability[i] - sum;
        variance += difference * difference;
    }
    return student_quantile(count - 1) * std::sqrt(variance / (count * (count - 1)));
}

}  // namespace

TileSample choose_tiles(std::span<const double> brightness, int count, std::uint64_t seed) {
    const std::size_t parts = brightness.size();
    TileSample sample;
    if (static_cast<std::size_t>(count) >= parts) {
        sample.certain.resize(parts);
        std::iota(sample.certain.begin(), sample.certain.end(), std::size_t{0});
        return sample;
    }
    // At most half of the parts can be certain: the brightest, in order.
    std::vector<std::size_t> order(static_cast<std::size_t>(count) / 2);
    std::vector<std::size_t> all_parts(parts);
    std::iota(all_parts.begin(), all_parts.end(), std::size_t{0});
    std::ranges::partial_sort_copy(all_parts, order, [&](std::size_t a, std::size_t b) {
        return brightness[a] > brightness[b] || (brightness[a] == brightness[b] && a < b);
    });
    // What is left without the first of them, small ones first: beside a sun the others would be lost.
    std::vector<double> weight(brightness.begin(), brightness.end()), left(order.size() + 1);
    for (const std::size_t i : order) weight[i] = 0;
    left.back() = std::accumulate(weight.begin(), weight.end(), 0.0);
    for (std::size_t k = order.size(); k-- > 0;) left[k] = left[k + 1] + brightness[order[k]];
    std::size_t certain = 0;
    const auto weight_of = [&](std::size_t i) {
        return (left[certain] > 0 ? brightness[i] / left[certain] : 0) +
               1.0 / static_cast<double>(parts - certain);
    };
    while (certain < order.size() &&
           weight_of(order[certain]) * static_cast<double>(static_cast<std::size_t>(count) - certain) >=
               (left[certain] > 0 ? 2 : 1))
        ++certain;
    sample.certain.assign(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(certain));
    for (std::size_t i = 0; i < parts; ++i) weight[i] = weight_of(i);
    for (const std::size_t i : sample.certain) weight[i] = 0;

    // One draw from each of equal shares of the weight, in the order of the parts: they spread over the
    // level.
    const double all = std::accumulate(weight.begin(), weight.end(), 0.0);
    const std::size_t draws = static_cast<std::size_t>(count) - certain;
    double passed = 0;
    std::size_t part = 0;
    for (std::size_t k = 0; k < draws; ++k) {
        const double at =
            all * (static_cast<double>(k) + pbr::random_unit(seed, k)) / static_cast<double>(draws);
        while (part + 1 < parts && (passed + weight[part] <= at || weight[part] == 0))
            passed += weight[part++];
        while (weight[part] == 0) --part;  // rounding led past the last one
        sample.drawn.push_back(part);
        sample.probability.push_back(weight[part] / all);
    }
    return sample;
}

TotalEstimate estimate_balance(const TileSample& sample, std::span<const double> of_certain,
                               std::span<const double> of_drawn) {
    const double certain = std::accumulate(of_certain.begin(), of_certain.end(), 0.0);
    const double drawn = sum_of_drawn(sample, of_drawn), value = certain + drawn;
    if (of_drawn.size() < 2) return {value, {value, value}};
    const double half = half_width(sample, of_drawn, drawn);
    return {value, {value - half, value + half}};
}

TotalEstimate estimate_total(const TileSample& sample, std::span<const double> of_certain,
                             std::span<const double> of_drawn) {
    const double certain = std::accumulate(of_certain.begin(), of_certain.end(), 0.0);
    const double drawn = sum_of_drawn(sample, of_drawn);
    if (!(drawn > 0) || of_drawn.size() < 2) return {certain + drawn, {certain, certain + drawn}};
    const double factor = pbr::exp_exact(std::min(30.0, half_width(sample, of_drawn, drawn) / drawn));
    return {certain + drawn, {certain + drawn / factor, certain + drawn * factor}};
}

}  // namespace pbrbake::probe
