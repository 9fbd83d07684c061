// Rounding to what a pixel type can store.

#include <ImathConfig.h>
#include <half.h>

#include <algorithm>
#include <cmath>

#include "bakers/io/io.hpp"

namespace pbrbake::io {
namespace {

/// The largest magnitude that `pixel` stores: half rounds what is below 65,520 down to 65,504.
double limit_of(PixelType pixel) {
    switch (pixel) {
        case PixelType::half:
            return std::nextafter(65520., 0.);
        case PixelType::float32:
            return HUGE_VAL;
        case PixelType::unorm16:
        case PixelType::unorm8:
            return 1;
    }
    return 0;
}

float round_to(float value, PixelType pixel) {
    if (std::isnan(value)) return value;
    const auto to_steps = [&](double steps) {
        return static_cast<float>(std::nearbyint(std::clamp(static_cast<double>(value), 0., 1.) * steps) /
                                  steps);
    };
    switch (pixel) {
        case PixelType::half:
            return static_cast<float>(half(value));
        case PixelType::float32:
            return value;
        case PixelType::unorm16:
            return to_steps(65535);
        case PixelType::unorm8:
            return to_steps(255);
    }
    return value;
}

}  // namespace

double quantise(std::vector<Image>& images, PixelType pixel) {
    const bool is_signed = pixel == PixelType::half || pixel == PixelType::float32;
    double peak = 0;
    for (const Image& image : images)
        for (const Level& level : image.levels)
            for (const float value : level.texels)
                if (std::isfinite(value))
                    peak = std::max(peak, static_cast<double>(is_signed ? std::abs(value) : value));

    double scale = 1;
    while (peak * scale > limit_of(pixel)) scale /= 2;

    for (Image& image : images)
        for (Level& level : image.levels)
            for (float& value : level.texels) value = round_to(static_cast<float>(value * scale), pixel);
    return scale;
}

}  // namespace pbrbake::io
