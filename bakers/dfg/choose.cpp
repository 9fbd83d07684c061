#include "bakers/dfg/choose.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "bakers/dfg/layout.hpp"
#include "bakers/dfg/sampled.hpp"
#include "bakers/dfg/terms.hpp"

namespace pbrbake::dfg {
namespace {

constexpr std::array kSizes{8, 16, 24, 32, 48, 64, 96, 128, 192, 256, 384, 512, 768, 1024};

constexpr std::size_t kVolumeSizes = 8;  // of them, up to 128

/// A square table, or a volume with a slice for every four rows and one of round lobes.
std::vector<int> sides(const DfgParams& params, int size) {
    return is_volume(params) ? std::vector{size, size, size / 4 | 1} : std::vector{size};
}

/// The layouts that a job allows, the simplest to look up first.
std::vector<DfgParams> candidates(const DfgParams& asked) {
    std::vector<DfgParams> all{settled(asked)};
    if (asked.target != Target::none || is_over_curvature(all.front().terms.front())) return all;
    DfgParams crowded = asked;
    if (crowded.axis == Axis::automatic) crowded.axis = Axis::cbrt_nov;
    if (crowded.roughness_axis == RoughnessAxis::automatic)
        crowded.roughness_axis = RoughnessAxis::sqrt_perceptual;
    if (crowded.axis != asked.axis || crowded.roughness_axis != asked.roughness_axis)
        all.push_back(settled(crowded));
    return all;
}

/// The first of the sizes below `end` whose error between exact texels is at most `max_error`, else `end`.
std::size_t smallest_size(DfgParams params, double max_error, std::size_t end, Context& context) {
    const pbr::DfgMethod truth = pbr::DfgMethod::quadrature(max_error / 50);
    for (std::size_t i = 0; i < end;) {
        params.size = sides(params, kSizes[i]);
        const double error =
            sampled_errors(params, nullptr, truth, Probing::middles, 0, 0, context).interpolation;
        if (error <= max_error) return i;
        // Errors fall by the square of the size at best: sizes that could not do are left out.
        const double least = kSizes[i] * std::sqrt(error / max_error) * 0.9;
        do ++i;
        while (i + 1 < end && kSizes[i] < least);
    }
    return end;
}

}  // namespace

Choice choose(const DfgParams& asked, Context& context) {
    // Halves round by up to 2^-12 in [.5, 1): worth half of the bytes where that leaves most of the error to
    // the lookup.
    constexpr double kHalfError = 0x1p-12;
    const double max_error = context.accuracy().max_error;
    const PixelType pixel = max_error >= 4 * kHalfError ? PixelType::half : PixelType::float32;
    const double left =
        max_error - (pixel == PixelType::half ? kHalfError : 0) - quadrature_error(context.accuracy());
    const std::size_t sizes = is_volume(settled(asked)) ? kVolumeSizes : kSizes.size();
    std::size_t smallest = sizes;
    DfgParams best = settled(asked);
    for (const DfgParams& candidate : candidates(asked)) {
        const std::size_t size = smallest_size(candidate, left, smallest, context);
        if (size < smallest) best = candidate;
        smallest = std::min(size, smallest);
    }
    best.size = sides(best, kSizes[std::min(smallest, sizes - 1)]);
    return {best, pixel};
}

}  // namespace pbrbake::dfg
