// Texture sets through the program: files in, files out, exit codes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "bakers/job/json_text.hpp"
#include "bakers/job/schema.hpp"
#include "tests/cli/program.hpp"

namespace pbrbake::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A TGA of one colour and alpha, 32 bits, top row first.
std::string targa(int width, int height, int red, int green, int blue, int alpha) {
    std::string file(18, '\0');
    file[2] = 2;
    file[12] = static_cast<char>(width);
    file[14] = static_cast<char>(height);
    file[16] = 32;
    file[17] = 0x28;
    for (int i = 0; i < width * height; ++i)
        for (const int value : {blue, green, red, (i % 2) * alpha}) file += static_cast<char>(value);
    return file;
}

void expect_valid_sidecar(const fs::path& document) {
    const fs::path file = fs::path(PBRBAKE_SOURCE_DIR) / "schemas/sidecar.schema.json";
    const job::Schema schema(job::parse_json(job::read_text(file), file.string()));
    for (const Mistake& mistake :
         schema.mistakes(job::parse_json(job::read_text(document), document.string())))
        ADD_FAILURE() << mistake.pointer << ": " << mistake.message;
}

TEST(TextureCommand, WritesASetInEveryFormatThatHoldsIt) {
    const TemporaryFolder folder;
    const fs::path diffuse = folder.write("wall_d.tga", targa(8, 8, 120, 110, 100, 255));
    const fs::path specular = folder.write("wall_s.tga", targa(8, 8, 56, 56, 56, 200));
    for (const char* extension : {"exr", "ktx2", "dds", "png"}) {
        SCOPED_TRACE(extension);
        const fs::path product = diffuse.parent_path() / (std::string("out.") + extension);
        const Outcome outcome =
            run_program({"texture", "--diffuse", diffuse, "--specular", specular, "--levels",
                         extension == std::string("png") ? "1" : "0", "-o", product});
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        expect_valid_sidecar(product.string() + ".json");
        const Json record = job::parse_json(job::read_text(product.string() + ".json"), "record");
        EXPECT_EQ(record["pixel"], extension == std::string("exr") ? "half" : "unorm8");
        EXPECT_EQ(record["outputs"].size(), 4u);  // base colour, orm, specular, material
        EXPECT_EQ(record["set"]["diffuse_alpha"], "opacity");
        EXPECT_LE(record["certificate"]["headline"]["value"].get<double>(), .02);
        EXPECT_EQ(
            run_program({"inspect", diffuse.parent_path() / (std::string("out_orm.") + extension)}).code, 0);
    }
}

TEST(TextureCommand, TellsAnErrorAloneAndAnAssumptionOnce) {
    const TemporaryFolder folder;
    const fs::path diffuse = folder.write("wall_d.tga", targa(8, 8, 120, 110, 100, 255));
    const std::vector<std::string> arguments{
        "texture", "--diffuse", diffuse, "--specular",      folder / "wall_s.tga",
        "--power", "20",        "-o",    folder / "out.png"};
    const Outcome missing = run_program(arguments);
    EXPECT_EQ(missing.code, 4);
    EXPECT_THAT(missing.err, testing::StartsWith("pbrbake: error: "));
    EXPECT_EQ(std::ranges::count(missing.err, '\n'), 1) << missing.err;
    folder.write("wall_s.tga", targa(8, 8, 56, 56, 56, 255));
    const Outcome done = run_program(arguments);
    EXPECT_EQ(done.code, 0) << done.err;
    EXPECT_THAT(done.err,
                HasSubstr("wall_d.tga and wall_s.tga: do not tell their colour space; taken as srgb"));
}

