#include "bakers/verify/compare.hpp"
#include "bakers/verify/product_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "bakers/job/json_text.hpp"
#include "bakers/job/schema.hpp"
#include "tests/bakers/verify/baked_folder.hpp"

namespace pbrbake::verify {
namespace {

namespace fs = std::filesystem;
using pbrbake::test::baked_folder;
using pbrbake::test::each_value;
using pbrbake::test::read_file;
using pbrbake::test::TemporaryFolder;
using pbrbake::test::write_changed;
using testing::ElementsAre;
using testing::HasSubstr;

Thresholds defaults() { return read_thresholds({}, {}); }

std::vector<std::string> lines(const fs::path& a, const fs::path& b) {
    std::vector<std::string> texts;
    for (const ProductComparison& product : compare(a, b, defaults()).products)
        texts.push_back(verdict_line(product));
    return texts;
}

/// A copy of the baked folder.
void copy_baked(const fs::path& to) { fs::copy(baked_folder(), to, fs::copy_options::recursive); }

TEST(CompareFolders, PairsWhatManifestsList) {
    const TemporaryFolder folder;
    copy_baked(folder / "other");
    EXPECT_THAT(lines(folder / "other", baked_folder()),
                ElementsAre("ok    room.ktx2: identical", "ok    table.exr: identical"));
    EXPECT_THAT(lines(folder / "other/manifest.json", baked_folder()), testing::SizeIs(2));
}

TEST(CompareFolders, AMissingProductFails) {
    const TemporaryFolder folder;
    copy_baked(folder / "other");
    fs::remove(folder / "other/room.ktx2");
    EXPECT_THAT(lines(folder / "other", baked_folder()),
                ElementsAre("FAIL  room.ktx2: missing: the reference has it", "ok    table.exr: identical"));
    EXPECT_EQ(compare(folder / "other", baked_folder(), defaults()).code, ExitCode::comparison_failed);
    EXPECT_THAT(lines(baked_folder(), folder / "other")[0], HasSubstr("the reference hasn't got it"));
}

TEST(CompareFolders, WithoutManifestsGoesByFiles) {
    const TemporaryFolder folder;
    fs::create_directories(folder / "a/deep");
    fs::create_directories(folder / "b/deep");
    fs::copy(baked_folder() / "table.exr", folder / "a/deep/t.exr");
    fs::copy(baked_folder() / "table.exr", folder / "b/deep/t.exr");
    folder.write("a/note.txt", "no product");
    EXPECT_THAT(lines(folder / "a", folder / "b"), ElementsAre("ok    deep/t.exr: identical"));
    folder.write("b/extra.exr", "");
    EXPECT_THAT(lines(folder / "a", folder / "b")[1], HasSubstr("extra.exr: missing"));
}

TEST(CompareFolders, OfNothingFails) {
    const TemporaryFolder a, b;
    const Comparison nothing = compare(a.path(), b.path(), defaults());
    EXPECT_EQ(nothing.code, ExitCode::comparison_failed);
    EXPECT_EQ(summary_line(nothing), "FAIL  nothing to compare");
}

TEST(CompareFolders, ARenamedProductIsFoundByWhatWasBaked) {
    const TemporaryFolder folder;
    copy_baked(folder / "other");
    fs::rename(folder / "other/table.exr", folder / "other/lut.exr");
    std::string manifest = read_file(folder / "other/manifest.json");
    for (std::string_view text : {"\"table\"", "table.exr"})
        for (std::size_t at; (at = manifest.find(text)) != std::string::npos;)
            manifest.replace(at, text.size(), text == "table.exr" ? "lut.exr" : "\"lut\"");
    folder.write("other/manifest.json", manifest);
    EXPECT_THAT(lines(folder / "other", baked_folder()),
                ElementsAre("ok    lut.exr: identical; held against table.exr: the same was baked",
                            "ok    room.ktx2: identical"));
}

TEST(CompareFolders, AnUnreadableProductStopsNoOther) {
    const TemporaryFolder folder;
    copy_baked(folder / "other");
    fs::resize_file(folder / "other/room.ktx2", 1000);
    const Comparison comparison = compare(folder / "other", baked_folder(), defaults());
    EXPECT_EQ(comparison.code, ExitCode::unreadable_input);
    EXPECT_EQ(comparison.products[0].verdict, Verdict::unreadable);
    EXPECT_THAT(verdict_line(comparison.products[0]), HasSubstr("room.ktx2"));
    EXPECT_TRUE(comparison.products[1].passed());
}

TEST(CompareFolders, AgainstAFileIsAMistakeOfUsage) {
    try {
        compare(baked_folder(), baked_folder() / "table.exr", defaults());
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::usage);
    }
}

TEST(CompareRecords, PairsProductsOfDifferentNames) {
    const TemporaryFolder folder;
    const auto record = [&](const char* name) {
        fs::create_directories(folder.path());
        fs::copy(baked_folder() / "table.exr", folder / (std::string(name) + ".exr"));
        return folder.write(
            std::string(name) + ".exr.json",
            R"({"name": ")" + std::string(name) + R"(", "outputs": [{"path": ")" + name + ".exr\"}]}");
    };
    const fs::path a = record("today"), b = record("yesterday");
    EXPECT_THAT(lines(a, b), ElementsAre("ok    today.exr: identical"));
}

