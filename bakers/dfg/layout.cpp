#include "bakers/dfg/layout.hpp"

#include <algorithm>
#include <cmath>

#include "bakers/dfg/targets.hpp"
#include "bakers/dfg/terms.hpp"
#include "pbr/brdf/roughness.hpp"

namespace pbrbake::dfg {
namespace {

/// Of a volume, where neither job nor target says; an odd number of slices has one of round lobes.
constexpr int kDefaultSide = 64, kDefaultDepth = 17;
/// (along - across) / (along + across) of the first and last slices, where the widths differ ten times.
constexpr double kMostStretched = 9.0 / 11;

/// Coordinate in [0, 1] of texel i of n. A single texel lies in the middle, whatever the alignment.
double coordinate(Align align, int i, int n) {
    return align == Align::ends && n > 1 ? static_cast<double>(i) / (n - 1) : (i + 0.5) / n;
}

double texel(Align align, double coordinate, int n) {
    return align == Align::ends && n > 1 ? coordinate * (n - 1) : coordinate * n - 0.5;
}

/// The coordinate that a value in [0, 1] has along an axis of its first, second or third root, and the way
/// back.
double root_of(int degree, double value) {
    return degree == 3 ? std::cbrt(value) : degree == 2 ? std::sqrt(value) : value;
}

double power_of(int degree, double coordinate) {
    const double square = coordinate * coordinate;
    return degree == 3 ? square * coordinate : degree == 2 ? square : coordinate;
}

int degree_of(Axis axis) { return axis == Axis::cbrt_nov ? 3 : axis == Axis::sqrt_nov ? 2 : 1; }

bool is_over_curvature(const DfgParams& params) { return is_over_curvature(params.terms.front()); }

template <class E>
void settle(E& value, E fallback) {
    if (value == E::automatic) value = fallback;
}

}  // namespace

DfgParams settled(DfgParams params) {
    const TargetLayout& target = layout_of(params.target);
    if (params.size == std::vector{0}) params.size = {0, 0};
    if (params.terms.empty()) params.terms = target.terms;
    if (is_volume(params)) {
        if (params.size.size() < 2) params.size.push_back(params.size.front());
        if (params.size.size() < 3) params.size.push_back(0);
        if (params.size[2] == 0) params.size[2] = kDefaultDepth;
        if (params.target == Target::none)
            for (int& side : params.size)
                if (side == 0) side = kDefaultSide;
    }
    if (params.size.front() == 0) params.size.front() = target.width;
    if (int& height = params.size.size() > 1 ? params.size[1] : params.size[0]; height == 0)
        height = target.height;
    settle(params.disney, target.disney);
    settle(params.cloth, target.cloth);
    settle(params.axis, target.axis);
    settle(params.roughness_axis, RoughnessAxis::perceptual);
    settle(params.align, target.align);
    settle(params.form, target.form);
    params.flip_rows = params.flip_rows != target.flip_rows;
    params.target = Target::none;  // settling again changes nothing
    return params;
}

double value_of_column(const DfgParams& params, int x) {
    const double u = coordinate(params.align, x, params.width());
    if (is_over_curvature(params)) return 2 * u - 1;
    return power_of(degree_of(params.axis), u);
}

double value_of_row(const DfgParams& params, int y) {
    const int row = params.flip_rows ? params.height() - 1 - y : y;
    const double v = coordinate(params.align, row, params.height());
    if (is_over_curvature(params)) return v;
    const double most = is_volume(params) ? kRoughestAlong : 1;
    if (params.roughness_axis == RoughnessAxis::alpha) return most * pbr::perceptual_roughness_from_alpha(v);
    return most * (params.roughness_axis == RoughnessAxis::sqrt_perceptual ? power_of(2, v) : v);
}

double value_of_slice(const DfgParams& params, int z) {
    if (!is_volume(params)) return 1;
    const double stretched = (2 * coordinate(params.align, z, params.depth()) - 1) * kMostStretched;
    return (1 - stretched) / (1 + stretched);
}

double slice_of_value(const DfgParams& params, double stretch) {
    if (!is_volume(params)) return 0;
    const double stretched = (1 - stretch) / (1 + stretch);
    return texel(params.align, (stretched / kMostStretched + 1) / 2, params.depth());
}

double column_of_value(const DfgParams& params, double across) {
    const double u = is_over_curvature(params) ? (across + 1) / 2 : root_of(degree_of(params.axis), across);
    return texel(params.align, u, params.width());
}

double row_of_value(const DfgParams& params, double down) {
    if (is_volume(params)) down /= kRoughestAlong;
    double v = down;
    if (!is_over_curvature(params)) {
        if (params.roughness_axis == RoughnessAxis::alpha) v = pbr::alpha_from_perceptual_roughness(down);
        if (params.roughness_axis == RoughnessAxis::sqrt_perceptual) v = root_of(2, down);
    }
    const double row = texel(params.align, v, params.height());
    return params.flip_rows ? params.height() - 1 - row : row;
}

Range across(const DfgParams& params) { return {is_over_curvature(params) ? -1.0 : 0.0, 1}; }

Range down(const DfgParams& params) {
    return {is_over_curvature(params) ? 0.0 : params.min_perceptual_roughness,
            is_volume(params) ? kRoughestAlong : 1};
}

Range deep(const DfgParams& params) {
    if (!is_volume(params)) return {1, 1};
    return {(1 - kMostStretched) / (1 + kMostStretched), (1 + kMostStretched) / (1 - kMostStretched)};
}

Json layout_json(const DfgParams& params) {
    Json terms = Json::array();
    for (const Term term : params.terms) terms.push_back(enum_name(term));
    Json size{params.width(), params.height()};
    if (is_volume(params)) size.push_back(params.depth());
    return {{"size", size},
            {"terms", terms},
            {"axis", enum_name(params.axis)},
            {"roughness_axis", enum_name(params.roughness_axis)},
            {"align", enum_name(params.align)},
            {"form", enum_name(params.form)},
            {"flip_rows", params.flip_rows}};
}

DfgParams as_baked(const DfgParams& asked, const Product& product) {
    using params_detail::read_value;
    DfgParams params = settled(asked);
    const Json& layout = product.properties.at("layout");
    params.size = read_value<std::vector<int>>(layout.at("size"));
    params.axis = read_value<Axis>(layout.at("axis"));
    params.roughness_axis = read_value<RoughnessAxis>(layout.at("roughness_axis"));
    return params;
}

double quadrature_error(const Accuracy& accuracy) {
    if (accuracy.as_sampled) return std::clamp(accuracy.max_error / 100, 1e-8, 1e-6);
    if (accuracy.stated()) return std::max(accuracy.max_error, 1e-8);
    return accuracy.name == "draft" ? 1e-3 : accuracy.name == "reference" ? 1e-8 : 1e-6;
}

}  // namespace pbrbake::dfg
