#include "bakers/verify/picture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "pbr/ibl/cubemap.hpp"

namespace pbrbake::verify {
namespace {

using testing::StartsWith;

/// A cube map whose texels are a function of their direction.
template <class Colour>
Image cube_of(int size, const Colour& colour) {
    Image image;
    image.channels = {"R", "G", "B"};
    image.faces = 6;
    image.levels.push_back({size, size, std::vector<float>(static_cast<std::size_t>(size) * size * 18)});
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const glm::dvec3 rgb = colour(face, pbr::cubemap_texel_direction({face, x, y}, size));
                for (int c = 0; c < 3; ++c) image.texel(0, face, y, x)[c] = static_cast<float>(rgb[c]);
            }
    return image;
}

TEST(DisplayTransform, IsSrgbAndClips) {
    EXPECT_EQ(srgb_byte(0), 0);
    EXPECT_EQ(srgb_byte(1), 255);
    EXPECT_EQ(srgb_byte(0.2140), 127);  // IEC 61966-2-1: 127/255 is .2122, 128/255 is .2159
    EXPECT_EQ(srgb_byte(0.0031308), 10);
    EXPECT_EQ(srgb_byte(-1), 0);
    EXPECT_EQ(srgb_byte(1e9), 255);
    EXPECT_EQ(srgb_byte(std::numeric_limits<double>::infinity()), 255);
    EXPECT_EQ(srgb_byte(std::numeric_limits<double>::quiet_NaN()), 0);
}

TEST(Exposure, DoublesALuminanceForAStep) {
    EXPECT_DOUBLE_EQ(exposure_of_ev100(0), 1 / 1.2);
    EXPECT_DOUBLE_EQ(exposure_of_ev100(14) * 2, exposure_of_ev100(13));
}

TEST(FalseColour, EndsAtTheScalesEndsAndGetsLighter) {
    EXPECT_EQ(false_colour(-1), false_colour(0));
    EXPECT_EQ(false_colour(2), false_colour(1));
    EXPECT_EQ(false_colour(std::numeric_limits<double>::quiet_NaN()), false_colour(0));
    for (double value = 0; value < 0.99; value += 0.01)
        EXPECT_LT(glm::dot(false_colour(value), {0.2126, 0.7152, 0.0722}),
                  glm::dot(false_colour(value + 0.01), {0.2126, 0.7152, 0.0722}));
}

TEST(Cross, PutsNeighboursOfTheCubeSideBySide) {
    constexpr int n = 32;
    const Image cube = cube_of(n, [](int, const glm::dvec3& d) { return 0.5 + 0.5 * d; });
    const Picture cross = cross_picture(cube, 0, 1, {9, 9, 9});
    ASSERT_EQ(cross.width, 4 * n);
    ASSERT_EQ(cross.height, 3 * n);
    const auto near = [&](int x0, int y0, int x1, int y1) {
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(cross.pixel(x0, y0)[c], cross.pixel(x1, y1)[c], 8) << x0 << "," << y0;
    };
    for (int i = 0; i < n; ++i) {
        for (const int edge : {n, 2 * n, 3 * n}) near(edge - 1, n + i, edge, n + i);  // along the middle row
        near(n + i, n - 1, n + i, n);                                                 // +Y above +Z
        near(n + i, 2 * n - 1, n + i, 2 * n);                                         // -Y below +Z
    }
    EXPECT_EQ(cross.pixel(0, 0)[0], 9);
}

TEST(Cross, HasPlusZInTheMiddleAndPlusXToItsRight) {
    const Image cube =
        cube_of(4, [](int face, const glm::dvec3&) { return glm::dvec3(face == 0, face == 4, face == 2); });
    const Picture cross = cross_picture(cube, 0, 1, {0, 0, 0});
    EXPECT_EQ(cross.pixel(6, 6)[1], 255);
    EXPECT_EQ(cross.pixel(10, 6)[0], 255);
    EXPECT_EQ(cross.pixel(6, 2)[2], 255);
}

TEST(Ball, ReflectsTheCameraInItsMiddleAndWhatIsBehindAtItsRim) {
    const View view({0, 0, -1});  // looks at -z, so +x is right and +y up

    const Picture ball = ball_picture(64, view, [](const glm::dvec3&, const glm::dvec3& reflected) {
        return glm::dvec3(reflected.z > 0.9, reflected.x > 0.7, reflected.y > 0.7);
    });
    EXPECT_EQ(ball.pixel(32, 32)[0], 255);
    EXPECT_EQ(ball.pixel(32 + 23, 32)[1], 255);
    EXPECT_EQ(ball.pixel(32 - 23, 32)[1], 0);
    EXPECT_EQ(ball.pixel(32, 32 - 23)[2], 255);
}

TEST(Level, IsReadInItsDirectionAndUnscaled) {
    for (const int size : {16, 15, 24, 100}) {
        const Image cube = cube_of(size, [](int, const glm::dvec3& d) { return 0.25 * (glm::dvec3(2) + d); });
        const Radiance radiance = radiance_of_level(cube, 0, 0.25);
        for (const glm::dvec3& d :
             {glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0.3, 0.2, -1),
              glm::normalize(glm::dvec3(1, 2, -3)), glm::normalize(glm::dvec3(1, 1, 1))})
            EXPECT_LT(glm::length(radiance(d) - (glm::dvec3(2) + d)), 0.1) << size;
    }
}

TEST(Strip, ShowsEveryBallBeforeTheBackground) {
    const Picture strip = strip_picture({90, 30, 3, 60, View({0, 0, -1}),
                                         [](int ball, const glm::dvec3&, const glm::dvec3&) {
                                             return glm::dvec3(ball == 0, ball == 1, ball == 2);
                                         },
                                         [](const glm::dvec3&) { return glm::dvec3(1); }});
    for (int ball = 0; ball < 3; ++ball)
        for (int c = 0; c < 3; ++c) EXPECT_EQ(strip.pixel(15 + 30 * ball, 15)[c], c == ball ? 255 : 0);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(strip.pixel(0, 0)[c], 255);
}

TEST(DataUri, HoldsAPng) {
    Picture picture(2, 1);
    EXPECT_THAT(data_uri(picture), StartsWith("data:image/png;base64,iVBORw0KGgo"));
}

}  // namespace
}  // namespace pbrbake::verify