TEST(CompareRecords, PairsOutputsByWhatTheyAre) {
    const TemporaryFolder folder;
    const auto record = [&](const std::string& name, const std::vector<std::string>& endings) {
        std::string outputs;
        for (const std::string& ending : endings) {
            fs::copy(baked_folder() / "table.exr", folder / (name + ending));
            outputs += (outputs.empty() ? "" : ", ") + (R"({"path": ")" + name + ending + "\"}");
        }
        return folder.write(name + ".exr.json",
                            R"({"name": ")" + name + R"(", "outputs": [)" + outputs + "]}");
    };
    const fs::path a = record("new", {".exr", "_normal.exr", "_orm.exr"}),
                   b = record("old", {".exr", "_orm.exr"});
    EXPECT_THAT(lines(a, b),
                ElementsAre("ok    new.exr: identical",
                            testing::StartsWith("FAIL  new_normal.exr: the reference hasn't got it"),
                            "ok    new_orm.exr: identical"));
    EXPECT_FALSE(record_of(folder / "new_normal.exr").is_null());
}

TEST(CompareDocuments, NumbersMayMoveALittleAndTextsMayNot) {
    const TemporaryFolder folder;
    const auto write = [&](const char* side, const char* document) {
        const fs::path at = side;
        folder.write((at / "manifest.json").string(),
                     R"({"products": [{"name": "x", "outputs": [{"path": "x.light.json"}]}]})");
        folder.write((at / "x.light.json").string(), document);
    };
    write("b", R"({"flux_lm": 1000.0, "spread": [1, 2], "name": "lamp"})");
    write("a", R"({"flux_lm": 1000.0001, "spread": [1, 2], "name": "lamp"})");
    EXPECT_THAT(lines(folder / "a", folder / "b"), ElementsAre("ok    x.light.json: within thresholds"));
    write("a", R"({"flux_lm": 1000.0, "spread": [1, 2.5], "name": "lamp"})");
    EXPECT_THAT(lines(folder / "a", folder / "b")[0], HasSubstr("/spread/1 is 2.5 instead of 2"));
    write("a", R"({"flux_lm": 1000.0, "name": "lamp"})");
    EXPECT_THAT(lines(folder / "a", folder / "b")[0], HasSubstr("/spread is missing"));
}

TEST(CompareThresholds, ComeFromSchemaFileAndFlags) {
    const TemporaryFolder folder;
    EXPECT_EQ(defaults().max_ulp, 1u);
    const fs::path file = folder.write("t.json", R"({"max_ulp": 4, "max_relative": 0.5})");
    const Thresholds both = read_thresholds(file, {{"max-ulp", "7"}, {"flip-exposures", "-3,2.5"}});
    EXPECT_EQ(both.max_ulp, 7u);
    EXPECT_EQ(both.max_relative, 0.5);
    EXPECT_EQ(both.flip_exposures, std::pair(-3.0, 2.5));
    const auto code_and_text = [&](const std::optional<fs::path>& path, const char* flag, const char* text) {
        try {
            read_thresholds(path, {{flag, text}});
            return std::string("nothing thrown");
        } catch (const Error& error) {
            return std::to_string(static_cast<int>(error.code())) + " " + error.what();
        }
    };
    EXPECT_THAT(code_and_text({}, "max-ulp", "-1"), testing::StartsWith("2 --max-ulp: "));
    EXPECT_THAT(code_and_text({}, "max-flip", "much"), testing::StartsWith("2 --max-flip: found \"much\""));
    EXPECT_THAT(code_and_text({}, "flip-exposures", "3"), testing::StartsWith("2 --flip-exposures: "));
    EXPECT_THAT(code_and_text({}, "flip-exposures", ""), testing::StartsWith("2 --flip-exposures: "));
    EXPECT_THAT(code_and_text(folder.write("u.json", R"({"max_upl": 4})"), "max-ulp", "1"),
                testing::AllOf(testing::StartsWith("3 "), HasSubstr("u.json#/max_upl: unknown key")));
}

TEST(CompareThresholds, LetAChangePassThatIsAllowed) {
    const TemporaryFolder folder;
    write_changed(baked_folder() / "table.exr", folder / "table.exr",
                  each_value([](double v) { return v * 1.004; }));
    EXPECT_FALSE(
        compare(folder / "table.exr", baked_folder() / "table.exr", defaults()).products[0].passed());
    const Thresholds wide = read_thresholds(
        {}, {{"max-energy-change", "0.005"}, {"max-relative-rms", "0.02"}, {"max-relative-p99", "0.006"}});
    const Comparison comparison = compare(folder / "table.exr", baked_folder() / "table.exr", wide);
    EXPECT_TRUE(comparison.products[0].passed()) << verdict_line(comparison.products[0]);
    EXPECT_EQ(comparison.products[0].verdict, Verdict::within);
}

TEST(CompareJson, KeepsItsSchema) {
    const TemporaryFolder folder;
    copy_baked(folder / "other");
    write_changed(baked_folder() / "room.ktx2", folder / "other/room.ktx2",
                  each_value([](double v) { return 2 * v; }));
    const Json json = comparison_json(compare(folder / "other", baked_folder(), defaults()));
    const job::Schema schema(
        job::parse_json(read_file(fs::path(PBRBAKE_SOURCE_DIR) / "schemas/comparison.schema.json"),
                        "comparison.schema.json"));
    for (const Mistake& mistake : schema.mistakes(json))
        ADD_FAILURE() << mistake.pointer << ": " << mistake.message;
    EXPECT_EQ(json["exit_code"], 6);
    EXPECT_EQ(json["products"][0]["levels"].size(), 15u);
    EXPECT_EQ(json["products"][0]["faces"].size(), 90u);
    EXPECT_NEAR(json["products"][0]["levels"][0]["energy_change"].get<double>(), 1, 1e-3);
}

}  // namespace
}  // namespace pbrbake::verify
