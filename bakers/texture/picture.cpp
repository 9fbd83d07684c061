#include "bakers/texture/picture.hpp"

#include <algorithm>

namespace pbrbake::texture {
namespace {

const std::array<float, 256> kUnit = [] {
    std::array<float, 256> values{};
    for (std::size_t code = 0; code < values.size(); ++code)
        values[code] = static_cast<float>(static_cast<double>(code) / 255);
    return values;
}();

}  // namespace

Picture::Picture(const SourceImage& source)
    : source_(&source),
      codes_(source.codes.empty() ? nullptr : source.codes.data()),
      texels_(source.image.levels.front().texels.data()),
      tables_{&kUnit, &source.linear},
      width_(source.image.levels.front().width),
      height_(source.image.levels.front().height),
      channels_(source.image.channel_count()) {}

void Picture::read(int x, int y, int channel, std::span<float> values) const {
    const std::size_t at = index(x, y) + static_cast<std::size_t>(channel);
    const auto step = static_cast<std::size_t>(channels_);
    if (codes_) {
        const std::array<float, 256>& linear = table(channel);
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = linear[codes_[at + i * step]];
    } else {
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = texels_[at + i * step];
    }
}

bool Picture::varies(int channel) const {
    const std::size_t texels = static_cast<std::size_t>(width_) * height_;
    const auto differs = [&](const auto* values) {
        for (std::size_t i = 1; i < texels; ++i)
            if (values[i * channels_ + channel] != values[channel]) return true;
        return false;
    };
    return codes_ ? differs(codes_) : differs(texels_);
}

bool Picture::is_grey() const {
    if (channels_ < 3) return true;
    const std::size_t values = static_cast<std::size_t>(width_) * height_ * channels_;
    const auto is_equal = [&](const auto* texels) {
        for (std::size_t i = 0; i < values; i += channels_)
            if (texels[i] != texels[i + 1] || texels[i] != texels[i + 2]) return false;
        return true;
    };
    return codes_ ? is_equal(codes_) : is_equal(texels_);
}

double Picture::share_above_one() const {
    if (codes_) return 0;
    const std::size_t texels = static_cast<std::size_t>(width_) * height_;
    std::size_t found = 0;
    for (std::size_t i = 0; i < texels; ++i) {
        const float* rgb = texels_ + i * channels_;
        found += std::max({rgb[0], rgb[1], rgb[2]}) > 1;
    }
    return static_cast<double>(found) / static_cast<double>(texels);
}

Picture picture_of(const Inputs& inputs, const std::string& field) {
    const auto found = inputs.find(field);
    return found == inputs.end() || found->second.image.levels.empty() ? Picture() : Picture(found->second);
}

void require_channel(const Inputs& inputs, const std::string& field, int channel, const std::string& stating,
                     std::string_view stated) {
    const Picture picture = picture_of(inputs, field);
    if (picture && channel >= picture.channels())
        throw Error(ExitCode::unreadable_input, "",
                    stating + ": found \"" + std::string(stated) + "\", but the picture of " + field +
                        " has no alpha");
}

}  // namespace pbrbake::texture
