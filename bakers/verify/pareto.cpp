#include "bakers/verify/pareto.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace pbrbake::verify {
namespace {

constexpr int kFixedCosts = 64;
constexpr double kLeastSpan = 2;
constexpr double kRounding = 1e-9;  // of powers of ten
constexpr std::size_t kFewestPoints = 3, kFewestPointsWithFixedCost = 4;

/// The line through (log(time - fixed), log error), and the sum of squares that it leaves.
struct Line {
    double slope = 0, intercept = 0, residual = std::numeric_limits<double>::infinity();
};

Line fitted_line(std::span<const Cost> points, double fixed) {
    const double n = static_cast<double>(points.size());
    double x = 0, y = 0, xx = 0, xy = 0;
    for (const Cost& point : points) {
        x += std::log(point.time - fixed) / n;
        y += std::log(point.error) / n;
    }
    for (const Cost& point : points) {
        const double dx = std::log(point.time - fixed) - x, dy = std::log(point.error) - y;
        xx += dx * dx;
        xy += dx * dy;
    }
    if (!(xx > 0)) return {};
    Line line{xy / xx, y - xy / xx * x, 0};
    for (const Cost& point : points) {
        const double off = std::log(point.error) - line.intercept - line.slope * std::log(point.time - fixed);
        line.residual += off * off;
    }
    return line;
}

}  // namespace

std::vector<std::size_t> pareto_front(std::span<const Cost> points) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (std::isfinite(points[i].time) && std::isfinite(points[i].error)) order.push_back(i);
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
        if (points[a].time != points[b].time) return points[a].time < points[b].time;
        return points[a].error < points[b].error;
    });
    std::vector<std::size_t> front;
    for (const std::size_t i : order)
        if (front.empty() || points[i].error < points[front.back()].error) front.push_back(i);
    return front;
}

double PowerLaw::error_at(double time) const { return coefficient * std::pow(time - fixed, -exponent); }
double PowerLaw::time_for(double error) const { return fixed + std::pow(error / coefficient, -1 / exponent); }
double PowerLaw::price_of_digit() const { return std::pow(10, 1 / exponent); }

std::optional<PowerLaw> fit_power_law(std::span<const Cost> points, double floor) {
    std::vector<Cost> used;
    for (const std::size_t i : pareto_front(points))
        if (points[i].error > floor && points[i].time > 0) used.push_back(points[i]);
    if (used.size() < kFewestPoints || used.back().time < kLeastSpan * used.front().time) return std::nullopt;
    Line best;
    double fixed = 0;
    const int candidates = used.size() < kFewestPointsWithFixedCost ? 1 : kFixedCosts;
    for (int i = 0; i < candidates; ++i) {
        const double candidate = used.front().time * i / kFixedCosts;
        const Line line = fitted_line(used, candidate);
        if (line.residual >= best.residual) continue;
        best = line;
        fixed = candidate;
    }
    if (!(best.slope < 0)) return std::nullopt;
    const double scatter = std::sqrt(best.residual / static_cast<double>(used.size())) / std::log(10.0);
    return PowerLaw{-best.slope, std::exp(best.intercept), fixed, scatter, static_cast<int>(used.size())};
}

std::vector<Digit> digits_reached(std::span<const Cost> points) {
    const std::vector<std::size_t> front = pareto_front(points);
    double highest = 0, lowest = std::numeric_limits<double>::infinity();
    for (const std::size_t i : front)
        if (points[i].error > 0) {
            highest = std::max(highest, points[i].error);
            lowest = std::min(lowest, points[i].error);
        }
    std::vector<Digit> digits;
    if (highest == 0) return digits;
    const int first = static_cast<int>(std::ceil(std::log10(highest) - kRounding));
    const int last = static_cast<int>(std::ceil(std::log10(lowest) - kRounding));
    for (int power = first; power >= last; --power) {
        const double error = std::pow(10.0, power);
        for (const std::size_t i : front)
            if (points[i].error <= error * (1 + kRounding)) {
                digits.push_back({error, i});
                break;
            }
    }
    return digits;
}

std::optional<std::size_t> knee(std::span<const Cost> front) {
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < front.size(); ++i)
        if (front[i].time > 0 && front[i].error > 0) kept.push_back(i);
    if (kept.size() < kFewestPoints) return std::nullopt;
    const Cost &first = front[kept.front()], &last = front[kept.back()];
    const double width = std::log(last.time / first.time), height = std::log(first.error / last.error);
    if (!(width > 0 && height > 0)) return std::nullopt;
    std::optional<std::size_t> best;
    double farthest = 0;
    for (const std::size_t i : kept) {
        const double x = std::log(front[i].time / first.time) / width;
        const double y = std::log(front[i].error / last.error) / height;
        const double below = 1 - x - y;
        if (below <= farthest) continue;
        farthest = below;
        best = i;
    }
    return best;
}

}  // namespace pbrbake::verify
