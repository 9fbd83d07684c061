// E and Fc of anisotropic GGX by product quadrature; lanes hold views, so any vector width gives the same bits.
//
// The parametrisation is dfg_kernel.cpp's, in the space in which the lobe is round: half vectors have slopes
// r (x cos psi, y sin psi) with r = sinh Y and x, y the widths, and density tanh Y / cosh^2 Y over
// (psi/(2 pi), Y). With a(psi) = |(x cos psi, y sin psi)|, psi_0 the azimuth of the stretched view and chi =
// psi - psi_0,
//     VoH/NoH = vz + b r,   b = along sin(v) cos(chi),   (1 + (a r)^2) NoL = vz + 2 b r - vz (a r)^2,
// along being the width that the view sees. The horizon is r_max = (b + sqrt(b^2 + (a vz)^2)) / (a^2 vz).
// Where chi = pi/2 the lobe is a = x y / along = `across` wide; there r_max swings over a width of vz across /
// (sin(v) along), which the same sinh widens. A round lobe is even in chi, others are so only where the view
// lies in a plane of symmetry: both sides are summed.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/simd/dfg_anisotropic_kernel.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <numbers>

#include "pbr/numerics/elementary.hpp"
#include "src/simd/dfg_anisotropic_kernel.hpp"
#include "src/simd/vector_math.hpp"

HWY_BEFORE_NAMESPACE();
namespace pbr {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// What is the same for all views: the widths, and the view's azimuth in the surface and in stretched space.
struct Lobe {
    double x, y;            ///< widths
    double cos_v, sin_v;    ///< the view's azimuth
    double along, across;   ///< ViewWidths
    double cos_0, sin_0;    ///< of psi_0
    double longest;         ///< Y beyond which less than 1e-8 of the lobe is left
    bool is_even;           ///< both sides of the view's plane are alike
};

Lobe lobe_of(const TangentAzimuth& azimuth, const AnisotropicAlpha<double>& alpha) {
    const ViewWidths seen = view_widths(azimuth, alpha);
    return {alpha.x,
            alpha.y,
            azimuth.cos,
            azimuth.sin,
            seen.along,
            seen.across,
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

/// Adds the node r = sinh Y, without its azimuth's weight; q = 1 + (a r)^2 and n = q NoL as in dfg_kernel.cpp.
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
    radius.slope_x =
        hn::Mul(hn::Set(d, lobe.x), hn::Sub(hn::Mul(cos_chi, cos_0), hn::Mul(sin_chi, sin_0)));
    radius.slope_y =
        hn::Mul(hn::Set(d, lobe.y), hn::Add(hn::Mul(sin_chi, cos_0), hn::Mul(cos_chi, sin_0)));
    radius.a2 =
        hn::Add(hn::Mul(radius.slope_x, radius.slope_x), hn::Mul(radius.slope_y, radius.slope_y));
    radius.b = hn::Mul(hn::Mul(vxy, hn::Set(d, lobe.along)), cos_chi);
    return radius;
}

/// A vector of views: E and Fc by the product rule.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Sums<V> integrate(D d, V NoV, const Lobe& lobe, const DfgRule::Band& rule) {
    const V one = hn::Set(d, 1.0);
    const V vz = hn::Min(hn::Max(NoV, hn::Set(d, 1e-10 * lobe.along)), one);  // the horizon is its limit
    const V vxy = hn::Sqrt(hn::Mul(hn::Sub(one, vz), hn::Add(one, vz)));
    const V along_vxy = hn::Mul(hn::Set(d, lobe.along), vxy);
    Radius<V> view{};
    view.vx = hn::Mul(vxy, hn::Set(d, lobe.cos_v));
    view.vy = hn::Mul(vxy, hn::Set(d, lobe.sin_v));
    view.vz = vz;
    view.root_v = hn::Sqrt(hn::Add(hn::Mul(along_vxy, along_vxy), hn::Mul(vz, vz)));
    const V width = hn::Div(hn::Max(along_vxy, hn::Set(d, 1e-3 * lobe.across)), hn::Mul(vz, hn::Set(d, lobe.across)));
    const V sinh_k = hn::Min(hn::Mul(hn::Set(d, std::numbers::pi / 2), width), hn::Set(d, 1e4));
    const V k = asinh(d, sinh_k), inverse_sinh_k = hn::Div(one, sinh_k);
    Sums<V> sums{hn::Zero(d), hn::Zero(d)};
    for (int i = 0; i < rule.azimuth.size(); ++i) {
        const V e = exp(d, hn::Mul(k, hn::Set(d, 2 * rule.azimuth.nodes[i] - 1)));
        const V inverse = hn::Div(one, e);
        // chi = pi/2 (1 + bend)
        const V bend = hn::Mul(hn::Mul(hn::Set(d, 0.5), hn::Sub(e, inverse)), inverse_sinh_k);
        const V cos_chi = hn::Neg(sin_half_pi(d, bend));
        const V sin_chi = sin_half_pi(d, hn::Sub(one, hn::Abs(bend)));
        // As in dfg_kernel.cpp, halved: each side is half of the circle.
        const V weight = hn::Mul(hn::Mul(hn::Set(d, rule.azimuth.weights[i] / 2), hn::Mul(k, inverse_sinh_k)),
                                 hn::Add(e, inverse));
        Sums<V> both =
            radial_sums(d, lobe, radius_at(d, lobe, view, vxy, cos_chi, sin_chi), rule.radial);
        const Sums<V> other =
            lobe.is_even ? both
                         : radial_sums(d, lobe, radius_at(d, lobe, view, vxy, cos_chi, hn::Neg(sin_chi)),
                                       rule.radial);
        both.E = hn::Add(both.E, other.E);
        both.Fc = hn::Add(both.Fc, other.Fc);
        sums.E = hn::Add(sums.E, hn::Mul(weight, both.E));
        sums.Fc = hn::Add(sums.Fc, hn::Mul(weight, both.Fc));
    }
    sums.E = hn::Min(sums.E, one);
    sums.Fc = hn::Min(sums.Fc, sums.E);
    return sums;
}

void anisotropic_row(const double* NoV, std::size_t count, const TangentAzimuth& azimuth,
                     const AnisotropicAlpha<double>& alpha, const DfgRule& rule, double* E,
                     double* Fc) {
    const hn::ScalableTag<double> d;
    const std::size_t lanes = hn::Lanes(d);
    const Lobe lobe = lobe_of(azimuth, alpha);
    double buffer[hn::MaxLanes(d)];
    for (const DfgRule::Band& band : rule.bands) {
        std::size_t view[hn::MaxLanes(d)];
        std::size_t used = 0;
        const auto flush = [&]() HWY_ATTR {
            if (used == 0) return;
            for (std::size_t i = 0; i < lanes; ++i) buffer[i] = NoV[view[i < used ? i : 0]];
            const auto sums = integrate(d, hn::LoadU(d, buffer), lobe, band);
            hn::StoreU(sums.E, d, buffer);
            for (std::size_t i = 0; i < used; ++i) E[view[i]] = buffer[i];
            hn::StoreU(sums.Fc, d, buffer);
            for (std::size_t i = 0; i < used; ++i) Fc[view[i]] = buffer[i];
            used = 0;
        };
        for (std::size_t i = 0; i < count; ++i) {
            if (&rule.band_of(NoV[i]) != &band) continue;
            view[used++] = i;
            if (used == lanes) flush();
        }
        flush();
    }
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
