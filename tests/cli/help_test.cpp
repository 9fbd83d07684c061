#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <sstream>

#include "tests/cli/program.hpp"

namespace pbrbake::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(Help, FitsEightyColumns) {
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{"--help"},
                                               {"bake", "--help"},
                                               {"dfg", "--help"},
                                               {"probe", "-h"},
                                               {"ies", "--help"},
                                               {"texture", "--help"},
                                               {"light", "--help"},
                                               {"inspect", "--help"},
                                               {"compare", "--help"},
                                               {"study", "--help"},
                                               {"demo", "--help"}}) {
        const Outcome outcome = run_program(arguments);
        EXPECT_EQ(outcome.code, 0);
        EXPECT_EQ(outcome.err, "");
        EXPECT_THAT(outcome.out, HasSubstr("usage: pbrbake"));
        std::istringstream lines(outcome.out);
        for (std::string line; std::getline(lines, line);) {
            EXPECT_LE(line.size(), 80u) << line;
            EXPECT_FALSE(line.ends_with(' ')) << line;
        }
    }
}

TEST(Help, ListsCommandsAndFlags) {
    const std::string commands = run_program({"--help"}).out;
    for (const char* command : {"bake", "dfg", "probe", "inspect", "compare", "demo", "study"})
        EXPECT_THAT(commands, HasSubstr(command));
    const std::string dfg = run_program({"dfg", "--help"}).out;
    EXPECT_THAT(dfg, HasSubstr("--align auto|center|ends"));
    EXPECT_THAT(dfg, testing::EndsWith(
                         "\nexample:\n  pbrbake dfg --size 128 --terms ggx,disney_diffuse -o dfg.exr\n"));
}

TEST(Switches, AreTurnedOffByNo) {
    EXPECT_THAT(run_program({"texture", "--help"}).out, HasSubstr("--[no-]regularise"));
    for (const char* off : {"--no-regularise", "--regularise=false"})
        EXPECT_EQ(
            run_program({"texture", "--diffuse", "a.png", off, "-o", "/nowhere/a.png", "--dry-run"}).code, 0)
            << off;
    EXPECT_THAT(run_program({"dfg", "--no-size", "-o", "/nowhere/a.exr"}).err,
                HasSubstr("--no-size: unknown flag"));
}

TEST(Version, IsOneLine) {
    EXPECT_THAT(run_program({"--version"}).out, testing::MatchesRegex("pbrbake [0-9.]+\n"));
}

TEST(Version, TakesNoTime) {
    std::chrono::duration<double> best{1};
    for (int i = 0; i < 5; ++i) {
        const auto start = std::chrono::steady_clock::now();
        run_program({"--version"});
        best = std::min<std::chrono::duration<double>>(best, std::chrono::steady_clock::now() - start);
    }
#if defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    EXPECT_LT(best.count(), 0.02);
#else
    EXPECT_LT(best.count(), 1.0);
#endif
}

TEST(Usage, UnknownWordsExitWithTwoAndASuggestion) {
    for (const auto& [arguments, hint] : std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{}, "--help"},
             {{"prob"}, "did you mean \"probe\"?"},
             {{"dfg", "-o", "/nowhere/a.exr", "--sise", "3"}, "did you mean \"--size\"?"},
             {{"dfg", "-o", "/nowhere/a.exr", "--sise=3"}, "--sise: unknown flag"},
             {{"dfg", "-o", "/nowhere/a.exr", "stray"}, "one argument too many"},
             {{"dfg", "-o", "/nowhere/a.exr", "--size"}, "missing an argument"},
             {{"dfg", "-o", "/nowhere/a.exr", "--size", "1", "--size", "2"}, "more than once"},
             {{"dfg", "-o", "/nowhere/a.exr", "--size", "big"},
              "--size: found \"big\"; allowed: integer 0 to 4096"},
             {{"dfg", "-o", "/nowhere/a.exr", "--threads", "0"},
              "--threads: found \"0\"; allowed: integer 1 to 1024"},
             {{"dfg"}, "-o: missing"},
             {{"probe", "-o", "/nowhere/a.exr"}, "SOURCE: missing"},
             {{"compare", "/nowhere"}, "B: missing"},
             {{"compare", "/nowhere", "/nowhere", "--max-ulp", "x"}, "--max-ulp: found \"x\""},
             {{"study", "--shading", "--environment", "moon"}, "--environment: found \"moon\""},
             {{"bake"}, "no job file given"}}) {
        const Outcome outcome = run_program(arguments);
        EXPECT_EQ(outcome.code, 2) << outcome.err;
        EXPECT_THAT(outcome.err, StartsWith("pbrbake: error: "));
        EXPECT_THAT(outcome.err, HasSubstr(hint));
        EXPECT_EQ(outcome.out, "");
    }
}

}  // namespace
}  // namespace pbrbake::test
