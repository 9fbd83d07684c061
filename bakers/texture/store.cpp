#include "bakers/texture/store.hpp"

#include <algorithm>
#include <cmath>

#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/sequence.hpp"

namespace pbrbake::texture {
namespace {

Image empty_image(std::string name, std::size_t channels, Transfer transfer) {
    constexpr std::array<const char*, 4> kNames{"R", "G", "B", "A"};
    Image image;
    image.name = std::move(name);
    image.channels.assign(kNames.begin(), kNames.begin() + static_cast<std::ptrdiff_t>(channels));
    image.transfer = transfer;
    return image;
}

/// IEC 61966-2-1, of an 8-bit code.
float srgb_value(int code) {
    const double encoded = code / 255.;
    return static_cast<float>(
        encoded <= .04045 ? encoded / 12.92 : pbr::exp_exact(2.4 * pbr::log_exact((encoded + .055) / 1.055)));
}

}  // namespace

Store::Store(const TextureParams& params, const Layout& layout) : params_(params) {
    for (const PackedImage& image : layout.images) {
        if (image.channels.front() == Held::dielectric_r) residual_ = images_.size();
        images_.push_back(empty_image(image.name, image.channels.size(),
                                      image.is_colour ? Transfer::srgb : Transfer::linear));
    }
    for (const ExtraMap map : params.maps)
        images_.push_back(empty_image(std::string(enum_name(map)), 1, Transfer::linear));
}

void Store::add_level(int width, int height) {
    const std::size_t texels = static_cast<std::size_t>(width) * height;
    const bool is_first = images_.front().levels.empty();
    const std::size_t count = is_first ? images_.size() : images_.size() - params_.maps.size();
    for (std::size_t i = 0; i < count; ++i)
        images_[i].levels.push_back({width, height, std::vector<float>(texels * images_[i].channels.size())});
}

void Store::put(std::size_t image, std::size_t channel, std::size_t to, std::span<const float> values) {
    const std::size_t step = images_[image].channels.size();
    float* out = images_[image].levels.back().texels.data() + to * step + channel;
    for (std::size_t i = 0; i < values.size(); ++i) out[i * step] = values[i];
}

float Store::residual_unit(float largest) const {
    constexpr std::size_t kStep = 7;  // every seventh number, of all channels in turn
    constexpr float kFinest = 65535, kMost = 1.05f;
    const std::vector<float>& values = images_[residual_].levels.front().texels;
    std::vector<std::uint32_t> histogram(1 << 16);
    for (std::size_t i = 0; i < values.size(); i += kStep)
        ++histogram[static_cast<std::size_t>(std::sqrt(values[i]) * kFinest + .5f)];
    const auto commonest = std::ranges::max_element(histogram) - histogram.begin();
    const float root = static_cast<float>(commonest) / kFinest;
    for (int code = 255; code > 0; --code) {
        const float unit = root * root / srgb_value(code);
        if (unit >= largest) return unit <= kMost * largest ? unit : largest;
    }
    return largest;
}

void Store::divide_residual(float unit) {
    for (Level& level : images_[residual_].levels)
        for (float& value : level.texels) value = std::min(1.f, value / unit);
}

void Store::dither() {
    constexpr float kCode = 1.f / 255;
    const auto seed = static_cast<std::uint64_t>(params_.seed);
    for (std::size_t m = 0; m < images_.size(); ++m)
        for (Level& level : images_[m].levels)
            for (std::size_t i = 0; i < level.texels.size(); ++i) {
                const double noise =
                    pbr::random_unit(seed + m, 2 * i) - pbr::random_unit(seed + m, 2 * i + 1);
                float& value = level.texels[i];
                // In sRGB's scale a code is narrower in the dark: half_step knows its width.
                const bool is_srgb =
                    images_[m].transfer == Transfer::srgb && i % images_[m].channels.size() < 3;
                const float code = is_srgb ? 2 * half_step(value, 8, true) : kCode;
                // Black and white stay what they are, and no noise leads beyond them.
                if (value > 0 && value < 1)
                    value = std::clamp(value + static_cast<float>(noise) * code / 2, 0.f, 1.f);
            }
}

}  // namespace pbrbake::texture
