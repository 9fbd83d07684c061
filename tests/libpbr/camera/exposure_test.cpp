#include "pbr/camera/exposure.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "pbr/light/emissive.hpp"
#include "tests/libpbr/support/property.hpp"

namespace pbr {
namespace {

using Ev = Ev100<double>;
constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(Exposure, OfSunnySixteenIsAsWorkedInTheHeader) {
    const Ev ev = ev100_from_settings(CameraSettings<double>{16, 1.0 / 100, 100});
    EXPECT_NEAR(ev.value(), 14.64, 5e-3);
    EXPECT_NEAR(luminance_from_ev100(ev).value(), 3200, 1e-9);
    EXPECT_NEAR(illuminance_from_ev100(ev).value(), 64'000, 1e-8);
    EXPECT_NEAR(saturation_luminance(ev).value(), 30'720, 1e-8);
    const Nits<double> grey_card = .18 * luminance_from_exitance(Lux<double>(1e5));
    EXPECT_NEAR(grey_card.value(), 5730, .5);
    EXPECT_NEAR(grey_card.value() * exposure_by_saturation(ev), .187, 5e-4);
}

TEST(Exposure, ValueRisesAStopForEachHalvingOfTheLight) {
    const CameraSettings<double> base{8, 1.0 / 60, 200};
    const double ev = ev100_from_settings(base).value();
    EXPECT_NEAR(ev, std::log2(64.0 * 60 / 2), 1e-14);
    EXPECT_NEAR(ev100_from_settings(CameraSettings<double>{8 * std::numbers::sqrt2, 1.0 / 60, 200}).value(),
                ev + 1, 1e-14);
    EXPECT_NEAR(ev100_from_settings(CameraSettings<double>{8, 1.0 / 120, 200}).value(), ev + 1, 1e-14);
    EXPECT_NEAR(ev100_from_settings(CameraSettings<double>{8, 1.0 / 60, 100}).value(), ev + 1, 1e-14);
    EXPECT_EQ(ev100_from_settings(CameraSettings<double>{1, 1, 100}).value(), 0);
}

TEST(Exposure, LensPassesOnWhatTheStandardSays) {
    const double ten = std::numbers::pi / 18;
    EXPECT_NEAR(std::numbers::pi / 4 * .9 * .98 * std::pow(std::cos(ten), 4), .652, 5e-4);
    EXPECT_NEAR(kLensAttenuation, .652, 2.5e-3);
}

TEST(Exposure, BySaturationFollowsFromTheSensorsExposure) {
    // H = q L t/N^2 is 78/S lx s at saturation and 10/S at middle grey.
    const CameraSettings<double> camera{5.6, 1.0 / 250, 400};
    const Ev ev = ev100_from_settings(camera);
    const auto sensor = [&](Nits<double> L) {
        return kLensAttenuation * L.value() * camera.shutter_s / (camera.f_number * camera.f_number);
    };
    EXPECT_NEAR(sensor(saturation_luminance(ev)), 78.0 / 400, 1e-14);
    EXPECT_NEAR(sensor(standard_output_luminance(ev)), 10.0 / 400, 1e-14);
    EXPECT_NEAR(saturation_luminance(Ev(15)).value(), 39'321.6, 1e-9);
    EXPECT_NEAR(saturation_luminance(Ev(0)).value(), 1.2, 1e-15);
    EXPECT_NEAR(standard_output_luminance(Ev(0)).value(), .1538, 5e-5);
}

TEST(Exposure, BringsWhatAMeterShowsToTheKnownGreys) {
    for (const double ev : {-3.0, 4.0, 15.0}) {
        const double mean = luminance_from_ev100(Ev(ev)).value();
        EXPECT_NEAR(mean * exposure_by_saturation(Ev(ev)), .104, 5e-4);
        EXPECT_NEAR(standard_output_luminance(Ev(ev)).value() * exposure_by_saturation(Ev(ev)), .128, 5e-4);
        EXPECT_NEAR(standard_output_luminance(Ev(ev)).value() * exposure_by_standard_output(Ev(ev)), .18,
                    1e-15);
        EXPECT_NEAR(exposure_by_standard_output(Ev(ev)) / exposure_by_saturation(Ev(ev)), 1.404, 1e-13);
    }
    EXPECT_NEAR(10 / .18, 55.6, .05);
    EXPECT_NEAR(kLensAttenuation * kReflectedMeterK, 8.1, .05);
}

TEST(Exposure, OfNoLightIsDefined) {
    const Ev black = ev100_from_luminance(Nits<double>(0));
    EXPECT_EQ(saturation_luminance(black).value(), 0);
    EXPECT_EQ(exposure_by_saturation(black), kInf);
    EXPECT_EQ(exposure_by_standard_output(black), kInf);
}

TEST(AutoExposure, ClampsTheMeterAndThenCompensates) {
    const AutoExposure<double> still{Stops<double>(0), Ev(-2), Ev(16)};
    EXPECT_EQ(auto_ev100(Nits<double>(4096), still).value(), 15);
    EXPECT_EQ(auto_ev100(Nits<double>(0), still).value(), -2);
    EXPECT_EQ(auto_ev100(Nits<double>(kInf), still).value(), 16);
    const AutoExposure<double> brighter{Stops<double>(1), Ev(-2), Ev(16)};
    EXPECT_EQ(auto_ev100(Nits<double>(4096), brighter).value(), 14);
    EXPECT_EQ(auto_ev100(Nits<double>(0), brighter).value(), -3);
    EXPECT_NEAR(exposure_by_saturation(auto_ev100(Nits<double>(100), brighter)) /
                    exposure_by_saturation(auto_ev100(Nits<double>(100), still)),
                2, 1e-14);
}

RC_GTEST_PROP(Exposure, InFloatIsWithinItsUlpsOfDouble, ()) {
    const float N = static_cast<float>(*log_uniform(.7, 64)), t = static_cast<float>(*log_uniform(1e-5, 100));
    const float S = static_cast<float>(*log_uniform(25, 1e5));
    const double exact = ev100_from_settings(CameraSettings<double>{N, t, S}).value();
    const double ulp = std::numeric_limits<float>::epsilon() * std::max(1.0, std::abs(exact));
    RC_ASSERT(std::abs(ev100_from_settings(CameraSettings<float>{N, t, S}).value() - exact) <= 4 * ulp);
    const float ev = static_cast<float>(*uniform(-20, 30));
    RC_ASSERT(ulp_distance(exposure_by_saturation(Ev100<float>(ev)),
                           static_cast<float>(exposure_by_saturation(Ev(ev)))) <= 4);
}

}  // namespace
}  // namespace pbr
