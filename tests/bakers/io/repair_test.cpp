// The rule of image.hpp for texels that are no light.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/bakers/io/fixtures.hpp"

namespace pbrbake::io::test {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

SourceImage read_row(const std::vector<float>& rgb, const std::string& working = "lin_rec709",
                     Infinity infinity = Infinity::peak) {
    TempDir dir;
    write_exr(dir / "a.exr", {.width = static_cast<int>(rgb.size() / 3),
                              .height = 1,
                              .type = "float",
                              .value = [&](const std::string& name, int x, int) {
                                  const std::size_t c = name == "R" ? 0 : name == "G" ? 1 : 2;
                                  return rgb[3 * static_cast<std::size_t>(x) + c];
                              }});
    return read_source({.path = dir / "a.exr", .working_space = working, .infinity = infinity});
}

TEST(Repair, NaNAndNegativeInfinityBecomeZero) {
    const SourceImage source = read_row({kNaN, 1, 2, -kInf, kNaN, 3});
    EXPECT_EQ(source.image.levels[0].texels, (std::vector<float>{0, 1, 2, 0, 0, 3}));
    EXPECT_EQ(source.repairs.non_finite, 2u);
    EXPECT_EQ(source.repairs.negative, 0u);
    EXPECT_EQ(source.repairs.lowest, 0);
}

TEST(Repair, InfinityBecomesTheLargestOfItsChannel) {
    const SourceImage source = read_row({kInf, 5, kInf, 7, kInf, kInf, 2, 100, kNaN});
    EXPECT_EQ(source.image.levels[0].texels, (std::vector<float>{7, 5, 0, 7, 100, 0, 2, 100, 0}));
    EXPECT_EQ(source.repairs.non_finite, 3u);
}

TEST(Repair, InfinityThatIsMeantBecomesTheLargestFloat) {
    constexpr float kMost = std::numeric_limits<float>::max();
    const SourceImage source =
        read_row({kInf, 5, -kInf, 7, kInf, kNaN}, "lin_rec709", Infinity::largest_float);
    EXPECT_EQ(source.image.levels[0].texels, (std::vector<float>{kMost, 5, 0, 7, kMost, 0}));
    EXPECT_EQ(source.repairs.non_finite, 2u);
}

TEST(Repair, NegativesBecomeZeroAndAreReported) {
    const SourceImage source = read_row({-1, -2, 3, 4, 5, 6, -.5f, 0, -0.f});
    EXPECT_EQ(source.image.levels[0].texels, (std::vector<float>{0, 0, 3, 4, 5, 6, 0, 0, 0}));
    EXPECT_EQ(source.repairs.negative, 2u);
    EXPECT_EQ(source.repairs.lowest, -2);
    EXPECT_EQ(source.repairs.non_finite, 0u);
}

TEST(Repair, NegativesThatAWiderGamutHoldsAreKept) {
    // Pure AP1 green is negative in Rec. 709; the other way round, nothing is lost.
    const SourceImage source = read_row({1, -.05f, .02f}, "acescg");
    EXPECT_EQ(source.repairs.negative, 0u);
    EXPECT_GT(source.image.levels[0].texels[1], 0.f);
}

TEST(Repair, NothingIsInfiniteAfterAConversion) {
    const SourceImage source = read_row({3.3e38f, 3.3e38f, 3.3e38f, 1, 1, 1}, "acescg");
    for (const float value : source.image.levels[0].texels) EXPECT_TRUE(std::isfinite(value)) << value;
}

}  // namespace
}  // namespace pbrbake::io::test
