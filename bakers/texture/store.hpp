#pragma once
// A set's images on their way to files.

#include <span>

#include "bakers/texture/pack.hpp"

namespace pbrbake::texture {

/// Holds the images of a layout, and grey ones besides.
class Store {
  public:
    Store(const TextureParams& params, const Layout& layout);

    /// Adds a level to the layout's images; the largest, which comes first, to grey ones too.
    void add_level(int width, int height);
    /// Texels from `to` on of one channel, in the newest level. Texels of different rows may be put at a
    /// time.
    void put(std::size_t image, std::size_t channel, std::size_t to, std::span<const float> values);
    /// A unit for dielectric f0, the residual: at least `largest`, and up to a twentieth more where the f0
    /// that most texels have is an 8-bit code exactly then. What many texels share would else be off by the
    /// same part of a code in all of them.
    float residual_unit(float largest) const;
    /// Divides the residual by the set's unit, which is known last; ends at 1.
    void divide_residual(float unit);
    /// Adds what triangular noise of one code's width takes from banding, where codes are 8 bits.
    void dither();
    const Level& newest_level() const { return images_.front().levels.back(); }
    std::vector<Image> take() { return std::move(images_); }

  private:
    const TextureParams& params_;
    std::vector<Image> images_;
    std::size_t residual_ = 0;  ///< which image that is, where there is one
};

}  // namespace pbrbake::texture
