#pragma once
// Anisotropic GGX's directional albedo a second time: over directions of light, straight from the BRDF of
// ggx_anisotropic.hpp; shares no parametrisation with libpbr's quadrature over stretched half vectors.

#include <array>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>

#include "pbr/brdf/fresnel.hpp"
#include "pbr/ibl/dfg_anisotropic.hpp"

namespace pbr {

/// E and Fc of a view, by adaptive Gauss-Kronrod over the polar angle of light and over its azimuth, from the
/// mirror direction. Good to 1e-7 for widths from .1 up.
inline DirectionalAlbedo dfg_anisotropic_witness(double NoV, const TangentAzimuth& azimuth,
                                                 const AnisotropicAlpha<double>& alpha) {
    using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;
    const double pi = std::numbers::pi, sin_v = std::sqrt((1 - NoV) * (1 + NoV));
    const Vec3<double> wo(sin_v * azimuth.cos, sin_v * azimuth.sin, NoV);
    const double mirror = std::atan2(-wo.y, -wo.x);
    const auto integral = [&](bool with_fresnel) {
        const auto ring = [&](double polar) {
            const double NoL = std::cos(polar), sin_l = std::sin(polar);
            const auto at = [&](double turn) {
                const Vec3<double> wi(sin_l * std::cos(mirror + turn), sin_l * std::sin(mirror + turn), NoL);
                const Vec3<double> wm = glm::normalize(wo + wi);
                const double value =
                    D_ggx_anisotropic(wm, alpha) * V_smith_ggx_anisotropic_correlated(wo, wi, alpha);
                return with_fresnel ? value * schlick_weight(glm::dot(wo, wm)) : value;
            };
            double sum = 0;
            for (const double from : {-pi, -pi / 2, 0.0, pi / 2})
                sum += Rule::integrate(at, from, from + pi / 2, 5, 1e-9);
            return sum * NoL * sin_l;
        };
        const double mirror_polar = std::acos(NoV);
        return Rule::integrate(ring, 0.0, mirror_polar, 5, 1e-8) +
               Rule::integrate(ring, mirror_polar, pi / 2, 5, 1e-8);
    };
    return {integral(false), integral(true)};
}

}  // namespace pbr
