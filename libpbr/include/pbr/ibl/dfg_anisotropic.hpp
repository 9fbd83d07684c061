#pragma once
// Directional albedo of anisotropic GGX: dfg.hpp's integrals with two widths, and their reduction to three
// numbers.
//
// E and Fc depend on NoV, the view's azimuth and two widths. What a view sees of a stretched lobe is most of
// all how wide it is along the view's own azimuth, which is all that masking knows (Heitz 2014, 5.3), and
// then across it. A lobe whose axes lie along and across the view and that has these widths stands for it,
// which leaves (NoV, along, across), three numbers; the shear between the two is what is lost.

#include <cmath>
#include <span>

#include "pbr/brdf/ggx_anisotropic.hpp"
#include "pbr/ibl/dfg.hpp"

namespace pbr {

/// The azimuth of a view about the normal, from the tangent; cos^2 + sin^2 = 1. Along the tangent unless set.
struct TangentAzimuth {
    double cos = 1;
    double sin = 0;
};

/// The widths of a lobe's slopes along and across a view's azimuth.
struct ViewWidths {
    double along;
    double across;
};

/// along = sqrt(x^2 cos^2 + y^2 sin^2), which is all that Smith's masking of the view knows (Heitz 2014, eq.
/// 80), and across = sqrt(x^2 sin^2 + y^2 cos^2). alpha positive. Relative error below 4 ulp.
inline ViewWidths view_widths(const TangentAzimuth& azimuth, const AnisotropicAlpha<double>& alpha) {
    const auto width = [&](double x, double y) { return std::sqrt(x * x + y * y); };
    return {width(alpha.x * azimuth.cos, alpha.y * azimuth.sin),
            width(alpha.x * azimuth.sin, alpha.y * azimuth.cos)};
}

/// The cheapest rule whose error is at most `max_error`, for widths in [1e-6, 3.2] whose ratio is at most 10,
/// as in Burley's convention; below 1e-7 the one of 1e-7. max_error > 0.
DfgRule dfg_anisotropic_rule(double max_error);

/// E and Fc of many views at one azimuth, height-correlated Smith. NoV in [0, 1], alpha positive, the spans
/// of equal sizes. Error as dfg_anisotropic_rule() says; with equal widths that of dfg_ggx_row and less, any
/// azimuth. Swapping the widths is turning the view by a quarter. Vectorised over views, each view's bits the
/// same in any row.
void dfg_ggx_anisotropic_row(std::span<const double> NoV, const TangentAzimuth& azimuth,
                             const AnisotropicAlpha<double>& alpha, const DfgRule& rule, std::span<double> E,
                             std::span<double> Fc);

/// E and Fc of one view.
DirectionalAlbedo dfg_ggx_anisotropic(double NoV, const TangentAzimuth& azimuth,
                                      const AnisotropicAlpha<double>& alpha, const DfgRule& rule);

}  // namespace pbr
