#pragma once
// Whether one cube map is another, turned.

#include <vector>

#include "bakers/image.hpp"

namespace pbrbake::verify {

struct Turn {
    double degrees = 0;    ///< in (-180, 180], as a probe's rotate_deg counts
    double remainder = 1;  ///< of the distance (face.hpp) that the turn leaves
};

/// The turn about the vertical axis that brings a level of `b`, RGB, nearest to that of `a`. Known to about
/// a tenth of a texel of `kTurnedSide` or of the level's own, if those are fewer.
Turn vertical_turn(const Image& a, const Image& b, int level, const std::vector<double>& typical);

/// Side that faces are shrunk to.
inline constexpr int kTurnedSide = 32;

}  // namespace pbrbake::verify
