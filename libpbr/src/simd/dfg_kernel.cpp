// E and Fc of a row of views by product quadrature; lanes hold views, so any vector width gives the same
// bits.
//
// Half vectors have slopes s (cos phi, sin phi) with s = alpha sinh y. Their density D NoH is then tanh y /
// cosh^2 y over (phi/pi, y), and
//     E = (2/pi) integral over phi in [0, pi] and y in [0, Y(phi)] of W tanh y / cosh^2 y,
//     W = G2 VoH / (NoV NoH) = 2 (VoH/NoH) NoL / (NoL root(NoV) + NoV root(NoL))   (uncorrelated: the
//         denominator is (NoV + root(NoV)) (NoL + root(NoL)) / 2),
// where with V = (vx, 0, vz):  VoH/NoH = vz + vx s cos phi,  NoL = (vz + 2 vx s cos phi - vz s^2) / (1 +
// s^2). NoL is positive up to one positive root in closed form, s_max = x + sqrt(x^2 + 1) with x = vx
// cos(phi) / vz: the horizon, where W goes to 0. Panels that end there have nothing but smooth integrands,
// and Gauss-Legendre converges geometrically. s_max swings over a width vz / vx about phi = pi/2; phi =
// (pi/2)(1 + sinh(k t) / sinh k) widens it.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/simd/dfg_kernel.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <numbers>

#include "pbr/numerics/elementary.hpp"
#include "src/simd/dfg_bands.hpp"
#include "src/simd/dfg_kernel.hpp"
#include "src/simd/vector_math.hpp"

