#include "pbr/ibl/zonal_kernel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include "pbr/numerics/sequence.hpp"
#include "tests/libpbr/support/chi_square.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/legendre.hpp>
#include <cmath>
#include <numbers>

#include "pbr/brdf/ggx.hpp"

namespace pbr {
namespace {

using boost::math::quadrature::gauss_kronrod;
constexpr double kAlphas[] = {1e-4, 0.0036, 0.04, 0.1, 0.25, 0.5, 0.8, 0.94, 0.95, 0.96, 0.999, 1.0};

/// Integral over the sphere of k times g(1 - mu), in the logarithm of 1 - mu.
template <class G>
double integrate(const GgxZonalKernel& kernel, const G& g) {
    const auto integrand = [&](double log_x) {
        const double x = std::exp(log_x);
        return 2 * std::numbers::pi * kernel.value(x) * g(x) * x;
    };
    return gauss_kronrod<double, 61>::integrate(integrand, -55.0, 0.0, 14, 1e-13);
}

TEST(GgxZonalKernel, IntegratesToOne) {
    for (const double alpha : kAlphas)
        EXPECT_NEAR(integrate(GgxZonalKernel(alpha), [](double) { return 1.0; }), 1, 1e-11) << alpha;
}

TEST(GgxZonalKernel, IsDTimesNoLWithViewAlongTheNormal) {
    for (const double alpha : {0.1, 0.5, 0.9}) {
        const GgxZonalKernel kernel(alpha);
        const auto D_NoL = [&](double mu) {
            const double NoH = std::sqrt((1 + mu) / 2);  // half the angle
            return D_ggx(NoH, (1 - mu) / 2, alpha) * mu;
        };
        const double factor = kernel.value(0.3) / D_NoL(0.7);
        for (const double mu : {0.05, 0.4, 0.9, 0.999})
            EXPECT_NEAR(kernel.value(1 - mu) / (factor * D_NoL(mu)), 1, 1e-12);
    }
}

TEST(GgxZonalKernel, HasThePublishedZonalCoefficients) {
    const struct {
        double alpha, k[4];
    } rows[] = {{0.1, {.954354, .876140, .783295, .689595}},
                {0.25, {.867396, .662406, .460388, .305538}},
                {0.5, {.763561, .436024, .179937, .055995}},
                {1, {2.0 / 3, 0.25, 0, -1.0 / 24}}};
    for (const auto& row : rows) {
        const GgxZonalKernel kernel(row.alpha);
        for (int l = 1; l <= 4; ++l)
            EXPECT_NEAR(integrate(kernel, [&](double x) { return boost::math::legendre_p(l, 1 - x); }),
                        row.k[l - 1], 1e-6)
                << "alpha " << row.alpha << ", band " << l;
    }
}

TEST(GgxZonalKernel, CdfIsTheIntegralOfTheKernel) {
    for (const double alpha : kAlphas) {
        const GgxZonalKernel kernel(alpha);
        for (const double x : {1e-3 * alpha * alpha, alpha * alpha, 0.3, 0.99}) {
            const auto integrand = [&](double log_t) {
                const double t = std::exp(log_t);
                return 2 * std::numbers::pi * kernel.value(t) * t;
            };
            const double share =
                gauss_kronrod<double, 61>::integrate(integrand, -55.0, std::log(x), 14, 1e-13);
            EXPECT_NEAR(kernel.cdf(x), share, 1e-11) << alpha << " " << x;
        }
        EXPECT_EQ(kernel.cdf(1), 1);
        EXPECT_NEAR(kernel.cdf(0), 0, 1e-14);
    }
}

TEST(GgxZonalKernel, SampleInvertsTheCdf) {
    for (const double alpha : kAlphas) {
        const GgxZonalKernel kernel(alpha);
        double previous = -1;
        for (int i = 0; i <= 1000; ++i) {
            const double u = i / 1000.0, x = kernel.sample(u);
            EXPECT_NEAR(kernel.cdf(x), u, 1e-12) << alpha;
            EXPECT_GE(x, previous);
            EXPECT_LE(x, 1);
            previous = x;
        }
    }
}

TEST(GgxZonalKernel, SamplesFollowTheKernel) {
    // Cells that double in 1 - mu from a hundredth of the peak's width on.
    for (const double alpha : {1e-2, 0.1, 0.5, 1.0}) {
        const GgxZonalKernel kernel(alpha);
        constexpr int kCount = 100'000;
        std::vector<double> edges = {0};
        for (double edge = 1e-2 * alpha * alpha; edge < 1; edge *= 2) edges.push_back(edge);
        edges.push_back(1);
        std::vector<double> observed(edges.size() - 1), expected(edges.size() - 1);
        for (int i = 0; i < kCount; ++i) {
            const double x = kernel.sample(random_unit(8, i));
            const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, x);
            observed[static_cast<std::size_t>(above - edges.begin() - 1)] += 1;
        }
        for (std::size_t i = 0; i < expected.size(); ++i)
            expected[i] = kCount * 2 * std::numbers::pi *
                          gauss_kronrod<double, 31>::integrate([&](double t) { return kernel.value(t); },
                                                               edges[i], edges[i + 1], 8, 1e-10);
        EXPECT_GT(pearson_p_value(observed, expected), kSignificance) << alpha;
    }
}

TEST(GgxZonalKernel, IsZeroFromTheHorizonOn) {
    const GgxZonalKernel kernel(0.5);
    EXPECT_EQ(kernel.value(1), 0);
    EXPECT_EQ(kernel.value(2), 0);
    EXPECT_GT(kernel.value(0.999), 0);
}

}  // namespace
}  // namespace pbr
