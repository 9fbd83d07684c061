#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "bakers/job/json_text.hpp"
#include "tests/cli/program.hpp"

namespace pbrbake::test {
namespace {

using testing::HasSubstr;

constexpr const char* kJob = R"({"version": 1, "bakes": [
    {"kind": "dfg", "name": "table", "size": 8}, {"kind": "dfg", "name": "other", "size": 8}]})";

/// Columns of a terminal: characters, not bytes.
std::size_t columns(const std::string& line) {
    return static_cast<std::size_t>(std::count_if(
        line.begin(), line.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

TEST(Study, OfAJobPrintsATableAndWritesFourFiles) {
    const TemporaryFolder folder;
    folder.write("job.json", kJob);
    const Outcome outcome = run_program(
        {"study", folder / "job.json", "--only", "table", "--budget-s", "1", "-o", folder / "out"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("table (dfg)"));
    EXPECT_THAT(outcome.out, HasSubstr("as the job has it"));
    EXPECT_THAT(outcome.out, testing::Not(HasSubstr("other")));
    std::istringstream lines(outcome.out + outcome.err);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(columns(line), 80u) << line;
    std::vector<std::string> names;
    for (const auto& [name, bytes] : contents(folder / "out")) names.push_back(name);
    EXPECT_THAT(names, testing::ElementsAre("study.csv", "study.html", "study.json", "study.svg"));
}

TEST(Study, KeepsTheSourcesOfItsOwnCasesAndIsHeldAgainstAnEarlierOne) {
    const TemporaryFolder folder;
    std::vector<std::string> arguments{"study", "--only", "light_ramp",  "--budget-s",
                                       "1",     "-o",     folder / "out"};
    ASSERT_EQ(run_program(arguments).code, 0);
    std::vector<std::string> names;
    for (const auto& [name, bytes] : contents(folder / "out")) names.push_back(name);
    EXPECT_THAT(names,
                testing::ElementsAre("ramp.json", "study.csv", "study.html", "study.json", "study.svg"));
    EXPECT_THAT(read_file(folder / "out/study.html"), HasSubstr("class=curve"));
    arguments.insert(arguments.end(), {"--against", folder / "out/study.json"});
    EXPECT_THAT(run_program(arguments).err, HasSubstr("of 5 ratios agree within 10.0 %"));
    arguments.back() = folder / "out/ramp.json";
    const Outcome outcome = run_program(arguments);
    EXPECT_EQ(outcome.code, 4);
    EXPECT_THAT(outcome.err, HasSubstr("is no study.json"));
}

TEST(Study, PrintsTheSameJsonAsItWrites) {
    const TemporaryFolder folder;
    folder.write("job.json", kJob);
    const Outcome outcome = run_program({"study", folder / "job.json", "--only", "table", "--budget-s", "1",
                                         "--json", "--quiet", "-o", folder / "out"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(outcome.out, read_file(folder / "out/study.json"));
}

TEST(Study, RefusesWhatItDoesNotKnow) {
    const TemporaryFolder folder;
    folder.write("job.json", kJob);
    const std::vector<std::pair<std::vector<std::string>, const char*>> mistakes{
        {{"--suite", "huge"}, "allowed: quick, full"},
        {{"--only", "probe_indor"}, "did you mean \"probe_indoor\"?"},
        {{"--budget-s", "0"}, "allowed: integer 1 to"},
        {{"--threads", "x"}, "--threads"},
    };
    for (const auto& [arguments, words] : mistakes) {
        std::vector<std::string> all{"study", "-o", folder / "out"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        const Outcome outcome = run_program(all);
        EXPECT_EQ(outcome.code, 2) << words;
        EXPECT_THAT(outcome.err, HasSubstr(words));
    }
    EXPECT_EQ(run_program({"study", folder / "absent.json", "-o", folder / "out"}).code, 4);
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

}  // namespace
}  // namespace pbrbake::test
