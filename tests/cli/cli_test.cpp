// What the program promises: exit codes, files, and the same bytes every time.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "bakers/job/json_text.hpp"
#include "bakers/job/schema.hpp"
#include "tests/cli/program.hpp"

namespace pbrbake::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

std::string job_text(const std::string& bakes) {
    return "{\"version\": 1, \"output\": \"out\", \"bakes\": [" + bakes + "]}";
}

constexpr const char* kSmall =
    R"({"kind": "dfg", "name": "lut", "size": [32, 16], "terms": ["ggx", "disney_diffuse"]},
       {"kind": "probe", "name": "sky", "source": "builtin:outdoor", "size": 16, "samples": 8, "format": "ktx2"})";

/// A schema of the project; the manifest's reference to another file is filled in.
job::Schema schema(const std::string& name) {
    const auto load = [](const std::string& stem) {
        const fs::path file = fs::path(PBRBAKE_SOURCE_DIR) / "schemas" / (stem + ".schema.json");
        return job::parse_json(job::read_text(file), file.string());
    };
    Json root = load(name);
    if (name == "manifest") {
        Json product = load("sidecar");
        root["definitions"] = product["definitions"];
        product.erase("definitions");
        product.erase("$id");
        root["definitions"]["product"] = product;
        root["properties"]["products"]["items"]["$ref"] = "#/definitions/product";
    }
    return job::Schema(root);
}

void expect_valid(const std::string& schema_name, const std::string& text) {
    const Json document = job::parse_json(text, schema_name);
    for (const Mistake& mistake : schema(schema_name).mistakes(document))
        ADD_FAILURE() << schema_name << "#" << mistake.pointer << ": " << mistake.message;
}

TEST(Bake, ReportsThreeMistakesByPointer) {
    const TemporaryFolder folder;
    const fs::path job = folder.write(
        "job.json",
        job_text(
            R"({"kind": "dfg", "name": "a", "size": "big"}, {"kind": "dfg", "name": "b", "terms": ["gxx"]},
           {"kind": "probe", "name": "c", "source": "x.hdr", "levles": 3})"));
    const Outcome outcome = run_program({"bake", job});
    EXPECT_EQ(outcome.code, 3);
    for (const char* pointer : {"#/bakes/0/size: found \"big\"", "#/bakes/1/terms/0: found \"gxx\"",
                                "#/bakes/2/levles: unknown key"})
        EXPECT_THAT(outcome.err, HasSubstr("pbrbake: error: " + job.string() + pointer));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 3);
    EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(Bake, RefusesPathsThatEscape) {
    const TemporaryFolder folder;
    folder.write("secret.hdr", "secret");
    fs::create_directory(folder / "jobs");
    fs::create_symlink(folder / "secret.hdr", folder / "jobs/link.hdr");
    for (const char* source : {"../secret.hdr", "link.hdr", "/etc/hostname"}) {
        const fs::path job = folder.write(
            "jobs/job.json",
            job_text(R"({"kind": "probe", "name": "a", "source": ")" + std::string(source) + "\"}"));
        const Outcome outcome = run_program({"bake", job});
        EXPECT_EQ(outcome.code, 3) << source;
        EXPECT_THAT(outcome.err, HasSubstr("#/bakes/0/source: \"" + std::string(source)));
    }
}

TEST(Bake, ReadsFromRootsOfTheCommandLine) {
    const TemporaryFolder folder;
    const fs::path job =
        folder.write("jobs/job.json", job_text(R"({"kind": "probe", "name": "a", "source": "../a.hdr"})"));
    EXPECT_EQ(run_program({"bake", job, "--dry-run"}).code, 3);
    EXPECT_EQ(run_program({"bake", job, "--dry-run", "--root", folder.path()}).code, 0);
}

TEST(Bake, ExitsWithFourForABadSourceAndBakesTheRest) {
    const TemporaryFolder folder;
    folder.write("cut.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 64 +X 128\n");
    const std::string bad = R"({"kind": "probe", "name": "cut", "source": "cut.hdr", "size": 8},
                               {"kind": "probe", "name": "absent", "source": "absent.hdr", "size": 8})";
    const Outcome alone = run_program({"bake", folder.write("bad.json", job_text(bad))});
    EXPECT_EQ(alone.code, 4);
    EXPECT_THAT(alone.err, HasSubstr("cut.hdr"));
    EXPECT_THAT(alone.err, HasSubstr("absent.hdr"));
    EXPECT_FALSE(fs::exists(folder / "out"));

    const Outcome mixed =
        run_program({"bake", folder.write("mixed.json",
                                          job_text(bad + R"(, {"kind": "dfg", "name": "lut", "size": 8})"))});
    EXPECT_EQ(mixed.code, 4);
    EXPECT_TRUE(fs::exists(folder / "out/lut.exr"));
    const Json manifest = job::parse_json(read_file(folder / "out/manifest.json"), "manifest");
    ASSERT_EQ(manifest["products"].size(), 1u);
    EXPECT_EQ(manifest["products"][0]["name"], "lut");
}

