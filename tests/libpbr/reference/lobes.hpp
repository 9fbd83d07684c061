#pragma once
// Lobes, views and expectations that tests of the reference share.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "pbr/brdf/ggx.hpp"
#include "pbr/numerics/adaptive_quadrature.hpp"
#include "pbr/numerics/vector.hpp"

namespace pbr {

constexpr double kPi = std::numbers::pi;

inline double lambert(const Vec3<double>&, const Vec3<double>&) { return 1 / kPi; }

/// Radiance 1 from everywhere.
inline double one(const Vec3<double>&) { return 1; }

/// GGX with height-correlated Smith, F = 1.
struct Ggx {
    double alpha;
    double operator()(const Vec3<double>& wo, const Vec3<double>& wi) const {
        const Vec3<double> h = glm::normalize(wo + wi);
        return D_ggx(h.z, h.x * h.x + h.y * h.y, alpha) * V_smith_ggx_correlated(wi.z, wo.z, alpha);
    }
};

/// A direction at a height and an azimuth in radians.
inline Vec3<double> view(double NoV, double azimuth = 0) {
    const double s = std::sqrt((1 - NoV) * (1 + NoV));
    return {s * std::cos(azimuth), s * std::sin(azimuth), NoV};
}

/// The estimate holds what it says, against an exact value: within four of its own errors.
inline void expect_holds(const Estimate& e, double exact) {
    EXPECT_TRUE(e.converged);
    EXPECT_NEAR(e.value, exact, 4 * e.error + 2e-15);
}

}  // namespace pbr
