#include "bakers/dfg/choose.hpp"

#include <array>
#include <cmath>

#include "bakers/dfg/layout.hpp"
#include "bakers/dfg/sampled.hpp"

namespace pbrbake::dfg {

Choice choose(DfgParams params, Context& context) {
    constexpr std::array kSizes{8, 16, 24, 32, 48, 64, 96, 128, 192, 256, 384, 512, 768, 1024};
    // Halves round by up to 2^-12 in [.5, 1): worth half of the bytes where that leaves most of the error to
    // the lookup.
    constexpr double kHalfError = 0x1p-12;
    const double max_error = context.accuracy().max_error;
    const PixelType pixel = max_error >= 4 * kHalfError ? PixelType::half : PixelType::float32;
    const double left =
        max_error - (pixel == PixelType::half ? kHalfError : 0) - quadrature_error(context.accuracy());
    const pbr::DfgMethod truth = pbr::DfgMethod::quadrature(max_error / 50);
    for (std::size_t i = 0; i < kSizes.size();) {
        params.size = {kSizes[i]};
        const double error =
            sampled_errors(params, nullptr, truth, Probing::middles, 0, 0, context).interpolation;
        if (error <= left || i + 1 == kSizes.size()) break;
        // Errors fall by the square of the size at best: sizes that could not do are left out.
        const double least = kSizes[i] * std::sqrt(error / left) * 0.9;
        do ++i;
        while (i + 1 < kSizes.size() && kSizes[i] < least);
    }
    return {params, pixel};
}

}  // namespace pbrbake::dfg
