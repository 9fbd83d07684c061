#include "pbr/light/colour.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/matrix.hpp>

#include "tests/libpbr/support/property.hpp"

namespace pbr {
namespace {

TEST(Colour, Rec709MatricesAreThePublishedOnes) {
    // IEC 61966-2-1, four digits; GLM's columns are the matrix's rows here.
    const double published[3][3] = {{.4124, .3576, .1805}, {.2126, .7152, .0722}, {.0193, .1192, .9505}};
    const glm::dmat3 derived = xyz_from_rgb(kRec709);
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            EXPECT_NEAR(derived[column][row], published[row][column], 5.1e-5);
    const glm::dmat3 one = derived * rgb_from_xyz(kRec709);
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) EXPECT_NEAR(one[column][row], row == column, 1e-15);
}

TEST(Colour, WhiteIsOneOneOne) {
    const glm::dvec3 white = rgb_of(kRec709.white);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(white[i], 1, 1e-15);
    EXPECT_NEAR(luminance_of_rgb(glm::dvec3(1)), 1, 1e-15);
    EXPECT_NEAR(luminance_of_rgb({1, 0, 0}), .2126, 5e-5);
    EXPECT_NEAR(luminance_of_rgb({0, 1, 0}), .7152, 5e-5);
    EXPECT_NEAR(luminance_of_rgb({0, 0, 1}), .0722, 5e-5);
}

TEST(Colour, PrimariesAreTheCornersOfTheGamut) {
    const glm::dvec3 red = rgb_of(kRec709.red);
    EXPECT_NEAR(red.g, 0, 1e-15);
    EXPECT_NEAR(red.b, 0, 1e-15);
    EXPECT_NEAR(red.r, 1 / .212639, 1e-5);
}

TEST(Colour, Uv1960OfTheWhitesIsAsPublished) {
    // D65 in CIE 1960: (.1978, .3122).
    EXPECT_NEAR(uv_1960(kRec709.white).x, .1978, 5e-5);
    EXPECT_NEAR(uv_1960(kRec709.white).y, .3122, 5e-5);
}

RC_GTEST_PROP(Colour, GamutRuleKeepsLuminanceAndDirectionFromWhite, ()) {
    const double x = *uniform(.05, .7), y = *uniform(.05, .9);
    RC_PRE(x + y < 1);
    const Chromaticity c{x, y}, back = chromaticity_from_uv(uv_1960(c));
    RC_ASSERT(std::abs(back.x - x) < 1e-14 && std::abs(back.y - y) < 1e-14);
    const glm::dvec3 rgb = rgb_of(c), fitted = rgb_into_gamut(rgb);
    RC_ASSERT(std::abs(luminance_of_rgb(rgb) - 1) < 1e-13 && std::abs(luminance_of_rgb(fitted) - 1) < 1e-13);
    RC_ASSERT(fitted.r >= 0 && fitted.g >= 0 && fitted.b >= 0);
    const bool inside = rgb.r >= 0 && rgb.g >= 0 && rgb.b >= 0;
    RC_ASSERT((fitted == rgb) == inside);
    // On the line from white to the colour, between the two.
    const Chromaticity at = chromaticity_of(xyz_from_rgb(kRec709) * fitted), w = kRec709.white;
    RC_ASSERT(std::abs((at.x - w.x) * (y - w.y) - (at.y - w.y) * (x - w.x)) < 1e-13);
    RC_ASSERT((at.x - w.x) * (x - w.x) + (at.y - w.y) * (y - w.y) >= 0);
}

}  // namespace
}  // namespace pbr
