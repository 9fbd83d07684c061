#pragma once
// Adaptive quadrature in one and two dimensions, with an error estimate and a count of evaluations.
//
// Global adaptation: the panel (interval or rectangle) with the largest error is halved until the sum of all
// errors meets the tolerance. A panel is measured by the 15-point Kronrod rule against the 7-point Gauss rule
// inside it (Kronrod 1965; nodes and error scaling as in Piessens et al. 1983, QUADPACK, routine qk15). What
// no panel's nodes see is not found: narrow features need a break point at them.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "pbr/numerics/sum.hpp"

namespace pbr {

/// An integral, what its error is thought to be, and what it cost.
struct Estimate {
    double value = 0;
    double error = 0;  ///< estimate of |value - integral|; not a bound
    std::int64_t evaluations = 0;
    bool converged = false;  ///< false: max_evaluations or rounding stopped it before the tolerance was met
};

/// When to stop: error <= max(absolute, relative |value|), or after max_evaluations (exceeded by two panels
/// at most). Give an absolute one where the integral may be 0 but the integrand is not.
struct QuadratureTolerance {
    double relative = 1e-9;
    double absolute = 0;
    std::int64_t max_evaluations = 4'000'000;
};

namespace kronrod {

constexpr int kPoints = 15;

/// Nodes on [-1, 1], ascending; the odd ones (1, 3, …) are the Gauss nodes.
constexpr std::array<double, kPoints> kNodes = {
    -0.991455371120812639206854697526329, -0.949107912342758524526189684047851,
    -0.864864423359769072789712788640926, -0.741531185599394439863864773280788,
    -0.586087235467691130294144691693013, -0.405845151377397166906606412076961,
    -0.207784955007898467600689403773245, 0,
    0.207784955007898467600689403773245,  0.405845151377397166906606412076961,
    0.586087235467691130294144691693013,  0.741531185599394439863864773280788,
    0.864864423359769072789712788640926,  0.949107912342758524526189684047851,
    0.991455371120812639206854697526329};

constexpr std::array<double, kPoints> kWeights = {
    0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
    0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
    0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
    0.204432940075298892414161999234649, 0.209482141084727828012999174891714,
    0.204432940075298892414161999234649, 0.190350578064785409913256402421014,
    0.169004726639267902826583426598550, 0.140653259715525918745189590510238,
    0.104790010322250183839876322541518, 0.063092092629978553290700663189204,
    0.022935322010529224963732008058970};

/// Weights of the Gauss rule, 0 at the nodes that it lacks.
constexpr std::array<double, kPoints> kGaussWeights = {
    0, 0.129484966168869693270611432679082, 0, 0.279705391489276667901467771423780,
    0, 0.381830050505118944950369775488975, 0, 0.417959183673469387755102040816327,
    0, 0.381830050505118944950369775488975, 0, 0.279705391489276667901467771423780,
    0, 0.129484966168869693270611432679082, 0};

/// QUADPACK's error of a panel from |Kronrod - Gauss|, the integral of |f - mean| (`deviation`) and that of
/// |f|: the difference is the Gauss rule's error, the Kronrod rule's own is far smaller where f is smooth.
inline double panel_error(double difference, double deviation) {
    if (deviation == 0 || difference == 0) return difference;
    return deviation * std::min(1.0, std::pow(200 * difference / deviation, 1.5));
}

/// Rounding leaves a panel no better than this, given its integral of |f|.
inline double rounding_error(double magnitude) {
    return 50 * std::numeric_limits<double>::epsilon() * magnitude;
}

/// A rectangle (an interval has y0 = 0, y1 = 1) with its integral.
struct Panel {
    double x0, x1, y0, y1;
    double value = 0, error = 0;
    bool along_x = true;     ///< the axis to halve
    bool exhausted = false;  ///< its error is rounding: halving gains nothing
    /// Order of the heap: the largest error first, exhausted panels last.
    bool operator<(const Panel& other) const {
        return exhausted != other.exhausted ? exhausted : error < other.error;
    }
};

/// Measures an interval.
template <class F>
void measure_interval(const F& f, Panel& panel) {
    const double centre = (panel.x0 + panel.x1) / 2, half = (panel.x1 - panel.x0) / 2;
    std::array<double, kPoints> values;
    double kronrod = 0, gauss = 0, magnitude = 0, deviation = 0;
    for (int i = 0; i < kPoints; ++i) {
        values[i] = f(centre + half * kNodes[i]);
        kronrod += kWeights[i] * values[i];
        gauss += kGaussWeights[i] * values[i];
        magnitude += kWeights[i] * std::abs(values[i]);
    }
    for (int i = 0; i < kPoints; ++i) deviation += kWeights[i] * std::abs(values[i] - kronrod / 2);
    panel.value = kronrod * half;
    panel.error = panel_error(std::abs(kronrod - gauss) * half, deviation * half);
    panel.exhausted = panel.error <= rounding_error(magnitude * half);
    panel.error = std::max(panel.error, rounding_error(magnitude * half));
}

/// Measures a rectangle; the axis along which the Gauss rule differs more is the one to halve.
template <class F>
void measure_rectangle(const F& f, Panel& panel) {
    const double cx = (panel.x0 + panel.x1) / 2, hx = (panel.x1 - panel.x0) / 2;
    const double cy = (panel.y0 + panel.y1) / 2, hy = (panel.y1 - panel.y0) / 2;
    std::array<double, kPoints * kPoints> values;
    double kronrod = 0, gauss_x = 0, gauss_y = 0, magnitude = 0, deviation = 0;
    for (int i = 0; i < kPoints; ++i) {
        double kronrod_row = 0, gauss_row = 0;
        for (int j = 0; j < kPoints; ++j) {
            const double value = f(cx + hx * kNodes[i], cy + hy * kNodes[j]);
            values[i * kPoints + j] = value;
            kronrod_row += kWeights[j] * value;
            gauss_row += kGaussWeights[j] * value;
            magnitude += kWeights[i] * kWeights[j] * std::abs(value);
        }
        kronrod += kWeights[i] * kronrod_row;
        gauss_x += kGaussWeights[i] * kronrod_row;
        gauss_y += kWeights[i] * gauss_row;
    }
    for (int i = 0; i < kPoints; ++i)
        for (int j = 0; j < kPoints; ++j)
            deviation += kWeights[i] * kWeights[j] * std::abs(values[i * kPoints + j] - kronrod / 4);
    const double area = hx * hy;
    const double error_x = panel_error(std::abs(kronrod - gauss_x) * area, deviation * area);
    const double error_y = panel_error(std::abs(kronrod - gauss_y) * area, deviation * area);
    panel.value = kronrod * area;
    panel.error = error_x + error_y;
    panel.along_x = error_x == error_y ? hx >= hy : error_x > error_y;
    panel.exhausted = panel.error <= rounding_error(magnitude * area);
    panel.error = std::max(panel.error, rounding_error(magnitude * area));
}

/// Halves panels of the heap until the tolerance is met.
template <class Measure>
Estimate refine(std::vector<Panel>& heap, const Measure& measure, std::int64_t cost,
                const QuadratureTolerance& tolerance) {
    std::make_heap(heap.begin(), heap.end());
    Estimate estimate;
    estimate.evaluations = cost * static_cast<std::int64_t>(heap.size());
    const auto totals = [&] {
        CompensatedSum value, error;
        for (const Panel& panel : heap) {
            value += panel.value;
            error += panel.error;
        }
        estimate.value = value.value();
        estimate.error = error.value();
    };
    const auto met = [&] {
        return estimate.error <= std::max(tolerance.absolute, tolerance.relative * std::abs(estimate.value));
    };
    totals();
    while (!heap.empty() && !met() && estimate.evaluations < tolerance.max_evaluations &&
           !heap.front().exhausted) {
        std::pop_heap(heap.begin(), heap.end());
        const Panel parent = heap.back();
        Panel low = parent, high = parent;
        if (parent.along_x)
            low.x1 = high.x0 = (parent.x0 + parent.x1) / 2;
        else
            low.y1 = high.y0 = (parent.y0 + parent.y1) / 2;
        measure(low);
        measure(high);
        estimate.value += low.value + high.value - parent.value;
        estimate.error += low.error + high.error - parent.error;
        estimate.evaluations += 2 * cost;
        heap.back() = low;
        std::push_heap(heap.begin(), heap.end());
        heap.push_back(high);
        std::push_heap(heap.begin(), heap.end());
    }
    totals();  // without the rounding of the running sums
    estimate.converged = met();
    return estimate;
}

}  // namespace kronrod

/// The integral of f(x) over [breaks.front(), breaks.back()]; every value of `breaks` (ascending, at least
/// two) is a panel's end, so kinks and peaks belong there. Nodes are inner points: f is never evaluated at a
/// break. Polynomials up to degree 22 are exact at once. f must be finite at the nodes; end point
/// singularities that are integrable converge.
template <class F>
Estimate integrate_adaptive(const F& f, std::span<const double> breaks,
                            const QuadratureTolerance& tolerance = {}) {
    std::vector<kronrod::Panel> heap;
    const auto measure = [&](kronrod::Panel& panel) { kronrod::measure_interval(f, panel); };
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
        if (!(breaks[i + 1] > breaks[i])) continue;
        heap.push_back({breaks[i], breaks[i + 1], 0, 1});
        measure(heap.back());
    }
    return kronrod::refine(heap, measure, kronrod::kPoints, tolerance);
}

