#include "bakers/verify/repeat.hpp"

#include <algorithm>
#include <cmath>

namespace pbrbake::verify {
namespace {

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
        : tasks_(tasks), limits_(limits), measured_(tasks.size()) {
        for (const RepeatTask& task : tasks_) times_.push_back(times_of(task));
    }

    /// Measures every task that isn't known; returns how many are.
    std::size_t add() {
        std::vector<std::size_t> order;
        for (std::size_t i = 0; i < tasks_.size(); ++i)
            if (!is_done(i)) order.push_back(i);
        if (round_++ % 2) std::ranges::reverse(order);
        // Together with those of the same base: a stretch of its own for each.
        std::ranges::stable_sort(order, {}, [&](std::size_t i) { return tasks_[i].base; });
        for (std::size_t k = 0; k < order.size();) {
            std::size_t end = k;
            while (end < order.size() && tasks_[order[end]].base == tasks_[order[k]].base) ++end;
            measure_group(tasks_[order[k]].base, std::span(order).subspan(k, end - k));
            k = end;
        }
        std::size_t known = 0;
        for (std::size_t i = 0; i < tasks_.size(); ++i) known += is_done(i);
        return known;
    }

    Timing timing(std::size_t task) const {
        return {median_of(measured_[task].seconds), median_of(measured_[task].ratios)};
    }

  private:
    struct Measured {
        std::vector<double> seconds, ratios;
    };

    /// How often to repeat a task. Its first runs fill caches and tell too little: one that is short is asked
    /// again with what they tell.
    int times_of(const RepeatTask& task) const {
        double once = task.cost(1);
        int times = 1;
        while (once * times < limits_.least_s && times < kMostInOneGo) {
            const double wanted = std::ceil(limits_.least_s / std::max(once, 1e-9));
            times = static_cast<int>(std::clamp<double>(wanted, times + 1, kMostInOneGo));
            once = task.cost(times);
        }
        return times;
    }

    /// The base before, after, and among the others as often as they have taken as long as it.
    void measure_group(std::size_t base, std::span<const std::size_t> group) {
        double before = measured_base(base), since = 0;
        std::vector<std::pair<std::size_t, double>> stretch;
        const auto close = [&] {
            const double after = measured_base(base);
            for (const auto& [task, seconds] : stretch)
                if (before + after > 0) measured_[task].ratios.push_back(2 * seconds / (before + after));
            stretch.clear();
            before = after;
            since = 0;
        };
        for (const std::size_t task : group) {
            if (task == base) continue;
            const double seconds = tasks_[task].cost(times_[task]);
            measured_[task].seconds.push_back(seconds);
            stretch.emplace_back(task, seconds);
            since += seconds * times_[task];
            if (since >= std::max(kLongestStretch_s, before * times_[base])) close();
        }
        if (!stretch.empty()) close();
    }

    double measured_base(std::size_t base) {
        const double seconds = tasks_[base].cost(times_[base]);
        measured_[base].seconds.push_back(seconds);
        measured_[base].ratios.push_back(1);
        return seconds;
    }

    bool is_done(std::size_t task) const {
        return static_cast<int>(measured_[task].seconds.size()) >= limits_.fewest &&
               is_known(timing(task), limits_);
    }

    /// A base is measured again after that many seconds, or its own if these are more: what a processor's
    /// speed is at 20 ms is much the same 20 ms later, and little so a second later.
    static constexpr double kLongestStretch_s = .02;

    std::span<const RepeatTask> tasks_;
    const RepeatLimits& limits_;
    std::vector<Measured> measured_;  ///< by task
    std::vector<int> times_;
    int round_ = 0;
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

bool is_known(const Timing& timing, const RepeatLimits& limits) {
    return timing.ratio.known_to() <= limits.known_to;
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
