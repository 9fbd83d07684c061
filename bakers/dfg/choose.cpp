#include "bakers/dfg/choose.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>
#include <vector>

#include "bakers/dfg/layout.hpp"
#include "bakers/dfg/sampled.hpp"
#include "bakers/dfg/terms.hpp"

namespace pbrbake::dfg {
namespace {

constexpr std::array kSides{8, 16, 24, 32, 48, 64, 96, 128, 192, 256, 384, 512, 768, 1024};

constexpr std::size_t kVolumeSizes = 8;  // of them, up to 128

/// What a size may be, smallest first: as the job states it; else square tables, or volumes with a slice for
/// every four rows and one of round lobes.
std::vector<std::vector<int>> sizes(const DfgParams& asked) {
    const DfgParams params = settled(asked);
    if (std::ranges::any_of(asked.size, [](int side) { return side > 0; }))
        return {is_volume(params) ? params.size : std::vector{params.width(), params.height()}};
    std::vector<std::vector<int>> all;
    for (const int n : kSides)
        if (!is_volume(params))
            all.push_back({n, n});
        else if (all.size() < kVolumeSizes)
            all.push_back({n, n, n / 4 | 1});
    return all;
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

/// At least what lookups in tables of these sizes are off by: of exact texels in the largest, at few points.
double least_error(DfgParams params, const std::vector<int>& largest, Context& context) {
    constexpr int kRows = 4;
    constexpr double kFinestRule = 1e-8;
    params.size = largest;
    return sampled_errors(params, nullptr, pbr::DfgMethod::quadrature(kFinestRule), Probing::some, kRows, 0,
                          context)
        .interpolation;
}

struct Search {
    std::size_t size;
    double error;  ///< of it, or of the last one tried
};

/// The first of the sizes before `end` whose error between exact texels is at most `max_error`, else `end`.
Search smallest_size(DfgParams params, const std::vector<std::vector<int>>& sizes, double max_error,
                     std::size_t end, Context& context) {
    const pbr::DfgMethod truth = pbr::DfgMethod::quadrature(max_error / 50);
    double error = 0;
    for (std::size_t i = 0; i < end;) {
        params.size = sizes[i];
        error = sampled_errors(params, nullptr, truth, Probing::middles, 0, 0, context).interpolation;
        if (error <= max_error) return {i, error};
        // Errors fall by the square of the size at best: sizes that could not do are left out.
        const double least = params.width() * std::sqrt(error / max_error) * 0.9;
        do ++i;
        while (i + 1 < end && sizes[i].front() < least);
    }
    return {end, error};
}

[[noreturn]] void refuse(const std::vector<int>& size, double error, double left, double max_error) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(2);
    text << "max_error " << max_error << " leaves a lookup " << std::max(left, 0.0)
         << ", but between the texels of ";
    for (std::size_t i = 0; i < size.size(); ++i) text << (i ? " x " : "") << size[i];
    text << " it is off by " << error
         << " or more; nothing was written. Ask for less, or leave size and axes open";
    throw Error(ExitCode::accuracy_missed, "", text.str());
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
    const std::vector<std::vector<int>> allowed = sizes(asked);
    std::size_t smallest = allowed.size();
    DfgParams best{};
    double least = std::numeric_limits<double>::infinity();
    for (const DfgParams& candidate : candidates(asked)) {
        double error = least_error(candidate, allowed.back(), context);
        if (error <= left) {
            const Search search = smallest_size(candidate, allowed, left, smallest, context);
            error = search.error;
            if (search.size < smallest) best = candidate;
            smallest = std::min(search.size, smallest);
        }
        least = std::min(error, least);
    }
    if (smallest == allowed.size()) refuse(allowed.back(), least, left, max_error);
    best.size = allowed[smallest];
    return {best, pixel};
}

}  // namespace pbrbake::dfg
