// pbrbake compare as a user runs it: what it prints, and how it ends.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bakers/job/json_text.hpp"
#include "tests/cli/program.hpp"

namespace pbrbake::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// Two tables that are equal, and one of another form.
class Compare : public testing::Test {
  protected:
    Compare() {
        EXPECT_EQ(bake("a.exr", "scale_bias"), 0);
        EXPECT_EQ(bake("b.exr", "scale_bias"), 0);
        EXPECT_EQ(bake("mix.exr", "mix"), 0);
    }
    int bake(const char* name, const char* form) const {
        return run_program({"dfg", "--size", "16", "--form", form, "--certify", "none", "-o", path(name)})
            .code;
    }
    std::string path(const char* name) const { return (folder_ / name).string(); }

    TemporaryFolder folder_;
};

TEST_F(Compare, EqualProductsEndWithZero) {
    const Outcome outcome = run_program({"compare", path("a.exr"), path("b.exr")});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "");
    EXPECT_THAT(outcome.out, StartsWith("ok    a.exr: "));
    EXPECT_THAT(outcome.out, HasSubstr("\nok    1 product\n"));
}

TEST_F(Compare, AChangeEndsWithSixAndOneLine) {
    const Outcome outcome = run_program({"compare", path("mix.exr"), path("b.exr"), "--quiet"});
    EXPECT_EQ(outcome.code, 6);
    EXPECT_THAT(outcome.out, testing::MatchesRegex("FAIL  mix.exr: [^\n]+\nFAIL  1 of 1 product\n"));
}

TEST_F(Compare, JsonHasTheExitCodeToo) {
    const Outcome outcome = run_program({"compare", "--json", path("mix.exr"), path("b.exr")});
    EXPECT_EQ(outcome.code, 6);
    const Json json = job::parse_json(outcome.out, "stdout");
    EXPECT_EQ(json["exit_code"], 6);
    EXPECT_EQ(json["products"][0]["verdict"], "differs");
    EXPECT_EQ(json["thresholds"]["max_ulp"], 1);
}

TEST_F(Compare, WhatCannotBeReadEndsWithFour) {
    folder_.write("torn.exr", "v/1");
    EXPECT_EQ(run_program({"compare", path("torn.exr"), path("b.exr")}).code, 4);
    const Outcome absent = run_program({"compare", path("absent.exr"), path("b.exr")});
    EXPECT_EQ(absent.code, 4);
    EXPECT_THAT(absent.err, HasSubstr("absent.exr: does not exist"));
}

TEST(CompareCommand, HoldsDocumentsThatAreProducts) {
    const TemporaryFolder folder;
    folder.write("lamps.csv", "name,type,unit,intensity,falloff\nbulb,point,cd,80,inverse_square\n");
    folder.write("brighter.csv", "name,type,unit,intensity,falloff\nbulb,point,cd,90,inverse_square\n");
    for (const char* at : {"a", "b", "c"}) {
        std::filesystem::create_directory(folder / at);
        const char* source = *at == 'c' ? "brighter.csv" : "lamps.csv";
        ASSERT_EQ(run_program({"light", folder / source, "-o", folder / at / "lamps.json"}).code, 0);
    }
    EXPECT_EQ(run_program({"compare", folder / "a/lamps.json", folder / "b/lamps.json"}).code, 0);
    EXPECT_EQ(run_program({"compare", folder / "a", folder / "b"}).code,
              0);  // nor do records count as products
    const Outcome outcome = run_program({"compare", folder / "a", folder / "c"});
    EXPECT_EQ(outcome.code, 6);
    EXPECT_THAT(outcome.out, testing::HasSubstr("/lights/0"));
}

}  // namespace
}  // namespace pbrbake::test