TEST(Bake, ExitsWithFiveWhereItCannotWrite) {
    const TemporaryFolder folder;
    folder.write("file", "");
    for (const std::string& output : {(folder / "file/lut.exr").string(), std::string("/proc/lut.exr")}) {
        const Outcome outcome = run_program({"dfg", "--size", "8", "-o", output});
        EXPECT_EQ(outcome.code, 5);
        EXPECT_THAT(outcome.err, HasSubstr(output));
    }
}

TEST(Bake, ExitsWithOneForFailuresOfSeveralKinds) {
    const TemporaryFolder folder;
    fs::create_directories(folder / "out/lut.exr");  // in the way
    const Outcome outcome = run_program(
        {"bake",
         folder.write(
             "job.json",
             job_text(
                 R"({"kind": "dfg", "name": "lut", "size": 8}, {"kind": "probe", "name": "a", "source": "absent.hdr"})"))});
    EXPECT_EQ(outcome.code, 1);
}

TEST(Bake, ExitsWithSevenWhenAStatedErrorIsMissed) {
    const TemporaryFolder folder;
    const Outcome outcome =
        run_program({"dfg", "--size", "8", "--accuracy", "1e-30", "-o", folder / "lut.exr"});
    EXPECT_EQ(outcome.code, 7);
    EXPECT_THAT(outcome.err, HasSubstr("above the max_error of 1e-30"));
    EXPECT_TRUE(fs::exists(folder / "lut.exr"));
}

TEST(Bake, GivesTheSameBytesAtAnyThreadCountAndAgain) {
    std::vector<std::pair<std::string, std::string>> first;
    for (const char* threads : {"1", "2", "7", "7"}) {
        const TemporaryFolder folder;
        const Outcome outcome =
            run_program({"bake", folder.write("job.json", job_text(kSmall)), "--threads", threads});
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        const auto files = contents(folder / "out");
        ASSERT_EQ(files.size(), 3u);
        if (first.empty()) first = files;
        EXPECT_EQ(files, first) << threads << " threads";
    }
}

TEST(OneShot, GivesTheBytesOfTheJobThatSaysTheSame) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_program({"bake", folder.write("job.json", job_text(kSmall))}).code, 0);
    const Outcome outcome = run_program(
        {"dfg", "--size", "32x16", "--terms", "ggx,disney_diffuse", "-o", folder / "shot/lut.exr"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(read_file(folder / "shot/lut.exr"), read_file(folder / "out/lut.exr"));

    const Json manifest = job::parse_json(read_file(folder / "out/manifest.json"), "manifest");
    const Json sidecar = job::parse_json(read_file(folder / "shot/lut.exr.json"), "sidecar");
    EXPECT_EQ(sidecar, manifest["products"][0]);
}

TEST(OneShot, SpellsFlagsWithHyphensOrUnderscores) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_program({"dfg", "--size", "8", "--roughness-axis", "alpha", "-o", folder / "a.exr"}).code,
              0);
    ASSERT_EQ(run_program({"dfg", "--size=8", "--roughness_axis=alpha", "-o", folder / "b.exr"}).code, 0);
    EXPECT_EQ(read_file(folder / "a.exr"), read_file(folder / "b.exr"));
}

