#pragma once
// Times that are known: measured again and again, in turn, until their medians stand.
//
// A processor's speed drifts, and other work comes and goes: seconds are never known to better than that. So
// every round measures all tasks once, every other round in the opposite order, and a task's base right
// before and after it: a ratio is to the mean of both, and the median of those of all rounds is what is told.

#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace pbrbake::verify {

/// A median and what is known of it.
struct Median {
    double value = 0;
    double low = 0, high = 0;  ///< 95 % interval; 0 and infinity for fewer than six values
    double spread = 0;         ///< half the distance of the quartiles, over the median
    int count = 0;

    /// Half the interval over the median: .05 is "known to 5 %".
    double known_to() const {
        return value > 0 ? (high - low) / (2 * value) : std::numeric_limits<double>::infinity();
    }
};

/// The median of some values, its interval by order statistics (binomial, no assumption on the distribution:
/// David & Nagaraja 2003, "Order Statistics", 7.1). All zero for none.
Median median_of(std::vector<double> values);

/// What is measured: `cost(times)` does it that many times and returns what one took, in seconds.
struct RepeatTask {
    std::function<double(int times)> cost;
    std::size_t base = 0;  ///< index of the task that this one's ratio is to
};

struct RepeatLimits {
    double known_to = .05;       ///< share of the median of the ratios: two such studies then agree within .1
    int fewest = 7, most = 400;  ///< rounds
    double budget_s = 60;        ///< wall; no round beyond `fewest` starts later
    double least_s = .005;       ///< a shorter task is measured several times in one go
};

struct Timing {
    Median seconds;
    Median ratio;  ///< to the base as measured beside it, a round at a time
};

/// Is told after every round: rounds done, tasks known, seconds gone.
using RepeatProgress = std::function<void(int round, std::size_t known, double wall_s)>;

/// Whether a ratio is known as the limits ask. A base's own is 1.
bool is_known(const Timing& timing, const RepeatLimits& limits);

/// Measures all tasks until each is known, or the limits end it. The first measurement of each is a warm-up;
/// a short one is then measured until it is known how often to repeat it. A task that is known is left out of
/// later rounds, unless it is the base of one that isn't. `wall_s` is a clock.
std::vector<Timing> repeat_until_known(std::span<const RepeatTask> tasks, const RepeatLimits& limits,
                                       const std::function<double()>& wall_s,
                                       const RepeatProgress& progress = {});

}  // namespace pbrbake::verify
