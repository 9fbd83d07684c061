#include "bakers/verify/page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace pbrbake::verify {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string base64_of(std::string_view text) {
    return base64(std::as_bytes(std::span(text.data(), text.size())));
}

TEST(Page, EscapesWhatHtmlReads) {
    EXPECT_EQ(escaped("a < b && c > \"d\" 'e'"), "a &lt; b &amp;&amp; c &gt; &quot;d&quot; &#39;e&#39;");
    EXPECT_EQ(escaped(""), "");
    EXPECT_EQ(escaped("η ≈ 1.5"), "η ≈ 1.5");
}

TEST(Page, EscapesItsTitle) { EXPECT_THAT(page("<script>", ""), Not(HasSubstr("<script"))); }

TEST(Page, NeedsNoNetworkAndNoScript) {
    const std::string html = page("title", "<p>body</p>");
    for (const char* word : {"http:", "https:", "<script", "@import", "url("})
        EXPECT_THAT(html, Not(HasSubstr(word)));
    EXPECT_THAT(html, HasSubstr("<p>body</p>"));
}

TEST(Base64, HasTheVectorsOfRfc4648) {
    EXPECT_EQ(base64_of(""), "");
    EXPECT_EQ(base64_of("f"), "Zg==");
    EXPECT_EQ(base64_of("fo"), "Zm8=");
    EXPECT_EQ(base64_of("foo"), "Zm9v");
    EXPECT_EQ(base64_of("foob"), "Zm9vYg==");
    EXPECT_EQ(base64_of("fooba"), "Zm9vYmE=");
    EXPECT_EQ(base64_of("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64_of("\xff\xff\xfe"), "///+");
}

TEST(Number, HasThreeSignificantDigits) {
    EXPECT_EQ(number(0), "0");
    EXPECT_EQ(number(1), "1.00");
    EXPECT_EQ(number(-12.345), "-12.3");
    EXPECT_EQ(number(9.999), "10.0");
    EXPECT_EQ(number(999.9), "1,000");
    EXPECT_EQ(number(123456), "123,000");
    EXPECT_EQ(number(0.00123456), "0.00123");
    EXPECT_EQ(number(0.000123456), "1.23e-4");
    EXPECT_EQ(number(-1.5e-10), "-1.50e-10");
    EXPECT_EQ(number(1.47e9), "1.47e9");
    EXPECT_EQ(number(std::numeric_limits<double>::infinity()), "Inf");
    EXPECT_EQ(number(std::numeric_limits<double>::quiet_NaN()), "NaN");
    EXPECT_EQ(percent(0.01234), "1.23 %");
}

TEST(Count, SetsThousandsApart) {
    EXPECT_EQ(count(0), "0");
    EXPECT_EQ(count(999), "999");
    EXPECT_EQ(count(1000), "1,000");
    EXPECT_EQ(count(134217728), "134,217,728");
}

TEST(Table, HasARowForEachAddedAndMarksWords) {
    Table table({"name", "value", "note"});
    table.set_text(2);
    table.add({"a", "1", "b"});
    EXPECT_THAT(table.html(), HasSubstr("<th>name</th><th>value</th><th class=t>note</th>"));
    EXPECT_THAT(table.html(), HasSubstr("<tr><td>a</td><td>1</td><td class=t>b</td></tr>"));
}

}  // namespace
}  // namespace pbrbake::verify
