#pragma once
// A texture as a shader reads it: interpolated between texels. Its flux and its peak.

#include "bakers/ies/projection.hpp"

namespace pbrbake::ies {

/// What a shader would find.
struct Decoded {
    double flux = 0;  ///< texture values x sr
    double peak = 0;  ///< the largest value; interpolation never exceeds a texel
};

/// Integrates the bilinear reconstruction. latlong and axial: exactly. The others: by 2 x 2 Gauss points
/// between neighbouring texel centres, each face clamped at its border.
Decoded decode(const Layout& layout, const Profile& profile, const Image& image);

/// What the texture should have: of a cookie just what its square holds, by the same quadrature.
Decoded truth(const Layout& layout, const Profile& profile);

}  // namespace pbrbake::ies
