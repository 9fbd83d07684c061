#include "bakers/verify/compare_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/bakers/verify/baked_folder.hpp"

namespace pbrbake::verify {
namespace {

namespace fs = std::filesystem;
namespace test = pbrbake::test;
using testing::HasSubstr;
using testing::Not;

TEST(ComparisonPage, ShowsWhatDiffersSideBySideInOneFile) {
    const test::TemporaryFolder folder;
    fs::copy(test::baked_folder(), folder / "a", fs::copy_options::recursive);
    test::write_changed(test::baked_folder() / "room.ktx2", folder / "a/room.ktx2",
                        test::each_value([](double v) { return v * 0.5; }));
    const std::string page =
        comparison_page(compare(folder / "a", test::baked_folder(), read_thresholds({}, {})));
    EXPECT_THAT(page, HasSubstr("FAIL  1 of 2 products"));
    EXPECT_THAT(page, HasSubstr("Looks like: values are 0.5 times the reference&#39;s"));
    std::size_t pictures = 0;
    for (std::size_t at = 0; (at = page.find("data:image/png;base64,", at)) != std::string::npos; ++at)
        ++pictures;
    EXPECT_EQ(pictures, 6u);  // A, B, their difference; the same of spheres
    EXPECT_THAT(page, Not(HasSubstr("http")));
    EXPECT_THAT(page, Not(HasSubstr("<script")));
    EXPECT_LT(page.size(), std::size_t{2} << 20);
}

TEST(ComparisonPage, SaysThatNothingWasCompared) {
    const test::TemporaryFolder a, b;
    EXPECT_THAT(comparison_page(compare(a.path(), b.path(), read_thresholds({}, {}))),
                HasSubstr("nothing to compare"));
}

TEST(ComparisonPage, ShowsANan) {
    const test::TemporaryFolder folder;
    test::write_changed(test::baked_folder() / "table.exr", folder / "table.exr", [](Image& image) {
        image.texel(0, 0, 1, 1)[0] = std::numeric_limits<float>::quiet_NaN();
    });
    const std::string page = comparison_page(
        compare(folder / "table.exr", test::baked_folder() / "table.exr", read_thresholds({}, {})));
    EXPECT_THAT(page, HasSubstr("1 value is NaN or infinite"));
}

}  // namespace
}  // namespace pbrbake::verify
