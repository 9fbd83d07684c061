#include "bakers/verify/metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pbrbake::verify {
namespace {

ErrorFigures figures(std::vector<float> a, std::vector<float> b, double scale = 1) {
    const std::vector<double> weights(a.size(), 1.0);
    return error_figures({std::move(a), std::move(b), {}, weights}, PixelType::half, scale);
}

TEST(UlpDistance, CountsStepsOfEachPixelType) {
    EXPECT_EQ(ulp_distance(1, 1, PixelType::half, 1), 0u);
    EXPECT_EQ(ulp_distance(1, 1 + 0x1p-10f, PixelType::half, 1), 1u);
    EXPECT_EQ(ulp_distance(1, 1 - 0x1p-11f, PixelType::half, 1), 1u);
    EXPECT_EQ(ulp_distance(1, 2, PixelType::half, 1), 1024u);
    EXPECT_EQ(ulp_distance(0, 0x1p-24f, PixelType::half, 1), 1u);                    // the least subnormal
    EXPECT_EQ(ulp_distance(-0x1p-24f, 0x1p-24f, PixelType::half, 1), 2u);            // through zero
    EXPECT_EQ(ulp_distance(0x1p-14f, 0x1p-14f - 0x1p-24f, PixelType::half, 1), 1u);  // across normal's end
    EXPECT_EQ(ulp_distance(0.f, -0.f, PixelType::half, 1), 0u);
    EXPECT_EQ(ulp_distance(65504, 65472, PixelType::half, 1), 1u);
    EXPECT_EQ(ulp_distance(1, std::nextafter(1.f, 2.f), PixelType::float32, 1), 1u);
    EXPECT_EQ(ulp_distance(-1, 1, PixelType::float32, 1), 2u * 0x3f800000u);
    EXPECT_EQ(ulp_distance(3 / 65535.f, 5 / 65535.f, PixelType::unorm16, 1), 2u);
    EXPECT_EQ(ulp_distance(3 / 255.f, 5 / 255.f, PixelType::unorm8, 1), 2u);
    EXPECT_EQ(ulp_distance(0.5f, 0.5f + 1 / 128.f, PixelType::rgbe, 1),
              1u);  // a step of the texel's exponent
}

TEST(ErrorFigures, OfKnownNumbers) {
    const ErrorFigures e = figures({1, 2, 3, 5}, {1, 2, 3, 4});
    EXPECT_EQ(e.values, 4u);
    EXPECT_EQ(e.differing, 1u);
    EXPECT_EQ(e.max_abs, 1);
    EXPECT_EQ(e.mean_abs, 0.25);
    EXPECT_EQ(e.rms, 0.5);
    EXPECT_EQ(e.relative_rms, 0.5 / 2.5);
    EXPECT_EQ(e.relative_max, 0.25);
    EXPECT_EQ(e.worst, 3u);
    EXPECT_EQ(e.relative_p50, 0);
    EXPECT_NEAR(e.relative_p99, 0.97 * 0.25, 1e-7);  // between the third and the fourth of four
    EXPECT_EQ(e.energy_a, 2.75);
    EXPECT_EQ(e.energy_b, 2.5);
    EXPECT_DOUBLE_EQ(e.energy_change, 0.1);
}

TEST(ErrorFigures, AreDividedByTheScale) {
    const ErrorFigures e = figures({1, 2, 3, 5}, {1, 2, 3, 4}, 0.25);
    EXPECT_EQ(e.max_abs, 4);
    EXPECT_EQ(e.rms, 2);
    EXPECT_EQ(e.relative_rms, 0.2);
    EXPECT_EQ(e.energy_b, 10);
}

TEST(ErrorFigures, OfADarkValueAreOverTheTypicalOne) {
    // 1e-6 is off by itself, but is a millionth of what is common.
    EXPECT_NEAR(figures({2e-6f, 1, 1}, {1e-6f, 1, 1}).relative_max, 1e-6, 1e-12);
    // One sun doesn't hide an error of what is common.
    EXPECT_NEAR(figures({1.5f, 1, 1, 60000}, {1, 1, 1, 60000}).relative_max, 0.5, 1e-7);
}

TEST(ErrorFigures, CountAndLeaveOutWhatIsNotFinite) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                    kInf = std::numeric_limits<float>::infinity();
    const ErrorFigures e = figures({kNan, 2, kInf, 1}, {1, 2, 3, kNan});
    EXPECT_EQ(e.values, 1u);
    EXPECT_EQ(e.non_finite_a, 2u);
    EXPECT_EQ(e.non_finite_b, 1u);
    EXPECT_EQ(e.max_abs, 0);
}

TEST(ErrorFigures, AgainstBlackAreInfinite) {
    const ErrorFigures e = figures({1, 0}, {0, 0});
    EXPECT_TRUE(std::isinf(e.relative_rms));
    EXPECT_TRUE(std::isinf(e.relative_max));
    EXPECT_TRUE(std::isinf(e.energy_change));
    EXPECT_EQ(figures({0, 0}, {0, 0}).relative_rms, 0);
    EXPECT_EQ(figures({}, {}).values, 0u);
}

TEST(ErrorFigures, OfFacesJoinAsOneSet) {
    const std::vector<ErrorFigures> parts{figures({1, 2}, {1, 3}), figures({4, 4}, {5, 4})};
    const ErrorFigures whole = figures({1, 2, 4, 4}, {1, 3, 5, 4}), joined = joined_figures(parts);
    EXPECT_DOUBLE_EQ(joined.rms, whole.rms);
    EXPECT_DOUBLE_EQ(joined.relative_rms, whole.relative_rms);
    EXPECT_DOUBLE_EQ(joined.energy_change, whole.energy_change);
    EXPECT_EQ(joined.differing, 2u);
    EXPECT_EQ(joined.max_abs, 1);
}

TEST(TexelWeights, OfACubeFaceSumToASixthOfTheSphere) {
    double sum = 0;
    for (const double weight : texel_weights({16, 16, {}}, true)) sum += weight;
    EXPECT_NEAR(sum, 4 * std::acos(-1.0) / 6, 1e-12);
    EXPECT_EQ(texel_weights({3, 2, {}}, false), std::vector<double>(6, 1.0));
}

}  // namespace
}  // namespace pbrbake::verify