TEST(TextureCommand, RefusesToWriteOverItsSources) {
    const TemporaryFolder folder;
    const fs::path normal = folder.write("wall_normal.tga", targa(4, 4, 128, 128, 255, 255));
    const fs::path diffuse = folder.write("d.tga", targa(4, 4, 90, 90, 90, 255));
    folder.write("wall_normal.png", "");
    const Outcome outcome =
        run_program({"texture", "--diffuse", diffuse, "--normal", normal.parent_path() / "wall_normal.png",
                     "-o", normal.parent_path() / "wall.png"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("would write wall_normal.png over the source of bake"));
}

TEST(TextureCommand, NamesWhatIsMissingOrMalformed) {
    const TemporaryFolder folder;
    const fs::path good = folder.write("d.tga", targa(4, 4, 90, 90, 90, 255));
    const fs::path cut = folder.write("cut.tga", targa(64, 64, 9, 9, 9, 9).substr(0, 300));
    const fs::path text = folder.write("text.png", "hello");
    const fs::path out = good.parent_path() / "out.png";
    Outcome outcome = run_program({"texture", "-o", out});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("--diffuse: missing, and specular too"));
    outcome = run_program({"texture", "--diffuse", good, "--levels", "3", "-o", out});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("--levels: found 3, but png holds one level"));
    for (const fs::path& bad : {cut, text, good.parent_path() / "none.png"}) {
        outcome = run_program({"texture", "--diffuse", good, "--specular", bad, "-o", out});
        EXPECT_EQ(outcome.code, 4) << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr(bad.filename().string()));
        EXPECT_FALSE(fs::exists(out));
    }
    outcome = run_program({"texture", "--diffuse", good, "--gloss-in", "gloss", "-o", out});
    EXPECT_EQ(outcome.code, 4);
    EXPECT_THAT(outcome.err, HasSubstr("gloss_in: found \"gloss\", but that map is absent"));
}

TEST(TextureCommand, RefusesEmptyFilesAndPicturesWithoutTexels) {
    const TemporaryFolder folder;
    const fs::path good = folder.write("d.tga", targa(4, 4, 90, 90, 90, 255));
    const fs::path out = good.parent_path() / "out.png";
    for (const fs::path& bad :
         {folder.write("empty.png", ""), folder.write("none.tga", targa(0, 0, 1, 1, 1, 1))}) {
        const Outcome outcome = run_program({"texture", "--diffuse", good, "--normal", bad, "-o", out});
        EXPECT_EQ(outcome.code, 4) << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr(bad.filename().string()));
    }
    const fs::path rules =
        folder.write("rules.json", R"({"version": 1, "rules": [{"match": "*", "shine": 1}]})");
    const Outcome outcome = run_program({"texture", "--diffuse", good, "--rules", rules, "-o", out});
    EXPECT_EQ(outcome.code, 4);
    EXPECT_THAT(outcome.err, HasSubstr("rules.json#/rules/0/shine: found '1'; allowed: match, f0"));
    EXPECT_FALSE(fs::exists(out));
}

/// Metallic -> specular-gloss in half EXR -> metallic, by files.
TEST(TextureCommand, ReadsHalfExrOfItsOwn) {
    const TemporaryFolder folder;
    const fs::path base = folder.write("base.tga", targa(8, 8, 200, 120, 40, 255));
    const fs::path orm = folder.write("orm.tga", targa(8, 8, 255, 128, 255, 255));
    const fs::path there = base.parent_path() / "there.exr", back = base.parent_path() / "back.png";
    Outcome outcome =
        run_program({"texture", "--model", "metallic_roughness", "--base-color", base, "--metallic-roughness",
                     orm, "--alpha-is", "nothing", "--packing", "specular_gloss", "-o", there});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    expect_valid_sidecar(there.string() + ".json");
    outcome = run_program({"texture", "--diffuse", there, "--specular",
                           base.parent_path() / "there_specular_gloss.exr", "--f0-tolerance", "0",
                           "--gloss-in", "none", "-o", back});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const Json record = job::parse_json(job::read_text(back.string() + ".json"), "record");
    EXPECT_NEAR(record["set"]["mean_metallic"].get<double>(), 1, 1e-3);
    EXPECT_LE(record["certificate"]["headline"]["value"].get<double>(), .01);
}

TEST(TextureCommand, InspectFlagsWhatNoSurfaceReflects) {
    const TemporaryFolder folder;
    const fs::path coal = folder.write("coal_d.tga", targa(8, 8, 8, 8, 8, 0));
    const fs::path out = coal.parent_path() / "out.png";
    ASSERT_EQ(run_program({"texture", "--diffuse", coal, "-o", out}).code, 0);
    const Outcome outcome = run_program({"inspect", out});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("dielectric base colour, sRGB     30 to 240   100.00%  100.00%"));
    EXPECT_THAT(outcome.out, HasSubstr("outside"));
    std::istringstream lines(
        outcome.out.substr(outcome.out.find("physical range"),
                           outcome.out.find("headline") - outcome.out.find("physical range")));
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
    const Json json = job::parse_json(run_program({"inspect", "--json", out}).out, "inspection");
    EXPECT_EQ(json["ranges"].size(), 4u);
}

