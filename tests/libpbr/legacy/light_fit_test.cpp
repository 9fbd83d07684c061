#include "pbr/legacy/light_fit.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "pbr/light/disk_light.hpp"
#include "pbr/light/rectangle_light.hpp"

namespace pbr {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180;

Falloff quake(double range) {
    Falloff law;
    law.window = FalloffWindow::ramp;
    law.range = range;
    return law;
}

/// Root mean square of stops by Simpson's rule of the plain formulas: shares no code with the fit.
double simpson_stops(const std::function<double(double)>& a, const std::function<double(double)>& b,
                     double near, double far) {
    constexpr int kParts = 2000;
    const auto f = [&](double d) { return std::pow(std::log2(a(d) / b(d)), 2); };
    double sum = f(near) + f(far);
    for (int i = 1; i < kParts; ++i) sum += f(near + (far - near) * i / kParts) * (i % 2 ? 4 : 2);
    return std::sqrt(sum / (3 * kParts));
}

double karis(double x) { return x < 1 ? std::pow(1 - std::pow(x, 4), 2) : 0; }

TEST(LightFit, ConstantAndQuadraticAreADiskOnItsAxis) {
    for (const double c : {.25, 1., 9.})
        for (const double q : {.00111109, .04, 1., 300.}) {
            const Falloff law{c, 0, q};
            const LightFit fit = fit_light(law, 5, EmitterShape::disk, LightWindow::quartic_squared,
                                           distances_that_matter(law, 5, .01));
            EXPECT_TRUE(fit.is_exact);
            EXPECT_NEAR(fit.light.intensity / (5 / q), 1, 1e-12);
            EXPECT_NEAR(fit.light.radius / std::sqrt(c / q), 1, 1e-12);
            EXPECT_LE(fit.error.max, 1e-6);
            // The witness is libpbr's disk light, in luminance and projected solid angle.
            const double r = fit.light.radius, luminance = fit.light.intensity / (kPi * r * r);
            for (const double share : {.01, .3, 1., 4., 60.}) {
                const double d = share * r;
                const DiskLight<double> disk{{0, 0, d}, {0, 0, -1}, r};
                EXPECT_NEAR(luminance * projected_solid_angle(disk, Vec3<double>(0), Vec3<double>(0, 0, 1)) *
                                (c + q * d * d) / 5,
                            1, 1e-6);
                EXPECT_NEAR(illuminance_at(fit.light, d) * (c + q * d * d) / 5, 1, 1e-12);
            }
        }
}

TEST(LightFit, SquareIsTheRectangleLightOnItsAxis) {
    const PhysicalLight light{EmitterShape::rectangle, LightWindow::quartic_squared, 12, .5};
    for (const double d : {.01, .2, 1., 5., 100.}) {
        const RectangleLight<double> square{{0, 0, d}, {0, .5, 0}, {.5, 0, 0}};
        const double expected =
            12. / 1. * projected_solid_angle(square, Vec3<double>(0), Vec3<double>(0, 0, 1));
        EXPECT_NEAR(illuminance_at(light, d) / expected, 1, 1e-9) << d;
    }
}

TEST(LightFit, QuakesRampIsNearWithASourceRadiusAndFarWithout) {
    const Falloff law = quake(300);
    const DistanceSpan span = distances_that_matter(law, 300, 1e-9);
    EXPECT_NEAR(span.near, 15, 1e-6);
    EXPECT_NEAR(span.far, 270, 1e-6);
    const LightFit point = fit_light(law, 300, EmitterShape::point, LightWindow::quartic_squared, span);
    const LightFit disk = fit_light(law, 300, EmitterShape::disk, LightWindow::quartic_squared, span);
    EXPECT_GT(point.error.rms, 1);
    EXPECT_LE(disk.error.rms, .15);
    EXPECT_GE(disk.light.attenuation_radius, 270);
    const double r = disk.light.radius, end = disk.light.attenuation_radius;
    const double simpson =
        simpson_stops([&](double d) { return disk.light.intensity / (d * d + r * r) * karis(d / end); },
                      [](double d) { return 300 * (1 - d / 300); }, span.near, span.far);
    EXPECT_NEAR(disk.error.rms, simpson, 1e-3);
    RecordProperty("point_stops", std::to_string(point.error.rms));
    RecordProperty("disk_stops", std::to_string(disk.error.rms));
}

/// Laws drawn from i alone; every fourth ends in the same way.
Falloff drawn_law(int i) {
    const auto draw = [&](int j) {  // Weyl sequences of irrational steps
        const double x = (i + 1) * std::sqrt(j * j + 2.) + j * .37;
        return x - std::floor(x);
    };
    Falloff law{draw(1), draw(2), draw(3) * draw(3)};
    law.range = 2 + 30 * draw(4);
    law.begin = .5 * law.range * draw(5);
    constexpr FalloffWindow kWindows[] = {FalloffWindow::none, FalloffWindow::ramp, FalloffWindow::smoothstep,
                                          FalloffWindow::cut};
    law.window = kWindows[i % 4];
    law.exponent = 1 + 2 * draw(6);
    return law;
}

/// A dozen laws, each against 40,000 lights on an even grid of radius and end, by the plain formulas at
/// distances of its own: neither the zoom nor the parametrisation nor the distances are shared.
TEST(LightFit, IsWithinTwoPercentOfTheBestOfADenseSearch) {
    constexpr int kDistances = 40, kRadii = 200, kEnds = 200;
    for (int i = 0; i < 12; ++i) {
        const Falloff law = drawn_law(i);
        const DistanceSpan span = distances_that_matter(law, 1, 1. / 256);
        std::array<double, kDistances> squares, ratios;
        // What no intensity makes up for of a light's distance from the law.
        const auto spread = [&](double radius, double end) {
            double sum = 0, sum_of_squares = 0;
            for (std::size_t n = 0; n < kDistances; ++n) {
                const double window = end == kInfinity ? 1 : karis(std::sqrt(squares[n]) / end);
                const double stops = std::log2(window * ratios[n] / (squares[n] + radius * radius));
                sum += stops, sum_of_squares += stops * stops;
            }
            const double mean = sum / kDistances;
            return std::sqrt(std::max(sum_of_squares / kDistances - mean * mean, 0.));
        };
        for (std::size_t n = 0; n < kDistances; ++n) {
            const double d = span.near + (span.far - span.near) * (static_cast<double>(n) + .5) / kDistances;
            squares[n] = d * d, ratios[n] = 1 / falloff_at(law, d);
        }
        double least = kInfinity;
        for (int k = 0; k <= (has_range(law) ? kEnds : 0); ++k)
            for (int j = 0; j <= kRadii; ++j) {
                const double share = static_cast<double>(k) / kEnds, part = static_cast<double>(j) / kRadii;
                const double end =
                    has_range(law) ? span.far * (1.0005 + 3 * share * share * share) : kInfinity;
                least = std::min(least, spread(4 * span.far * part * part, end));
            }
        const LightFit fit = fit_light(law, 1, EmitterShape::disk, LightWindow::quartic_squared, span);
        EXPECT_LE(spread(fit.light.radius, fit.light.attenuation_radius), 1.02 * least) << "law " << i;
        RecordProperty("law_" + std::to_string(i), std::to_string(fit.error.rms));
    }
}

TEST(LightFit, IsTheSameInAnyUnitOfLengthAndIntensity) {
    const LightFit one =
        fit_light(quake(300), 300, EmitterShape::disk, LightWindow::quartic_squared, {15, 270});
    const LightFit other =
        fit_light(quake(3), 1, EmitterShape::disk, LightWindow::quartic_squared, {.15, 2.7});
    EXPECT_NEAR(one.light.radius / other.light.radius, 100, 1e-3);
    EXPECT_NEAR(one.light.intensity / other.light.intensity, 300 * 1e4, 300);
    EXPECT_NEAR(one.error.rms, other.error.rms, 1e-6);
}

TEST(LightFit, WindowOfItsOwnFormIsExact) {
    Falloff law{0, 0, 1};
    law.window = FalloffWindow::quartic;
    law.range = 10;
    const LightFit gltf = fit_light(law, 20, EmitterShape::point, LightWindow::quartic, {.5, 9});
    EXPECT_TRUE(gltf.is_exact);
    EXPECT_EQ(gltf.light.attenuation_radius, 10);
    EXPECT_LE(gltf.error.max, 1e-12);
    const LightFit other = fit_light(law, 20, EmitterShape::point, LightWindow::quartic_squared, {.5, 9});
    EXPECT_FALSE(other.is_exact);
    EXPECT_LE(other.error.rms, .2);
}

TEST(LightFit, DistancesThatMatterKnowNoConstantAndNoDarkLight) {
    EXPECT_EQ(distances_that_matter(Falloff{1, 0, 0}, 1, .01).far, 0);
    EXPECT_EQ(distances_that_matter(Falloff{0, 0, 1}, 0, .01).far, 0);
    Falloff nowhere{0, 0, 1};
    nowhere.window = FalloffWindow::cut;
    nowhere.range = 0;
    EXPECT_EQ(distances_that_matter(nowhere, 1, .01).far, 0);
    EXPECT_NEAR(distances_that_matter(Falloff{0, 0, 1}, 1e6, .01).far, 9e3, 1e-6);
}

/// Differences whose largest is known: at the near end, at the far end, at a kink and at a smooth peak
/// between grid points, whatever the count.
TEST(LightFit, LargestErrorIsOfTheWholeSpan) {
    const PhysicalLight point{EmitterShape::point, LightWindow::quartic_squared, 1, 0, kInfinity};
    for (const int count : {16, 256, 4096}) {
        // 1 / d^2 against 1 / d, log2(d) apart.
        const StopsError near = stops_between(point, Falloff{0, 1, 0}, 1, {.05, 2}, count);
        EXPECT_NEAR(near.max, std::log2(20), 1e-12) << count;
        EXPECT_EQ(near.max_at, .05);
        const StopsError far = stops_between(point, Falloff{0, 1, 0}, 1, {.7, 13}, count);
        EXPECT_NEAR(far.max, std::log2(13), 1e-12) << count;
        EXPECT_EQ(far.max_at, 13);
        Falloff floored;
        floored.power = 2, floored.floor = 9;
        PhysicalLight disk = point;
        disk.shape = EmitterShape::disk, disk.radius = 3;
        // max(d^2, 9) / (d^2 + 9) is lowest at the kink, d = 3: one half.
        const StopsError kink = stops_between(disk, floored, 1, {1, 10}, count);
        EXPECT_NEAR(kink.max, 1, 1e-6) << count;
        EXPECT_NEAR(kink.max_at, 3, 1e-5) << count;
        // 2 d / (1 + d^2) is 1 at d = 1: of twice that light, the difference peaks there at 1 and is smooth.
        disk.radius = 1, disk.intensity = 4;
        const StopsError smooth = stops_between(disk, Falloff{0, 1, 0}, 1, {.3, 3}, count);
        EXPECT_NEAR(smooth.max, 1, 1e-12) << count;
        EXPECT_NEAR(smooth.max_at, 1, 1e-5) << count;
    }
}

TEST(LightFit, DarknessCountsAsManyStops) {
    PhysicalLight light{EmitterShape::point, LightWindow::quartic, 1, 0, 5};
    const StopsError error = stops_between(light, Falloff{0, 0, 1}, 1, {1, 9}, 64);
    EXPECT_EQ(error.max, kDarkStops);
    EXPECT_TRUE(std::isfinite(error.rms));
}

TEST(SpotFit, GltfsRampAndHardConesAreExact) {
    const SpotFit ramp = fit_spot({SpotLaw::cosine_ramp, 20 * kDegree, 40 * kDegree, 2});
    EXPECT_TRUE(ramp.is_exact);
    EXPECT_EQ(ramp.inner_rad, 20 * kDegree);
    const SpotFit hard = fit_spot({SpotLaw::hard, 0, 30 * kDegree, 1});
    EXPECT_TRUE(hard.is_exact);
    EXPECT_EQ(hard.inner_rad, hard.outer_rad);
    EXPECT_TRUE(fit_spot({SpotLaw::hard, 0, 0, 1}).is_exact);
}

TEST(SpotFit, CosinePowersKeepShapeAndFlux) {
    // glTF's square ramp can't have a broad lobe's soft edge at 90 degrees: below exponent 2 it stays apart.
    for (const auto& [exponent, largest] :
         {std::pair{.15, .17}, {1., .12}, {2., 1e-4}, {4., .05}, {32., .05}, {128., .05}}) {
        const SpotFit fit = fit_spot({SpotLaw::cosine_power, 0, kPi / 2, exponent});
        EXPECT_LE(fit.inner_rad, fit.outer_rad);
        EXPECT_LE(fit.outer_rad, kPi / 2 + 1e-12);
        EXPECT_LE(fit.error.rms_share, largest) << exponent;
        EXPECT_LE(std::abs(fit.error.flux_stops), .25) << exponent;
    }
}

TEST(SpotFit, DifferenceIsTheFitsOwnAndNoneForTheSameCone) {
    const SpotFalloff law{SpotLaw::cosine_power, 0, kPi / 2, 4};
    const SpotFit fit = fit_spot(law);
    EXPECT_NEAR(spot_difference(law, fit.inner_rad, fit.outer_rad, 4096).rms_share, fit.error.rms_share,
                1e-4);
    EXPECT_LE(spot_difference({SpotLaw::cosine_ramp, .3, .6, 2}, .3, .6, 512).max_share, 1e-12);
    // Beyond the law's cone the fitted one counts as well: (cos .6 - cos .9) of the directions are lit in
    // vain.
    const double lit = (std::cos(.6) - std::cos(.9)) / (1 - std::cos(.9));
    EXPECT_NEAR(spot_difference({SpotLaw::hard, 0, .6, 1}, .9, .9, 4096).rms_share, std::sqrt(lit), 1e-3);
}

}  // namespace
}  // namespace pbr
