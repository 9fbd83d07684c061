#pragma once
// Pearson's test that samples follow the density that is claimed for them.

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "pbr/numerics/quadrature.hpp"
#include "pbr/numerics/sequence.hpp"
#include "pbr/numerics/vector.hpp"

namespace pbr {

/// A sampler is wrong if chance alone would give a worse fit less often than this.
constexpr double kSignificance = 1e-4;

/// p-value of counts against expected counts, a cell each; cells with fewer than 10 expected are pooled.
inline double pearson_p_value(const std::vector<double>& observed, const std::vector<double>& expected) {
    double statistic = 0, pooled_observed = 0, pooled_expected = 0;
    int cells = 0;
    for (std::size_t i = 0; i < observed.size(); ++i) {
        if (expected[i] < 10) {  // too few for the normal approximation: pooled
            pooled_observed += observed[i];
            pooled_expected += expected[i];
            continue;
        }
        statistic += (observed[i] - expected[i]) * (observed[i] - expected[i]) / expected[i];
        ++cells;
    }
    if (pooled_expected > 5) {
        const double difference = pooled_observed - pooled_expected;
        statistic += difference * difference / pooled_expected;
        ++cells;
    }
    return boost::math::cdf(complement(boost::math::chi_squared(cells - 1), statistic));
}

/// p-value of samples against a density over a grid of z x azimuth on the sphere from z = `z_min` (0: the
/// upper hemisphere, -1: all of it) to 1. `sample(u1, u2)` gives a unit vector, `pdf(direction)` its density
/// per steradian. A sample below z_min fails the test that calls.
template <class Sample, class Pdf>
double chi_square_p_value(const Sample& sample, const Pdf& pdf, double z_min = 0) {
    constexpr int kRings = 16, kSectors = 16, kCount = 200'000, kSub = 24;
    const double span = 1 - z_min;
    std::vector<double> observed(kRings * kSectors), expected(kRings * kSectors);
    int outside = 0;
    for (int i = 0; i < kCount; ++i) {
        const Vec3<double> w = sample(random_unit(11, i, 0), random_unit(11, i, 1));
        if (!(w.z >= z_min - 1e-12)) {
            ++outside;
            continue;
        }
        const double turns = std::atan2(w.y, w.x) / (2 * std::numbers::pi);
        const int ring = std::clamp(static_cast<int>((w.z - z_min) / span * kRings), 0, kRings - 1);
        const int sector =
            std::clamp(static_cast<int>((turns - std::floor(turns)) * kSectors), 0, kSectors - 1);
        observed[ring * kSectors + sector] += 1;
    }
    EXPECT_EQ(outside, 0);
    const QuadratureRule rule = gauss_legendre(kSub);
    const double cell = span * 2 * std::numbers::pi / (kRings * kSectors);
    for (int ring = 0; ring < kRings; ++ring)
        for (int sector = 0; sector < kSectors; ++sector)
            for (int a = 0; a < kSub; ++a)
                for (int b = 0; b < kSub; ++b) {
                    const double z = z_min + span * (ring + rule.nodes[a]) / kRings;
                    const double phi = 2 * std::numbers::pi * (sector + rule.nodes[b]) / kSectors;
                    const double s = std::sqrt(1 - z * z);
                    expected[ring * kSectors + sector] +=
                        rule.weights[a] * rule.weights[b] * cell * kCount *
                        pdf(Vec3<double>(s * std::cos(phi), s * std::sin(phi), z));
                }
    return pearson_p_value(observed, expected);
}

}  // namespace pbr
