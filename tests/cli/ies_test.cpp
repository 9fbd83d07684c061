// Photometric files through the program: products, records, exit codes, conversion.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bakers/job/json_text.hpp"
#include "bakers/job/schema.hpp"
#include "tests/cli/program.hpp"

namespace pbrbake::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr const char* kLamp =
    "IESNA:LM-63-2002\n[TEST] 1\n[LAMP] LED 3000K\nTILT=lamp.tlt\n1 900 1 4 3 1 2 -.1 -.1 0 1 1 10\n0 30 60 "
    "90\n0 90 180\n"
    "100 90 40 5\n100 70 20 0\n100 50 10 0\n";

void expect_valid(const std::string& name, const fs::path& document) {
    const fs::path file = fs::path(PBRBAKE_SOURCE_DIR) / "schemas" / (name + ".schema.json");
    const job::Schema schema(job::parse_json(job::read_text(file), file.string()));
    for (const Mistake& mistake :
         schema.mistakes(job::parse_json(job::read_text(document), document.string())))
        ADD_FAILURE() << name << "#" << mistake.pointer << ": " << mistake.message;
}

TEST(IesCommand, WritesProductRecordAndDocumentsInEveryFormat) {
    const TemporaryFolder folder;
    const fs::path lamp = folder.write("lamp.ies", kLamp);
    folder.write("lamp.tlt", "1\n2\n0 90\n1 .5\n");
    for (const char* extension : {"exr", "ktx2", "dds", "png", "hdr"}) {
        SCOPED_TRACE(extension);
        const fs::path product = lamp.parent_path() / (std::string("out.") + extension);
        const Outcome outcome = run_program({"ies", lamp, "--tilt-deg", "90", "-o", product});
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        expect_valid("sidecar", product.string() + ".json");
        expect_valid("light_profile", product.parent_path() / "out.light.json");
        const Json record = job::parse_json(job::read_text(product.string() + ".json"), "record");
        EXPECT_EQ(record["inputs"].size(), 2u);
        EXPECT_EQ(record["max_cd"], 50);
        EXPECT_LE(record["certificate"]["headline"]["value"].get<double>(), 1e-3);
        const Outcome inspection = run_program({"inspect", "--json", product});
        EXPECT_EQ(inspection.code, 0) << inspection.err;
        EXPECT_THAT(inspection.out, HasSubstr(std::string("\"format\": \"") + extension));
    }
}

TEST(IesCommand, EndsWithCode4AndOneLineForMalformedFiles) {
    const TemporaryFolder folder;
    const std::string sound = kLamp;
    for (const std::string& text : {std::string(), sound.substr(0, sound.size() - 12),
                                    std::string("\xFF\xFEI\0E\0", 6), std::string("hello"), sound + "nan"}) {
        const fs::path lamp = folder.write("bad.ies", text);
        const Outcome outcome = run_program({"ies", lamp, "-o", lamp.parent_path() / "out.exr"});
        if (text == sound + "nan") {
            EXPECT_EQ(outcome.code, 0);  // after the last value: diagnosed
            EXPECT_THAT(outcome.err, HasSubstr("after the last candela value"));
            continue;
        }
        EXPECT_EQ(outcome.code, 4) << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr("bad.ies"));
        EXPECT_FALSE(fs::exists(lamp.parent_path() / "out.exr"));
    }
}

TEST(IesCommand, RefusesACubeInAFlatFormatAndAPixelTheFormatLacks) {
    const TemporaryFolder folder;
    const fs::path lamp = folder.write("lamp.ies", kLamp), out = lamp.parent_path() / "out.png";
    const Outcome cube = run_program({"ies", lamp, "--projection", "cube", "-o", out});
    EXPECT_EQ(cube.code, 2);
    EXPECT_THAT(cube.err, HasSubstr("holds no cube map"));
    const Outcome half = run_program({"ies", lamp, "--pixel", "half", "-o", out});
    EXPECT_EQ(half.code, 2);
    EXPECT_THAT(half.err, HasSubstr("\"unorm16\""));
}

TEST(IesCommand, ConvertsThereAndBack) {
    const TemporaryFolder folder;
    const fs::path lamp = folder.write("lamp.ies", kLamp), ldt = lamp.parent_path() / "lamp.ldt",
                   back = lamp.parent_path() / "back.IES";
    Outcome outcome = run_program({"ies", "--convert", lamp, "-o", ldt});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("has no field for TILT"));
    outcome = run_program({"ies", ldt, "--convert", "-o", back});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(job::read_text(back), testing::StartsWith("IES:LM-63-2019\r\n"));
    EXPECT_EQ(run_program({"ies", lamp, "--convert", "-o", lamp}).code, 2);
    EXPECT_EQ(run_program({"ies", lamp, "--convert", "-o", lamp.parent_path() / "a.exr"}).code, 2);
    EXPECT_EQ(run_program({"ies", lamp.parent_path() / "none.ies", "--convert", "-o", ldt}).code, 4);
}

}  // namespace
}  // namespace pbrbake::test
