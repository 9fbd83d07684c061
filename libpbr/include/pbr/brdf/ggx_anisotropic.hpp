#pragma once
// GGX stretched along the tangent: distribution, Smith's visibility, and sampling triples. T is float or
// double.
//
// Directions are in the frame of the surface, normal +z, tangent +x, bitangent +y, and point away from it. x
// is the width along the tangent, y along the bitangent; both positive. As in ggx.hpp the specular BRDF is D
// V F, V = G / (4 NoL NoV), and 1/pi lives in D. With x = y, D has the bits of D_ggx and the rest agrees
// within the ulp stated at each.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "pbr/brdf/ggx_sampling.hpp"
#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/sequence.hpp"
#include "pbr/numerics/vector.hpp"

namespace pbr {

/// The widths of GGX along tangent and bitangent.
template <class T>
struct AnisotropicAlpha {
    T x;
    T y;
};

/// Burley's convention, the house's default: aspect = sqrt(1 - .9 anisotropy), x = alpha / aspect, y = alpha
/// aspect (Burley 2012, "Physically-based shading at Disney", 5.4). anisotropy in [0, 1]; 0 gives x = y =
/// alpha exactly. The product stays alpha^2, and with it the peak of D; x may exceed 1 (up to alpha / .316),
/// where GGX is still defined. Relative error below 4 ulp.
template <class T>
AnisotropicAlpha<T> anisotropic_alpha(T alpha, T anisotropy) {
    const T aspect = std::sqrt(T(1) - T(0.9) * anisotropy);
    return {alpha / aspect, alpha * aspect};
}

/// Kulla & Conty's convention, Filament's too: x = alpha (1 + anisotropy), y = alpha (1 - anisotropy) (Kulla
/// & Conty 2017, "Revisiting physically based shading at Imageworks"). anisotropy in (-1, 1), negative along
/// the bitangent; at the ends a width is 0, which no function here takes. Keeps the mean width but not the
/// peak. Relative error below 2 ulp.
template <class T>
AnisotropicAlpha<T> anisotropic_alpha_kulla_conty(T alpha, T anisotropy) {
    return {alpha * (T(1) + anisotropy), alpha * (T(1) - anisotropy)};
}

/// 1 / (pi x y ((wm.x/x)^2 + (wm.y/y)^2 + wm.z^2)^2), 1/sr (Burley 2012, eq. 13). wm a unit vector, wm.z in
/// [0, 1]. Largest value 1 / (pi x y), at the normal. Relative error below 12 ulp for x y as
/// alpha^2 in D_ggx; for x = y its bits.
template <class T>
T D_ggx_anisotropic(const Vec3<T>& wm, const AnisotropicAlpha<T>& alpha) {
    // Multiplied through by x y, so that only their ratio is divided by and x = y leaves D_ggx.
    const T product = alpha.x * alpha.y, ratio = alpha.y / alpha.x;
    const T denominator = (wm.x * wm.x * ratio + wm.y * wm.y / ratio) + product * wm.z * wm.z;
    return (alpha.x / denominator) * (alpha.y / denominator) / std::numbers::pi_v<T>;
}

/// sqrt(x^2 w.x^2 + y^2 w.y^2 + w.z^2) = w.z (1 + 2 Lambda(w)) (Heitz 2014, eq. 86-87), Smith's Lambda
/// without its pole at grazing angles. w a unit vector. Relative error below 4 ulp; for x = y = alpha within
/// 4 ulp of smith_ggx_root as far as w has length 1.
template <class T>
T smith_ggx_root_anisotropic(const Vec3<T>& w, const AnisotropicAlpha<T>& alpha) {
    return glm::length(Vec3<T>(alpha.x * w.x, alpha.y * w.y, w.z));
}

/// Height-correlated Smith visibility (Heitz 2014, eq. 99). wo.z, wi.z in [0, 1]; both 0: +Inf; one 0:
/// finite. Relative error below 8 ulp.
template <class T>
T V_smith_ggx_anisotropic_correlated(const Vec3<T>& wo, const Vec3<T>& wi, const AnisotropicAlpha<T>& alpha) {
    return T(0.5) /
           (wi.z * smith_ggx_root_anisotropic(wo, alpha) + wo.z * smith_ggx_root_anisotropic(wi, alpha));
}

/// Uncorrelated (separable) Smith visibility (Walter et al. 2007, eq. 23). Never above the correlated one.
/// wo.z, wi.z in [0, 1]; finite everywhere. Relative error below 8 ulp.
template <class T>
T V_smith_ggx_anisotropic_uncorrelated(const Vec3<T>& wo, const Vec3<T>& wi,
                                       const AnisotropicAlpha<T>& alpha) {
    return T(1) /
           ((wi.z + smith_ggx_root_anisotropic(wi, alpha)) * (wo.z + smith_ggx_root_anisotropic(wo, alpha)));
}

/// A half vector with density D wm.z: a circle of slopes stretched by (x, y) (Burley 2012, eq. 14). u1, u2 in
/// [0, 1); u1 = 0 is the normal. A unit vector within 4 ulp, z > 0.
template <class T>
Vec3<T> sample_ggx_anisotropic_ndf(const AnisotropicAlpha<T>& alpha, T u1, T u2) {
    const SinCos azimuth = sin_cos_pi(2 * static_cast<double>(u2));
    const T radius = std::sqrt(u1), height = std::sqrt(T(1) - u1);
    return glm::normalize(Vec3<T>(alpha.x * radius * static_cast<T>(azimuth.cos),
                                  alpha.y * radius * static_cast<T>(azimuth.sin), height));
}

/// D wm.z, 1/sr, the density of sample_ggx_anisotropic_ndf; 0 below the surface. Relative error below 14 ulp.
template <class T>
T pdf_ggx_anisotropic_ndf(const AnisotropicAlpha<T>& alpha, const Vec3<T>& wm) {
    return wm.z > T(0) ? D_ggx_anisotropic(wm, alpha) * wm.z : T(0);
}

/// The (u1, u2) that sample_ggx_anisotropic_ndf turns into wm; wm.z > 0. At the normal both are 0. Round trip
/// within 1e-9 (double).
template <class T>
Sample2 inverse_ggx_anisotropic_ndf(const AnisotropicAlpha<T>& alpha, const Vec3<T>& wm) {
    const T x = wm.x / alpha.x, y = wm.y / alpha.y;
    const T tan2 = x * x + y * y;
    return {static_cast<double>(tan2 / (wm.z * wm.z + tan2)), static_cast<double>(azimuth_turns(x, y))};
}

/// A half vector visible from wo, by a spherical cap (Dupuy & Benyoub 2023, listing 3). wo.z >= 0; u1 chooses
/// the azimuth, u2 the height, both in [0, 1). A unit vector within 4 ulp with wm.z >= 0 and wo.wm >= 0 but
/// for a rounding. For x = y it is sample_ggx_vndf to the bit.
template <class T>
Vec3<T> sample_ggx_anisotropic_vndf(const Vec3<T>& wo, const AnisotropicAlpha<T>& alpha, T u1, T u2) {
    const Vec3<T> wo_std = glm::normalize(Vec3<T>(alpha.x * wo.x, alpha.y * wo.y, wo.z));
    const SinCos azimuth = sin_cos_pi(2 * static_cast<double>(u1));
    const T z = (T(1) - u2) * (T(1) + wo_std.z) - wo_std.z;
    const T sine = std::sqrt(std::clamp(T(1) - z * z, T(0), T(1)));
    const Vec3<T> h =
        Vec3<T>(sine * static_cast<T>(azimuth.cos), sine * static_cast<T>(azimuth.sin), z) + wo_std;
    return glm::normalize(Vec3<T>(alpha.x * h.x, alpha.y * h.y, h.z));
}

/// G1(wo) max(0, wo.wm) D(wm) / wo.z, 1/sr, the density of sample_ggx_anisotropic_vndf (Heitz 2018, eq. 3);
/// finite at wo.z = 0. 0 below the surface and where wm isn't visible. Relative error below 20 ulp beside
/// that of wo.wm itself.
template <class T>
T pdf_ggx_anisotropic_vndf(const Vec3<T>& wo, const AnisotropicAlpha<T>& alpha, const Vec3<T>& wm) {
    const T cosine = glm::dot(wo, wm);
    if (wm.z <= T(0) || cosine <= T(0)) return T(0);
    return T(2) * cosine * D_ggx_anisotropic(wm, alpha) / (wo.z + smith_ggx_root_anisotropic(wo, alpha));
}

/// The (u1, u2) that sample_ggx_anisotropic_vndf turns into wm, which must be visible from wo. Round trip in
/// double: u2 within 1e-7; u1 within 1e-6 away from the ends of u2, where every azimuth is one direction.
template <class T>
Sample2 inverse_ggx_anisotropic_vndf(const Vec3<T>& wo, const AnisotropicAlpha<T>& alpha, const Vec3<T>& wm) {
    const Vec3<T> wo_std = glm::normalize(Vec3<T>(alpha.x * wo.x, alpha.y * wo.y, wo.z));
    const Vec3<T> wm_std = glm::normalize(Vec3<T>(wm.x / alpha.x, wm.y / alpha.y, wm.z));
    const Vec3<T> cap = T(2) * glm::dot(wo_std, wm_std) * wm_std - wo_std;  // wo_std mirrored at wm_std
    const T u2 = T(1) - (cap.z + wo_std.z) / (T(1) + wo_std.z);
    return {static_cast<double>(azimuth_turns(cap.x, cap.y)),
            static_cast<double>(std::clamp(u2, T(0), T(1)))};
}

}  // namespace pbr
