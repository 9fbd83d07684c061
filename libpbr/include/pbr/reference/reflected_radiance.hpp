#pragma once
// The reference: radiance that a surface reflects, by adaptive quadrature in double precision, for any
// material under any light.
//
// What tables, fits and approximations are tested against. Nothing here knows a lobe or a light: `brdf(wo,
// wi)` is any function in 1/sr, `incident(wi)` any radiance; both get unit vectors in the frame of the
// surface, normal +z, and give doubles. The integral is of brdf incident wi.z over the directions of the
// domain that lie above the surface; wo.z > 0. All return a value with an error estimate and a count
// (numerics/adaptive_quadrature.hpp). An integrand with a narrow peak needs a Peak, or it can be missed.
//
//     reflected_radiance               all directions          environments given by a function, smooth lobes
//     reflected_radiance_half_vector   all directions          the same, GGX lobes of any narrowness
//     reflected_radiance_from_cap      a cone of directions    sphere lights, the sun
//     reflected_radiance_from_parallelogram, _from_disk        area lights, in reference/flat_light.hpp
//     reflected_radiance_from_tube     directions of a tube    tube lights, in reference/tube_light.hpp
//     reflected_radiance_from_texels   pictures, in reference/reflected_texels.hpp
//     reflected_colour                 any of them in colour   a Material, in reference/colour.hpp

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>

#include "pbr/numerics/adaptive_quadrature.hpp"
#include "pbr/numerics/vector.hpp"
#include "pbr/reference/polar_domain.hpp"

namespace pbr {

/// Over the directions of a PolarDomain. The quadrature runs on shares of the range of angles that is above
/// the horizon, so that the horizon is an edge of its panels.
template <class Brdf, class Incident>
Estimate reflected_radiance_over(const PolarDomain& domain, const Brdf& brdf, const Vec3<double>& wo,
                                 const Incident& incident, const QuadratureTolerance& tolerance = {},
                                 std::span<const Peak> peaks = {}) {
    const auto integrand = [&](double psi, double share) {
        const auto [low, high] = domain.gamma_range(psi);
        if (!(high > low)) return 0.0;
        const double gamma = low + (high - low) * share;
        const Vec3<double> wi = domain.direction(psi, gamma);
        if (!(wi.z > 0)) return 0.0;  // a rounding below the horizon
        return brdf(wo, wi) * incident(wi) * wi.z * std::sin(gamma) * (high - low);
    };
    return integrate_adaptive_2d(integrand, domain.psi_breaks(peaks), domain.share_breaks(peaks), tolerance);
}

/// Over the hemisphere, in polar coordinates about the normal.
template <class Brdf, class Incident>
Estimate reflected_radiance(const Brdf& brdf, const Vec3<double>& wo, const Incident& incident,
                            const QuadratureTolerance& tolerance = {}, std::span<const Peak> peaks = {}) {
    return reflected_radiance_over(PolarDomain({0, 0, 1}, std::numbers::pi / 2), brdf, wo, incident,
                                   tolerance, peaks);
}

/// Over the hemisphere by half vectors wm in polar coordinates about the normal, angles drawn apart near 0 on
/// the scale of `alpha`: a GGX lobe of that alpha is as smooth to it at 1e-5 as at 1. dwi = 4 (wo.wm) dwm; a
/// half vector at azimuth phi from wo's and angle theta reflects to height sin(theta_o) sin(2 theta) cos(phi)
/// + cos(theta_o) cos(2 theta), which is 0 at 2 theta = atan2(cos(theta_o), -sin(theta_o) cos(phi)).
template <class Brdf, class Incident>
Estimate reflected_radiance_half_vector(const Brdf& brdf, const Vec3<double>& wo, const Incident& incident,
                                        double alpha, const QuadratureTolerance& tolerance = {}) {
    const double sine = std::hypot(wo.x, wo.y), azimuth = std::atan2(wo.y, wo.x);
    const auto integrand = [&](double phi, double share) {
        const double limit = std::asinh(std::atan2(wo.z, -sine * std::cos(phi)) / 2 / alpha);
        const double theta = alpha * std::sinh(share * limit);
        const double s = std::sin(theta);
        const Vec3<double> wm(s * std::cos(phi + azimuth), s * std::sin(phi + azimuth), std::cos(theta));
        const double cosine = glm::dot(wo, wm);
        const Vec3<double> wi = 2 * cosine * wm - wo;
        if (!(wi.z > 0)) return 0.0;
        return brdf(wo, wi) * incident(wi) * wi.z * 4 * cosine * s * alpha * std::cosh(share * limit) * limit;
    };
    constexpr double kPi = std::numbers::pi;
    return integrate_adaptive_2d(integrand, std::array{-kPi, -kPi / 2, 0.0, kPi / 2, kPi},
                                 std::array{0.0, 1.0}, tolerance);
}

/// A cone of directions.
struct SphericalCap {
    Vec3<double> axis;  ///< unit, frame of the surface; may lie below it
    double half_angle_rad;
};

/// The cap under which a sphere appears from the origin: half-angle asin(radius / distance), all directions
/// from inside.
inline SphericalCap cap_of_sphere(const Vec3<double>& centre, double radius_m) {
    const double distance = glm::length(centre);
    if (!(distance > radius_m)) return {{0, 0, 1}, std::numbers::pi};
    return {centre / distance, std::asin(radius_m / distance)};
}

/// From a cap, as far as it lies above the surface.
template <class Brdf, class Incident>
Estimate reflected_radiance_from_cap(const Brdf& brdf, const Vec3<double>& wo, const SphericalCap& cap,
                                     const Incident& incident, const QuadratureTolerance& tolerance = {},
                                     std::span<const Peak> peaks = {}) {
    return reflected_radiance_over(PolarDomain(cap.axis, cap.half_angle_rad), brdf, wo, incident, tolerance,
                                   peaks);
}

}  // namespace pbr