HWY_BEFORE_NAMESPACE();
namespace pbr {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// What the integrand holds constant along a radius.
template <class V>
struct Radius {
    V vz, b, root_v;  ///< b = vx cos phi
    V alpha, alpha2, one_minus_alpha2;
};

template <class V>
struct Sums {
    V E, Fc;
};

/// Adds a node of slope alpha sinh y, without its azimuth's weight. One division: with q = 1 + s^2 and n = q
/// NoL, W is 2 (VoH/NoH) n / (n root(NoV) + NoV sqrt(alpha^2 q^2 + (1 - alpha^2) n^2)), and it shares its
/// denominator with VoH = (VoH/NoH) / sqrt(q).
template <DfgVisibility visibility, class D, class V = hn::Vec<D>>
HWY_INLINE void add_node(D d, const Radius<V>& radius, V sinh, V cosh, double weight, Sums<V>& sums) {
    const V one = hn::Set(d, 1.0);
    const V s = hn::Mul(radius.alpha, sinh), s2 = hn::Mul(s, s), bs = hn::Mul(radius.b, s);
    const V q = hn::Add(one, s2);
    const V voh_over_noh = hn::Add(radius.vz, bs);
    const V n = hn::Max(hn::Zero(d), hn::Sub(hn::Add(voh_over_noh, bs), hn::Mul(radius.vz, s2)));
    const V root_l = hn::Sqrt(
        hn::Add(hn::Mul(radius.alpha2, hn::Mul(q, q)), hn::Mul(radius.one_minus_alpha2, hn::Mul(n, n))));
    const V smith =
        visibility == DfgVisibility::correlated
            ? hn::Add(hn::Mul(n, radius.root_v), hn::Mul(radius.vz, root_l))
            : hn::Mul(hn::Mul(hn::Set(d, 0.5), hn::Add(radius.vz, radius.root_v)), hn::Add(n, root_l));
    const V denominator = hn::Mul(smith, hn::Mul(cosh, hn::Mul(cosh, cosh)));
    const V root_q = hn::Sqrt(q);
    const V inverse = hn::Div(one, hn::Mul(denominator, root_q));
    const V numerator = hn::Mul(hn::Mul(voh_over_noh, n), hn::Mul(sinh, hn::Set(d, 2 * weight)));
    const V term = hn::Mul(numerator, hn::Mul(inverse, root_q));
    const V VoH = hn::Mul(voh_over_noh, hn::Mul(inverse, denominator));
    const V m = hn::Max(hn::Zero(d), hn::Sub(one, VoH));
    const V m2 = hn::Mul(m, m);
    sums.E = hn::Add(sums.E, term);
    sums.Fc = hn::Add(sums.Fc, hn::Mul(term, hn::Mul(hn::Mul(m2, m2), m)));
}

/// Sums over the radial nodes for a fixed azimuth a lane: y from 0 to the horizon or `longest`. Nodes come in
/// pairs x, 1 - x, whose exponentials are each other's reciprocals but for e^end.
template <DfgVisibility visibility, class D, class V = hn::Vec<D>>
HWY_INLINE Sums<V> radial_sums(D d, const Radius<V>& radius, double longest, const QuadratureRule& rule) {
    const V half = hn::Set(d, 0.5), one = hn::Set(d, 1.0);
    // s_max, without cancellation for either sign of cos phi.
    const V root = hn::Sqrt(hn::Add(hn::Mul(radius.b, radius.b), hn::Mul(radius.vz, radius.vz)));
    const V s_max = hn::IfThenElse(hn::Ge(radius.b, hn::Zero(d)), hn::Div(hn::Add(radius.b, root), radius.vz),
                                   hn::Div(radius.vz, hn::Sub(root, radius.b)));
    const V end = hn::Min(asinh(d, hn::Div(s_max, radius.alpha)), hn::Set(d, longest));
    const V e_end = exp(d, end), inverse_e_end = hn::Div(one, e_end);
    Sums<V> sums{hn::Zero(d), hn::Zero(d)};
    const auto add = [&](V y, V e, V inverse, double weight) HWY_ATTR {
        add_node<visibility>(d, radius, sinh_from_exp(d, y, e, inverse), hn::Mul(half, hn::Add(e, inverse)),
                             weight, sums);
    };
    const int count = rule.size();
    for (int j = 0; j < count / 2; ++j) {
        const V y = hn::Mul(end, hn::Set(d, rule.nodes[j]));
        const V e = exp(d, y), inverse = hn::Div(one, e);
        add(y, e, inverse, rule.weights[j]);
        add(hn::Sub(end, y), hn::Mul(e_end, inverse), hn::Mul(inverse_e_end, e), rule.weights[count - 1 - j]);
    }
    if (count % 2 == 1) {
        const V y = hn::Mul(end, half), e = exp(d, y);
        add(y, e, hn::Div(one, e), rule.weights[count / 2]);
    }
    return {hn::Mul(sums.E, end), hn::Mul(sums.Fc, end)};
}

/// A vector of views: E and Fc by the product rule.
template <DfgVisibility visibility, class D, class V = hn::Vec<D>>
HWY_INLINE Sums<V> integrate(D d, V NoV, double alpha, double longest, const DfgRule::Band& rule) {
    const V one = hn::Set(d, 1.0), a2 = hn::Set(d, alpha * alpha);
    // A view at the horizon is taken as its limit, 1 - E being about .21 NoV / alpha there.
    const V vz = hn::Min(hn::Max(NoV, hn::Set(d, 1e-10 * alpha)), one);
    const V vx = hn::Sqrt(hn::Mul(hn::Sub(one, vz), hn::Add(one, vz)));
    Radius<V> radius{vz, vx, vx, hn::Set(d, alpha), a2, hn::Set(d, 1 - alpha * alpha)};
    radius.root_v = hn::Sqrt(hn::Add(a2, hn::Mul(radius.one_minus_alpha2, hn::Mul(vz, vz))));
    // k = asinh(pi/2 / width) for a swing of that width about phi = pi/2. Swings narrower than 1e-4 hold less
    // of E than that times their width: the even rule straddles them.
    const V width = hn::Div(hn::Max(vx, hn::Set(d, 1e-3)), vz);
    const V sinh_k = hn::Min(hn::Mul(hn::Set(d, std::numbers::pi / 2), width), hn::Set(d, 1e4));
    const V k = asinh(d, sinh_k), inverse_sinh_k = hn::Div(one, sinh_k);
    Sums<V> sums{hn::Zero(d), hn::Zero(d)};
    for (int i = 0; i < rule.azimuth.size(); ++i) {
        const V e = exp(d, hn::Mul(k, hn::Set(d, 2 * rule.azimuth.nodes[i] - 1)));
        const V inverse = hn::Div(one, e);
        // phi = pi/2 (1 + bend)
        const V bend = hn::Mul(hn::Mul(hn::Set(d, 0.5), hn::Sub(e, inverse)), inverse_sinh_k);
        radius.b = hn::Neg(hn::Mul(vx, sin_half_pi(d, bend)));
        // dphi = (pi/2) k cosh(k t) / sinh k dt and dt = 2 dnode, and the 2/pi of E.
        const V weight = hn::Mul(hn::Mul(hn::Set(d, rule.azimuth.weights[i]), hn::Mul(k, inverse_sinh_k)),
                                 hn::Add(e, inverse));
        const Sums<V> along = radial_sums<visibility>(d, radius, longest, rule.radial);
        sums.E = hn::Add(sums.E, hn::Mul(weight, along.E));
        sums.Fc = hn::Add(sums.Fc, hn::Mul(weight, along.Fc));
    }
    sums.E = hn::Min(sums.E, one);
    sums.Fc = hn::Min(sums.Fc, sums.E);
    return sums;
}

template <DfgVisibility visibility>
HWY_INLINE void row(const double* NoV, std::size_t count, double alpha, const DfgRule& rule, double* E,
                    double* Fc) {
    const hn::ScalableTag<double> d;
    // Beyond y = ln(2/alpha) + 20 (slopes above e^20) less than 1e-8 of a lobe is left.
    const double longest = log_exact(2 / alpha) + 20;
    integrate_by_bands(NoV, count, rule, E, Fc, [&](auto views, const DfgRule::Band& band) HWY_ATTR {
        return integrate<visibility>(d, views, alpha, longest, band);
    });
}

void dfg_row(const double* NoV, std::size_t count, double alpha, const DfgMethod& method, double* E,
             double* Fc) {
    if (method.visibility == DfgVisibility::correlated)
        row<DfgVisibility::correlated>(NoV, count, alpha, method.rule, E, Fc);
    else
        row<DfgVisibility::uncorrelated>(NoV, count, alpha, method.rule, E, Fc);
}

}  // namespace HWY_NAMESPACE
}  // namespace pbr
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pbr {

HWY_EXPORT(dfg_row);

void dfg_quadrature_row(std::span<const double> NoV, double alpha, const DfgMethod& method,
                        std::span<double> E, std::span<double> Fc) {
    HWY_DYNAMIC_DISPATCH(dfg_row)(NoV.data(), NoV.size(), alpha, method, E.data(), Fc.data());
}

}  // namespace pbr
#endif
