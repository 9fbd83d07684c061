#pragma once
// Our cube maps in OpenEXR's picture of one (faces stacked, n x 6n, each turned its own way), and back.

#include <cstddef>

namespace pbrbake::io {

/// Where texel (x, y) of one of our faces lies in the picture: origin + x * along_x + y * along_y, as texel
/// indices into the n x 6n picture. A permutation: texel centres stay texel centres.
struct ExrFace {
    std::ptrdiff_t origin = 0, along_x = 0, along_y = 0;
    std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(origin + along_x * x + along_y * y);
    }
};

/// `face`: 0-5 for +X -X +Y -Y +Z -Z, in our and in OpenEXR's order. `size` >= 1.
/// Derived from Imf::CubeMap::direction and pixelPosition, so that it can't disagree with the library.
ExrFace exr_face(int face, int size);

}  // namespace pbrbake::io
