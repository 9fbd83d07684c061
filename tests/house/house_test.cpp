// The rules of the house that the compiler doesn't hold: who includes what, and words that must not be
// written.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace pbrbake::test {
namespace {

namespace fs = std::filesystem;

struct Line {
    std::string file;  ///< relative to the tree: "bakers/io/io.hpp"
    int number;
    std::string text;  ///< without its // comment

    std::string place() const { return file + ":" + std::to_string(number) + ": " + text; }
};

/// Every line of the C++ sources in a folder of the tree.
std::vector<Line> lines_of(const std::string& folder) {
    const fs::path root = PBRBAKE_SOURCE_DIR;
    std::vector<Line> lines;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
        if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
        std::ifstream stream(entry.path());
        int number = 0;
        for (std::string text; std::getline(stream, text);)
            lines.push_back({entry.path().lexically_relative(root).generic_string(), ++number,
                             text.substr(0, text.find("//"))});
    }
    return lines;
}

std::vector<Line> lines_of_all(const std::vector<std::string>& folders) {
    std::vector<Line> lines;
    for (const std::string& folder : folders)
        for (Line& line : lines_of(folder)) lines.push_back(std::move(line));
    return lines;
}

/// What a line includes, with its quotes or brackets; "" if nothing.
std::string included(const Line& line) {
    static const std::regex pattern(R"(^\s*#\s*include\s*(["<][^">]+[">]))");
    std::smatch match;
    return std::regex_search(line.text, match, pattern) ? match[1].str() : "";
}

/// Lines that include what `pattern` matches, apart from files that `allowed` matches.
std::vector<std::string> includers(const std::vector<Line>& lines, const std::string& pattern,
                                   const std::string& allowed = "^$") {
    const std::regex what(pattern), who(allowed);
    std::vector<std::string> found;
    for (const Line& line : lines)
        if (const std::string name = included(line);
            !name.empty() && std::regex_search(name, what) && !std::regex_search(line.file, who))
            found.push_back(line.place());
    return found;
}

std::vector<std::string> writers(const std::vector<Line>& lines, const std::string& pattern,
                                 const std::string& allowed = "^$") {
    const std::regex what(pattern), who(allowed);
    std::vector<std::string> found;
    for (const Line& line : lines)
        if (std::regex_search(line.text, what) && !std::regex_search(line.file, who))
            found.push_back(line.place());
    return found;
}

const std::vector<std::string> kCode{"libpbr", "bakers", "cli"};

/// Folders of bakers: those with params of their own.
std::set<std::string> baker_folders() {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(fs::path(PBRBAKE_SOURCE_DIR) / "bakers"))
        if (fs::exists(entry.path() / "params.hpp")) names.insert(entry.path().filename().string());
    return names;
}

TEST(House, IsWhereTheTestsLook) {
    for (const std::string& folder : kCode) EXPECT_GT(lines_of(folder).size(), 500u) << folder;
    EXPECT_THAT(baker_folders(), testing::IsSupersetOf({"dfg", "probe"}));
    EXPECT_THAT(includers(lines_of("libpbr"), "^<glm/"), testing::Not(testing::IsEmpty()));
    EXPECT_THAT(includers(lines_of("bakers/io"), "^<(Imf|OpenImageIO)"), testing::Not(testing::IsEmpty()));
}

TEST(House, LibpbrKnowsStdGlmHighwayAndItself) {
    // A name without a slash or dot is the standard library's. Highway wants to name the file it includes
    // again.
    EXPECT_THAT(includers(lines_of("libpbr"),
                          R"(^(?!<[a-z_0-9]+>|<glm/|<hwy/|"hwy/|"pbr/|"src/|HWY_TARGET_INCLUDE))"),
                testing::IsEmpty());
}

TEST(House, LibpbrHasNoFilesThreadsOrClocks) {
    EXPECT_THAT(includers(lines_of("libpbr"),
                          "^<(chrono|cstdio|ctime|filesystem|fstream|future|iostream|mutex|thread|atomic)>"),
                testing::IsEmpty());
}

TEST(House, ImageLibrariesAreBehindIo) {
    EXPECT_THAT(includers(lines_of_all(kCode), "^[<\"](OpenImageIO|OpenEXR|OpenColorIO|Imf|Iex|IlmThread)",
                          "^bakers/io/"),
                testing::IsEmpty());
}

TEST(House, CommandLineParserIsInCli) {
    EXPECT_THAT(includers(lines_of_all(kCode), "cxxopts", "^cli/"), testing::IsEmpty());
    EXPECT_THAT(includers(lines_of_all({"libpbr", "bakers"}), "^\"cli/"), testing::IsEmpty());
}

TEST(House, LayersPointOneWay) {
    EXPECT_THAT(includers(lines_of("libpbr"), "bakers/"), testing::IsEmpty());
    EXPECT_THAT(includers(lines_of("bakers/io"), "^\"bakers/(job|run|verify|registry)"), testing::IsEmpty());
    EXPECT_THAT(includers(lines_of("bakers/job"), "^\"bakers/(run|verify|io/)"), testing::IsEmpty());
    EXPECT_THAT(includers(lines_of("bakers/run"), "^\"bakers/verify"), testing::IsEmpty());
}

TEST(House, BakersKnowTheContractAndLibpbrAlone) {
    for (const std::string& name : baker_folders())
        EXPECT_THAT(
            includers(lines_of("bakers/" + name), "^\"(bakers|cli)/(?!" + name + R"(/|parse/|[a-z0-9_]+\.hpp"))"),
            testing::IsEmpty());
}

TEST(House, JsonTextIsMadeAndReadInOnePlace) {
    // Everyone else goes through bakers/job/json_text.hpp: strict when reading, one layout when writing.
    EXPECT_THAT(writers(lines_of_all(kCode), R"(\.dump\(|[Jj]son::parse\(|\.parse\(text)", "^bakers/job/"),
                testing::IsEmpty());
    EXPECT_THAT(includers(lines_of_all(kCode), "json_text", "^(bakers/(job|parse|run|verify)|cli)/"),
                testing::IsEmpty());
}

TEST(House, ValijsonIsInOneFile) {
    EXPECT_THAT(includers(lines_of_all(kCode), "valijson", "^bakers/job/accepts.cpp"), testing::IsEmpty());
}

TEST(House, RandomnessHangsOnTheSeed) {
    const std::vector<Line> lines = lines_of_all(kCode);
    EXPECT_THAT(writers(lines, R"(\brand\(|\bsrand\(|mt19937|random_device|default_random_engine|drand48)"),
                testing::IsEmpty());
    EXPECT_THAT(includers(lines, "^<random>"), testing::IsEmpty());
}

TEST(House, RoughnessSaysWhichItIs) {
    EXPECT_THAT(writers(lines_of_all(kCode), R"(\b(float|double|T|auto)&? roughness\b)"), testing::IsEmpty());
}

TEST(House, PiComesFromTheStandardLibrary) {
    EXPECT_THAT(writers(lines_of_all(kCode), R"(3\.14159|\bM_PI\b)"), testing::IsEmpty());
}

}  // namespace
}  // namespace pbrbake::test
