#pragma once
// What a difference between two pictures looks like: the mistakes that bakers, loaders and containers make.

#include <string>

#include "bakers/verify/product_file.hpp"

namespace pbrbake::verify {

/// Names the one known mistake that turns `b` (the reference) into `a`, as "faces +X and -X are swapped", or
/// gives "". Known are: a factor (with its name where it is pi or its like) of all or some levels or
/// channels; faces swapped, moved, turned or mirrored; a table or picture mirrored or turned; a turn about
/// the vertical; a shift by half a texel or a whole one, or texels aligned to centres instead of ends;
/// perceptual roughness squared once too often or not at all; a gamma. Each is tried on the level that
/// differs most, and named if it takes away most of the difference. The pictures have the same shape; `a` is
/// brought to b's scale.
std::string diagnose(const Image& a, const ProductFile& b);

}  // namespace pbrbake::verify
