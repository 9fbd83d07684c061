#pragma once
// Codes of 8 bits, linear or sRGB, and the linear numbers they stand for.

#include <cstdint>

#include "bakers/image.hpp"

namespace pbrbake::io {

/// The code nearest to a linear value: in the code's own scale, so an sRGB code is the one whose encoded
/// value is nearest. NaN is 0.
std::uint8_t unorm8_of(float linear, Transfer transfer);

/// The linear value of a code; unorm8_of gives the code back.
float from_unorm8(std::uint8_t code, Transfer transfer);

/// The transfer of channel `index` of an image.
inline Transfer channel_transfer(const Image& image, std::size_t index) {
    return index < 3 ? image.transfer : Transfer::linear;
}

}  // namespace pbrbake::io
