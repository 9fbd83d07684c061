#pragma once
// What a set of (time, error) points says: which are worth having, how fast error falls, where it stops
// paying.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace pbrbake::verify {

/// What a setting costs and how far off it is.
struct Cost {
    double time = 0;   ///< any unit, > 0
    double error = 0;  ///< >= 0
};

/// Indices of the points that no other beats in both: in order of time, error falling strictly. Of equal
/// points the first. Points with a time or error that is not finite are left out.
std::vector<std::size_t> pareto_front(std::span<const Cost> points);

/// error = coefficient * (time - fixed)^-exponent: `fixed` is what is paid whatever the setting.
struct PowerLaw {
    double exponent = 0;
    double coefficient = 0;
    double fixed = 0;    ///< in [0, time of the cheapest point)
    double scatter = 0;  ///< root mean square of log10(error / law), over the points used
    int points = 0;      ///< used

    double error_at(double time) const;
    /// Inverse of error_at; error > 0.
    double time_for(double error) const;
    /// What (time - fixed) is multiplied by for a tenth of the error: 10^(1/exponent).
    double price_of_digit() const;
};

/// The law through a method's points, by least squares of log error over log(time - fixed), `fixed` the best
/// of 64 from 0 up to the cheapest point's time (0 for fewer than four points). Used are the points of the
/// method's own front with errors above `floor`, the reference's own error: below it nothing is known.
/// Nothing for fewer than three such points, where their times span less than a factor of two, or where error
/// does not fall.
std::optional<PowerLaw> fit_power_law(std::span<const Cost> points, double floor = 0);

/// What it takes to get below an error, measured.
struct Digit {
    double error = 0;       ///< 10^-k
    std::size_t point = 0;  ///< index of the cheapest point at or below it
};
/// For every power of ten from the one at or above the largest error of the front down to the one at or above
/// its smallest; errors of 0 count as reaching all of these. Nothing where all errors are 0.
std::vector<Digit> digits_reached(std::span<const Cost> points);

/// The knee of a front (as pareto_front orders it): the point farthest below the straight line from its first
/// to its last in log-log, both axes scaled to 1 (Satopaa et al. 2011, "Finding a Kneedle in a Haystack").
/// Nothing if no point is below that line. Errors of 0 are left out.
std::optional<std::size_t> knee(std::span<const Cost> front);

}  // namespace pbrbake::verify
