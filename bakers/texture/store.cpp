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

/// By how much a residual's factor grows where its colour's largest channel is beyond 1.
float growth_of(float factor, float largest) {
    return factor > 0 && factor < 1 && largest > 1 ? std::min(largest, 1 / factor) : 1;
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
            else if (i == residual_) {
                roots_.emplace_back(3 * texels);
                factors_.emplace_back(numbers - 3 * texels);
            } else
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
    const auto code = [&](std::size_t i) { return code_of(image, first + i * step, values[i]); };
    if (!is_coded_)
        for (std::size_t i = 0; i < values.size(); ++i) out.texels[first + i * step] = values[i];
    else if (image != residual_)
        for (std::size_t i = 0; i < values.size(); ++i) out.codes[first + i * step] = code(i);
    else if (channel == 3)
        for (std::size_t i = 0; i < values.size(); ++i) factors_[level][to + i] = code(i);
    else
        for (std::size_t i = 0; i < values.size(); ++i)
            roots_[level][(to + i) * 3 + channel] = root_of(values[i]);
}

float Store::residual_unit(float largest) const {
    constexpr std::size_t kStep = 7;  // every seventh number, of all channels in turn
    constexpr float kMost = 1.05f;
    std::vector<std::uint32_t> histogram(1 << 16);
    if (is_coded_) {
        for (std::size_t i = 0; i < roots_[0].size(); i += kStep) ++histogram[roots_[0][i]];
    } else {
        const std::vector<float>& values = images_[residual_].levels[0].texels;
        const std::size_t step = images_[residual_].channels.size();
        for (std::size_t i = 0; i < values.size() / step * 3; i += kStep)
            ++histogram[root_of(values[i / 3 * step + i % 3])];
    }
    const auto commonest = std::ranges::max_element(histogram) - histogram.begin();
    const float value = squared(static_cast<std::size_t>(commonest));
    for (int code = 255; code > 0; --code) {
        const float unit = value / from_unorm8(static_cast<std::uint8_t>(code), Transfer::srgb);
        if (unit >= largest) return unit <= kMost * largest ? unit : largest;
    }
    return largest;
}

void Store::divide_residual(float unit, bool keeps_factor) {
    Image& image = images_[residual_];
    const std::size_t before = image.channels.size(), after = keeps_factor ? before : 3;
    image.channels.resize(after);
    for (std::size_t l = 0; l < image.levels.size(); ++l)
        is_coded_ ? divide_codes(unit, l, after) : divide_floats(unit, l, before, after);
}

/// In place, from `before` channels to `after`.
void Store::divide_floats(float unit, std::size_t l, std::size_t before, std::size_t after) {
    std::vector<float>& numbers = images_[residual_].levels[l].texels;
    const std::size_t texels = numbers.size() / before;
    for (std::size_t i = 0; i < texels; ++i) {
        Colour colour = Colour(numbers[i * before], numbers[i * before + 1], numbers[i * before + 2]) / unit;
        float factor = before > 3 ? numbers[i * before + 3] : 1;
        const float growth = growth_of(factor, pbr::max_channel(colour));
        colour = glm::min(colour / growth, Colour(1));
        for (std::size_t c = 0; c < 3; ++c) numbers[i * after + c] = colour[static_cast<int>(c)];
        if (after > 3) numbers[i * after + 3] = factor * growth;
    }
    numbers.resize(texels * after);
}

void Store::divide_codes(float unit, std::size_t l, std::size_t channels) {
    const std::vector<std::uint16_t> roots = std::move(roots_[l]);
    const std::vector<std::uint8_t> factors = std::move(factors_[l]);
    std::vector<float> values(1 << 16);
    std::vector<std::uint8_t> codes(1 << 16);
    for (std::size_t root = 0; root < values.size(); ++root) {
        values[root] = squared(root) / unit;
        codes[root] = unorm8_of(values[root], Transfer::srgb);
    }
    std::vector<std::uint8_t>& numbers = images_[residual_].levels[l].codes;
    numbers.resize(roots.size() / 3 * channels);
    for (std::size_t i = 0; i < roots.size() / 3; ++i) {
        const std::uint16_t* texel = roots.data() + 3 * i;
        std::uint8_t factor_code = factors.empty() ? 255 : factors[i];
        float shrunk = 1;  // of colours, as the factor grows
        if (factor_code < 255) {
            const float factor = from_unorm8(factor_code, Transfer::linear),
                        grown = factor * growth_of(factor, values[*std::max_element(texel, texel + 3)]);
            if (grown > factor) {
                factor_code = static_cast<std::uint8_t>(std::ceil(grown * 255));
                shrunk = factor / from_unorm8(factor_code, Transfer::linear);
            }
        }
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t number = i * channels + c;
            if (params_.dither || shrunk < 1)
                numbers[number] = code_of(residual_, number, std::min(1.f, values[texel[c]] * shrunk));
            else
                numbers[number] = codes[texel[c]];
        }
        if (channels > 3) numbers[i * channels + 3] = factor_code;
    }
}

/// The code of a level's number, after what triangular noise of one code's width takes from banding, where
/// that is asked for.
std::uint8_t Store::code_of(std::size_t image, std::size_t number, float value) const {
    const Transfer transfer = channel_transfer(images_[image], number % images_[image].channels.size());
    // Black and white stay what they are, and no noise leads beyond them.
    if (params_.dither && value > 0 && value < 1) {
        const std::uint64_t seed = static_cast<std::uint64_t>(params_.seed) + image;
        const double noise = pbr::random_unit(seed, 2 * number) - pbr::random_unit(seed, 2 * number + 1);
        // In sRGB's scale a code is narrower in the dark: half_step knows its width.
        value += static_cast<float>(noise) * half_step(value, 8, transfer == Transfer::srgb);
    }
    return unorm8_of(value, transfer);
}

}  // namespace pbrbake::texture
