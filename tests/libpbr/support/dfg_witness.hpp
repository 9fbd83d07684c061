#pragma once
// The DFG integrals a second time, over directions of light in place of half vectors, in any real type:
// shares neither a parametrisation nor a line with libpbr's.
//
// Let l and v be the polar angles of light and view, s = (l + v)/2, d = (l - v)/2. With phi the light's
// azimuth from the mirror direction, |L + V|^2 sin^2(angle between half vector and normal) and the like are
//     T = P + Q sin^2(phi/2),    P = 4 cos^2 s (sin^2 d + alpha^2 cos^2 d),  Q = 4 sin l sin v,
//     D = alpha^2/pi (1 + k/T)^2,  k = (1 - alpha^2) 4 cos^2 s cos^2 d,      VoH = sqrt(T + k) / 2,
// and P + Q = 4 cos^2 d (sin^2 s + alpha^2 cos^2 s): nothing cancels. V depends on l alone, so E's integral
// over phi is closed. Fc's becomes smooth with tan(phi/2) = sqrt(P / (P+Q)) sinh w. Over l, tan d =
// alpha sinh y spreads the lobe out.

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "pbr/ibl/dfg.hpp"

namespace pbr {

template <class Real>
struct AlbedoWitness {
    Real E, Fc;
};

/// E and Fc of NoV in [0, 1], alpha in (0, 1]. Points: of the Gauss rule on each panel.
template <class Real, int kPoints = 30>
AlbedoWitness<Real> dfg_witness(Real NoV, Real alpha, DfgVisibility visibility) {
    using Rule = boost::math::quadrature::gauss<Real, kPoints>;
    const Real pi = std::numbers::pi_v<Real>, a2 = alpha * alpha;
    const Real v = std::acos(NoV);
    const auto root = [&](Real c) { return std::sqrt(a2 + (1 - a2) * c * c); };
    const Real root_v = root(NoV);
    struct Ring {
        Real P, P_plus_Q, k, weight;  ///< weight: V NoL sin l dl/dy
    };
    const auto ring_at = [&](Real y) {
        const Real slope = alpha * std::sinh(y), d = std::atan(slope), l = v + 2 * d, s = v + d;
        const Real NoL = std::cos(l), sin_l = std::sin(l);
        const Real cos_s = std::cos(s), sin_s = std::sin(s), cos_d = 1 / std::hypot(Real(1), slope),
                   sin_d = slope * cos_d;
        const Real P = 4 * cos_s * cos_s * (sin_d * sin_d + a2 * cos_d * cos_d);
        const Real P_plus_Q = 4 * cos_d * cos_d * (sin_s * sin_s + a2 * cos_s * cos_s);
        const Real k = (1 - a2) * 4 * cos_s * cos_s * cos_d * cos_d;
        const Real shadowed = visibility == DfgVisibility::correlated
                                  ? NoL / (2 * (NoL * root_v + NoV * root(NoL)))
                                  : NoL / ((NoL + root(NoL)) * (NoV + root_v));
        const Real dl = 2 * alpha * std::cosh(y) * cos_d * cos_d;
        return Ring{P, P_plus_Q, k, std::max(Real(0), shadowed) * sin_l * dl};
    };
    const auto E_at = [&](Real y) {
        const Ring r = ring_at(y);
        const Real R = std::sqrt(r.P * r.P_plus_Q);
        return r.weight * 2 * a2 * (1 + 2 * r.k / R + r.k / R * (r.k / R) * ((r.P + r.P_plus_Q) / (2 * R)));
    };
    const auto Fc_at = [&](Real y) {
        const Ring r = ring_at(y);
        const auto at = [&](Real sin2) {  // of phi/2
            const Real T = r.P + (r.P_plus_Q - r.P) * sin2, q = 1 + r.k / T;
            return q * q * std::pow(std::max(Real(0), 1 - std::sqrt(T + r.k) / 2), 5);
        };
        // The near half: tan(phi/2) = width sinh w, dphi = 2 width cosh w / (1 + tan^2) dw.
        const Real width = std::sqrt(r.P / r.P_plus_Q), far = std::asinh(1 / width);
        const auto near_at = [&](Real w) {
            const Real t = width * std::sinh(w), t2 = t * t;
            return 2 * width * std::cosh(w) / (1 + t2) * at(t2 / (1 + t2));
        };
        const auto far_at = [&](Real phi) { return at(std::pow(std::sin(phi / 2), 2)); };
        Real sum = Rule::integrate(far_at, pi / 2, pi);
        const std::array ends{Real(0), std::min(far, Real(2)), std::max(std::min(far, Real(2)), far / 2),
                              far};
        for (int i = 0; i < 3; ++i) sum += Rule::integrate(near_at, ends[i], ends[i + 1]);
        return r.weight * a2 / pi * 2 * sum;
    };
    // Panels end where the light is at the normal, about alpha from it, at and about the mirror direction, at
    // the horizon, and between the two in powers: masking bends where NoL is about NoV or alpha.
    const auto y_of = [&](Real l) { return std::asinh(std::tan((l - v) / 2) / alpha); };
    const Real first = y_of(0), last = y_of(pi / 2);
    std::vector<Real> ends{first, last, y_of(alpha), y_of(8 * alpha)};
    for (const int y : {-10, -6, -2, 0, 2, 6, 10}) ends.push_back(static_cast<Real>(y));
    for (Real NoL = std::max(NoV, Real(1e-10)); NoL < 1; NoL *= 6) ends.push_back(y_of(std::acos(NoL)));
    for (Real& end : ends) end = std::clamp(end, first, last);
    std::sort(ends.begin(), ends.end());
    AlbedoWitness<Real> sum{0, 0};
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        if (!(ends[i + 1] - ends[i] > Real(1e-12))) continue;
        sum.E += Rule::integrate(E_at, ends[i], ends[i + 1]);
        sum.Fc += Rule::integrate(Fc_at, ends[i], ends[i + 1]);
    }
    return sum;
}

}  // namespace pbr
