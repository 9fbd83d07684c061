#include "bakers/verify/curve_plot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pbrbake::verify {
namespace {

using testing::HasSubstr;

Json curve_of(const char* rows) {
    return {{"columns", {"distance_m", "legacy_lx", "<b>", "stops"}}, {"rows", Json::parse(rows)}};
}

std::size_t lines_in(const std::string& html) {
    std::size_t lines = 0;
    for (std::size_t at = 0; (at = html.find("<polyline", at)) != std::string::npos; ++at) ++lines;
    return lines;
}

TEST(CurvePlot, HasBothLightsAndTheirDifference) {
    const std::string html = curve_html(curve_of("[[1, 8, 8, 0], [2, 4, 2, -1], [4, 2, 0.5, -2]]"));
    for (const char* words : {"4.0 stops", "± 2.00 stops", "1 m", "4 m", "legacy_lx", "&lt;b&gt;"})
        EXPECT_THAT(html, HasSubstr(words));
    EXPECT_EQ(lines_in(html), 3u);
}

TEST(CurvePlot, LeavesAGapWhereALightIsDark) {
    const std::string html =
        curve_html(curve_of("[[1, 8, 8, 0], [2, 4, 4, 0], [3, 0, 1, null], [4, 4, 4, 0], [5, 4, 4, 0]]"));
    EXPECT_EQ(lines_in(html), 6u);
    EXPECT_THAT(html, HasSubstr("1.0 stops"));
    const std::string dark = curve_html(curve_of("[[1, 0, 0, null], [2, 0, 0, null]]"));
    EXPECT_EQ(lines_in(dark), 0u);
    EXPECT_THAT(dark, HasSubstr("0.0 stops"));
}

TEST(CurvePlot, IsEmptyForOtherCurves) {
    EXPECT_EQ(curve_html(nullptr), "");
    EXPECT_EQ(curve_html(curve_of("[[1, 8, 8, 0]]")), "");
    EXPECT_EQ(curve_html({{"columns", {"x", "y"}}, {"rows", {{1, 2}, {3, 4}}}}), "");
}

}  // namespace
}  // namespace pbrbake::verify
