#include "bakers/job/flags.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "bakers/job/json_text.hpp"

namespace pbrbake::job {
namespace {

using testing::ElementsAre;
using testing::StartsWith;

Json param(const std::string& kind, const std::string& flag, const std::string& text,
           const std::string& property) {
    std::vector<FlagText> flags{{flag, text}};
    if (kind == "probe") flags.push_back({"source", "a.hdr"});
    return from_flags(kind, flags, "out.exr").bakes[0].params[property];
}

std::vector<std::string> mistakes(const std::string& kind, const std::vector<FlagText>& flags,
                                  const std::string& output = "out.exr") {
    std::vector<std::string> lines;
    try {
        from_flags(kind, flags, output);
    } catch (const JobError& error) {
        EXPECT_EQ(error.code(), ExitCode::usage);
        for (const Mistake& mistake : error.mistakes())
            lines.push_back(mistake.pointer + ": " + mistake.message);
    }
    return lines;
}

TEST(Flags, AreTheSchemasProperties) {
    std::vector<std::string> names;
    for (const Flag& flag : flags_of("dfg")) names.push_back(flag.name);
    EXPECT_THAT(names, ElementsAre("target", "size", "terms", "disney", "cloth", "axis", "roughness-axis",
                                   "align", "form", "flip-rows", "min-perceptual-roughness", "integrator",
                                   "samples", "seed", "format", "pixel", "certify", "accuracy",
                                   "working-space", "max-side", "max-decoded-bytes"));
}

TEST(Flags, TellWhatTheyTake) {
    std::map<std::string, Flag> flags;
    for (const Flag& flag : flags_of("dfg")) {
        EXPECT_NE(flag.help, "") << flag.name;
        flags[flag.name] = flag;
    }
    EXPECT_EQ(flags["size"].value, "N|N,...");
    EXPECT_THAT(flags["size"].help,
                testing::EndsWith("[integer 0 to 4096, or an array of 2 to 3 of those; default: 0]"));
    EXPECT_TRUE(flags["flip-rows"].is_switch);
    EXPECT_EQ(flags["accuracy"].value, "draft|production|reference|X");
}

TEST(Flags, BecomeJson) {
    EXPECT_EQ(param("dfg", "size", "64", "size"), 64);
    EXPECT_EQ(param("dfg", "size", "64,32", "size"), Json::array({64, 32}));
    EXPECT_EQ(param("dfg", "size", "64x32", "size"), Json::array({64, 32}));
    EXPECT_EQ(param("dfg", "terms", "ggx,disney_diffuse", "terms"), Json::array({"ggx", "disney_diffuse"}));
    EXPECT_EQ(param("dfg", "terms", "ggx", "terms"), Json::array({"ggx"}));
    EXPECT_EQ(param("dfg", "flip-rows", "true", "flip_rows"), true);
    EXPECT_EQ(param("dfg", "flip-rows", "false", "flip_rows"), false);
    EXPECT_EQ(param("dfg", "accuracy", "draft", "accuracy"), "draft");
    EXPECT_EQ(param("dfg", "accuracy", "1e-3", "accuracy"), (Json{{"max_error", 1e-3}}));
    EXPECT_EQ(param("dfg", "accuracy", "1e-3:sampled", "accuracy"),
              (Json{{"max_error", 1e-3}, {"as", "sampled"}}));
    EXPECT_EQ(param("probe", "samples", "32", "samples"), 32);
    EXPECT_EQ(param("probe", "samples", "1,16,32,32,64,64", "samples"), Json::array({1, 16, 32, 32, 64, 64}));
    EXPECT_EQ(param("probe", "rotate-deg", "-30", "rotate_deg"), -30.0);
}

TEST(Flags, GoDownTheWayOfAJob) {
    const Job job = from_flags("dfg", std::vector<FlagText>{{"max-side", "512"}, {"working-space", "acescg"}},
                               "some where/my lut.ktx2");
    EXPECT_EQ(job.max_side, 512);
    EXPECT_EQ(job.working_space, "acescg");
    EXPECT_EQ(job.output, "some where");
    EXPECT_EQ(job.record, Record::sidecar);
    EXPECT_EQ(job.bakes[0].file, "my lut.ktx2");
    EXPECT_EQ(job.bakes[0].name, "my_lut");
    EXPECT_EQ(job.bakes[0].format, "ktx2");
}

TEST(Flags, AreNamedInMistakes) {
    EXPECT_THAT(mistakes("dfg", {{"size", "big"}, {"terms", "ggx,gx"}, {"seed", "nan"}}),
                ElementsAre("--size: found \"big\"; allowed: integer 0 to 4096, or an array of 2 to 3 of those",
                            "--terms: found \"gx\"; allowed: \"ggx\", \"disney_diffuse\", \"multiscatter\", "
                            "\"charlie\", \"clear_coat\", \"uncorrelated\", \"eon\", \"chan\", \"hammon\", "
                            "\"subsurface\", \"ggx_anisotropic\"; did you mean \"ggx\"?",
                            "--seed: found \"nan\"; allowed: integer 0 to 2^53 - 1"));
    EXPECT_THAT(mistakes("dfg", {{"max-side", "0"}}),
                ElementsAre("--max-side: found 0; allowed: integer 1 to 1048576"));
    EXPECT_THAT(mistakes("dfg", {{"accuracy", "1e-3:sampeld"}}),
                ElementsAre(testing::HasSubstr("--accuracy: found \"1e-3:sampeld\"")));
    EXPECT_THAT(mistakes("dfg", {{"accuracy", "-1"}}),
                ElementsAre("--accuracy: found -1.0; allowed: number above 0"));
    EXPECT_THAT(mistakes("probe", {}), ElementsAre(StartsWith("SOURCE: missing")));
}

TEST(Flags, GetTheFormatFromTheOutput) {
    EXPECT_THAT(mistakes("dfg", {}, "out.gif"), ElementsAre(StartsWith("-o: found \"out.gif\"; allowed:")));
    for (const char* output : {"", ".exr", "out", "folder/", "."})
        EXPECT_THAT(mistakes("dfg", {}, output), ElementsAre(StartsWith("-o: found"))) << output;
    EXPECT_THAT(mistakes("dfg", {{"format", "ktx2"}}),
                ElementsAre(StartsWith("--format: found \"ktx2\", but -o ends")));
    EXPECT_THAT(mistakes("dfg", {{"format", "exr"}}), ElementsAre());
}

TEST(Flags, LeaveNoAbsolutePathInTheRecord) {
    const Job job = from_flags("probe", std::vector<FlagText>{{"source", "/data/hdri/a.hdr"}}, "out.exr");
    EXPECT_EQ(job.bakes[0].sources[0].file, "/data/hdri/a.hdr");
    EXPECT_EQ(job.bakes[0].params["source"], "a.hdr");
    EXPECT_EQ(job.bakes[0].sources[0].read.path, "a.hdr");
}

}  // namespace
}  // namespace pbrbake::job