/// The same over [low, high] without inner breaks.
template <class F>
Estimate integrate_adaptive(const F& f, double low, double high, const QuadratureTolerance& tolerance = {}) {
    return integrate_adaptive(f, std::array{low, high}, tolerance);
}

/// The integral of f(x, y) over the rectangle spanned by the first and last of `x_breaks` and `y_breaks`
/// (ascending); lines at all breaks are panels' edges. A panel costs 225 evaluations. Polynomials up to
/// degree 22 in each variable are exact at once. Kinks along curves are the slow case: map the domain so that
/// they fall on edges.
template <class F>
Estimate integrate_adaptive_2d(const F& f, std::span<const double> x_breaks, std::span<const double> y_breaks,
                               const QuadratureTolerance& tolerance = {}) {
    std::vector<kronrod::Panel> heap;
    const auto measure = [&](kronrod::Panel& panel) { kronrod::measure_rectangle(f, panel); };
    for (std::size_t i = 0; i + 1 < x_breaks.size(); ++i)
        for (std::size_t j = 0; j + 1 < y_breaks.size(); ++j) {
            if (!(x_breaks[i + 1] > x_breaks[i] && y_breaks[j + 1] > y_breaks[j])) continue;
            heap.push_back({x_breaks[i], x_breaks[i + 1], y_breaks[j], y_breaks[j + 1]});
            measure(heap.back());
        }
    return kronrod::refine(heap, measure, kronrod::kPoints * kronrod::kPoints, tolerance);
}

}  // namespace pbr
