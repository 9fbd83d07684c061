#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "tests/cli/program.hpp"

namespace pbrbake::test {
namespace {

using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

/// A page without the base64 of its pictures, which may spell anything.
std::string without_pictures(const std::string& page) {
    const std::string_view start_of_picture = "base64,";
    std::string words;
    for (std::size_t at = 0; at < page.size();) {
        const std::size_t start = std::min(page.find(start_of_picture, at), page.size());
        words += page.substr(at, start - at);
        at = std::min(page.find('"', start), page.size());
    }
    return words;
}

TEST(Demo, WritesProductsAPageAndTheJobThatRepeatsThem) {
    const TemporaryFolder folder;
    const std::string demo = folder / "demo";
    const Outcome outcome = run_program({"demo", "-o", demo});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, demo + "/index.html\n");
    std::istringstream lines(outcome.err);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;

    const auto before = contents(demo);
    std::vector<std::string> names;
    for (const auto& [name, bytes] : before) names.push_back(name);
    EXPECT_THAT(names, IsSupersetOf({"dfg.exr", "indoor_1024.ktx2", "indoor_32.ktx2", "index.html",
                                     "job.json", "manifest.json", "outdoor_1024.ktx2", "outdoor_32.ktx2"}));
    const std::string page = read_file(folder / "demo/index.html");
    EXPECT_LT(page.size(), 3'000'000u);
    const std::string words = without_pictures(page);
    EXPECT_LT(words.size(), 100'000u);
    for (const char* word : {"http:", "https:", "<script", "NaN", "Inf "})
        EXPECT_THAT(words, Not(HasSubstr(word)));

    EXPECT_EQ(
        run_program({"bake", "--quiet", "--only", "dfg", "--only", "indoor_32", demo + "/job.json"}).code, 0);
    EXPECT_EQ(contents(demo), before);
}

TEST(Demo, LeavesAnotherJobAlone) {
    const TemporaryFolder folder;
    folder.write("job.json", "{\"mine\": true}");
    const Outcome outcome = run_program({"demo", "-o", folder.path()});
    EXPECT_EQ(outcome.code, 5);
    EXPECT_THAT(outcome.err, HasSubstr("-o"));
    EXPECT_EQ(read_file(folder / "job.json"), "{\"mine\": true}");
}

}  // namespace
}  // namespace pbrbake::test
