#pragma once
// Properties over random inputs, by RapidCheck: generators of this field's quantities with their hazards in,
// and the distance of floating-point numbers. Use RC_GTEST_PROP(Suite, Behaviour, ()) { const double NoV =
// *unit_interval(); RC_ASSERT(...); }. CTest pins the seed; RC_PARAMS=seed=N repeats a failure.

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <type_traits>

#include "pbr/numerics/vector.hpp"

namespace pbr {

/// Uniform in [low, high), whatever the size RapidCheck is at; shrinks to low.
inline rc::Gen<double> uniform(double low, double high) {
    constexpr std::int64_t kSteps = std::int64_t{1} << 40;
    return rc::gen::map(rc::gen::resize(100, rc::gen::inRange<std::int64_t>(0, kSteps)),
                        [=](std::int64_t i) { return low + (high - low) * static_cast<double>(i) / kSteps; });
}

/// Uniform in the logarithm over [low, high); both positive.
inline rc::Gen<double> log_uniform(double low, double high) {
    return rc::gen::map(uniform(std::log(low), std::log(high)), [](double x) { return std::exp(x); });
}

/// [0, 1]: one draw in four is an end point or next to one, one in four small, the rest uniform. For cosines,
/// roughness, reflectance.
inline rc::Gen<double> unit_interval() {
    return rc::gen::weightedOneOf<double>(
        {{1, rc::gen::element(0.0, 1.0, 1e-8, 1e-4, 1 - 1e-8, 0.5, std::numeric_limits<double>::min())},
         {1, log_uniform(1e-6, 1)},
         {2, uniform(0, 1)}});
}

/// A unit vector with z in [z_min, 1]; poles, grazing ones and axes among them.
inline rc::Gen<Vec3<double>> direction(double z_min = -1) {
    const auto z = rc::gen::weightedOneOf<double>(
        {{1, rc::gen::element(1.0, z_min, std::max(z_min, 0.0), 1 - 1e-9, std::max(z_min, 1e-9))},
         {4, uniform(z_min, 1)}});
    return rc::gen::map(rc::gen::pair(z, uniform(0, 2 * std::numbers::pi)),
                        [](const std::pair<double, double>& p) {
                            const double s = std::sqrt(std::max(0.0, (1 - p.first) * (1 + p.first)));
                            return Vec3<double>(s * std::cos(p.second), s * std::sin(p.second), p.first);
                        });
}

/// A unit vector above the surface with normal +z.
inline rc::Gen<Vec3<double>> direction_above() { return direction(0); }

/// How many floating-point numbers of T lie from a to b; NaN is infinitely far from everything, 0 and -0 are
/// one.
template <class T>
double ulp_distance(T a, T b) {
    using Bits = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;
    if (std::isnan(a) || std::isnan(b)) return std::numeric_limits<double>::infinity();
    const auto ordered = [](T x) {
        const Bits bits = std::bit_cast<Bits>(x);
        return bits < 0 ? -(bits & std::numeric_limits<Bits>::max()) : bits;
    };
    const Bits i = ordered(a), j = ordered(b);
    // Exact where it counts: as doubles, the places of two neighbours of 64 bits are the same or 512 apart.
    if ((i < 0) == (j < 0)) return static_cast<double>(i < j ? j - i : i - j);
    return std::abs(static_cast<double>(i)) + std::abs(static_cast<double>(j));
}

}  // namespace pbr
