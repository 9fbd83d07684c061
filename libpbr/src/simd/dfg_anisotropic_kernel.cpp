// E and Fc of anisotropic GGX by product quadrature; lanes hold views, so any vector width gives the same
// bits.
//
// The parametrisation is dfg_kernel.cpp's, in the space in which the lobe is round: half vectors have slopes
// r (x cos psi, y sin psi) with r = sinh Y and x, y the widths, and density tanh Y / cosh^2 Y over
// (psi/(2 pi), Y). With a(psi) = |(x cos psi, y sin psi)|, psi_0 the azimuth of the stretched view and chi =
// psi - psi_0,
//     VoH/NoH = vz + b r,   b = along sin(v) cos(chi),   (1 + (a r)^2) NoL = vz + 2 b r - vz (a r)^2,
// along being the width that the view sees. The horizon is r_max = (b + sqrt(b^2 + (a vz)^2)) / (a^2 vz).
// Where chi = pi/2 the lobe is a = x y / along wide; there r_max swings over a width of vz (x y / along) /
// (sin(v) along). Where the lobe is narrow a(psi) turns over the ratio of the widths. Panels end at both, and
// a sinh spreads each half panel out from its end. A lobe is even in chi where it is round or the view lies
// in a plane of symmetry; else both sides are summed.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/simd/dfg_anisotropic_kernel.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pbr/numerics/elementary.hpp"
#include "src/simd/dfg_anisotropic_kernel.hpp"
#include "src/simd/dfg_bands.hpp"
#include "src/simd/vector_math.hpp"

HWY_BEFORE_NAMESPACE();
namespace pbr {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// What is the same for all views: the widths, and the view's azimuth in the surface and in stretched space.
struct Lobe {
    double x, y;          ///< widths
    double cos_v, sin_v;  ///< the view's azimuth
    double along;         ///< the width that the view sees
    double across;        ///< x y / along
    double cos_0, sin_0;  ///< of psi_0
    double longest;       ///< Y beyond which less than 1e-8 of the lobe is left
    bool is_even;         ///< both sides of the view's plane are alike
};

Lobe lobe_of(const TangentAzimuth& azimuth, const AnisotropicAlpha<double>& alpha) {
    const ViewWidths seen = view_widths(azimuth, alpha);
    return {alpha.x,
            alpha.y,
            azimuth.cos,
            azimuth.sin,
            seen.along,
            alpha.x * alpha.y / seen.along,
            alpha.x * azimuth.cos / seen.along,
            alpha.y * azimuth.sin / seen.along,
            log_exact(2 / std::min(alpha.x, alpha.y)) + 20,
            azimuth.cos == 0 || azimuth.sin == 0 || alpha.x == alpha.y};
}

/// What the integrand holds constant along a radius.
template <class V>
struct Radius {
    V vx, vy, vz, root_v;
    V b, a2;
    V slope_x, slope_y;  ///< of the half vector at r = 1
};

template <class V>
struct Sums {
    V E, Fc;
};

/// Adds the node r = sinh Y, without its azimuth's weight; q = 1 + (a r)^2 and n = q NoL as in
/// dfg_kernel.cpp.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void add_node(D d, const Lobe& lobe, const Radius<V>& radius, V r, V cosh, double weight,
                         Sums<V>& sums) {
    const V one = hn::Set(d, 1.0);
    const V br = hn::Mul(radius.b, r), s2 = hn::Mul(radius.a2, hn::Mul(r, r));
    const V q = hn::Add(one, s2);
    const V voh_over_noh = hn::Add(radius.vz, br);
    const V n = hn::Max(hn::Zero(d), hn::Sub(hn::Add(voh_over_noh, br), hn::Mul(radius.vz, s2)));
    const V twice = hn::Mul(hn::Set(d, 2.0), hn::Mul(voh_over_noh, r));
    const V lx = hn::Mul(hn::Set(d, lobe.x), hn::Sub(hn::Mul(twice, radius.slope_x), hn::Mul(q, radius.vx)));
    const V ly = hn::Mul(hn::Set(d, lobe.y), hn::Sub(hn::Mul(twice, radius.slope_y), hn::Mul(q, radius.vy)));
    const V root_l = hn::Sqrt(hn::Add(hn::Add(hn::Mul(lx, lx), hn::Mul(ly, ly)), hn::Mul(n, n)));
    const V smith = hn::Add(hn::Mul(n, radius.root_v), hn::Mul(radius.vz, root_l));
    const V denominator = hn::Mul(smith, hn::Mul(cosh, hn::Mul(cosh, cosh)));
    const V root_q = hn::Sqrt(q);
    const V inverse = hn::Div(one, hn::Mul(denominator, root_q));
    const V numerator = hn::Mul(hn::Mul(voh_over_noh, n), hn::Mul(r, hn::Set(d, 2 * weight)));
    const V term = hn::Mul(numerator, hn::Mul(inverse, root_q));
    const V VoH = hn::Mul(voh_over_noh, hn::Mul(inverse, denominator));
    const V m = hn::Max(hn::Zero(d), hn::Sub(one, VoH));
    const V m2 = hn::Mul(m, m);
    sums.E = hn::Add(sums.E, term);
    sums.Fc = hn::Add(sums.Fc, hn::Mul(term, hn::Mul(hn::Mul(m2, m2), m)));
}

