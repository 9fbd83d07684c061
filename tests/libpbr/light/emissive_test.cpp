#include "pbr/light/emissive.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "pbr/camera/exposure.hpp"
#include "tests/libpbr/support/integrate.hpp"

namespace pbr {
namespace {

TEST(Emissive, AboveTheCameraKeepsItsPixelValueAtAnyExposure) {
    const Stops<double> above(2);
    for (const double ev : {-6.0, 0.0, 9.5, 16.0}) {
        const Nits<double> L = emissive_luminance(Ev100<double>(ev), above);
        EXPECT_NEAR(L.value() * exposure_by_saturation(Ev100<double>(ev)), 4 * 12.5 / 120, 1e-14) << ev;
    }
    EXPECT_EQ(emissive_luminance(Ev100<double>(15), Stops<double>(0)).value(), 4096);
    EXPECT_EQ(emissive_luminance(Ev100<double>(-std::numeric_limits<double>::infinity()), above).value(), 0);
}

TEST(Emissive, ExitanceIsTheLightOfAHemisphere) {
    const double sum = integrate_hemisphere([](const Vec3<double>& w) { return 7 * w.z; });
    EXPECT_NEAR(exitance_from_luminance(Nits<double>(7)).value(), sum, 1e-9);
    EXPECT_DOUBLE_EQ(luminance_from_exitance(exitance_from_luminance(Nits<double>(7))).value(), 7);
}

TEST(Emissive, TrianglesOfAMeshAddUpToItsArea) {
    // A regular tetrahedron of edge sqrt 2 has the area 2 sqrt 3.
    const Vec3<double> a(0, 0, 0), b(1, 1, 0), c(1, 0, 1), d(0, 1, 1);
    const double area =
        triangle_area(a, b, c) + triangle_area(a, b, d) + triangle_area(a, c, d) + triangle_area(b, c, d);
    EXPECT_NEAR(area, 2 * std::sqrt(3), 1e-14);
    EXPECT_EQ(triangle_area(a, b, 2.0 * b), 0);
    EXPECT_EQ(triangle_area(a, a, a), 0);
    EXPECT_NEAR(triangle_area(Vec3<float>(0), Vec3<float>(1e-25f, 0, 0), Vec3<float>(0, 1, 0)) / 5e-26f, 1,
                1e-6);
}

}  // namespace
}  // namespace pbr
