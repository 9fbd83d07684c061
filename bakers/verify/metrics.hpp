#pragma once
// How far values are from reference values: what compare and study count in.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bakers/image.hpp"

namespace pbrbake::verify {

/// Errors of one channel over one face of one level. Values are divided by the reference's scale. Those that
/// are not finite on either side are counted, and left out of everything else.
struct ErrorFigures {
    std::uint64_t values = 0;     ///< compared
    std::uint64_t differing = 0;  ///< of those, not equal
    std::uint64_t non_finite_a = 0, non_finite_b = 0;
    std::uint64_t max_ulp = 0;  ///< steps of the pixel type between a and b
    double max_abs = 0, mean_abs = 0, rms = 0;
    double relative_rms = 0;  ///< rms over the mean of |b|; infinite where b is black and a is not
    /// Percentiles of |a - b| / max(|b|, typical), typical being the median of |b| (its mean if that is 0):
    /// shares of a value that is neither the sun nor a shadow.
    double relative_p50 = 0, relative_p95 = 0, relative_p99 = 0, relative_max = 0;
    double energy_a = 0, energy_b = 0;  ///< weighted means
    double energy_reference = 0;        ///< weighted mean of |b|
    double energy_change = 0;           ///< |energy_a - energy_b| / energy_reference
    double reference_mean = 0;          ///< mean of |b|
    std::size_t worst = 0;              ///< index of the value with relative_max
};

/// Steps of a pixel type between two values, as its bit patterns are ordered; 0 and -0 are one. Both must be
/// values that the type holds, and finite. Of rgbe: steps of the texel whose brightest channel is
/// `brightest`.
std::uint64_t ulp_distance(float a, float b, PixelType pixel, float brightest);

/// One channel of one face, gathered.
struct Samples {
    std::vector<float> a, b;         ///< as stored, a brought to b's scale
    std::vector<float> brightest;    ///< largest channel of each texel of b; empty but for rgbe
    std::span<const double> weight;  ///< of each value: solid angle, or 1
};

/// Errors of a against b. `scale` is b's: stored value = scale x value. Spans are of one length. An empty set
/// gives zeros.
ErrorFigures error_figures(const Samples& samples, PixelType pixel, double scale);

/// The sum of parts as if they were one set: maxima, root mean squares and energies exactly, percentiles as
/// the largest of the parts'.
ErrorFigures joined_figures(std::span<const ErrorFigures> parts);

/// The weight of each texel of a face or picture: its solid angle if it is a cube map's, else 1.
std::vector<double> texel_weights(const Level& level, bool is_cube);

/// The value at a share of a set in rising order, between the two nearest; 0 of an empty set. Reorders it.
double quantile(std::vector<float>& values, double share);

}  // namespace pbrbake::verify
