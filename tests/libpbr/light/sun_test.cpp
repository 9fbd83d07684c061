#include "pbr/light/sun.hpp"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <limits>

#include "pbr/brdf/ggx.hpp"
#include "tests/libpbr/support/integrate.hpp"
#include "tests/libpbr/support/property.hpp"

namespace pbr {
namespace {

using Vec = Vec3<double>;
constexpr double kPi = std::numbers::pi;

TEST(Sun, HasTheKnownSizeAndLuminance) {
    EXPECT_NEAR(kSunHalfAngle_rad, .00465, 5e-6);
    EXPECT_NEAR(kSunHalfAngle_rad, std::asin(695'700 / 149'597'870.7), 3e-13);
    EXPECT_NEAR(solid_angle_of_sun<double>().value(), 6.794e-5, 5e-9);
    EXPECT_NEAR(solid_angle_of_sun<float>().value() / solid_angle_of_sun<double>().value(), 1, 5e-7);
    EXPECT_NEAR(disk_luminance_from_illuminance(Lux<double>(1e5), kSunHalfAngle_rad).value(), 1.472e9, 5e5);
}

TEST(Sun, IlluminanceIsTheIntegralOfItsDisk) {
    for (const double s : {kSunHalfAngle_rad, .1, .7, kPi / 2}) {
        const double sum = integrate_directions([](const Vec& w) { return 3 * w.z; }, std::cos(s), 1);
        // cos(s) as the integral's end has a rounding of 1e-16, which is 1e-11 of a sun.
        EXPECT_NEAR(illuminance_from_disk_luminance(Nits<double>(3), s).value() / sum, 1, 2e-11) << s;
    }
    EXPECT_NEAR(illuminance_from_disk_luminance(Nits<double>(3), kPi / 2).value(), 3 * kPi, 1e-14);
    EXPECT_EQ(illuminance_from_disk_luminance(Nits<double>(3), 0.0).value(), 0);
    EXPECT_EQ(disk_luminance_from_illuminance(Lux<double>(3), 0.0).value(),
              std::numeric_limits<double>::infinity());
}

TEST(Sun, IlluminanceIsLessThanLuminanceTimesSolidAngleByItsCosines) {
    const double s = kSunHalfAngle_rad;
    const double E = illuminance_from_disk_luminance(Nits<double>(1), s).value();
    EXPECT_NEAR(solid_angle_cone(s).value() / E - 1, s * s / 4, 1e-9);
    EXPECT_NEAR(s * s / 4, 5e-6, 5e-7);
}

TEST(Sun, NearestDirectionOfADiskIsTheNearestOfItsRim) {
    const Vec centre = glm::normalize(Vec(1, 2, 3)), u = glm::normalize(glm::cross(centre, Vec(0, 0, 1))),
              v = glm::cross(centre, u);
    const double s = .3;
    for (const double angle : {.31, 1.0, 2.0, 3.1}) {
        const Vec R = std::cos(angle) * centre + std::sin(angle) * (.6 * u + .8 * v);
        const Vec found = nearest_direction_of_disk(R, centre, s);
        EXPECT_NEAR(glm::dot(found, centre), std::cos(s), 1e-15);
        for (int i = 0; i < 360; ++i) {
            const double phi = i * kPi / 180;
            const Vec rim = std::cos(s) * centre + std::sin(s) * (std::cos(phi) * u + std::sin(phi) * v);
            EXPECT_LE(glm::dot(rim, R), glm::dot(found, R) + 1e-15);
        }
    }
}

TEST(Sun, NearestDirectionInsideTheDiskIsTheMirrorDirection) {
    const Vec centre(0, 0, 1), R(std::sin(.0046), 0, std::cos(.0046));
    EXPECT_EQ(nearest_direction_of_disk(R, centre, kSunHalfAngle_rad), R);
    EXPECT_EQ(nearest_direction_of_disk(centre, centre, kSunHalfAngle_rad), centre);
    EXPECT_EQ(nearest_direction_of_disk(centre, centre, 0.0), centre);
}

RC_GTEST_PROP(Sun, NearestDirectionIsAUnitVectorOnTheDiskAndContinuous, ()) {
    const Vec centre = *direction();
    const double s = *unit_interval() * kPi / 2;
    const Vec R = *rc::gen::weightedOneOf<Vec>({{1, rc::gen::element(centre, -centre)}, {3, direction()}});
    const Vec found = nearest_direction_of_disk(R, centre, s);
    RC_ASSERT(std::abs(glm::length(found) - 1) < 1e-14);
    RC_ASSERT(glm::length(found - centre) <= 2 * std::sin(s / 2) + 1e-14);
    // Across the rim.
    const Vec side =
        glm::normalize(glm::cross(centre, std::abs(centre.z) < .9 ? Vec(0, 0, 1) : Vec(1, 0, 0)));
    const double inside = s * (1 - 1e-9), outside = s * (1 + 1e-9);
    const Vec a = nearest_direction_of_disk(std::cos(inside) * centre + std::sin(inside) * side, centre, s);
    const Vec b = nearest_direction_of_disk(std::cos(outside) * centre + std::sin(outside) * side, centre, s);
    RC_ASSERT(glm::length(a - b) < 1e-8);
    const Vec3<float> single = nearest_direction_of_disk(Vec3<float>(R), Vec3<float>(centre), float(s));
    RC_ASSERT(std::abs(glm::length(single) - 1) < 1e-6f);
}

RC_GTEST_PROP(Sun, ConversionsInFloatAreWithinTheirUlpsOfDouble, ()) {
    const float s = static_cast<float>(*log_uniform(1e-6, kPi / 2)),
                x = static_cast<float>(*log_uniform(1, 1e6));
    RC_ASSERT(ulp_distance(illuminance_from_disk_luminance(Nits<float>(x), s).value(),
                           static_cast<float>(
                               illuminance_from_disk_luminance(Nits<double>(x), double(s)).value())) <= 6);
    RC_ASSERT(ulp_distance(disk_luminance_from_illuminance(Lux<float>(x), s).value(),
                           static_cast<float>(
                               disk_luminance_from_illuminance(Lux<double>(x), double(s)).value())) <= 6);
}

TEST(Sun, ShiningFromItsNearestPointIsTooBrightForSmoothSurfaces) {
    // Seen at the mirror direction, over the disk about it: mean of D against D at the centre.
    const double s = kSunHalfAngle_rad;
    for (const auto& [alpha, excess] : {std::pair{.01, 1.05}, std::pair{.001, 6.4}}) {
        const auto ring = [alpha = alpha](double t) {  // t: angle of the half vector, half of the light's
            const double c = std::cos(t), sine = std::sin(t);
            return D_ggx(c, sine * sine, alpha) * 2 * std::sin(2 * t) * 2 * kPi;
        };
        const double mean =
            boost::math::quadrature::gauss_kronrod<double, 31>::integrate(ring, 0.0, s / 2, 10, 1e-12) /
            solid_angle_cone(s).value();
        const double measured = D_ggx(1.0, 0.0, alpha) / mean;
        EXPECT_NEAR(measured, 1 + s * s / (4 * alpha * alpha), 1e-4 * measured);
        EXPECT_NEAR(measured / excess, 1, .01);
    }
}

}  // namespace
}  // namespace pbr
