#pragma once
// FLIP: the difference that a person sees when flipping between two pictures.
//
// Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström & Fairchild 2020, "FLIP: A Difference Evaluator for
// Alternating Images" (LDR-FLIP), and Andersson, Nilsson, Shirley & Akenine-Möller 2021, "Visualizing Errors
// in Rendered High Dynamic Range Images" (HDR-FLIP). Written from the papers; every figure that tests ask of
// NVIDIA's own implementation is within 2e-5 of it.

#include <optional>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

namespace pbrbake::verify {

/// A picture in linear Rec. 709, row 0 at the top.
struct LinearPicture {
    LinearPicture(int columns, int rows)
        : width(columns), height(rows), rgb(static_cast<std::size_t>(columns) * rows) {}

    int width, height;
    std::vector<glm::dvec3> rgb;

    glm::dvec3& at(int x, int y) { return rgb[static_cast<std::size_t>(y) * width + x]; }
    const glm::dvec3& at(int x, int y) const { return rgb[static_cast<std::size_t>(y) * width + x]; }
};

/// Pixels a degree of sight for a 0.7 m wide monitor of 3840 pixels seen from 0.7 m: 67.02, FLIP's default.
double default_pixels_per_degree();

/// Error of each pixel, 0 to 1, row 0 at the top.
struct FlipMap {
    int width, height;
    std::vector<double> error;

    double mean() const;
    double max() const;
};

/// LDR-FLIP of linear pictures of one size; values are clipped to [0, 1]. Symmetric.
FlipMap ldr_flip(const LinearPicture& reference, const LinearPicture& test,
                 double pixels_per_degree = default_pixels_per_degree());

/// First and last exposure, in stops, between which HDR-FLIP looks: those that tone-map the reference's
/// largest and its median luminance to 0.85 (2021, section 4). Both 0 for a black reference.
std::pair<double, double> flip_exposures(const LinearPicture& reference);

/// HDR-FLIP: the largest LDR-FLIP of each pixel over max(2, ceil(stop - start)) exposures evenly from start
/// to stop, tone-mapped by ACES as Narkowicz fitted it. Exposures found from the reference if none are given.
FlipMap hdr_flip(const LinearPicture& reference, const LinearPicture& test,
                 std::optional<std::pair<double, double>> exposures = {},
                 double pixels_per_degree = default_pixels_per_degree());

}  // namespace pbrbake::verify
