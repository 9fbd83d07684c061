#include "bakers/job/job.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bakers/job/json_text.hpp"
#include "bakers/job/schema.hpp"
#include "tests/bakers/job/temporary_folder.hpp"

namespace pbrbake::job {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

/// The mistakes of a job, one a line, without the file's name.
std::vector<std::string> mistakes(const std::string& text) {
    const test::TemporaryFolder folder;
    const fs::path file = folder.write("job.json", text);
    try {
        load(file);
    } catch (const JobError& error) {
        EXPECT_EQ(error.code(), ExitCode::invalid_job);
        std::vector<std::string> lines;
        for (const Mistake& mistake : error.mistakes()) {
            EXPECT_TRUE(mistake.pointer.starts_with(file.string() + "#")) << mistake.pointer;
            lines.push_back(mistake.pointer.substr(file.string().size() + 1) + ": " + mistake.message);
        }
        return lines;
    }
    return {};
}

Job loaded(const std::string& text) {
    const test::TemporaryFolder folder;
    return load(folder.write("job.json", text));
}

TEST(Job, FillsInDefaults) {
    const Job job = loaded(R"({"version": 1, "bakes": [{"kind": "dfg", "name": "lut"}]})");
    ASSERT_EQ(job.bakes.size(), 1u);
    const Bake& bake = job.bakes[0];
    EXPECT_EQ(bake.file, "lut.exr");
    EXPECT_EQ(bake.accuracy.name, "production");
    EXPECT_EQ(bake.params["size"], 0);  // for the target, else the accuracy, else 128
    EXPECT_EQ(bake.params["accuracy"], "production");
    EXPECT_FALSE(bake.params.contains("name"));
    EXPECT_EQ(job.max_side, 65536);
    EXPECT_EQ(job.max_decoded_bytes, std::uint64_t{4} << 30);
    EXPECT_EQ(job.working_space, "lin_rec709");
    EXPECT_EQ(job.record, Record::manifest);
}

TEST(Job, ReadsTheSameWhateverTheOrderOfItsKeys) {
    const Job one =
        loaded(R"({"version": 1, "bakes": [{"kind": "dfg", "name": "a", "seed": 3, "size": 8}]})");
    const Job other =
        loaded(R"({"bakes": [{"size": 8, "name": "a", "seed": 3, "kind": "dfg"}], "version": 1})");
    EXPECT_EQ(to_line(one.bakes[0].params), to_line(other.bakes[0].params));
}

TEST(Job, GivesItsAccuracyToBakesThatStateNone) {
    const Job job = loaded(R"({"version": 1, "accuracy": {"max_error": 0.001}, "bakes": [
        {"kind": "dfg", "name": "a"}, {"kind": "dfg", "name": "b", "accuracy": "draft"}]})");
    EXPECT_TRUE(job.bakes[0].accuracy.stated());
    EXPECT_EQ(job.bakes[0].accuracy.max_error, 0.001);
    EXPECT_FALSE(job.bakes[1].accuracy.stated());
    EXPECT_EQ(job.bakes[1].accuracy.name, "draft");
}

TEST(Job, ReadsWhereAStatedErrorHolds) {
    const Job job = loaded(R"({"version": 1, "bakes": [
        {"kind": "dfg", "name": "a", "accuracy": {"max_error": 0.001, "as": "sampled"}},
        {"kind": "dfg", "name": "b", "accuracy": {"max_error": 0.001}}]})");
    EXPECT_TRUE(job.bakes[0].accuracy.as_sampled);
    EXPECT_FALSE(job.bakes[1].accuracy.as_sampled);
}

TEST(Job, RefusesTermsThatNoTableHolds) {
    EXPECT_THAT(mistakes(R"({"version": 1, "bakes": [
        {"kind": "dfg", "name": "a", "terms": ["ggx", "uncorrelated", "eon"]},
        {"kind": "dfg", "name": "b", "terms": ["eon", "subsurface"]}]})"),
                ElementsAre(StartsWith("/bakes/0/terms: found terms of 5 channels; a table has up to 4"),
                            StartsWith("/bakes/1/terms: subsurface has axes of its own")));
}

TEST(Job, ReportsAllMistakesAtOnce) {
    EXPECT_THAT(
        mistakes(R"({"version": 1, "outptu": "x", "bakes": [
        {"kind": "dfg", "name": "a", "size": "big"},
        {"kind": "probe", "name": "b", "source": "b.hdr", "levels": 99},
        {"kind": "dfg", "name": "c", "accuracy": {"max_error": 0.1}, "certify": "none"},
        {"kind": "probe", "name": "c", "source": "../c.hdr"}]})"),
        ElementsAre(R"(/bakes/0/size: found "big"; allowed: integer 0 to 4096, or an array of 2 to 3 of those)",
                    "/bakes/1/levels: found 99; allowed: integer 0 to 14",
                    AllOf(StartsWith("/outptu: unknown key"), HasSubstr("did you mean \"output\"?")),
                    StartsWith("/bakes/2/certify: found \"none\", but this bake states a max_error"),
                    StartsWith("/bakes/3/name: found \"c\", the name of /bakes/2 too"),
                    StartsWith("/bakes/3/source: \"../c.hdr\" leads outside")));
}

