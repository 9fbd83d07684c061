#pragma once
// Reflected radiance of flat area lights, integrated over their area; conventions of
// reference/reflected_radiance.hpp.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "pbr/numerics/adaptive_quadrature.hpp"
#include "pbr/numerics/vector.hpp"
#include "pbr/reference/polar_domain.hpp"

namespace pbr {

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
