#pragma once
// A decoded map of a set, whichever way it is held: floats, or an 8-bit file's codes.

#include <array>
#include <span>

#include "bakers/baker.hpp"

namespace pbrbake::texture {

/// A view into a source; without one it has no channels.
class Picture {
  public:
    Picture() = default;
    explicit Picture(const SourceImage& source);

    explicit operator bool() const { return source_ != nullptr; }
    int width() const { return width_; }
    int height() const { return height_; }
    int channels() const { return channels_; }
    int bits() const { return source_->bits; }
    bool is_half() const { return source_->is_half; }
    bool is_srgb() const { return source_->colour_space.find("srgb") != std::string::npos; }
    bool is_same(const Picture& other) const { return source_ == other.source_; }

    /// A channel of row y from column x on; linear.
    void read(int x, int y, int channel, std::span<float> values) const;
    /// The same of one texel.
    float value(int x, int y, int channel) const {
        const std::size_t at = index(x, y) + static_cast<std::size_t>(channel);
        return codes_ ? table(channel)[codes_[at]] : texels_[at];
    }
    /// The codes of a texel; null where it is floats. `linear` says what one of a channel stands for.
    const std::uint8_t* codes(int x, int y) const { return codes_ ? codes_ + index(x, y) : nullptr; }
    float linear(int channel, std::uint8_t code) const { return table(channel)[code]; }
    /// Whether a channel isn't the same everywhere.
    bool varies(int channel) const;
    /// Whether R, G and B are the same everywhere, or there is one channel only.
    bool is_grey() const;
    /// The share of texels with a colour above 1.
    double share_above_one() const;

  private:
    std::size_t index(int x, int y) const { return (static_cast<std::size_t>(y) * width_ + x) * channels_; }
    const std::array<float, 256>& table(int channel) const { return *tables_[channel < 3]; }

    const SourceImage* source_ = nullptr;
    const std::uint8_t* codes_ = nullptr;  ///< null: floats
    const float* texels_ = nullptr;
    std::array<const std::array<float, 256>*, 2> tables_{};  ///< of alpha, and of colours
    int width_ = 0, height_ = 0, channels_ = 0;
};

/// The picture of a field; none where the set has no such file.
Picture picture_of(const Inputs& inputs, const std::string& field);

/// Throws Error(unreadable_input) where `stating`, stated as `stated`, takes the alpha of a picture without
/// one. Other channels are always there.
void require_channel(const Inputs& inputs, const std::string& field, int channel, const std::string& stating,
                     std::string_view stated);

}  // namespace pbrbake::texture
