#pragma once
// Independent integrals over directions: adaptive Gauss-Kronrod in z and azimuth, which shares no code with
// libpbr's own quadrature. Slow, and good to about 1e-10 where the integrand is smooth or broken at few places.

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>

#include "pbr/numerics/vector.hpp"

namespace pbr {

/// Integral of f(unit vector) over the part of the sphere with z in [z0, z1], sr.
template <class F>
double integrate_directions(const F& f, double z0, double z1, double tolerance = 1e-10) {
    using boost::math::quadrature::gauss_kronrod;
    const auto ring = [&](double z) {
        const double s = std::sqrt((1 - z) * (1 + z));
        const auto at = [&](double phi) { return f(Vec3<double>(s * std::cos(phi), s * std::sin(phi), z)); };
        return gauss_kronrod<double, 31>::integrate(at, -std::numbers::pi, std::numbers::pi, 8, tolerance);
    };
    return gauss_kronrod<double, 31>::integrate(ring, z0, z1, 8, tolerance);
}

/// Over the upper hemisphere.
template <class F>
double integrate_hemisphere(const F& f, double tolerance = 1e-10) {
    return integrate_directions(f, 0, 1, tolerance);
}

/// Over the whole sphere.
template <class F>
double integrate_sphere(const F& f, double tolerance = 1e-10) {
    return integrate_directions(f, -1, 0, tolerance) + integrate_directions(f, 0, 1, tolerance);
}

/// Albedo of brdf(wo, wi), unit vectors away from a surface with normal +z, seen from NoV in the x-z plane.
template <class Brdf>
double directional_albedo(const Brdf& brdf, double NoV, double tolerance = 1e-10) {
    const Vec3<double> wo(std::sqrt((1 - NoV) * (1 + NoV)), 0, NoV);
    return integrate_hemisphere([&](const Vec3<double>& wi) { return brdf(wo, wi) * wi.z; }, tolerance);
}

}  // namespace pbr