/// Sums over Y from 0 to the horizon or lobe.longest.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Sums<V> radial_sums(D d, const Lobe& lobe, const Radius<V>& radius, const QuadratureRule& rule) {
    const V half = hn::Set(d, 0.5), one = hn::Set(d, 1.0);
    const V a2_vz = hn::Mul(radius.a2, radius.vz);
    const V root = hn::Sqrt(hn::Add(hn::Mul(radius.b, radius.b), hn::Mul(a2_vz, radius.vz)));
    // r_max, without cancellation for either sign of b.
    const V r_max = hn::IfThenElse(hn::Ge(radius.b, hn::Zero(d)), hn::Div(hn::Add(radius.b, root), a2_vz),
                                   hn::Div(radius.vz, hn::Sub(root, radius.b)));
    const V end = hn::Min(asinh(d, r_max), hn::Set(d, lobe.longest));
    Sums<V> sums{hn::Zero(d), hn::Zero(d)};
    for (int j = 0; j < rule.size(); ++j) {
        const V Y = hn::Mul(end, hn::Set(d, rule.nodes[j]));
        const V e = exp(d, Y), inverse = hn::Div(one, e);
        add_node(d, lobe, radius, sinh_from_exp(d, Y, e, inverse), hn::Mul(half, hn::Add(e, inverse)),
                 rule.weights[j], sums);
    }
    return {hn::Mul(sums.E, end), hn::Mul(sums.Fc, end)};
}

/// The radius at chi from the view's azimuth, sine of either sign.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Radius<V> radius_at(D d, const Lobe& lobe, Radius<V> radius, V vxy, V cos_chi, V sin_chi) {
    const V cos_0 = hn::Set(d, lobe.cos_0), sin_0 = hn::Set(d, lobe.sin_0);
    radius.slope_x = hn::Mul(hn::Set(d, lobe.x), hn::Sub(hn::Mul(cos_chi, cos_0), hn::Mul(sin_chi, sin_0)));
    radius.slope_y = hn::Mul(hn::Set(d, lobe.y), hn::Add(hn::Mul(sin_chi, cos_0), hn::Mul(cos_chi, sin_0)));
    radius.a2 = hn::Add(hn::Mul(radius.slope_x, radius.slope_x), hn::Mul(radius.slope_y, radius.slope_y));
    radius.b = hn::Mul(hn::Mul(vxy, hn::Set(d, lobe.along)), cos_chi);
    return radius;
}

/// Half of a panel of azimuths on one side of the view, in bends: chi = pi/2 (1 + bend). Nodes crowd towards
/// `anchor`, on the scale of what happens there.
struct HalfPanel {
    double anchor;
    double length;     ///< towards the other end, of either sign
    double near_axis;  ///< distance at which the narrow axis lets a(psi) turn
    double to_swing;   ///< distance of the anchor from the swing of the horizon at bend 0
};

/// Half panels of one side: between the side's ends, the swing and the narrow axis of the lobe, halved.
struct Side {
    HalfPanel panels[6];
    int count = 0;
};

Side side_of(const Lobe& lobe, double sign) {
    // The lobe is narrow at psi = pi/2 or 0; a(psi) has its complex zeros min/max of the widths beside it.
    const double psi_0 = atan2_exact(lobe.sin_0, lobe.cos_0) * (2 / std::numbers::pi);
    const double turns = sign * ((lobe.x < lobe.y ? 0.0 : 1.0) - psi_0) / 2;  // of pi, from the view
    const double axis = 2 * (turns - std::floor(turns)) - 1;
    const double turn = std::min(lobe.x, lobe.y) / std::max(lobe.x, lobe.y) * (2 / std::numbers::pi);
    const double points[] = {-1, std::min(axis, 0.0), std::max(axis, 0.0), 1};
    Side side;
    const auto add = [&](double anchor, double length) {
        const double direct = std::abs(anchor - axis), from_axis = std::min(direct, 2 - direct);
        side.panels[side.count++] = {anchor, length, std::sqrt(turn * turn + from_axis * from_axis),
                                     std::abs(anchor)};
    };
    for (int i = 0; i < 3; ++i) {
        const double half = (points[i + 1] - points[i]) / 2;
        if (half < 1e-12) continue;
        add(points[i], half);
        add(points[i + 1], -half);
    }
    return side;
}

