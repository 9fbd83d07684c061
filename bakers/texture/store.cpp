#include "bakers/texture/store.hpp"

#include <algorithm>
#include <cmath>

#include "bakers/texture/chain.hpp"
#include "bakers/unorm8.hpp"
#include "pbr/numerics/sequence.hpp"

namespace pbrbake::texture {
namespace {

constexpr float kRootOfOne = 65535;
constexpr std::size_t kNone = -1;

Image empty_image(std::string name, std::size_t channels, Transfer transfer) {
    constexpr std::array<const char*, 4> kNames{"R", "G", "B", "A"};
    Image image;
    image.name = std::move(name);
    image.channels.assign(kNames.begin(), kNames.begin() + static_cast<std::ptrdiff_t>(channels));
    image.transfer = transfer;
    return image;
}

std::uint16_t root_of(float value) {
    return static_cast<std::uint16_t>(std::sqrt(std::clamp(value, 0.f, 1.f)) * kRootOfOne + .5f);
}

float squared(std::size_t root) {
    const float value = static_cast<float>(root) / kRootOfOne;
    return value * value;
}

}  // namespace

Store::Store(const TextureParams& params, const Layout& layout, int width, int height, bool is_coded)
    : params_(params), is_coded_(is_coded), residual_(kNone) {
    for (const PackedImage& image : layout.images) {
        if (image.channels.front() == Held::dielectric_r) residual_ = images_.size();
        images_.push_back(empty_image(image.name, image.channels.size(),
                                      image.is_colour ? Transfer::srgb : Transfer::linear));
    }
    for (const ExtraMap map : params.maps)
        images_.push_back(empty_image(std::string(enum_name(map)), 1, Transfer::linear));

    for (int level = 0; params.levels == 0 || level < params.levels; ++level) {
        const std::size_t texels = static_cast<std::size_t>(width) * height;
        for (std::size_t i = 0; i < (level == 0 ? images_.size() : layout.images.size()); ++i) {
            const std::size_t numbers = texels * images_[i].channels.size();
            images_[i].levels.push_back({width, height, {}});
            Level& added = images_[i].levels.back();
            if (!is_coded)
                added.texels.resize(numbers);
            else if (i == residual_)
                roots_.emplace_back(numbers);
            else
                added.codes.resize(numbers);
        }
        if (std::max(width, height) == 1) break;
        width = side_below(width);
        height = side_below(height);
    }
}

void Store::put(std::size_t image, std::size_t channel, std::size_t level, std::size_t to,
                std::span<const float> values) {
    const std::size_t step = images_[image].channels.size(), first = to * step + channel;
    Level& out = images_[image].levels[level];
    const auto put_each = [&](auto& numbers, const auto& stored) {
        for (std::size_t i = 0; i < values.size(); ++i) numbers[first + i * step] = stored(i);
    };
    if (!is_coded_)
        put_each(out.texels, [&](std::size_t i) { return values[i]; });
    else if (image == residual_)
        put_each(roots_[level], [&](std::size_t i) { return root_of(values[i]); });
    else
        put_each(out.codes, [&](std::size_t i) { return code_of(image, first + i * step, values[i]); });
}

float Store::residual_unit(float largest) const {
    constexpr std::size_t kStep = 7;  // every seventh number, of all channels in turn
    constexpr float kMost = 1.05f;
    std::vector<std::uint32_t> histogram(1 << 16);
    if (is_coded_) {
        for (std::size_t i = 0; i < roots_[0].size(); i += kStep) ++histogram[roots_[0][i]];
    } else {
        const std::vector<float>& values = images_[residual_].levels[0].texels;
        for (std::size_t i = 0; i < values.size(); i += kStep) ++histogram[root_of(values[i])];
    }
    const auto commonest = std::ranges::max_element(histogram) - histogram.begin();
    const float value = squared(static_cast<std::size_t>(commonest));
    for (int code = 255; code > 0; --code) {
        const float unit = value / from_unorm8(static_cast<std::uint8_t>(code), Transfer::srgb);
        if (unit >= largest) return unit <= kMost * largest ? unit : largest;
    }
    return largest;
}

void Store::divide_residual(float unit, bool is_unit) {
    std::vector<Level>& levels = images_[residual_].levels;
    if (!is_coded_) {
        for (Level& level : levels)
            for (float& value : level.texels) value = is_unit ? std::min(1.f, value / unit) : value / unit;
        return;
    }
    std::vector<float> values(1 << 16);
    for (std::size_t root = 0; root < values.size(); ++root)
        values[root] = std::min(1.f, squared(root) / unit);
    std::vector<std::uint8_t> codes;
    for (const float value : values) codes.push_back(unorm8_of(value, Transfer::srgb));
    for (std::size_t l = 0; l < levels.size(); ++l) {
        const std::vector<std::uint16_t> roots = std::move(roots_[l]);
        levels[l].codes.resize(roots.size());
        for (std::size_t i = 0; i < roots.size(); ++i)
            levels[l].codes[i] = params_.dither ? code_of(residual_, i, values[roots[i]]) : codes[roots[i]];
    }
}

/// The code of a level's number, after noise that takes banding away where that is asked for: triangular, up
/// to a code either way, with which codes have the number's mean (Lipshitz et al. 1992, "Quantization and
/// Dither").
std::uint8_t Store::code_of(std::size_t image, std::size_t number, float value) const {
    const Transfer transfer = channel_transfer(images_[image], number % images_[image].channels.size());
    // Black and white stay what they are, and no noise leads beyond them.
    if (params_.dither && value > 0 && value < 1) {
        const std::uint64_t seed = static_cast<std::uint64_t>(params_.seed) + image;
        const double noise = pbr::random_unit(seed, 2 * number) - pbr::random_unit(seed, 2 * number + 1);
        // In sRGB's scale a code is narrower in the dark: half_step knows its width.
        value += static_cast<float>(noise) * 2 * half_step(value, 8, transfer == Transfer::srgb);
    }
    return unorm8_of(value, transfer);
}

}  // namespace pbrbake::texture
