#include "bakers/dfg/layout.hpp"

#include <algorithm>
#include <cmath>

#include "bakers/dfg/targets.hpp"
#include "bakers/dfg/terms.hpp"
#include "pbr/brdf/roughness.hpp"

namespace pbrbake::dfg {
namespace {

/// Coordinate in [0, 1] of texel i of n. A single texel lies in the middle, whatever the alignment.
double coordinate(Align align, int i, int n) {
    return align == Align::ends && n > 1 ? static_cast<double>(i) / (n - 1) : (i + 0.5) / n;
}

double texel(Align align, double coordinate, int n) {
    return align == Align::ends && n > 1 ? coordinate * (n - 1) : coordinate * n - 0.5;
}

bool is_over_curvature(const DfgParams& params) { return is_over_curvature(params.terms.front()); }

template <class E>
void settle(E& value, E fallback) {
    if (value == E::automatic) value = fallback;
}

}  // namespace

DfgParams settled(DfgParams params) {
    const TargetLayout& target = layout_of(params.target);
    if (params.size == std::vector{0}) params.size = {0, 0};
    if (params.size.front() == 0) params.size.front() = target.width;
    if (params.size.back() == 0) params.size.back() = target.height;
    if (params.terms.empty()) params.terms = target.terms;
    settle(params.disney, target.disney);
    settle(params.cloth, target.cloth);
    settle(params.axis, target.axis);
    settle(params.align, target.align);
    settle(params.form, target.form);
    params.flip_rows = params.flip_rows != target.flip_rows;
    params.target = Target::none;  // settling again changes nothing
    return params;
}

double value_of_column(const DfgParams& params, int x) {
    const double u = coordinate(params.align, x, params.width());
    if (is_over_curvature(params)) return 2 * u - 1;
    return params.axis == Axis::sqrt_nov ? u * u : u;
}

double value_of_row(const DfgParams& params, int y) {
    const int row = params.flip_rows ? params.height() - 1 - y : y;
    const double v = coordinate(params.align, row, params.height());
    const bool by_alpha = params.roughness_axis == RoughnessAxis::alpha && !is_over_curvature(params);
    return by_alpha ? pbr::perceptual_roughness_from_alpha(v) : v;
}

double column_of_value(const DfgParams& params, double across) {
    const double u = is_over_curvature(params)       ? (across + 1) / 2
                     : params.axis == Axis::sqrt_nov ? std::sqrt(across)
                                                     : across;
    return texel(params.align, u, params.width());
}

double row_of_value(const DfgParams& params, double down) {
    const bool by_alpha = params.roughness_axis == RoughnessAxis::alpha && !is_over_curvature(params);
    const double v = by_alpha ? pbr::alpha_from_perceptual_roughness(down) : down;
    const double row = texel(params.align, v, params.height());
    return params.flip_rows ? params.height() - 1 - row : row;
}

Range across(const DfgParams& params) { return {is_over_curvature(params) ? -1.0 : 0.0, 1}; }

Range down(const DfgParams& params) {
    return {is_over_curvature(params) ? 0.0 : params.min_perceptual_roughness, 1};
}

double quadrature_error(const Accuracy& accuracy) {
    if (accuracy.as_sampled) return std::clamp(accuracy.max_error / 100, 1e-8, 1e-6);
    if (accuracy.stated()) return std::max(accuracy.max_error, 1e-8);
    return accuracy.name == "draft" ? 1e-3 : accuracy.name == "reference" ? 1e-8 : 1e-6;
}

}  // namespace pbrbake::dfg
