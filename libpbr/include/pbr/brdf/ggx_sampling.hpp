#pragma once
// Sampling the GGX distribution: triples sample / inverse / pdf. T is float or double.
//
// Half vectors wm are unit vectors in the frame of the surface, normal +z; pdfs are with respect to solid
// angle of wm. For a reflected direction wi = 2 (wo.wm) wm - wo divide by the Jacobian 4 (wo.wm).

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "pbr/brdf/ggx.hpp"
#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/sequence.hpp"
#include "pbr/numerics/vector.hpp"

namespace pbr {

/// Turns in [0, 1) of the azimuth of (x, y); 0 at (0, 0). Absolute error 2e-16 and a rounding to T, which may
/// round a turn just below 1 up to 1.
template <class T>
T azimuth_turns(T x, T y) {
    const double turns = atan2_exact(static_cast<double>(y), static_cast<double>(x)) / (2 * std::numbers::pi);
    return static_cast<T>(turns < 0 ? turns + 1 : turns);
}

/// A half vector with density D NoH (Walter et al. 2007, eq. 35-36): tan^2 = alpha^2 u1 / (1 - u1). u1, u2 in
/// [0, 1); u1 = 0 is the normal. A unit vector within 4 ulp, z > 0.
template <class T>
Vec3<T> sample_ggx_ndf(T alpha, T u1, T u2) {
    const T sin_part = alpha * alpha * u1, cos_part = T(1) - u1;
    const T cos2 = cos_part / (cos_part + sin_part), sine = std::sqrt(sin_part / (cos_part + sin_part));
    const SinCos azimuth = sin_cos_pi(2 * static_cast<double>(u2));
    return {sine * static_cast<T>(azimuth.cos), sine * static_cast<T>(azimuth.sin), std::sqrt(cos2)};
}

/// D NoH, 1/sr, the density of sample_ggx_ndf; 0 below the surface. Relative error below 10 ulp.
template <class T>
T pdf_ggx_ndf(T alpha, const Vec3<T>& wm) {
    return wm.z > T(0) ? D_ggx(wm.z, wm.x * wm.x + wm.y * wm.y, alpha) * wm.z : T(0);
}

/// The (u1, u2) that sample_ggx_ndf turns into wm; wm.z > 0. At the normal u1 and u2 are 0. Round trip within
/// 1e-9 (double).
template <class T>
Sample2 inverse_ggx_ndf(T alpha, const Vec3<T>& wm) {
    const T tan2 = (wm.x * wm.x + wm.y * wm.y) / (wm.z * wm.z);
    return {static_cast<double>(tan2 / (alpha * alpha + tan2)),
            static_cast<double>(azimuth_turns(wm.x, wm.y))};
}

/// A half vector visible from wo, by a spherical cap (Dupuy & Benyoub 2023, "Sampling visible GGX normals
/// with spherical caps", listing 3). wo.z >= 0; u1 chooses the azimuth, u2 the height. u1, u2 in [0, 1).
/// A unit vector within 4 ulp with wm.z >= 0 and wo.wm >= 0 but for a rounding.
template <class T>
Vec3<T> sample_ggx_vndf(const Vec3<T>& wo, T alpha, T u1, T u2) {
    const Vec3<T> wo_std = glm::normalize(Vec3<T>(alpha * wo.x, alpha * wo.y, wo.z));
    const SinCos azimuth = sin_cos_pi(2 * static_cast<double>(u1));
    const T z = (T(1) - u2) * (T(1) + wo_std.z) - wo_std.z;
    const T sine = std::sqrt(std::clamp(T(1) - z * z, T(0), T(1)));
    const Vec3<T> h =
        Vec3<T>(sine * static_cast<T>(azimuth.cos), sine * static_cast<T>(azimuth.sin), z) + wo_std;
    return glm::normalize(Vec3<T>(alpha * h.x, alpha * h.y, h.z));
}

/// G1(wo) max(0, wo.wm) D(wm) / NoV, 1/sr (Heitz 2018, "Sampling the GGX distribution of visible normals",
/// eq. 3). wo.z = 0 gives the limit: 2 max(0, wo.wm) D / alpha. Relative error below
/// 16 ulp beside that of wo.wm itself.
template <class T>
T pdf_ggx_vndf(const Vec3<T>& wo, T alpha, const Vec3<T>& wm) {
    const T cosine = glm::dot(wo, wm);
    if (wm.z <= T(0) || cosine <= T(0)) return T(0);
    const T D = D_ggx(wm.z, wm.x * wm.x + wm.y * wm.y, alpha);
    return T(2) * cosine * D / (wo.z + smith_ggx_root(wo.z, alpha));
}

/// The (u1, u2) that sample_ggx_vndf turns into wm, which must be visible from wo. Round trip in
/// double: u2 within 1e-7; u1 within 1e-6 away from the ends of u2, where every azimuth is one direction.
template <class T>
Sample2 inverse_ggx_vndf(const Vec3<T>& wo, T alpha, const Vec3<T>& wm) {
    const Vec3<T> wo_std = glm::normalize(Vec3<T>(alpha * wo.x, alpha * wo.y, wo.z));
    const Vec3<T> wm_std = glm::normalize(Vec3<T>(wm.x / alpha, wm.y / alpha, wm.z));
    const Vec3<T> cap = T(2) * glm::dot(wo_std, wm_std) * wm_std - wo_std;  // wo_std mirrored at wm_std
    const T u2 = T(1) - (cap.z + wo_std.z) / (T(1) + wo_std.z);
    return {static_cast<double>(azimuth_turns(cap.x, cap.y)),
            static_cast<double>(std::clamp(u2, T(0), T(1)))};
}

}  // namespace pbr
