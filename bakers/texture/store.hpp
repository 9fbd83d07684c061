#pragma once
// A set's images on their way to files.

#include <span>

#include "bakers/texture/pack.hpp"

namespace pbrbake::texture {

/// Holds the images of a layout with all their levels, and grey ones of the largest level besides: as 8-bit
/// codes, or as floats.
class Store {
  public:
    Store(const TextureParams& params, const Layout& layout, int width, int height, bool is_coded);

    int levels() const { return static_cast<int>(images_.front().levels.size()); }
    /// Texels from `to` on of one channel of an image's level; each is put once. Others may be put at the
    /// same time.
    void put(std::size_t image, std::size_t channel, std::size_t level, std::size_t to,
             std::span<const float> values);
    /// A unit for dielectric f0, the residual: at least `largest`, and up to a twentieth more where the f0
    /// that most texels have is an 8-bit code exactly then. What many texels share would else be off by the
    /// same part of a code in all of them.
    float residual_unit(float largest) const;
    /// Divides the residual by the set's unit, which is known last; ends at 1. Its fourth channel, if there
    /// is one, is kept or dropped, and grows where colours would end otherwise: what they multiply to stays.
    void divide_residual(float unit, bool keeps_factor);
    std::vector<Image> take() { return std::move(images_); }

  private:
    void divide_floats(float unit, std::size_t l, std::size_t before, std::size_t after);
    void divide_codes(float unit, std::size_t l, std::size_t channels);
    std::uint8_t code_of(std::size_t image, std::size_t number, float value) const;

    const TextureParams& params_;
    bool is_coded_;
    std::vector<Image> images_;
    std::size_t residual_;  ///< which image that is; where there is none, none
    /// Of a residual that will be codes, each level until its unit is known: square roots, 65535 is 1. An
    /// sRGB code is some hundred of these wide.
    std::vector<std::vector<std::uint16_t>> roots_;
    std::vector<std::vector<std::uint8_t>> factors_;  ///< each level's codes of its fourth channel
};

}  // namespace pbrbake::texture
