#include "bakers/job/json_text.hpp"

#include <gtest/gtest.h>

#include "tests/bakers/job/temporary_folder.hpp"

namespace pbrbake::job {
namespace {

std::string failure(const std::string& text) {
    try {
        parse_json(text, "x.json");
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::invalid_job);
        return error.what();
    }
    return "";
}

TEST(ParseJson, NamesLineAndColumn) {
    EXPECT_EQ(failure("{\n  \"a\": ]\n}").substr(0, 21), "x.json:2:8: not JSON:");
    EXPECT_EQ(failure("").substr(0, 11), "x.json:1:1:");
}

TEST(ParseJson, RefusesAKeyGivenTwice) {
    EXPECT_EQ(failure(R"({"a": [{"b/c": 1}, {"b/c": 1, "b/c": 2}]})"),
              "x.json#/a/1/b~1c: key given twice; keep one of them");
    EXPECT_EQ(failure(R"({"a": {"b": 1}, "c": {"b": 1}})"), "");
}

TEST(ParseJson, RefusesCommentsAndTrailingText) {
    EXPECT_NE(failure("// no\n{}"), "");
    EXPECT_NE(failure("{} {}"), "");
    EXPECT_NE(failure("{\"a\": 1,}"), "");
}

TEST(ParseJson, RefusesNumbersThatOverflow) {
    EXPECT_EQ(failure("{\"a\": 1e999}"), "x.json:1:7: not JSON: number overflow parsing '1e999'");
    EXPECT_EQ(failure("{\"1e999\": [1, 2,\n  3,\n\t-1e999, 4]}"),
              "x.json:3:2: not JSON: number overflow parsing '-1e999'");
}

TEST(ParseJson, BoundsNesting) {
    const auto nested = [](int depth) { return std::string(depth, '[') + std::string(depth, ']'); };
    EXPECT_EQ(failure(nested(kDeepestNesting)), "");
    EXPECT_EQ(failure(nested(kDeepestNesting + 1)), "x.json: nested deeper than 32 levels");
    EXPECT_EQ(failure(std::string(1000000, '[')), "x.json: nested deeper than 32 levels");
}

TEST(ParseJson, RefusesInvalidUtf8) { EXPECT_NE(failure("{\"a\": \"\xff\"}"), ""); }

TEST(ReadText, RefusesWhatIsTooLargeOrNoFile) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(read_text(folder / "absent.json"), Error);
    EXPECT_THROW(read_text(folder.path()), Error);
    EXPECT_THROW(read_text(folder.write("large.json", std::string(kLargestText + 1, ' '))), Error);
    EXPECT_EQ(read_text(folder.write("fits.json", std::string(kLargestText, ' '))).size(), kLargestText);
}

TEST(ToText, ReplacesWhatIsNotUtf8) { EXPECT_EQ(to_line(Json("\xff")), "\"\xEF\xBF\xBD\""); }

}  // namespace
}  // namespace pbrbake::job
