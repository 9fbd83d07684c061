#pragma once
// Exponents of Phong and Blinn-Phong lobes to the alpha of GGX, and back. T is float or double.
//
// A fit is a choice of what the two lobes share. Each is a factor on sqrt(2 / (n + 2)), found where lobes are
// narrow (n >> 1, sin = angle) and kept everywhere.

#include <algorithm>
#include <cmath>
#include <limits>

namespace pbr {

/// What a Blinn-Phong lobe and the GGX lobe that replaces it have in common.
enum class LobeFit {
    slope,  ///< the height of the distribution's peak, and Beckmann's slope variance (Walter 2007, sec. 5.2)
    l2,     ///< least squares of the distributions over the solid angle
    cumulative,  ///< least squares, over the angle, of the share of facets within it
    half_width,  ///< the angle at which the distribution is half as high
};

/// The factor of a fit: 1; .92480, which minimises 1 / (3 s) + 2 s e^s E1(s) at its square; .70; sqrt(ln 2 /
/// (sqrt 2 - 1)) = 1.29361. Error of the constants below 1e-5 (cumulative: 5e-3).
constexpr double alpha_factor(LobeFit fit) {
    switch (fit) {
        case LobeFit::slope:
            return 1;
        case LobeFit::l2:
            return .92480;
        case LobeFit::cumulative:
            return .70;
        case LobeFit::half_width:
            return 1.29361;
    }
    return 1;
}

/// alpha of GGX for a Blinn-Phong exponent n: factor sqrt(2 / (n + 2)), at most 1 (Walter et al. 2007,
/// "Microfacet models for refraction", 5.2). n > 0; what is no exponent (n <= 0, NaN) is the widest lobe
/// there is, alpha 1, and n = +Inf a mirror, 0. Relative error below 4 ulp.
template <class T>
T alpha_from_blinn_phong(T n, LobeFit fit = LobeFit::slope) {
    if (!(n > T(0))) return T(1);
    return std::min(T(1), static_cast<T>(alpha_factor(fit)) * std::sqrt(T(2) / (n + T(2))));
}

/// The exponent of alpha_from_blinn_phong, 2 (factor / alpha)^2 - 2, at least 0. alpha in [0, 1]; 0 gives
/// +Inf, and so do alphas whose square underflows. Relative error below 8 ulp where n > 1.
template <class T>
T blinn_phong_from_alpha(T alpha, LobeFit fit = LobeFit::slope) {
    const T ratio = static_cast<T>(alpha_factor(fit)) / alpha;
    return std::max(T(0), T(2) * ratio * ratio - T(2));
}

/// The Blinn-Phong exponent whose lobe is as wide as Phong's cos^n about the mirror direction: 4 n, since the
/// half vector turns by half the angle and 1 - cos goes with its square. Exact in the limit of narrow lobes.
template <class T>
constexpr T blinn_phong_from_phong(T n) {
    return T(4) * n;
}

/// alpha for a Phong exponent: alpha_from_blinn_phong of 4 n, with its domain and edge values.
template <class T>
T alpha_from_phong(T n, LobeFit fit = LobeFit::slope) {
    return alpha_from_blinn_phong(blinn_phong_from_phong(n), fit);
}

}  // namespace pbr
