// Lights through the program: products, records, jobs, exit codes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bakers/job/json_text.hpp"
#include "bakers/job/schema.hpp"
#include "tests/cli/program.hpp"

namespace pbrbake::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr const char* kLights =
    R"({"lights": [{"intensity": 2, "falloff": {"kind": "linear", "range": 10}}, {"type": "ambient"}]})";

void expect_valid(const std::string& name, const fs::path& document) {
    const fs::path file = fs::path(PBRBAKE_SOURCE_DIR) / "schemas" / (name + ".schema.json");
    const job::Schema schema(job::parse_json(job::read_text(file), file.string()));
    for (const Mistake& mistake :
         schema.mistakes(job::parse_json(job::read_text(document), document.string())))
        ADD_FAILURE() << name << "#" << mistake.pointer << ": " << mistake.message;
}

TEST(LightCommand, WritesEitherDocumentAsProductWithItsRecord) {
    for (const char* format : {"json", "gltf"}) {
        const TemporaryFolder folder;
        const fs::path source = folder.write("in.json", kLights), out = source.parent_path();
        const fs::path product = out / (std::string("out.") + format);
        const Outcome outcome = run_program({"light", source, "-o", product});
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr("lights everything alike"));
        expect_valid("lights", out / "out.json");
        expect_valid("sidecar", product.string() + ".json");
        const Json record = job::parse_json(job::read_text(product.string() + ".json"), "record");
        ASSERT_EQ(record["outputs"].size(), 2u);
        EXPECT_EQ(record["outputs"][0]["path"], std::string("out.") + format);
        EXPECT_FALSE(record.contains("pixel"));
        EXPECT_EQ(record["lights"]["fill"], 1);
        EXPECT_LE(record["certificate"]["headline"]["value"].get<double>(), .15);
    }
}

TEST(LightCommand, WritesAPageWithTheCurvesOfItsCertificate) {
    const TemporaryFolder folder;
    const fs::path source = folder.write("in.json", kLights), out = source.parent_path();
    const fs::path page = out / "page.html";
    ASSERT_EQ(run_program({"light", source, "-o", out / "out.json", "--html", page}).code, 0);
    const std::string html = job::read_text(page);
    for (const char* words :
         {"lights everything alike", "stops_rms.linear ramp", "<polyline", "out.gltf", "over 512 distances"})
        EXPECT_THAT(html, HasSubstr(words));
    ASSERT_EQ(run_program({"light", out / "none.json", "-o", out / "out.json", "--html", page}).code, 4);
    EXPECT_THAT(job::read_text(page), HasSubstr("there is no such file"));
    EXPECT_EQ(run_program({"light", source, "-o", out / "out.json", "--html", out / "in.json/x"}).code, 5);
}

TEST(LightCommand, GivesTheSameBytesOnAnyNumberOfThreads) {
    const TemporaryFolder folder;
    const fs::path source = folder.write("in.json", kLights), out = source.parent_path();
    ASSERT_EQ(run_program({"light", source, "-o", out / "a.json", "--threads", "1"}).code, 0);
    ASSERT_EQ(run_program({"light", source, "-o", out / "b.json", "--threads", "4"}).code, 0);
    EXPECT_EQ(job::read_text(out / "a.json"), job::read_text(out / "b.json"));
    EXPECT_EQ(job::read_text(out / "a.gltf"), job::read_text(out / "b.gltf"));
}

TEST(LightCommand, BakesFromAJobIntoAManifest) {
    const TemporaryFolder folder;
    const fs::path source = folder.write("in.json", kLights), out = source.parent_path();
    const fs::path job = folder.write(
        "job.json",
        R"({"version": 1, "output": "baked", "bakes": [{"kind": "light", "name": "lights", "source": "in.json", "ev100": 12}]})");
    const Outcome dry = run_program({"bake", job, "--dry-run"});
    EXPECT_EQ(dry.code, 0) << dry.err;
    EXPECT_THAT(dry.out, HasSubstr("lights.gltf"));
    const Outcome outcome = run_program({"bake", job});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const Json manifest = job::parse_json(job::read_text(out / "baked/manifest.json"), "manifest");
    EXPECT_EQ(manifest["products"][0]["outputs"].size(), 2u);
    EXPECT_EQ(manifest["products"][0]["outputs"][0]["path"], "lights.json");
    EXPECT_EQ(manifest["products"][0]["params"]["pixel"], "auto");
    expect_valid("lights", out / "baked/lights.json");
}

TEST(LightCommand, HoldsAStatedErrorAgainstTheWorstLight) {
    const TemporaryFolder folder;
    const fs::path source = folder.write("in.json", kLights), out = source.parent_path() / "out.json";
    EXPECT_EQ(run_program({"light", source, "-o", out, "--accuracy", "0.1"}).code, 0);
    EXPECT_EQ(run_program({"light", source, "-o", out, "--accuracy", "0.1", "--shape", "point"}).code, 7);
}

TEST(LightCommand, RefusesWhatCantBe) {
    const TemporaryFolder folder;
    const fs::path source = folder.write("in.json", kLights), out = source.parent_path();
    const Outcome over = run_program({"light", source, "-o", source});
    EXPECT_EQ(over.code, 2);
    EXPECT_THAT(over.err, HasSubstr("would write in.json over the source"));
    const Outcome format = run_program({"light", source, "-o", out / "out.exr"});
    EXPECT_EQ(format.code, 2);
    EXPECT_THAT(format.err, HasSubstr("json"));
    const Outcome documents = run_program({"light", source, "-o", out / "out.gltf", "--documents", "json"});
    EXPECT_EQ(documents.code, 2);
    EXPECT_THAT(documents.err, HasSubstr("documents"));
    const Outcome broken = run_program({"light", folder.write("bad.map", "{\n"), "-o", out / "out.json"});
    EXPECT_EQ(broken.code, 4);
    EXPECT_THAT(broken.err, HasSubstr("bad.map:1: opens a brace"));
    EXPECT_FALSE(fs::exists(out / "out.json"));
    EXPECT_EQ(run_program({"light", source}).code, 2);
}

}  // namespace
}  // namespace pbrbake::test
