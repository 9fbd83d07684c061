// E and Fc of a row of views by product quadrature; lanes hold views, so any vector width gives the same
// bits.
//
// Half vectors have slopes s (cos phi, sin phi) with s = alpha sinh y. Their density D NoH is then tanh y /
// cosh^2 y over (phi/pi, y), and
//     E = (2/pi) integral over phi in [0, pi] and y in [0, Y(phi)] of W tanh y / cosh^2 y,
//     W = G2 VoH / (NoV NoH) = 2 (VoH/NoH) NoL / (NoL root(NoV) + NoV root(NoL)),
// where with V = (vx, 0, vz):  VoH/NoH = vz + vx s cos phi,  NoL = (vz + 2 vx s cos phi - vz s^2) / (1 +
// s^2). NoL is positive up to one positive root in closed form, s_max = x + sqrt(x^2 + 1) with x = vx
// cos(phi) / vz: the horizon, where W goes to 0. Panels that end there have nothing but smooth integrands,
// and Gauss-Legendre converges geometrically. s_max swings over a width vz / vx about phi = pi/2; phi =
// (pi/2)(1 + sinh(k t) / sinh k) widens it.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/simd/dfg_kernel.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "pbr/brdf/ggx.hpp"
#include "pbr/numerics/elementary.hpp"
#include "src/simd/dfg_kernel.hpp"
#include "src/simd/vector_math.hpp"