TEST(TextureCommand, ShowsWhatWasKeptOnPages) {
    const TemporaryFolder folder;
    const fs::path diffuse = folder.write("steel_d.tga", targa(8, 8, 60, 60, 60, 255));
    folder.write("steel_s.tga", targa(8, 8, 90, 90, 90, 255));
    const Outcome bake = run_program({"texture", "--diffuse", diffuse, "--specular", folder / "steel_s.tga",
                                      "--model", "blinn_phong", "--power", "20", "--packing", "unity", "-o",
                                      folder / "out.ktx2", "--html", folder / "page.html"});
    ASSERT_EQ(bake.code, 0) << bake.err;
    folder.write(
        "job.json",
        R"({"version": 1, "bakes": [{"kind": "texture", "name": "steel", "model": "blinn_phong", "power": 20,
        "diffuse": "steel_d.tga", "specular": "steel_s.tga", "format": "png"}]})");
    const Outcome study =
        run_program({"study", folder / "job.json", "--budget-s", "1", "--quiet", "-o", folder / "study"});
    ASSERT_EQ(study.code, 0) << study.err;
    for (const char* page : {"page.html", "study/study.html"}) {
        const std::string html = job::read_text(folder / page);
        for (const char* words : {"<b>before</b>", "<b>calibrated</b>", "<b>after</b>", "FLIP",
                                  "metal, by the word “steel”", "<code>delta_e_max</code>"})
            EXPECT_TRUE(html.find(words) != std::string::npos) << page << ": " << words;
        EXPECT_EQ(html.find("No pictures"), std::string::npos) << page;
    }
}

