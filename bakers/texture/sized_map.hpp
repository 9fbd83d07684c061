#pragma once
// A map of a set at the set's size, whatever its own is.

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/texture/params.hpp"
#include "bakers/texture/picture.hpp"

namespace pbrbake::texture {

/// One channel, or several from one on, `step` further each, of a picture; interpolated bilinearly where its
/// size isn't the set's. Without a picture it holds nothing.
class SizedMap {
  public:
    SizedMap() = default;
    /// Of a set of width x height; wrap says what lies beyond the picture's edges.
    SizedMap(const Picture& picture, int channel, int step, int width, int height, Wrap wrap);

    explicit operator bool() const { return bool(picture_); }
    const Picture& picture() const { return picture_; }
    int channel(int c) const { return channel_ + c * step_; }  ///< the picture's of its own channel c
    /// Whether it is even in sRGB: colours are, and no alpha.
    bool is_srgb() const { return channel_ < 3 && picture_.is_srgb(); }
    /// Channel `c` of its own in row y from column x on; linear.
    void read(int c, int x, int y, std::span<float> values) const;
    /// The codes of its channel c there, a picture's channels apart; null where it isn't as large as the set,
    /// or floats.
    const std::uint8_t* codes(int c, int x, int y) const;

  private:
    /// The two texels of the picture that a texel of the set lies between, along one axis.
    struct Place {
        int first, second;
        float share;  ///< the second's
    };
    static std::vector<Place> places(int size, int set_size, Wrap wrap);

    Picture picture_;
    int channel_ = 0, step_ = 1;
    std::vector<Place> columns_, rows_;  ///< of the set; empty where the picture is as large
};

}  // namespace pbrbake::texture
