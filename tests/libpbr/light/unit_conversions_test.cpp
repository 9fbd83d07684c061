#include "pbr/light/unit_conversions.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "pbr/light/solid_angle.hpp"
#include "tests/libpbr/support/integrate.hpp"
#include "tests/libpbr/support/property.hpp"

namespace pbr {
namespace {

constexpr double kPi = std::numbers::pi, kInf = std::numeric_limits<double>::infinity();
constexpr Lumens<double> kThousand(1000);

TEST(UnitConversions, GiveTheKnownFiguresOfAThousandLumens) {
    EXPECT_NEAR(intensity_from_power(kThousand, solid_angle_whole_sphere<double>()).value(), 79.5775, 5e-5);
    EXPECT_NEAR(intensity_from_power(kThousand, solid_angle_cone(kPi / 6)).value(), 1187.95, 5e-3);
    EXPECT_NEAR(intensity_of_frostbite_spot(kThousand).value(), 318.31, 5e-3);
    EXPECT_NEAR(luminance_from_power(kThousand, emitter_sphere(.1)).value(), 2533.03, 5e-3);
    EXPECT_NEAR(luminance_from_power(kThousand, emitter_disk(.1)).value(), 10132.1, 5e-2);
    EXPECT_NEAR(luminance_from_power(kThousand, emitter_rectangle(2.0, .5)).value(), 318.31, 5e-3);
    EXPECT_NEAR(luminance_from_power(kThousand, emitter_tube(.05, 1.0)).value(), 921.1, 5e-2);
}

TEST(UnitConversions, FrostbiteSpotIsTrueForAConeOfSixtyDegrees) {
    EXPECT_NEAR(
        intensity_of_frostbite_spot(kThousand) / intensity_from_power(kThousand, solid_angle_cone(kPi / 3)),
        1, 1e-14);
    EXPECT_NEAR(power_of_frostbite_spot(Candelas<double>(1)).value(), kPi, 1e-15);
}

/// Surface and largest shadow of a body of revolution about z with this profile of radius, by shells along z:
/// each has the slant of the profile. Two to the power of n shells.
Emitter<double> emitter_of_revolution(const auto& radius, double z0, double z1) {
    constexpr int kShells = 1 << 18;
    Emitter<double> sum{0, 0};
    for (int i = 0; i < kShells; ++i) {
        const double a = z0 + (z1 - z0) * i / kShells, b = z0 + (z1 - z0) * (i + 1) / kShells;
        const double ra = radius(a), rb = radius(b);
        sum.area_m2 += kPi * (ra + rb) * std::hypot(b - a, rb - ra);
        sum.facing_area_m2 += (ra + rb) * (b - a);
    }
    return sum;
}

TEST(UnitConversions, ATubeIsACylinderWithHemispheres) {
    const double r = .3, length = 1.1;
    const auto radius = [&](double z) {
        const double beyond = std::max(std::abs(z) - length / 2, 0.0);
        return std::sqrt(std::max(r * r - beyond * beyond, 0.0));
    };
    const Emitter<double> sum = emitter_of_revolution(radius, -length / 2 - r, length / 2 + r);
    const Emitter<double> tube = emitter_tube(r, length);
    EXPECT_NEAR(tube.area_m2, sum.area_m2, 1e-5);
    EXPECT_NEAR(tube.facing_area_m2, sum.facing_area_m2, 1e-5);
}

TEST(UnitConversions, ATubeWithoutLengthIsASphere) {
    EXPECT_DOUBLE_EQ(emitter_tube(.2, 0.0).area_m2, emitter_sphere(.2).area_m2);
    EXPECT_DOUBLE_EQ(emitter_tube(.2, 0.0).facing_area_m2, emitter_sphere(.2).facing_area_m2);
}

TEST(UnitConversions, PowerIsTheIntegralOfIntensityOverDirections) {
    // A disk's intensity falls with the cosine, a sphere's doesn't.
    const Candelas<double> disk = intensity_from_power(kThousand, emitter_disk(.1));
    const double flux = integrate_hemisphere([&](const Vec3<double>& w) { return disk.value() * w.z; });
    EXPECT_NEAR(flux, 1000, 1e-6);
    const Candelas<double> sphere = intensity_from_power(kThousand, emitter_sphere(.1));
    EXPECT_NEAR(integrate_sphere([&](const Vec3<double>&) { return sphere.value(); }), 1000, 1e-6);
    // A tube is as bright from every side and shows less of itself the nearer its axis one looks from.
    const double r = .05, length = 1, L = luminance_from_power(kThousand, emitter_tube(r, length)).value();
    const double tube = integrate_sphere(
        [&](const Vec3<double>& w) {
            return L * (2 * r * length * std::sqrt(std::max(0.0, 1 - w.z * w.z)) + kPi * r * r);
        },
        1e-8);
    EXPECT_NEAR(tube, 1000, 1e-4);
}

TEST(UnitConversions, GiveTheKnownFiguresOfExposureValues) {
    EXPECT_EQ(luminance_from_ev100(Ev100<double>(15)).value(), 4096);
    EXPECT_EQ(illuminance_from_ev100(Ev100<double>(15)).value(), 81'920);
    EXPECT_EQ(ev100_from_luminance(Nits<double>(4096)).value(), 15);
    EXPECT_NEAR(ev100_from_illuminance(Lux<double>(81'920)).value(), 15, 1e-14);
    EXPECT_EQ(luminance_from_ev100(Ev100<float>(3)).value(), 1);  // 2^(EV - 3)
}

TEST(UnitConversions, NoLightIsAnExposureValueOfMinusInfinity) {
    EXPECT_EQ(ev100_from_luminance(Nits<double>(0)).value(), -kInf);
    EXPECT_EQ(ev100_from_illuminance(Lux<double>(0)).value(), -kInf);
    EXPECT_EQ(luminance_from_ev100(Ev100<double>(-kInf)).value(), 0);
    EXPECT_EQ(illuminance_from_ev100(Ev100<double>(-kInf)).value(), 0);
    EXPECT_TRUE(std::isnan(ev100_from_luminance(Nits<double>(-1)).value()));
    EXPECT_EQ(luminance_from_ev100(Ev100<float>(128)).value(), std::numeric_limits<float>::infinity());
    EXPECT_LT(luminance_from_ev100(Ev100<float>(127.9f)).value(), std::numeric_limits<float>::infinity());
}

TEST(UnitConversions, OfDegenerateShapesAreLimits) {
    const Emitter<double> none = emitter_disk(0.0);
    const Lumens<double> lit(5), dark(0);
    EXPECT_EQ(luminance_from_power(lit, none).value(), kInf);
    EXPECT_EQ(luminance_from_power(dark, none).value(), 0);
    EXPECT_EQ(luminance_from_intensity(Candelas<double>(1), none).value(), kInf);
    EXPECT_EQ(luminance_from_intensity(Candelas<double>(0), none).value(), 0);
    EXPECT_EQ(intensity_from_power(lit, none).value(), 0);
    EXPECT_EQ(power_from_intensity(Candelas<double>(1), none).value(), 0);
    EXPECT_EQ(intensity_from_power(lit, Steradians<double>(0)).value(), kInf);
    EXPECT_EQ(intensity_from_power(dark, Steradians<double>(0)).value(), 0);
}

RC_GTEST_PROP(UnitConversions, UndoEachOther, ()) {
    const double x = *log_uniform(1e-6, 1e12), r = *log_uniform(1e-4, 1e3), l = *log_uniform(1e-4, 1e3);
    const auto same = [](double a, double b) { return ulp_distance(a, b) <= 8; };
    const Lumens<double> lm(x);
    const Candelas<double> cd(x);
    const Nits<double> nit(x);
    const Steradians<double> sr = solid_angle_cone(*uniform(0.01, kPi));
    RC_ASSERT(same(power_from_intensity(intensity_from_power(lm, sr), sr).value(), x));
    RC_ASSERT(same(power_of_frostbite_spot(intensity_of_frostbite_spot(lm)).value(), x));
    for (const Emitter<double>& shape :
         {emitter_sphere(r), emitter_disk(r), emitter_rectangle(r, l), emitter_tube(r, l)}) {
        RC_ASSERT(same(power_from_luminance(luminance_from_power(lm, shape), shape).value(), x));
        RC_ASSERT(same(intensity_from_luminance(luminance_from_intensity(cd, shape), shape).value(), x));
        RC_ASSERT(same(power_from_intensity(intensity_from_power(lm, shape), shape).value(), x));
        // Both ways round the triangle.
        RC_ASSERT(same(intensity_from_luminance(luminance_from_power(lm, shape), shape).value(),
                       intensity_from_power(lm, shape).value()));
    }
    RC_ASSERT(std::abs(luminance_from_ev100(ev100_from_luminance(nit)).value() / x - 1) < 2e-14);
    RC_ASSERT(std::abs(illuminance_from_ev100(ev100_from_illuminance(Lux<double>(x))).value() / x - 1) <
              2e-14);
}

RC_GTEST_PROP(UnitConversions, InFloatAreWithinFourUlpsOfDouble, ()) {
    const float x = static_cast<float>(*log_uniform(1e-3, 1e9)),
                r = static_cast<float>(*log_uniform(1e-3, 1e3));
    const Emitter<double> shape{r, r};
    const Emitter<float> single{r, r};
    const auto ulps = [](auto a, auto b) { return ulp_distance(a.value(), static_cast<float>(b.value())); };
    RC_ASSERT(ulps(luminance_from_power(Lumens<float>(x), single),
                   luminance_from_power(Lumens<double>(x), shape)) <= 4);
    RC_ASSERT(ulps(intensity_from_power(Lumens<float>(x), single),
                   intensity_from_power(Lumens<double>(x), shape)) <= 4);
    RC_ASSERT(ulps(power_from_luminance(Nits<float>(x), single),
                   power_from_luminance(Nits<double>(x), shape)) <= 4);
    const float ev = static_cast<float>(*uniform(-20, 30));
    RC_ASSERT(ulps(luminance_from_ev100(Ev100<float>(ev)), luminance_from_ev100(Ev100<double>(ev))) <= 4);
}

}  // namespace
}  // namespace pbr
