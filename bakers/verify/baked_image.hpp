#pragma once
// Products read back, and how far one is from another.

#include <cstddef>
#include <vector>

#include "bakers/image.hpp"
#include "bakers/run/run.hpp"

namespace pbrbake::verify {

/// A product's image as its file holds it: stored = scale * value.
struct BakedImage {
    Image image;
    double scale = 1;
    std::vector<double> perceptual_roughness;  ///< of each level
};
/// What a product's record says of its levels; pbr::perceptual_roughness_from_level where it says nothing.
std::vector<double> perceptual_roughness_of_levels(const Json& record, std::size_t levels);

/// The first image of a bake that is done, decoded from its file.
BakedImage read_baked(const run::BakeReport& bake);

/// A flat image read bilinearly, its edges clamped, at the texel centres of a larger or smaller one, one
/// level.
BakedImage resampled(const BakedImage& flat, int width, int height);

/// Stored value less the reference's, both divided by their scales; `index` is into Level::texels.
double value_error(const BakedImage& product, const BakedImage& reference, int level, std::size_t index);

/// Root mean square of value_error over a level, over the reference's mean there; absolute where that mean is
/// not positive.
double relative_rmse(const BakedImage& product, const BakedImage& reference, int level);

/// Of all levels the largest.
struct WorstLevel {
    double relative_rmse = 0;
    int level = 0;
};
/// The images have the same faces, levels and channels; throws Error(invalid_job) if they don't.
WorstLevel worst_level(const BakedImage& product, const BakedImage& reference);

}  // namespace pbrbake::verify