TEST(Documents, MatchTheirSchemas) {
    const TemporaryFolder folder;
    const fs::path job = folder.write("job.json", job_text(kSmall));
    expect_valid("job", read_file(job));
    const Outcome outcome = run_program({"bake", job, "--report", folder / "run.json", "--json"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    expect_valid("manifest", read_file(folder / "out/manifest.json"));
    expect_valid("report", read_file(folder / "run.json"));
    expect_valid("report", outcome.out);
    ASSERT_EQ(run_program({"dfg", "--size", "8", "-o", folder / "lut.exr"}).code, 0);
    expect_valid("sidecar", read_file(folder / "lut.exr.json"));
    expect_valid("report", run_program({"bake", job, "--dry-run", "--json"}).out);
}

TEST(Bake, ATablesChoiceOfPixelGivesWayToTheJobAndTheFormat) {
    const TemporaryFolder folder;
    for (const auto& [settings, pixel] : {std::pair{R"("format": "png")", "unorm16"},
                                          {R"("format": "exr", "pixel": "float")", "float"},
                                          {R"("format": "exr")", "half"}}) {
        const fs::path job = folder.write(
            "job.json",
            job_text(R"({"kind": "dfg", "name": "t", "accuracy": {"max_error": 0.02, "as": "sampled"}, )" +
                     std::string(settings) + "}"));
        ASSERT_EQ(run_program({"bake", job}).code, 0) << settings;
        EXPECT_THAT(read_file(folder / "out/manifest.json"),
                    HasSubstr("\"pixel\": \"" + std::string(pixel) + "\",\n      \"units\""))
            << settings;
    }
}

TEST(Documents, HoldNoAbsolutePaths) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_program({"bake", folder.write("job.json", job_text(kSmall))}).code, 0);
    for (const auto& [name, bytes] : contents(folder / "out"))
        EXPECT_EQ(bytes.find(folder.path().string()), std::string::npos) << name;
}

TEST(Bake, PlansOnADryRun) {
    const TemporaryFolder folder;
    const Outcome outcome = run_program({"bake", folder.write("job.json", job_text(kSmall)), "--dry-run"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.out, HasSubstr("reads   builtin:outdoor"));
    EXPECT_THAT(outcome.out, HasSubstr("writes  " + (folder / "out/sky.ktx2").string()));
    EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(Bake, RunsOneBakeAlone) {
    const TemporaryFolder folder;
    const fs::path job = folder.write("job.json", job_text(kSmall));
    EXPECT_EQ(run_program({"bake", job, "--only", "lut"}).code, 0);
    EXPECT_TRUE(fs::exists(folder / "out/lut.exr"));
    EXPECT_FALSE(fs::exists(folder / "out/sky.ktx2"));
    const Outcome unknown = run_program({"bake", job, "--only", "lat"});
    EXPECT_EQ(unknown.code, 2);
    EXPECT_THAT(unknown.err, HasSubstr("--only: found \"lat\"; allowed: lut, sky; did you mean \"lut\"?"));
}

TEST(Bake, IsSilentWhenAskedTo) {
    const TemporaryFolder folder;
    const Outcome outcome = run_program({"dfg", "--size", "8", "--quiet", "-o", folder / "a.exr"});
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "");
    EXPECT_THAT(run_program({"dfg", "--size", "8", "-o", folder / "a.exr"}).err,
                HasSubstr((folder / "a.exr").string()));
}

TEST(Bake, WritesADependencyFile) {
    const TemporaryFolder folder;
    const fs::path job = folder.write("job.json", job_text(R"({"kind": "dfg", "name": "lut", "size": 8})"));
    ASSERT_EQ(run_program({"bake", job, "--depfile", folder / "job.d"}).code, 0);
    EXPECT_EQ(read_file(folder / "job.d"), (folder / "out/manifest.json").string() + " " +
                                               (folder / "out/lut.exr").string() + ": \\\n  " + job.string() +
                                               "\n");
}

TEST(Inspect, ShowsLevelsAndCertificate) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_program({"bake", folder.write("job.json", job_text(kSmall))}).code, 0);
    const Outcome table = run_program({"inspect", folder / "out/lut.exr"});
    EXPECT_EQ(table.code, 0) << table.err;
    EXPECT_THAT(table.out, HasSubstr("32x16"));
    EXPECT_THAT(table.out, HasSubstr("headline"));
    for (const char* product : {"out/lut.exr", "out/sky.ktx2"}) {
        std::istringstream lines(run_program({"inspect", folder / product}).out);
        std::string line;
        std::getline(lines, line);  // has the path
        while (std::getline(lines, line)) EXPECT_LE(line.size(), 80u) << line;
    }
    const Outcome cube = run_program({"inspect", "--json", folder / "out/sky.ktx2"});
    ASSERT_EQ(cube.code, 0) << cube.err;
    expect_valid("inspection", cube.out);
    expect_valid("inspection", run_program({"inspect", "--json", folder / "out/lut.exr"}).out);
    const Json document = job::parse_json(cube.out, "inspect");
    EXPECT_EQ(document["faces"], 6);
    EXPECT_EQ(document["record"]["name"], "sky");
    EXPECT_GT(document["levels"][0]["channels"][0]["energy"], 0.0);
    EXPECT_EQ(run_program({"inspect", folder / "absent.exr"}).code, 4);
}

}  // namespace
}  // namespace pbrbake::test
