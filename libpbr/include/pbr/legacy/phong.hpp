#pragma once
// Blinn-Phong and Phong lobes as BRDFs, and what they reflect. T is float or double.
//
// A legacy lobe is ks N cos^n: cos is NoH (Blinn-Phong) or the cosine between light and mirror direction
// (Phong), N the factor that an engine had, or had not. The BRDF is in 1/sr, and the cosine of the light is
// not in it. Albedos below are of cos^n alone, so multiply by ks N.
//
// Averages over the hemisphere are exact, which is why energy can be kept texel by texel. With the pair of
// directions written as half vector and difference (Rusinkiewicz 1998), d wi d wo = 4 cos_d d wh d wd, and
//
//     K(NoH) = integral of [cos_i cos_o]+ 4 cos_d d wd = 2 pi NoH^3
//
// (the parts with and without a direction below the horizon add up to a single power), so any lobe of NoH
// alone has the cosine-averaged albedo 2 integral f(c) K(c) dc, and cos^n has 4 pi / (n + 4).

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pbr/numerics/elementary.hpp"

namespace pbr {

/// The factor N before ks cos^n.
enum class PhongNorm {
    energy,  ///< 1 / albedo at normal view: ks is what is reflected there
    /// (n + 8) / (8 pi), its usual approximation for Blinn-Phong; (n + 2) / (2 pi), exact, for Phong
    n_plus_8,
    none,     ///< 1: BRDF ks cos^n
    over_pi,  ///< 1 / pi: under the light that makes the diffuse BRDF kd / pi, as in OBJ's illum 2
};

/// Which angle the cosine is of.
enum class PhongLobe { blinn, mirror };

/// Albedo at normal view of the Blinn-Phong lobe cos^n, 8 pi (n + 2^(-n/2)) / ((n + 2)(n + 4))
/// (Akenine-Moeller et al., Real-Time Rendering, 4th ed., 9.8.1 has its reciprocal). n >= 0: pi at 0, 1.4966
/// at 10, .44754 at 50, 0 at +Inf. Relative error below 16 ulp.
template <class T>
T blinn_phong_normal_albedo(T n) {
    if (std::isinf(n)) return T(0);
    const T low =  // nothing beside n from there on
        n < T(128) ? static_cast<T>(exp_exact(-static_cast<double>(n) * std::numbers::ln2 / 2)) : T(0);
    return T(8) * std::numbers::pi_v<T> * ((n + low) / (n + T(2))) / (n + T(4));
}

/// Cosine-weighted mean over views of the albedo of the Blinn-Phong lobe cos^n: 4 pi / (n + 4), see above.
/// n >= 0: pi at 0, 0 at +Inf. For narrow lobes half the albedo at normal view: towards grazing view the lobe
/// goes like the cosine squared. Relative error below 4 ulp.
template <class T>
constexpr T blinn_phong_mean_albedo(T n) {
    return T(4) * std::numbers::pi_v<T> / (n + T(4));
}

/// Albedo at normal view of the Phong lobe, 2 pi / (n + 2). n >= 0. Relative error below 4 ulp.
template <class T>
constexpr T phong_normal_albedo(T n) {
    return T(2) * std::numbers::pi_v<T> / (n + T(2));
}

/// integral of cos^n over [0, pi/2] (Wallis), sqrt(pi) Gamma((n+1)/2) / (2 Gamma(n/2+1)). n >= 0.
/// Relative error below 1e-11 (the asymptotic series from n = 24 on, and W_n = W_(n+2) (n + 2) / (n + 1) down
/// to n).
inline double wallis_integral(double n) {
    double factor = 1;
    for (; n < 24; n += 2) factor *= (n + 2) / (n + 1);
    // Gamma(x + 1/2) / Gamma(x + 1) = x^(-1/2) (1 - 1/(8x) + ...) at x = n/2, in the better variable
    // n + 1/2:
    const double u = 1 / ((n + .5) * (n + .5));
    const double series = 1 + u * (-1. / 16 + u * (21. / 512 + u * (-671. / 8192 + u * (180323. / 524288))));
    return factor * std::sqrt(std::numbers::pi / (2 * (n + .5))) * series;
}

/// Cosine-weighted mean over views of the albedo of the Phong lobe, 4 (pi + W / (n + 2)) / (3 (n + 2)) with W
/// the integral of cos^n: over all normals, the two clamped cosines of directions an angle g apart make (2/3)
/// (sin g + (pi - g) cos g). n >= 0: 5 pi / 6 at 0, 0 at +Inf. Relative error below 1e-11 (double).
template <class T>
T phong_mean_albedo(T n) {
    if (std::isinf(n)) return T(0);
    const T W = static_cast<T>(wallis_integral(static_cast<double>(n)));
    return T(4) * (std::numbers::pi_v<T> + W / (n + T(2))) / (T(3) * (n + T(2)));
}

/// Albedo at normal view of a lobe's cos^n; domain and error as of the two above.
template <class T>
T normal_albedo(PhongLobe lobe, T n) {
    return lobe == PhongLobe::blinn ? blinn_phong_normal_albedo(n) : phong_normal_albedo(n);
}

/// N of a lobe, 1/sr. n >= 0; +Inf for the energy norms at n = +Inf. Relative error below 16 ulp.
template <class T>
T phong_norm(PhongNorm norm, PhongLobe lobe, T n) {
    constexpr T kPi = std::numbers::pi_v<T>;
    switch (norm) {
        case PhongNorm::energy:
            return T(1) / normal_albedo(lobe, n);
        case PhongNorm::n_plus_8:
            return lobe == PhongLobe::blinn ? (n + T(8)) / (T(8) * kPi) : (n + T(2)) / (T(2) * kPi);
        case PhongNorm::none:
            return T(1);
        case PhongNorm::over_pi:
            return std::numbers::inv_pi_v<T>;
    }
    return T(1);
}

/// What a lobe of ks = 1 reflects: at normal view, and in the cosine-weighted mean over views.
template <class T>
struct PhongAlbedo {
    T normal;
    T mean;
};

/// Both albedos of N cos^n. n >= 0, NaN and negatives as 0; +Inf has the limits: 1 and 1/2 (Blinn) or 2/3
/// (mirror) where N holds energy, else 0. May exceed 1: legacy lobes did. Relative error below 32 ulp
/// (mirror: and 1e-11).
template <class T>
PhongAlbedo<T> phong_albedo(PhongNorm norm, PhongLobe lobe, T n) {
    n = n > T(0) ? n : T(0);
    const bool keeps_energy = norm == PhongNorm::energy || norm == PhongNorm::n_plus_8;
    // Beyond this the limits are exact to a rounding, and n^2 may overflow.
    if (n > T(1e9))
        return keeps_energy ? PhongAlbedo<T>{T(1), lobe == PhongLobe::blinn ? T(.5) : T(2) / T(3)}
                            : PhongAlbedo<T>{T(0), T(0)};
    const T N = phong_norm(norm, lobe, n);
    const T mean = lobe == PhongLobe::blinn ? blinn_phong_mean_albedo(n) : phong_mean_albedo(n);
    return {N * normal_albedo(lobe, n), N * mean};
}

}  // namespace pbr
