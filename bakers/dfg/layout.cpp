#include "bakers/dfg/layout.hpp"

#include <algorithm>
#include <cmath>

#include "pbr/brdf/disney_diffuse.hpp"
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

}  // namespace

double nov_of_column(const DfgParams& params, int x) {
    const double u = coordinate(params.align, x, params.width());
    return params.axis == Axis::sqrt_nov ? u * u : u;
}

double perceptual_roughness_of_row(const DfgParams& params, int y) {
    const int row = params.flip_rows ? params.height() - 1 - y : y;
    const double v = coordinate(params.align, row, params.height());
    return params.roughness_axis == RoughnessAxis::alpha ? pbr::perceptual_roughness_from_alpha(v) : v;
}

double column_of_nov(const DfgParams& params, double NoV) {
    return texel(params.align, params.axis == Axis::sqrt_nov ? std::sqrt(NoV) : NoV, params.width());
}

double row_of_perceptual_roughness(const DfgParams& params, double perceptual_roughness) {
    const bool by_alpha = params.roughness_axis == RoughnessAxis::alpha;
    const double v =
        by_alpha ? pbr::alpha_from_perceptual_roughness(perceptual_roughness) : perceptual_roughness;
    const double row = texel(params.align, v, params.height());
    return params.flip_rows ? params.height() - 1 - row : row;
}

bool has_term(const DfgParams& params, Term term) {
    return std::find(params.terms.begin(), params.terms.end(), term) != params.terms.end();
}

int column_count(const DfgParams& params) {
    int count = 0;
    for (const Term term : params.terms) count += term == Term::ggx ? 2 : 1;
    return count;
}

void write_texel(const DfgParams& params, const pbr::DirectionalAlbedo& ggx, double disney, float* out) {
    for (const Term term : params.terms) {
        if (term == Term::disney_diffuse) {
            *out++ = static_cast<float>(disney);
            continue;
        }
        const bool mix = params.form == Form::mix;
        *out++ = static_cast<float>(mix ? ggx.Fc : ggx.E - ggx.Fc);
        *out++ = static_cast<float>(mix ? ggx.E : ggx.Fc);
    }
}

double disney_albedo(const DfgParams& params, double NoV, double perceptual_roughness) {
    return params.disney == Disney::original ? pbr::albedo_disney_diffuse_original(NoV, perceptual_roughness)
                                             : pbr::albedo_disney_diffuse(NoV, perceptual_roughness);
}

double quadrature_error(const Accuracy& accuracy) {
    if (accuracy.stated()) return std::max(accuracy.max_error, 1e-8);
    return accuracy.name == "draft" ? 1e-3 : accuracy.name == "reference" ? 1e-8 : 1e-6;
}

}  // namespace pbrbake::dfg
