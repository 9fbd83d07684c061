#pragma once
// Pairs of directions for tests of BRDFs, and albedos of BRDFs that are functions of a Reflection.

#include <cmath>
#include <numbers>

#include "pbr/brdf/reflection.hpp"
#include "pbr/numerics/quadrature.hpp"
#include "pbr/numerics/sequence.hpp"
#include "tests/libpbr/support/integrate.hpp"

namespace pbr {

/// The unit vector at this cosine and this many turns.
inline Vec3<double> direction_at(double cosine, double turns) {
    const double s = std::sqrt((1 - cosine) * (1 + cosine)), phi = 2 * std::numbers::pi * turns;
    return {s * std::cos(phi), s * std::sin(phi), cosine};
}

/// The i-th of many reflections above the surface: even ones anywhere, odd ones near grazing angles.
inline Reflection<double> sample_reflection(int i) {
    const double power = i % 2 == 0 ? 1 : 6;
    return reflection(direction_at(std::pow(random_unit(91, i), power), random_unit(92, i)),
                      direction_at(std::pow(random_unit(93, i), power), random_unit(94, i)));
}

/// The same reflection in float, from its rounded directions; and those directions' in double.
inline Reflection<float> as_float(const Reflection<double>& r) {
    return reflection(Vec3<float>(r.wo), Vec3<float>(r.wi));
}

/// A float reflection's members, each exactly, as double.
inline Reflection<double> as_double(const Reflection<float>& r) {
    return {Vec3<double>(r.wo),
            Vec3<double>(r.wi),
            Vec3<double>(r.wm),
            r.NoV,
            r.NoL,
            r.NoH,
            r.LoV,
            r.LoH,
            r.sin2};
}

/// Adaptive albedo of f(reflection) seen from NoV.
template <class F>
double reflection_albedo(const F& f, double NoV, double tolerance = 1e-7) {
    return directional_albedo(
        [&](const Vec3<double>& wo, const Vec3<double>& wi) { return f(reflection(wo, wi)); }, NoV,
        tolerance);
}

/// The same by a fixed product rule, NoL = u^2 and azimuths crowded about wo and its antipode: fast, good to
/// about 1e-5 for lobes no narrower than alpha = .05. For sweeps.
template <class F>
double reflection_albedo_fixed(const F& f, double NoV) {
    static const QuadratureRule heights = gauss_legendre(48), azimuths = gauss_legendre(48);
    const Vec3<double> wo = direction_at(NoV, 0);
    double sum = 0;
    for (int i = 0; i < heights.size(); ++i)
        for (int j = 0; j < azimuths.size(); ++j) {
            const double u = heights.nodes[i], t = azimuths.nodes[j], cube = t * t * t / 4;
            const double weight =
                heights.weights[i] * azimuths.weights[j] * 2 * u * 3 * std::numbers::pi * t * t * u * u;
            sum += weight * (f(reflection(wo, direction_at(u * u, cube))) +
                             f(reflection(wo, direction_at(u * u, .5 - cube))));
        }
    return sum;
}

}  // namespace pbr
