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
//     reflected_radiance_from_parallelogram, _from_disk        area lights, by area
//     reflected_radiance_from_texels   (reference/reflected_texels.hpp)

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

/// A flat light seen from the origin, frame of the surface: points centre + u half_u + v half_v, metres. It
/// emits to the side of cross(half_u, half_v) alone. A parallelogram has u and v in [-1, 1]; a disk (or
/// ellipse, if half_u and half_v are perpendicular semi-axes) has u² + v² <= 1.
struct FlatLight {
    Vec3<double> centre;
    Vec3<double> half_u;
    Vec3<double> half_v;

    /// What turns radiance at a point of the light into reflected radiance per area: cos / distance², times
    /// the area element. 0 behind the light, and in its plane.
    double form_factor(const Vec3<double>& point) const {
        const double distance2 = glm::dot(point, point);
        // |normal| is the area element; all points have the centre's distance to the plane.
        const double towards = -glm::dot(centre, glm::cross(half_u, half_v));
        return towards > 0 ? towards / (distance2 * std::sqrt(distance2)) : 0.0;
    }
};

/// The part of [low, high] in which offset + slope t > 0.
inline std::pair<double, double> positive_range(double offset, double slope, double low, double high) {
    const double zero = -offset / slope;
    if (slope > 0) return {std::max(low, zero), high};
    if (slope < 0) return {low, std::min(high, zero)};
    return offset > 0 ? std::pair(low, high) : std::pair(low, low);
}

/// Break points for the outer and inner variable of a flat light, graded towards where the rays of `peaks`
/// meet it. `coordinates` maps (u, v) to (outer, inner).
template <class Coordinates>
void add_flat_light_breaks(const FlatLight& light, std::span<const Peak> peaks,
                           const Coordinates& coordinates, std::vector<double>& outer,
                           std::vector<double>& inner) {
    const Vec3<double> normal = glm::cross(light.half_u, light.half_v);
    for (const Peak& peak : peaks) {
        const double slope = glm::dot(peak.direction, normal);
        const double t = glm::dot(light.centre, normal) / slope;
        if (!(slope != 0 && t > 0)) continue;
        const Vec3<double> offset = t * peak.direction - light.centre;
        const double area2 = glm::dot(normal, normal);
        const double u = glm::dot(glm::cross(offset, light.half_v), normal) / area2;
        const double v = glm::dot(glm::cross(light.half_u, offset), normal) / area2;
        const auto [at_outer, at_inner] = coordinates(u, v);
        add_graded_breaks(outer.front(), outer.back(), at_outer,
                          peak.width_rad * t / glm::length(light.half_u), outer);
        add_graded_breaks(inner.front(), inner.back(), at_inner,
                          peak.width_rad * t / glm::length(light.half_v), inner);
    }
    sort_breaks(outer);
    sort_breaks(inner);
}

/// From a parallelogram, as far as it lies above the surface.
template <class Brdf, class Incident>
Estimate reflected_radiance_from_parallelogram(const Brdf& brdf, const Vec3<double>& wo,
                                               const FlatLight& light, const Incident& incident,
                                               const QuadratureTolerance& tolerance = {},
                                               std::span<const Peak> peaks = {}) {
    const auto integrand = [&](double u, double share) {
        const auto [low, high] = positive_range(light.centre.z + u * light.half_u.z, light.half_v.z, -1, 1);
        if (!(high > low)) return 0.0;
        const double v = low + (high - low) * share;
        const Vec3<double> point = light.centre + u * light.half_u + v * light.half_v;
        const Vec3<double> wi = glm::normalize(point);
        if (!(wi.z > 0)) return 0.0;
        return brdf(wo, wi) * incident(wi) * wi.z * light.form_factor(point) * (high - low);
    };
    std::vector<double> outer = {-1, 1}, inner = {0, 1};
    // The horizon enters at the edges v = -1 and v = 1 where the height is 0.
    for (const double v : {-1.0, 1.0}) {
        const double u = -(light.centre.z + v * light.half_v.z) / light.half_u.z;
        if (std::abs(u) < 1) outer.push_back(u);
    }
    sort_breaks(outer);
    const auto coordinates = [&](double u, double v) {
        const auto [low, high] = positive_range(light.centre.z + u * light.half_u.z, light.half_v.z, -1, 1);
        return std::pair(u, high > low ? (v - low) / (high - low) : 0.5);
    };
    add_flat_light_breaks(light, peaks, coordinates, outer, inner);
    return integrate_adaptive_2d(integrand, outer, inner, tolerance);
}

/// From a disk or ellipse, as far as it lies above the surface; polar coordinates about its centre.
template <class Brdf, class Incident>
Estimate reflected_radiance_from_disk(const Brdf& brdf, const Vec3<double>& wo, const FlatLight& light,
                                      const Incident& incident, const QuadratureTolerance& tolerance = {},
                                      std::span<const Peak> peaks = {}) {
    constexpr double kPi = std::numbers::pi;
    const auto range = [&](double phi) {
        return positive_range(light.centre.z, light.half_u.z * std::cos(phi) + light.half_v.z * std::sin(phi),
                              0, 1);
    };
    const auto integrand = [&](double phi, double share) {
        const auto [low, high] = range(phi);
        if (!(high > low)) return 0.0;
        const double r = low + (high - low) * share;
        const Vec3<double> point =
            light.centre + r * (std::cos(phi) * light.half_u + std::sin(phi) * light.half_v);
        const Vec3<double> wi = glm::normalize(point);
        if (!(wi.z > 0)) return 0.0;
        return brdf(wo, wi) * incident(wi) * wi.z * light.form_factor(point) * r * (high - low);
    };
    std::vector<double> outer = {-kPi, -kPi / 2, 0, kPi / 2, kPi}, inner = {0, 1};
    const double reach = std::hypot(light.half_u.z, light.half_v.z);  // height of the rim over the centre
    const double steepest = std::atan2(light.half_v.z, light.half_u.z);
    for (const double height :
         {0.0, -light.centre.z})  // where the range of r opens, and where the rim meets the horizon
        if (std::abs(height) < reach)
            for (const double turn : {std::acos(height / reach), -std::acos(height / reach)})
                outer.push_back(std::remainder(steepest + turn, 2 * kPi));
    sort_breaks(outer);
    const auto coordinates = [&](double u, double v) {
        const double phi = std::atan2(v, u);
        const auto [low, high] = range(phi);
        return std::pair(phi, high > low ? (std::hypot(u, v) - low) / (high - low) : 0.5);
    };
    add_flat_light_breaks(light, peaks, coordinates, outer, inner);
    return integrate_adaptive_2d(integrand, outer, inner, tolerance);
}

}  // namespace pbr