HWY_BEFORE_NAMESPACE();
namespace pbr {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Sums over the radial nodes for a fixed azimuth a lane: y from 0 to `end`, cos phi as given.
template <class D, class V = hn::Vec<D>>
void add_radial(D d, V vz, V vx, V root_v, V cos_phi, V azimuth_weight, double alpha,
                const QuadratureRule& rule, V& E, V& Fc) {
    const V one = hn::Set(d, 1.0), two = hn::Set(d, 2.0), a = hn::Set(d, alpha);
    const V a2 = hn::Set(d, alpha * alpha), one_minus_a2 = hn::Set(d, 1 - alpha * alpha);
    const V b = hn::Mul(vx, cos_phi);
    // s_max, without cancellation for either sign of cos phi.
    const V root = hn::Sqrt(hn::Add(hn::Mul(b, b), hn::Mul(vz, vz)));
    const V s_max =
        hn::IfThenElse(hn::Ge(b, hn::Zero(d)), hn::Div(hn::Add(b, root), vz), hn::Div(vz, hn::Sub(root, b)));
    // Beyond y = ln(2/alpha) + 20 (slopes above e^20) less than 1e-8 of a lobe is left.
    const double longest = log_exact(2 / alpha) + 20;
    const V end = hn::Min(asinh(d, hn::Div(s_max, a)), hn::Set(d, longest));
    for (int j = 0; j < rule.size(); ++j) {
        const V y = hn::Mul(end, hn::Set(d, rule.nodes[j]));
        const SinhCosh<V> hyperbolic = sinh_cosh(d, y);
        const V s = hn::Mul(a, hyperbolic.sinh);
        const V bs = hn::Mul(b, s);
        const V inverse_q = hn::Div(one, hn::Add(one, hn::Mul(s, s)));
        const V voh_over_noh = hn::Add(vz, bs);
        const V NoL = hn::Max(
            hn::Zero(d), hn::Mul(hn::Sub(hn::Add(voh_over_noh, bs), hn::Mul(vz, hn::Mul(s, s))), inverse_q));
        const V root_l = hn::Sqrt(hn::Add(a2, hn::Mul(one_minus_a2, hn::Mul(NoL, NoL))));
        const V weight = hn::Div(hn::Mul(hn::Mul(two, voh_over_noh), NoL),
                                 hn::Add(hn::Mul(NoL, root_v), hn::Mul(vz, root_l)));
        const V cosh3 = hn::Mul(hyperbolic.cosh, hn::Mul(hyperbolic.cosh, hyperbolic.cosh));
        const V density = hn::Div(hyperbolic.sinh, cosh3);
        const V measure = hn::Mul(hn::Mul(azimuth_weight, end), hn::Set(d, rule.weights[j]));
        const V term = hn::Mul(hn::Mul(weight, density), measure);
        const V VoH = hn::Mul(voh_over_noh, hn::Sqrt(inverse_q));
        const V m = hn::Max(hn::Zero(d), hn::Sub(one, VoH));
        const V m2 = hn::Mul(m, m);
        E = hn::Add(E, term);
        Fc = hn::Add(Fc, hn::Mul(term, hn::Mul(hn::Mul(m2, m2), m)));
    }
}

void dfg_row(const double* NoV, std::size_t count, double alpha, const DfgRule& rule, double* E_out,
             double* Fc_out) {
    const hn::ScalableTag<double> d;
    using V = hn::Vec<decltype(d)>;
    const std::size_t lanes = hn::Lanes(d);
    const std::size_t nodes = static_cast<std::size_t>(rule.azimuth.size());
    std::vector<double> cos_phi(nodes * lanes), weight(nodes * lanes), vz(lanes), vx(lanes), root_v(lanes),
        result(lanes);
    for (std::size_t begin = 0; begin < count; begin += lanes) {
        const std::size_t used = std::min(lanes, count - begin);
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            // A view at the horizon is taken as its limit, 1 - E being about .21 NoV / alpha there.
            const double z = std::clamp(NoV[begin + std::min(lane, used - 1)], 1e-10 * alpha, 1.0);
            vz[lane] = z;
            vx[lane] = std::sqrt((1 - z) * (1 + z));
            root_v[lane] = smith_ggx_root(z, alpha);
            // k = asinh(pi/2 / width) for a swing of that width about phi = pi/2.
            // Swings narrower than 1e-4 hold less of E than that times their width: the even rule straddles
            // them.
            const double sinh_k = std::min(std::numbers::pi / 2 * std::max(vx[lane], 1e-3) / z, 1e4);
            const double k = log_exact(sinh_k + std::sqrt(sinh_k * sinh_k + 1));
            for (std::size_t i = 0; i < nodes; ++i) {
                const double t = 2 * rule.azimuth.nodes[i] - 1;
                const double e = exp_exact(k * t);
                const double bend = (e - 1 / e) / 2 / sinh_k;  // phi = pi/2 (1 + bend)
                cos_phi[i * lanes + lane] = -sin_cos_pi(bend / 2).sin;
                // dphi = (pi/2) k cosh(k t) / sinh k dt and dt = 2 dnode, and the 2/pi of E.
                weight[i * lanes + lane] = rule.azimuth.weights[i] * k * (e + 1 / e) / sinh_k;
            }
        }
        V E = hn::Zero(d), Fc = hn::Zero(d);
        for (std::size_t i = 0; i < nodes; ++i)
            add_radial(d, hn::LoadU(d, vz.data()), hn::LoadU(d, vx.data()), hn::LoadU(d, root_v.data()),
                       hn::LoadU(d, &cos_phi[i * lanes]), hn::LoadU(d, &weight[i * lanes]), alpha,
                       rule.radial, E, Fc);
        hn::StoreU(hn::Min(E, hn::Set(d, 1.0)), d, result.data());
        std::copy_n(result.begin(), used, E_out + begin);
        hn::StoreU(hn::Min(hn::Min(Fc, E), hn::Set(d, 1.0)), d, result.data());
        std::copy_n(result.begin(), used, Fc_out + begin);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace pbr
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pbr {

HWY_EXPORT(dfg_row);

void dfg_quadrature_row(std::span<const double> NoV, double alpha, const DfgRule& rule, std::span<double> E,
                        std::span<double> Fc) {
    HWY_DYNAMIC_DISPATCH(dfg_row)(NoV.data(), NoV.size(), alpha, rule, E.data(), Fc.data());
}

}  // namespace pbr
#endif
