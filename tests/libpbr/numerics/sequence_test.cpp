#include "pbr/numerics/sequence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace pbr {
namespace {

/// Star discrepancy of a point set over a grid of corners.
double discrepancy(const std::vector<Sample2>& points) {
    double worst = 0;
    for (int i = 1; i <= 32; ++i)
        for (int j = 1; j <= 32; ++j) {
            const double a = i / 32.0, b = j / 32.0;
            const auto inside = std::count_if(points.begin(), points.end(),
                                              [&](const Sample2& p) { return p.u1 < a && p.u2 < b; });
            worst = std::max(
                worst, std::abs(static_cast<double>(inside) / static_cast<double>(points.size()) - a * b));
        }
    return worst;
}

TEST(Sequence, HammersleyStratifiesBothCoordinates) {
    std::set<int> columns, rows;
    for (std::uint32_t i = 0; i < 64; ++i) {
        const Sample2 p = hammersley(i, 64);
        columns.insert(static_cast<int>(p.u1 * 64));
        rows.insert(static_cast<int>(p.u2 * 64));
    }
    EXPECT_EQ(columns.size(), 64u);
    EXPECT_EQ(rows.size(), 64u);
}

TEST(Sequence, LowDiscrepancyBeatsRandom) {
    std::vector<Sample2> hammersley_points, r2_points, random_points;
    for (std::uint32_t i = 0; i < 1024; ++i) {
        hammersley_points.push_back(hammersley(i, 1024, 0.3));
        r2_points.push_back(r2_sequence(i, 7));
        random_points.push_back({random_unit(1, i, 0), random_unit(1, i, 1)});
    }
    EXPECT_LT(discrepancy(hammersley_points), 0.006);
    EXPECT_LT(discrepancy(r2_points), 0.006);
    EXPECT_GT(discrepancy(random_points), 0.01);
}

TEST(Sequence, StaysInTheUnitSquare) {
    for (std::uint32_t i = 0; i < 10'000; ++i) {
        for (const Sample2 p : {hammersley(i, 10'000, 0.999999), r2_sequence(i * 0x1234567ull, i)}) {
            EXPECT_GE(p.u1, 0);
            EXPECT_LT(p.u1, 1);
            EXPECT_GE(p.u2, 0);
            EXPECT_LT(p.u2, 1);
        }
    }
}

TEST(Sequence, RandomBitsDependOnEveryCounter) {
    std::set<std::uint64_t> seen;
    for (int a = 0; a < 10; ++a)
        for (int b = 0; b < 10; ++b)
            for (int c = 0; c < 10; ++c) seen.insert(random_bits(a, b, c));
    EXPECT_EQ(seen.size(), 1000u);
}

TEST(Sequence, RandomUnitHasTheMomentsOfTheUniformDistribution) {
    double sum = 0, squares = 0;
    constexpr int kCount = 100'000;
    for (int i = 0; i < kCount; ++i) {
        const double u = random_unit(42, i);
        sum += u;
        squares += u * u;
    }
    EXPECT_NEAR(sum / kCount, 0.5, 4 * std::sqrt(1.0 / 12 / kCount));
    EXPECT_NEAR(squares / kCount, 1.0 / 3, 4 * std::sqrt(4.0 / 45 / kCount));
}

}  // namespace
}  // namespace pbr
