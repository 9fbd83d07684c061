#include "bakers/verify/flip.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/bakers/verify/flip_pictures.hpp"

namespace pbrbake::verify {
namespace {

namespace test = pbrbake::test;
using test::kPictureHeight;
using test::kPictureWidth;

template <class Formula>
LinearPicture picture(const Formula& formula, bool test) {
    LinearPicture result(kPictureWidth, kPictureHeight);
    for (int y = 0; y < kPictureHeight; ++y)
        for (int x = 0; x < kPictureWidth; ++x) result.at(x, y) = formula(x, y, test);
    return result;
}

/// What NVIDIA's own implementation says (FLIP.h 1.6 of github.com/NVlabs/flip, CPU, default parameters) of
/// the same pictures: mean, largest, and two pixels.
struct Witness {
    double mean, max, at_40_30, at_62_20;
};

/// Largest disagreement: the two have other digits of the Rec. 709 matrix, and floats in other places.
constexpr double kAgreement = 2e-5;

void expect_agreement(const FlipMap& map, const Witness& witness) {
    const auto at = [&](int x, int y) { return map.error[static_cast<std::size_t>(y) * map.width + x]; };
    EXPECT_NEAR(map.mean(), witness.mean, kAgreement);
    EXPECT_NEAR(map.max(), witness.max, kAgreement);
    EXPECT_NEAR(at(40, 30), witness.at_40_30, kAgreement);
    EXPECT_NEAR(at(62, 20), witness.at_62_20, kAgreement);
}

TEST(LdrFlip, AgreesWithNvidias) {
    const auto flip = [](const auto& formula) {
        return ldr_flip(picture(formula, false), picture(formula, true));
    };
    expect_agreement(flip(test::bars), {.2529421, .7669649, .0611037, .2265428});
    expect_agreement(flip(test::sky), {.0736510, .2998876, .0050468, 0});
    expect_agreement(flip(test::lamps), {.0901074, .7449672, .0107269, .0037940});
}

TEST(HdrFlip, AgreesWithNvidias) {
    const auto flip = [](const auto& formula) {
        return hdr_flip(picture(formula, false), picture(formula, true));
    };
    expect_agreement(flip(test::bars), {.3318105, .6919942, .0878416, .3090665});
    expect_agreement(flip(test::sky), {.0725412, .4580531, .0766154, .4580531});
    expect_agreement(flip(test::lamps), {.1210684, .7677175, .0265580, .0114289});
}

TEST(FlipExposures, AgreeWithNvidias) {
    const auto [bars_start, bars_stop] = flip_exposures(picture(test::bars, false));
    EXPECT_NEAR(bars_start, 1.705937, 1e-4);
    EXPECT_NEAR(bars_stop, 3.423018, 1e-4);
    const auto [sky_start, sky_stop] = flip_exposures(picture(test::sky, false));
    EXPECT_NEAR(sky_start, -12.707376, 1e-4);
    EXPECT_NEAR(sky_stop, 1.092795, 1e-4);
}

TEST(FlipExposures, OfAMostlyBlackPictureAreFinite) {
    LinearPicture black(8, 8);
    EXPECT_EQ(flip_exposures(black), std::pair(0.0, 0.0));
    black.at(3, 3) = glm::dvec3(2);
    const auto [start, stop] = flip_exposures(black);
    EXPECT_EQ(start, stop);
    EXPECT_TRUE(std::isfinite(start));
}

TEST(Flip, OfEqualPicturesIsZero) {
    const LinearPicture sky = picture(test::sky, false);
    EXPECT_EQ(ldr_flip(sky, sky).max(), 0);
    EXPECT_EQ(hdr_flip(sky, sky).max(), 0);
    const LinearPicture black(16, 8);
    EXPECT_EQ(hdr_flip(black, black).max(), 0);
}

TEST(Flip, IsSymmetricAndAtMostOne) {
    const LinearPicture a = picture(test::bars, false), b = picture(test::lamps, true);
    const FlipMap ab = ldr_flip(a, b), ba = ldr_flip(b, a);
    for (std::size_t i = 0; i < ab.error.size(); ++i) EXPECT_DOUBLE_EQ(ab.error[i], ba.error[i]);
    EXPECT_LE(ab.max(), 1);
    EXPECT_GT(ab.max(), 0.5);
}

TEST(Flip, PinnedExposuresAreUsed) {
    const LinearPicture a = picture(test::sky, false), b = picture(test::sky, true);
    const auto own = flip_exposures(a);
    EXPECT_EQ(hdr_flip(a, b, own).mean(), hdr_flip(a, b).mean());
    EXPECT_LT(hdr_flip(a, b, std::pair(-40.0, -38.0)).mean(), 1e-3);  // all is black there
}

}  // namespace
}  // namespace pbrbake::verify
