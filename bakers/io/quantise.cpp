// Rounding to what a pixel type can store.

#include <ImathConfig.h>
#include <half.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bakers/io/io.hpp"
#include "bakers/io/rgbe.hpp"
#include "bakers/io/unorm8.hpp"

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
        case PixelType::rgbe:
            return 0x1p126;  // the exponent's byte ends at 2^127
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
        case PixelType::rgbe:
            return value;
        case PixelType::unorm16:
            return to_steps(65535);
        case PixelType::unorm8:
            break;  // round_to_unorm8
    }
    return value;
}

/// Rounds texels to RGBE. With 8 bits a flat region would be off by up to .4 % everywhere; so what rounding
/// took or gave is carried to the next texel, as long as that has a step as large, and means are kept.
void round_to_rgbe(std::vector<float>& texels, std::size_t channels) {
    const std::size_t kept = std::min<std::size_t>(channels, 3);
    std::array<float, 3> carried{};
    for (std::size_t i = 0; i < texels.size(); i += channels) {
        float* texel = &texels[i];
        const float step = std::max({texel[0], texel[kept / 2], texel[kept - 1]}) / 128;
        std::array<float, 3> wanted{};
        for (std::size_t c = 0; c < kept; ++c)
            wanted[c] = texel[c] + (texel[c] > 0 && std::abs(carried[c]) <= step ? carried[c] : 0);
        const std::array<float, 3> stored = from_rgbe(rgbe_of(wanted.data(), kept));
        for (std::size_t c = 0; c < kept; ++c) {
            carried[c] = wanted[c] - stored[c];
            texel[c] = stored[c];
        }
    }
}

void round_to_unorm8(Level& level, const Image& image, float scale) {
    const std::size_t channels = image.channels.size();
    for (std::size_t c = 0; c < channels; ++c) {
        const Transfer transfer = channel_transfer(image, c);
        for (std::size_t i = c; i < level.texels.size(); i += channels) {
            float& value = level.texels[i];
            if (!std::isnan(value)) value = from_unorm8(unorm8_of(value * scale, transfer), transfer);
        }
    }
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
        for (Level& level : image.levels) {
            if (pixel == PixelType::unorm8) {
                round_to_unorm8(level, image, static_cast<float>(scale));
                continue;
            }
            for (float& value : level.texels) value = round_to(static_cast<float>(value * scale), pixel);
            if (pixel == PixelType::rgbe) round_to_rgbe(level.texels, image.channels.size());
        }
    return scale;
}

}  // namespace pbrbake::io
