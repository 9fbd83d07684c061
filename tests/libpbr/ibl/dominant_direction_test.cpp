#include "pbr/ibl/dominant_direction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pbr/brdf/disney_diffuse.hpp"
#include "pbr/brdf/ggx.hpp"
#include "pbr/reference/reflected_radiance.hpp"
#include "tests/libpbr/support/property.hpp"

namespace pbr {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

struct Lobe {
    double alpha;
    bool correlated;
    double operator()(const Vec3<double>& wo, const Vec3<double>& wi) const {
        const Vec3<double> h = glm::normalize(wo + wi);
        return D_ggx(h.z, h.x * h.x + h.y * h.y, alpha) * (correlated
                                                               ? V_smith_ggx_correlated(wi.z, wo.z, alpha)
                                                               : V_smith_ggx_uncorrelated(wi.z, wo.z, alpha));
    }
};

Vec3<double> view(double NoV) { return {std::sqrt((1 - NoV) * (1 + NoV)), 0, NoV}; }
Vec3<double> mirror(double NoV) { return {-view(NoV).x, 0, NoV}; }
const Vec3<double> kNormal(0, 0, 1);

/// Degrees from the normal, in the plane of incidence, towards +x.
double degrees(const Vec3<double>& d) { return std::atan2(d.x, d.z) / kDegree; }

/// Where the brightest direction of lobe times NoL is, degrees.
double peak(const Lobe& lobe, double NoV) {
    double best = -1, at = 0;
    for (int i = -899; i < 900; ++i) {
        const Vec3<double> wi(std::sin(i * 0.1 * kDegree), 0, std::cos(i * 0.1 * kDegree));
        const double value = lobe(view(NoV), wi) * wi.z;
        if (value > best) best = value, at = i * 0.1;
    }
    return at;
}

/// The mean direction of a lobe, degrees.
template <class Brdf>
double mean(const Brdf& brdf, double NoV) {
    const Peak towards{mirror(NoV), 0.2};
    const auto component = [&](int axis) {
        return reflected_radiance(
                   brdf, view(NoV), [&](const Vec3<double>& w) { return w[axis]; }, {1e-5, 1e-6},
                   std::span(&towards, 1))
            .value;
    };
    return degrees({component(0), 0, component(2)});
}

constexpr double kAlphas[] = {0.1, 0.25, 0.5, 0.75, 0.9, 1};
constexpr double kViews[] = {0.1, 0.3, 0.5, 0.7, 0.9};

/// The largest distance, in degrees, of a factor's direction from a lobe's peak or mean.
template <class Factor, class Target>
double worst(const Factor& factor, const Target& target) {
    double result = 0;
    for (const double alpha : kAlphas)
        for (const double NoV : kViews) {
            const double at = degrees(dominant_direction(kNormal, mirror(NoV), factor(NoV, alpha)));
            result = std::max(result, std::abs(at - target(NoV, alpha)));
        }
    return result;
}

TEST(DominantDirection, FrostbitesFitsFindThePeakNotTheMean) {
    const auto correlated_peak = [](double NoV, double alpha) { return peak(Lobe{alpha, true}, NoV); };
    const auto uncorrelated_peak = [](double NoV, double alpha) { return peak(Lobe{alpha, false}, NoV); };
    const auto mean_of = [](double NoV, double alpha) { return mean(Lobe{alpha, true}, NoV); };
    const auto c = [](double NoV, double alpha) { return dominant_factor_peak_correlated(NoV, alpha); };
    const auto u = [](double NoV, double alpha) { return dominant_factor_peak_uncorrelated(NoV, alpha); };
    const auto fast = [](double, double alpha) { return dominant_factor_frostbite(alpha); };
    const auto filament = [](double, double alpha) { return dominant_factor_filament(alpha); };
    const auto none = [](double, double) { return 1.0; };
    EXPECT_NEAR(worst(c, correlated_peak), 8.8, 0.2);
    EXPECT_NEAR(worst(u, uncorrelated_peak), 2.9, 0.1);
    EXPECT_NEAR(worst(fast, correlated_peak), 40.2, 0.5);
    // Of the mean, the simple formula misses least, and still much.
    EXPECT_NEAR(worst(c, mean_of), 58.4, 0.5);
    EXPECT_NEAR(worst(fast, mean_of), 26.4, 0.5);
    EXPECT_NEAR(worst(filament, mean_of), 40.1, 0.5);
    EXPECT_NEAR(worst(none, mean_of), 84.3, 0.5);
    EXPECT_NEAR(std::abs(mean_of(.1, .5) - degrees(mirror(.1))), 58, 0.5);
}

TEST(DominantDirection, TakesAlphaAndNotPerceptualRoughness) {
    // Listing 21 says `roughness`: the peak says which.
    double with_alpha = 0, with_perceptual = 0;
    for (const double alpha : {0.1, 0.25, 0.5, 0.75})
        for (const double NoV : kViews) {
            const double at = peak(Lobe{alpha, false}, NoV);
            const auto miss = [&](double r) {
                return std::abs(degrees(dominant_direction(kNormal, mirror(NoV),
                                                           dominant_factor_peak_uncorrelated(NoV, r))) -
                                at);
            };
            with_alpha = std::max(with_alpha, miss(alpha));
            with_perceptual = std::max(with_perceptual, miss(std::sqrt(alpha)));
        }
    EXPECT_LT(with_alpha, 3);
    EXPECT_GT(with_perceptual, 15);
}

TEST(DominantDirection, OfDisneyDiffuseLeansToTheViewer) {
    double off = 0, off_perceptual = 0, off_above = 0, lean = 0, lean_above = 0;
    for (const double p : {.25, .5, .75, 1.})
        for (const double NoV : kViews) {
            const auto brdf = [&](const Vec3<double>& wo, const Vec3<double>& wi) {
                return f_disney_diffuse(wi.z, wo.z, glm::dot(wi, glm::normalize(wo + wi)), p);
            };
            const double at = mean(brdf, NoV);
            const auto miss = [&](double roughness) {
                return std::abs(degrees(dominant_diffuse_direction(kNormal, view(NoV), NoV, roughness)) - at);
            };
            EXPECT_GE(at, 0);
            off = std::max(off, miss(p * p));
            off_perceptual = std::max(off_perceptual, miss(p));
            lean = std::max(lean, at);
            if (NoV >= 0.5) {
                off_above = std::max(off_above, miss(p * p));
                lean_above = std::max(lean_above, at);
            }
        }
    EXPECT_NEAR(off, 4.6, 0.1);
    EXPECT_NEAR(off_perceptual, 5.7, 0.1);
    EXPECT_NEAR(lean, 11.4, 0.1);
    EXPECT_NEAR(off_above, 2.2, 0.1);
    EXPECT_NEAR(lean_above, 2.2, 0.1);
}

RC_GTEST_PROP(DominantDirection, StaysBetweenItsEnds, ()) {
    const double NoV = *unit_interval(), alpha = *unit_interval();
    const double factors[] = {dominant_factor_frostbite(alpha), dominant_factor_peak_correlated(NoV, alpha),
                              dominant_factor_peak_uncorrelated(NoV, alpha), dominant_factor_filament(alpha)};
    for (const double factor : factors) {
        RC_ASSERT(factor >= 0 && factor <= 1);
        const Vec3<double> d = dominant_direction(kNormal, mirror(NoV), factor);
        RC_ASSERT(std::abs(glm::length(d) - 1) < 1e-14);
        RC_ASSERT(d.z >= NoV - 1e-14);
        RC_ASSERT(d.x <= 0);
    }
    const Vec3<double> diffuse = dominant_diffuse_direction(kNormal, view(NoV), NoV, alpha);
    RC_ASSERT(diffuse.x >= 0);
    RC_ASSERT(std::abs(glm::length(diffuse) - 1) < 1e-14);
    const float single = dominant_factor_peak_correlated(static_cast<float>(NoV), static_cast<float>(alpha));
    if (alpha < 0.99 && NoV > 1e-3) RC_ASSERT(std::abs(single - factors[1]) < 2e-5);
    RC_ASSERT(std::abs(dominant_factor_frostbite(static_cast<float>(alpha)) - factors[0]) < 3e-4);
}

TEST(DominantDirection, HasItsEnds) {
    for (const double NoV : kViews) EXPECT_EQ(dominant_factor_peak_correlated(NoV, 0.0), 1);
    EXPECT_EQ(dominant_factor_frostbite(0.0), 1);
    EXPECT_EQ(dominant_factor_frostbite(1.0), 0);
    EXPECT_EQ(dominant_factor_filament(0.0), 1);
    EXPECT_EQ(dominant_factor_filament(1.0), 0);
    EXPECT_EQ(dominant_direction(kNormal, mirror(.6), 1.0), mirror(.6));
    EXPECT_EQ(dominant_direction(kNormal, mirror(.6), 0.0), kNormal);
    EXPECT_EQ(dominant_diffuse_direction(kNormal, view(.1), .1, 0.0), kNormal);
}

}  // namespace
}  // namespace pbr
