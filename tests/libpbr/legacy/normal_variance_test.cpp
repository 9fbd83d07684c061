#include "pbr/legacy/normal_variance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "pbr/brdf/ggx.hpp"
#include "pbr/numerics/sequence.hpp"

namespace pbr {
namespace {

Vec3<double> tilted(double sx, double sy) { return glm::normalize(Vec3<double>(-sx, -sy, 1)); }

TEST(NormalVariance, FlatGroundKeepsAlphaAndNormal) {
    SlopeMoments<double> sums;
    for (int i = 0; i < 16; ++i) sums.add(tilted(.3, -.2), .25);
    EXPECT_NEAR(sums.alpha(), .25, 1e-12);
    EXPECT_NEAR(glm::distance(sums.normal(), tilted(.3, -.2)), 0, 1e-12);
}

TEST(NormalVariance, SlopesOfARidgeBecomeAlpha) {
    SlopeMoments<double> sums;
    sums.add(tilted(.2, 0), .1);
    sums.add(tilted(-.2, 0), .1);
    EXPECT_NEAR(sums.variance(), .02, 1e-14);  // .04 along x, none along y
    EXPECT_NEAR(sums.alpha(), std::sqrt(.01 + .04), 1e-14);
    EXPECT_NEAR(sums.normal().z, 1, 1e-14);
}

TEST(NormalVariance, PartsAddUpToTheWhole) {
    SlopeMoments<double> whole, a, b;
    for (int i = 0; i < 32; ++i) {
        const Vec3<double> n = tilted(random_unit(1, i) - .5, random_unit(2, i) - .5);
        whole.add(n, random_unit(3, i));
        (i < 16 ? a : b).add(n, random_unit(3, i));
    }
    a.add(b);
    EXPECT_NEAR(a.alpha(), whole.alpha(), 1e-14);
}

TEST(NormalVariance, BadNormalsAreDefined) {
    SlopeMoments<float> sums;
    sums.add(Vec3<float>(0), 1e-4f);
    sums.add(Vec3<float>(1, 0, 0), 1e-4f);
    sums.add(Vec3<float>(0, 0, -1), 1e-4f);
    EXPECT_TRUE(std::isfinite(sums.alpha()));
    EXPECT_LE(sums.alpha(), 1);
    EXPECT_TRUE(std::isfinite(sums.normal().x));
}

/// Mean over Gaussian ground of slope deviation sigma of the lobe that sees a half vector `angle` off the
/// mean normal, in the slopes' plane (D cos^4 is a density there).
double averaged_lobe(double sigma, double alpha, double slope) {
    double sum = 0;
    constexpr int kSamples = 4000;
    for (int i = 0; i < kSamples; ++i) {
        const Sample2 u = r2_sequence(static_cast<std::uint64_t>(i), 7);
        const double r = sigma * std::sqrt(-2 * std::log(1 - u.u1)), phi = 2 * std::numbers::pi * u.u2;
        const double dx = slope - r * std::cos(phi), dy = r * std::sin(phi), t2 = dx * dx + dy * dy;
        sum += alpha * alpha / (std::numbers::pi * std::pow(alpha * alpha + t2, 2));
    }
    return sum / kSamples;
}

double single_lobe(double alpha, double slope) {
    return alpha * alpha / (std::numbers::pi * std::pow(alpha * alpha + slope * slope, 2));
}

/// Relative L1 distance of the single lobe to the averaged one over slopes.
double lobe_distance(double sigma, double alpha, double effective) {
    double off = 0, all = 0;
    for (int i = 0; i < 40; ++i) {
        const double slope = 3 * (sigma + alpha) * (i + .5) / 40, truth = averaged_lobe(sigma, alpha, slope);
        off += slope * std::abs(single_lobe(effective, slope) - truth);
        all += slope * truth;
    }
    return off / all;
}

TEST(NormalVariance, WidenedLobeIsNearTheAveragedOne) {
    for (const double alpha : {.02, .1, .3})
        for (const double sigma : {.05, .15}) {
            SlopeMoments<double> sums;
            Vec3<double> mean(0);
            for (int i = 0; i < 4000; ++i) {
                const Sample2 u = r2_sequence(static_cast<std::uint64_t>(i), 7);
                const double r = sigma * std::sqrt(-2 * std::log(1 - u.u1)),
                             phi = 2 * std::numbers::pi * u.u2;
                const Vec3<double> n = tilted(r * std::cos(phi), r * std::sin(phi));
                sums.add(n, alpha);
                mean += n / 4000.;
            }
            const double kept = lobe_distance(sigma, alpha, alpha);
            const double slopes = lobe_distance(sigma, alpha, sums.alpha());
            const double toksvig = lobe_distance(sigma, alpha, alpha_toksvig(alpha, glm::length(mean)));
            EXPECT_LT(slopes, .75) << alpha << " " << sigma << " " << kept;
            EXPECT_NEAR(slopes, toksvig, .1)
                << alpha << " " << sigma;  // the two agree where normals are exact
            if (sigma > alpha) {
                EXPECT_LT(slopes, kept) << alpha << " " << sigma;
            }
        }
}

TEST(NormalVariance, SlopesDontMindNormalsOfEightBitsAndToksvigDoes) {
    // The same level ground, stored in 8 bits: lengths differ from 1 by rounding alone.
    const auto stored = [](const Vec3<double>& n) {
        return Vec3<double>(std::round((n.x + 1) * 127.5), std::round((n.y + 1) * 127.5),
                            std::round((n.z + 1) * 127.5)) /
                   127.5 -
               Vec3<double>(1);
    };
    double worst_toksvig = 0, worst_slopes = 0;
    for (int i = 0; i < 300; ++i) {
        const Vec3<double> n = stored(tilted(random_unit(8, i) - .5, random_unit(9, i) - .5));
        SlopeMoments<double> sums;
        sums.add(n, .01);
        worst_slopes = std::max(worst_slopes, sums.alpha());
        worst_toksvig = std::max(worst_toksvig, alpha_toksvig(.01, glm::length(n)));
    }
    EXPECT_NEAR(worst_slopes, .01, 1e-9);
    EXPECT_GT(worst_toksvig, .08);
    EXPECT_LT(worst_toksvig, .12);
}

}  // namespace
}  // namespace pbr