/// The line of a range: "metal f0, sRGB  180 to 255   50.00%    0.00%    0.00%".
std::string range_line(const std::vector<std::string>& arguments, const std::string& what) {
    std::vector<std::string> all{"inspect"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Outcome outcome = run_program(all);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    std::istringstream lines(outcome.out);
    std::string found = "nothing of " + what;
    for (std::string line; std::getline(lines, line);) {
        EXPECT_TRUE(line.size() <= 80 || line.starts_with('/')) << line;  // the file, however long
        if (line.starts_with(what)) found = line;
    }
    return found;
}

TEST(InspectCommand, FlagsSetsThatWereMadeElsewhere) {
    const TemporaryFolder folder;
    const auto grey = [&](const char* name, int size, int value) {
        return folder.write(name, targa(size, size, value, value, value, 255)).string();
    };
    const std::string coal = grey("coal.tga", 8, 8), chalk = grey("chalk.tga", 8, 250),
                      silver = grey("silver.tga", 8, 248), lead = grey("lead.tga", 8, 120),
                      dielectric = grey("dielectric.tga", 4, 0), metal = grey("metal.tga", 16, 255),
                      mixed = grey("mixed.tga", 8, 128);
    const auto line = [](const std::string& base, const std::string& mask, const char* what) {
        return range_line({base, "--metallic-roughness", mask}, what);
    };
    EXPECT_THAT(line(coal, dielectric, "dielectric base colour"),
                HasSubstr("30 to 240   100.00%  100.00%    0.00%  outside"));
    EXPECT_THAT(line(chalk, dielectric, "dielectric base colour"), HasSubstr("0.00%  100.00%  outside"));
    EXPECT_THAT(line(lead, dielectric, "dielectric base colour"), HasSubstr("100.00%    0.00%    0.00%"));
    EXPECT_THAT(line(silver, metal, "metal f0"), HasSubstr("180 to 255   100.00%    0.00%    0.00%"));
    EXPECT_THAT(line(lead, metal, "metal f0"), HasSubstr("100.00%  100.00%    0.00%  outside"));
    EXPECT_THAT(line(lead, mixed, "metallic, of neither"), HasSubstr("100.00%"));
    EXPECT_THAT(range_line({silver, "--metallic", metal}, "metal f0"), HasSubstr("100.00%    0.00%"));
    const Json json =
        job::parse_json(run_program({"inspect", "--json", lead, "--metallic", metal}).out, "inspection");
    EXPECT_EQ(json["format"], "tga");
    EXPECT_EQ(json["ranges"].size(), 3u);  // such a set holds no dielectric f0
}

TEST(InspectCommand, FlagsSpecularAndGloss) {
    const TemporaryFolder folder;
    const std::string clay = folder.write("clay_d.tga", targa(8, 8, 150, 90, 70, 255)).string(),
                      usual = folder.write("usual.tga", targa(8, 8, 56, 56, 56, 128)).string(),
                      none = folder.write("none.tga", targa(8, 8, 10, 10, 10, 128)).string(),
                      steel = folder.write("steel.tga", targa(8, 8, 198, 198, 198, 128)).string();
    const auto line = [&](const std::string& f0, const char* what) {
        return range_line({clay, "--specular", f0}, what);
    };
    EXPECT_THAT(line(usual, "dielectric diffuse, sRGB"), HasSubstr("100.00%    0.00%    0.00%"));
    EXPECT_THAT(line(usual, "dielectric f0, linear"), HasSubstr("100.00%    0.00%    0.00%"));
    EXPECT_THAT(line(none, "dielectric f0, linear"), HasSubstr("100.00%  100.00%    0.00%  outside"));
    EXPECT_THAT(line(steel, "metal f0, sRGB"), HasSubstr("100.00%    0.00%    0.00%"));
    EXPECT_THAT(line(steel, "metal diffuse, sRGB"), HasSubstr("100.00%    0.00%  100.00%  outside"));
    const std::string out = (folder / "out.png").string();
    ASSERT_EQ(run_program({"texture", "--diffuse", clay, "--specular", steel, "--packing", "specular_gloss",
                           "--calibrate", "none", "-o", out})
                  .code,
              0);
    EXPECT_THAT(range_line({out}, "metal diffuse, sRGB"), HasSubstr("100.00%    0.00%  100.00%  outside"));
}

TEST(InspectCommand, NamesWhatItCannotTakeTogetherOrRead) {
    const TemporaryFolder folder;
    const std::string base = folder.write("base.tga", targa(4, 4, 90, 90, 90, 255)).string();
    Outcome outcome = run_program({"inspect", base, "--metallic", base, "--specular", base});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("--specular: found beside --metallic; allowed: one of the two"));
    outcome = run_program({"inspect", folder / "scene.gltf"});
    EXPECT_EQ(outcome.code, 4);
    EXPECT_THAT(outcome.err, HasSubstr("scene.gltf: is a document; inspect a picture of its base colour"));
    outcome = run_program({"inspect", base, "--metallic", folder / "absent.png"});
    EXPECT_EQ(outcome.code, 4);
    EXPECT_THAT(outcome.err, HasSubstr("absent.png"));
}

TEST(TextureCommand, TwoHundredSetsTakeTheMemoryOfTwenty) {
    const TemporaryFolder folder;
    const fs::path diffuse = folder.write("d.tga", targa(128, 128, 90, 80, 70, 255));
    folder.write("s.tga", targa(128, 128, 60, 60, 60, 99));
    Json bakes = Json::array();
    for (int i = 0; i < 200; ++i)
        bakes.push_back({{"kind", "texture"},
                         {"name", "set" + std::to_string(i)},
                         {"diffuse", "d.tga"},
                         {"specular", "s.tga"},
                         {"certify", "none"},
                         {"format", "dds"}});
    const fs::path job =
        folder.write("job.json", Json({{"version", 1}, {"output", "baked"}, {"bakes", bakes}}).dump());
    const fs::path report = diffuse.parent_path() / "report.json";
    const Outcome outcome = run_program({"bake", job, "--quiet", "--threads", "2", "--report", report});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const Json run = job::parse_json(job::read_text(report), "report");
    const auto peak = [&](std::size_t i) { return run["bakes"][i]["peak_memory_bytes"].get<double>(); };
    EXPECT_LT(peak(199) - peak(19), 4 << 20);
}

}  // namespace
}  // namespace pbrbake::test
