#pragma once
// Area lights by brute force: adaptive Gauss-Kronrod over the light's surface of the rendering equation's
// area form. Shares with libpbr the shapes alone. And the grid of scenes on which approximations are
// measured.

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "pbr/light/disk_light.hpp"
#include "pbr/light/rectangle_light.hpp"
#include "pbr/light/sphere_light.hpp"
#include "pbr/light/tube_light.hpp"

namespace pbr {

using Vec = Vec3<double>;

constexpr double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// Two unit vectors perpendicular to `axis` and each other.
inline std::pair<Vec, Vec> plane_of(const Vec& axis) {
    const Vec other = std::abs(axis.x) < 0.5 ? Vec(1, 0, 0) : Vec(0, 1, 0);
    const Vec x = glm::normalize(glm::cross(other, axis));
    return {x, glm::cross(axis, x)};
}

template <class F>
double integrate_2d(const F& f, double a0, double a1, double b0, double b1, double tolerance) {
    using boost::math::quadrature::gauss_kronrod;
    const auto inner = [&](double a) {
        return gauss_kronrod<double, 15>::integrate([&](double b) { return f(a, b); }, b0, b1, 8, tolerance);
    };
    return gauss_kronrod<double, 15>::integrate(inner, a0, a1, 8, tolerance);
}

/// Integral over the surface of f(point, outward unit normal).
template <class F>
double integrate_surface(const DiskLight<double>& light, const F& f, double tolerance = 1e-7) {
    const auto [x, y] = plane_of(light.normal);
    const auto at = [&, x = x, y = y](double r, double phi) {
        return r * f(light.centre + r * (std::cos(phi) * x + std::sin(phi) * y), light.normal);
    };
    return integrate_2d(at, 0, light.radius, 0, 2 * std::numbers::pi, tolerance);
}

template <class F>
double integrate_surface(const RectangleLight<double>& light, const F& f, double tolerance = 1e-7) {
    const Vec area = glm::cross(light.half_x, light.half_y);
    const auto at = [&](double x, double y) {
        return glm::length(area) *
               f(light.centre + x * light.half_x + y * light.half_y, glm::normalize(area));
    };
    return integrate_2d(at, -1, 1, -1, 1, tolerance);
}

template <class F>
double integrate_surface(const TubeLight<double>& light, const F& f, double tolerance = 1e-7) {
    const double length = glm::length(light.end1 - light.end0), r = light.radius;
    const Vec axis = (light.end1 - light.end0) / length;
    const auto [x, y] = plane_of(axis);
    const auto at = [&, x = x, y = y](double height, double phi) {
        const double foot = std::clamp(height, 0.0, length), z = (height - foot) / r;
        const Vec normal = std::sqrt((1 - z) * (1 + z)) * (std::cos(phi) * x + std::sin(phi) * y) + z * axis;
        return r * f(light.end0 + foot * axis + r * normal, normal);
    };
    const auto part = [&](double from, double to) {
        return integrate_2d(at, from, to, 0, 2 * std::numbers::pi, tolerance);
    };
    return part(-r, 0) + part(0, length) + part(length, length + r);
}

/// Integral over the solid angle in which p sees the light's lit, convex surface, of f(wi).
template <class Light, class F>
double integrate_light(const Light& light, const Vec& p, const F& f, double tolerance = 1e-7) {
    const auto at = [&](const Vec& x, const Vec& normal) {
        const Vec ray = x - p;
        const double d2 = glm::dot(ray, ray), facing = -glm::dot(ray, normal);
        return facing > 0 ? f(ray / std::sqrt(d2)) * facing / (d2 * std::sqrt(d2)) : 0.0;
    };
    return integrate_surface(light, at, tolerance);
}

/// The same for a sphere: over the part of its surface that p sees, in rings about the line from its centre
/// to p.
template <class F>
double integrate_light(const SphereLight<double>& light, const Vec& p, const F& f, double tolerance = 1e-7) {
    const double distance = glm::length(p - light.centre), r = light.radius;
    const Vec axis = (p - light.centre) / distance;
    const auto [x, y] = plane_of(axis);
    const auto at = [&, x = x, y = y](double z, double phi) {
        const double s = std::sqrt((1 - z) * (1 + z));
        const Vec normal = s * std::cos(phi) * x + s * std::sin(phi) * y + z * axis;
        const Vec ray = light.centre + r * normal - p;
        const double d = glm::length(ray);
        return r * r * f(ray / d) * std::max(-glm::dot(ray, normal), 0.0) / (d * d * d);
    };
    return integrate_2d(at, r / distance, 1, 0, 2 * std::numbers::pi, tolerance);
}

template <class Light>
double reference_projected_solid_angle(const Light& light, const Vec& p, const Vec& n) {
    return integrate_light(light, p, [&](const Vec& wi) { return std::max(0.0, glm::dot(n, wi)); });
}

template <class Light>
double reference_solid_angle(const Light& light, const Vec& p) {
    return integrate_light(
        light, p, [](const Vec&) { return 1.0; }, 1e-10);
}

/// Calls f(p, n) for receivers around a light at the origin with normal +z: at `distance`, from head-on to
/// nearly edge on in two azimuths, turned by up to 100 deg from the light to four sides.
template <class F>
void for_each_receiver(double distance, const F& f) {
    for (const double from_axis : {0.0, 25.0, 50.0, 70.0, 85.0})
        for (const double azimuth : {0.0, 30.0}) {
            const double theta = radians(from_axis), phi = radians(azimuth);
            const Vec up(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
            const auto [x, y] = plane_of(up);
            for (const double tilt : {0.0, 30.0, 60.0, 80.0, 90.0, 100.0})
                for (const double side : {0.0, 90.0, 180.0, 270.0}) {
                    const Vec sideways = std::cos(radians(side)) * x + std::sin(radians(side)) * y;
                    f(distance * up, std::sin(radians(tilt)) * sideways - std::cos(radians(tilt)) * up);
                }
        }
}

/// Worst of |approximate - exact| / normaliser over for_each_receiver.
template <class Approximate, class Exact, class Normaliser>
double worst_error(double distance, const Approximate& approximate, const Exact& exact,
                   const Normaliser& normaliser) {
    double worst = 0;
    for_each_receiver(distance, [&](const Vec& p, const Vec& n) {
        worst = std::max(worst, std::abs(approximate(p, n) - exact(p, n)) / normaliser(p));
    });
    return worst;
}

}  // namespace pbr
