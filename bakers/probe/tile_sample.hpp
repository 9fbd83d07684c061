#pragma once
// Which parts of a level are checked, and what they say of the whole.
//
// Errors follow brightness: rounding is a share of the value, and what a sun adds is wrong where it is
// bright. Parts that would be drawn for certain - a sun's peak - are all measured and take no part in the
// draw. Of the others each is drawn with probability in half its share of their squared values, in half alike
// (Hansen & Hurwitz 1943, "On the theory of sampling from finite populations").

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace pbrbake::probe {

/// Parts of a level to measure.
struct TileSample {
    std::vector<std::size_t> certain;  ///< measured each
    std::vector<std::size_t> drawn;    ///< with replacement, from the others
    std::vector<double> probability;   ///< of each of `drawn`, a draw
    /// How many measurements.
    std::size_t size() const { return certain.size() + drawn.size(); }
};

/// Chooses about `count` >= 1 of brightness.size() parts; all of them, as certain, where `count` is no less.
/// `brightness` >= 0: sums of squared values. At least half are drawn. A function of its arguments alone.
TileSample choose_tiles(std::span<const double> brightness, int count, std::uint64_t seed);

/// A total over all parts from measured ones.
struct TotalEstimate {
    double value;
    std::pair<double, double> interval;  ///< 95 %; both the value where all parts were measured
};

/// `of_certain` and `of_drawn`, of any sign, in the sample's order. The interval is Student's.
TotalEstimate estimate_balance(const TileSample& sample, std::span<const double> of_certain,
                               std::span<const double> of_drawn);

/// The same of what is >= 0. The interval takes the logarithm of the drawn
/// parts' sum for a Student's t, since errors are skewed: checked to hold the truth at least nine times in
/// ten on baked probes with and without suns.
TotalEstimate estimate_total(const TileSample& sample, std::span<const double> of_certain,
                             std::span<const double> of_drawn);

}  // namespace pbrbake::probe