/// The sum over a half panel. `swing` is the scale, in bends, of what happens at bend 0.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Sums<V> panel_sums(D d, const Lobe& lobe, const Radius<V>& view, V vxy, V swing, double sign,
                              const HalfPanel& panel, const DfgRule::Band& rule) {
    const V one = hn::Set(d, 1.0), half = hn::Set(d, 0.5);
    const V from_swing =
        hn::Sqrt(hn::Add(hn::Mul(swing, swing), hn::Set(d, panel.to_swing * panel.to_swing)));
    const V scale = hn::Min(from_swing, hn::Set(d, panel.near_axis));
    const V sinh_k = hn::Div(hn::Set(d, std::abs(panel.length)), scale);
    const V k = asinh(d, sinh_k), inverse_sinh_k = hn::Div(one, sinh_k);
    Sums<V> sums{hn::Zero(d), hn::Zero(d)};
    for (int i = 0; i < rule.azimuth.size(); ++i) {
        const V y = hn::Mul(k, hn::Set(d, rule.azimuth.nodes[i]));
        const V e = exp(d, y), inverse = hn::Div(one, e);
        const V part = hn::Mul(sinh_from_exp(d, y, e, inverse), inverse_sinh_k);
        const V bend = hn::Add(hn::Set(d, panel.anchor), hn::Mul(hn::Set(d, panel.length), part));
        const V cos_chi = hn::Neg(sin_half_pi(d, bend));
        const V sin_chi = hn::Mul(hn::Set(d, sign), sin_half_pi(d, hn::Sub(one, hn::Abs(bend))));
        // dchi / pi
        const V weight = hn::Mul(hn::Mul(hn::Set(d, rule.azimuth.weights[i] * std::abs(panel.length) / 2),
                                         hn::Mul(k, inverse_sinh_k)),
                                 hn::Mul(half, hn::Add(e, inverse)));
        const Sums<V> along =
            radial_sums(d, lobe, radius_at(d, lobe, view, vxy, cos_chi, sin_chi), rule.radial);
        sums.E = hn::Add(sums.E, hn::Mul(weight, along.E));
        sums.Fc = hn::Add(sums.Fc, hn::Mul(weight, along.Fc));
    }
    return sums;
}

/// A vector of views: E and Fc by the product rule.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Sums<V> integrate(D d, V NoV, const Lobe& lobe, const Side& left, const Side& right,
                             const DfgRule::Band& rule) {
    const V one = hn::Set(d, 1.0);
    const V vz = hn::Min(hn::Max(NoV, hn::Set(d, 1e-10 * lobe.along)), one);  // the horizon is its limit
    const V vxy = hn::Sqrt(hn::Mul(hn::Sub(one, vz), hn::Add(one, vz)));
    const V along_vxy = hn::Mul(hn::Set(d, lobe.along), vxy);
    Radius<V> view{};
    view.vx = hn::Mul(vxy, hn::Set(d, lobe.cos_v));
    view.vy = hn::Mul(vxy, hn::Set(d, lobe.sin_v));
    view.vz = vz;
    view.root_v = hn::Sqrt(hn::Add(hn::Mul(along_vxy, along_vxy), hn::Mul(vz, vz)));
    // Swings narrower than 1e-4 hold less of E than that times their width: the even rule straddles them.
    const V swing = hn::Max(hn::Div(hn::Mul(vz, hn::Set(d, lobe.across * 2 / std::numbers::pi)),
                                    hn::Max(along_vxy, hn::Set(d, 1e-3 * lobe.across))),
                            hn::Set(d, 1e-4));
    Sums<V> sums{hn::Zero(d), hn::Zero(d)};
    const auto add = [&](const Side& side, double sign, double sides) HWY_ATTR {
        for (int i = 0; i < side.count; ++i) {
            const Sums<V> panel = panel_sums(d, lobe, view, vxy, swing, sign, side.panels[i], rule);
            sums.E = hn::Add(sums.E, hn::Mul(hn::Set(d, sides), panel.E));
            sums.Fc = hn::Add(sums.Fc, hn::Mul(hn::Set(d, sides), panel.Fc));
        }
    };
    add(left, 1, lobe.is_even ? 2 : 1);
    if (!lobe.is_even) add(right, -1, 1);
    sums.E = hn::Min(sums.E, one);
    sums.Fc = hn::Min(sums.Fc, sums.E);
    return sums;
}

void anisotropic_row(const double* NoV, std::size_t count, const TangentAzimuth& azimuth,
                     const AnisotropicAlpha<double>& alpha, const DfgRule& rule, double* E, double* Fc) {
    const hn::ScalableTag<double> d;
    const Lobe lobe = lobe_of(azimuth, alpha);
    const Side left = side_of(lobe, 1), right = side_of(lobe, -1);
    integrate_by_bands(NoV, count, rule, E, Fc, [&](auto views, const DfgRule::Band& band) HWY_ATTR {
        return integrate(d, views, lobe, left, right, band);
    });
}

}  // namespace HWY_NAMESPACE
}  // namespace pbr
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pbr {

HWY_EXPORT(anisotropic_row);

void dfg_anisotropic_quadrature_row(std::span<const double> NoV, const TangentAzimuth& azimuth,
                                    const AnisotropicAlpha<double>& alpha, const DfgRule& rule,
                                    std::span<double> E, std::span<double> Fc) {
    HWY_DYNAMIC_DISPATCH(anisotropic_row)
    (NoV.data(), NoV.size(), azimuth, alpha, rule, E.data(), Fc.data());
}

}  // namespace pbr
#endif