TEST(Job, SaysWhatIsMissing) {
    EXPECT_THAT(mistakes("{}"), ElementsAre("/version: missing; allowed: 1",
                                            StartsWith("/bakes: missing; allowed: an array")));
    EXPECT_THAT(mistakes(R"({"version": 1, "bakes": [{"name": "a"}]})"),
                ElementsAre(R"(/bakes/0/kind: missing; allowed: "dfg", "probe", "ies", "texture", "light")"));
    EXPECT_THAT(mistakes(R"({"version": 1, "bakes": [{"kind": "probe", "name": "a"}]})"),
                ElementsAre(StartsWith("/bakes/0/source: missing; allowed: a string (Environment")));
    EXPECT_THAT(mistakes(R"({"version": 1, "bakes": []})"),
                ElementsAre(StartsWith("/bakes: found []; allowed: an array of 1 or more")));
}

TEST(Job, NamesAnUnknownKindOnce) {
    EXPECT_THAT(
        mistakes(R"({"version": 1, "bakes": [{"kind": "prob", "name": "a", "source": "x"}]})"),
        ElementsAre(R"(/bakes/0/kind: found "prob"; allowed: "dfg", "probe", "ies", "texture", "light"; did you mean "probe"?)"));
}

TEST(Job, RefusesNamesThatAreNoFileStems) {
    for (const char* name : {"", ".", "..", "a/b", "../a", ".hidden", "-flag", "a b", "é"})
        EXPECT_THAT(
            mistakes(R"({"version": 1, "bakes": [{"kind": "dfg", "name": ")" + std::string(name) + "\"}]}"),
            ElementsAre(StartsWith("/bakes/0/name: found")))
            << name;
}

TEST(Job, RefusesWrongTypesEverywhere) {
    const std::vector<std::string> values{"null", "true", "-1.5", "\"\"", "[]", "{}", "[[]]"};
    for (const auto& [name, property] : job_schema().root()["definitions"]["probe"]["properties"].items())
        for (const std::string& value : values) {
            const std::string text =
                "{\"version\": 1, \"bakes\": [{\"kind\": \"probe\", \"name\": \"a\", \"source\": "
                "\"builtin:outdoor\", \"" +
                name + "\": " + value + "}]}";
            if (job_schema().accepts(Json::parse(value), property) || name == "kind" || name == "name" ||
                name == "source")
                continue;
            EXPECT_THAT(mistakes(text), ElementsAre(StartsWith("/bakes/0/" + name))) << value;
        }
}

TEST(Job, NeverWritesOverWhatItReads) {
    EXPECT_THAT(mistakes(R"({"version": 1, "bakes": [
        {"kind": "probe", "name": "studio", "source": "studio.exr"},
        {"kind": "dfg", "name": "sky"},
        {"kind": "probe", "name": "b", "source": "sub/../sky.exr"}]})"),
                ElementsAre(testing::AllOf(testing::StartsWith("/bakes/0/name"),
                                           testing::HasSubstr("studio.exr over the source")),
                            testing::StartsWith("/bakes/1/name")));
    const test::TemporaryFolder folder;
    const fs::path file =
        folder.write("manifest.json", R"({"version": 1, "bakes": [{"kind": "dfg", "name": "a"}]})");
    EXPECT_THROW(load(file), JobError);
    EXPECT_NO_THROW(loaded(R"({"version": 1, "output": "out", "bakes": [
        {"kind": "probe", "name": "studio", "source": "studio.exr"}]})"));
}

TEST(Job, KeepsItsOutputInsideItsFolder) {
    EXPECT_THAT(mistakes(R"({"version": 1, "output": "../x", "bakes": [{"kind": "dfg", "name": "a"}]})"),
                ElementsAre(StartsWith("/output: \"../x\" leads outside")));
}

TEST(Job, ResolvesSourcesAgainstItsFolder) {
    const test::TemporaryFolder folder;
    const fs::path file =
        folder.write("jobs/job.json", R"({"version": 1, "roots": ["../hdri"], "output": "out", "bakes": [
        {"kind": "probe", "name": "a", "source": "../hdri/a.hdr"},
        {"kind": "probe", "name": "b", "source": "builtin:indoor"}]})");
    const Job job = load(file);
    EXPECT_EQ(job.output, folder / "jobs/out");
    EXPECT_EQ(job.bakes[0].sources[0].file, folder / "hdri/a.hdr");
    EXPECT_EQ(job.bakes[0].sources[0].read.path, "../hdri/a.hdr");
    EXPECT_TRUE(job.bakes[1].sources[0].file.empty());
}

TEST(Job, TakesRootsFromTheCommandLine) {
    const test::TemporaryFolder folder;
    const fs::path file = folder.write("jobs/job.json", R"({"version": 1, "bakes": [
        {"kind": "probe", "name": "a", "source": "../hdri/a.hdr"}]})");
    EXPECT_THROW(load(file), JobError);
    EXPECT_NO_THROW(load(file, {folder / "hdri"}));
}

TEST(Job, TellsAMissingFileFromABadOne) {
    const test::TemporaryFolder folder;
    try {
        load(folder / "absent.json");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::unreadable_input);
    }
}

TEST(Job, ExamplesAreValid) {
    const fs::path examples = fs::path(PBRBAKE_SOURCE_DIR) / "examples";
    if (!fs::exists(examples)) GTEST_SKIP() << "there are no examples";
    for (const auto& entry : fs::recursive_directory_iterator(examples)) {
        if (entry.path().extension() != ".json") continue;
        const Json document = parse_json(read_text(entry.path()), entry.path().string());
        if (!document.contains("bakes")) continue;
        EXPECT_NO_THROW(load(entry.path())) << entry.path();
    }
}

}  // namespace
}  // namespace pbrbake::job
