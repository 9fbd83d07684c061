#include "bakers/verify/repeat.hpp"

#include <algorithm>
#include <cmath>

namespace pbrbake::verify {
namespace {

constexpr double kMissing = -1;
constexpr int kMostInOneGo = 1 << 20;

double middle(const std::vector<double>& sorted) {
    const std::size_t n = sorted.size();
    return n % 2 ? sorted[n / 2] : (sorted[n / 2 - 1] + sorted[n / 2]) / 2;
}

/// The value at a share of the way through, linear between two.
double quantile(const std::vector<double>& sorted, double share) {
    const double at = share * (static_cast<double>(sorted.size()) - 1);
    const auto i = static_cast<std::size_t>(at);
    const double next = sorted[std::min(i + 1, sorted.size() - 1)];
    return sorted[i] + (at - static_cast<double>(i)) * (next - sorted[i]);
}

/// Largest k for which at most k of n fair coins are heads with a chance of 2.5 % or less; -1 if none is.
int binomial_rank(int n) {
    double chance = std::ldexp(1.0, -n), sum = 0;
    for (int k = 0; k <= n; ++k) {
        sum += chance;
        if (sum > .025) return k - 1;
        chance *= static_cast<double>(n - k) / (k + 1);
    }
    return n;
}

class Rounds {
  public:
    Rounds(std::span<const RepeatTask> tasks, const RepeatLimits& limits)
        : tasks_(tasks), limits_(limits), seconds_(tasks.size()), times_(tasks.size(), 1) {
        for (std::size_t i = 0; i < tasks_.size(); ++i) {
            const double once = tasks_[i].cost(1);
            if (once < limits_.least_s)
                times_[i] = static_cast<int>(
                    std::min<double>(kMostInOneGo, std::ceil(limits_.least_s / std::max(once, 1e-9))));
        }
    }

    /// Measures every task that is wanted; returns how many are not.
    std::size_t add() {
        const std::vector<bool> wanted = this->wanted();
        for (std::vector<double>& of_task : seconds_) of_task.push_back(kMissing);
        const std::size_t round = seconds_.empty() ? 0 : seconds_[0].size() - 1;
        for (std::size_t k = 0; k < tasks_.size(); ++k) {
            const std::size_t i = round % 2 ? tasks_.size() - 1 - k : k;
            if (wanted[i]) seconds_[i].back() = tasks_[i].cost(times_[i]);
        }
        return static_cast<std::size_t>(std::ranges::count_if(seconds_, [&](const std::vector<double>& of) {
            return is_known(static_cast<std::size_t>(&of - seconds_.data()));
        }));
    }

    Timing timing(std::size_t task) const {
        std::vector<double> seconds, ratios;
        const std::vector<double>&mine = seconds_[task], &base = seconds_[tasks_[task].base];
        for (std::size_t round = 0; round < mine.size(); ++round) {
            if (mine[round] == kMissing) continue;
            seconds.push_back(mine[round]);
            if (base[round] > 0) ratios.push_back(mine[round] / base[round]);
        }
        return {median_of(std::move(seconds)), median_of(std::move(ratios))};
    }

  private:
    bool is_known(std::size_t task) const {
        if (static_cast<int>(std::ranges::count_if(seconds_[task], [](double s) { return s != kMissing; })) <
            limits_.fewest)
            return false;
        const Timing now = timing(task);
        return now.seconds.known_to() <= limits_.known_to &&
               (tasks_[task].base == task || now.ratio.known_to() <= limits_.ratio_known_to);
    }

    std::vector<bool> wanted() const {
        std::vector<bool> wanted(tasks_.size(), false);
        for (std::size_t i = 0; i < tasks_.size(); ++i)
            if (!is_known(i)) wanted[i] = wanted[tasks_[i].base] = true;
        return wanted;
    }

    std::span<const RepeatTask> tasks_;
    const RepeatLimits& limits_;
    std::vector<std::vector<double>> seconds_;  ///< task by round; kMissing where left out
    std::vector<int> times_;
};

}  // namespace

Median median_of(std::vector<double> values) {
    if (values.empty()) return {};
    std::ranges::sort(values);
    Median median;
    median.count = static_cast<int>(values.size());
    median.value = middle(values);
    const int rank = binomial_rank(median.count);
    median.low = rank < 0 ? 0 : values[static_cast<std::size_t>(rank)];
    median.high = rank < 0 ? std::numeric_limits<double>::infinity()
                           : values[values.size() - 1 - static_cast<std::size_t>(rank)];
    if (median.value > 0)
        median.spread = (quantile(values, .75) - quantile(values, .25)) / (2 * median.value);
    return median;
}

std::vector<Timing> repeat_until_known(std::span<const RepeatTask> tasks, const RepeatLimits& limits,
                                       const std::function<double()>& wall_s,
                                       const RepeatProgress& progress) {
    const double start = wall_s();
    Rounds rounds(tasks, limits);
    for (int round = 1; round <= limits.most; ++round) {
        const double gone = wall_s() - start;
        if (round > limits.fewest && gone > limits.budget_s) break;
        const std::size_t known = rounds.add();
        if (progress) progress(round, known, wall_s() - start);
        if (known == tasks.size()) break;
    }
    std::vector<Timing> timings;
    for (std::size_t i = 0; i < tasks.size(); ++i) timings.push_back(rounds.timing(i));
    return timings;
}

}  // namespace pbrbake::verify
