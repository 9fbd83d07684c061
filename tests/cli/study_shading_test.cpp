#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "bakers/job/json_text.hpp"
#include "tests/cli/program.hpp"

namespace pbrbake::test {
namespace {

TEST(StudyShading, WritesAPageAndFigures) {
    const TemporaryFolder folder;
    const Outcome outcome =
        run_program({"study", "--shading", "--size", "8", "-o", (folder / "study").string()});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, testing::EndsWith("study/index.html\n"));
    EXPECT_THAT(read_file(folder / "study/index.html"), testing::HasSubstr("Gold, a plane at grazing view"));
    const Json figures = job::parse_json(read_file(folder / "study/figures.json"), "figures.json");
    EXPECT_EQ(figures["scenes"].size(), 3u * 4 * 2);  // scenes, roughnesses, ways to shade
    // On the rough plane, look-ups along R lose most, and the dominant direction takes some of it back.
    double mirrored = 0, dominant = 0;
    for (const Json& scene : figures["scenes"])
        if (scene["scene"] != "spheres" && scene["perceptual_roughness"] == 0.8)
            (scene["shading"] == "split_sum" ? mirrored : dominant) = scene["errors"].back()["relative_rms"];
    EXPECT_GT(mirrored, 0.2);
    EXPECT_LT(dominant, 0.8 * mirrored);
}

TEST(StudyShading, WithoutOpenColorIOPicturesAreSrgb) {
    // A copy of the program in a tree with the other module alone, which pictures need.
    namespace fs = std::filesystem;
    const TemporaryFolder folder;
    for (const char* name : {"bin", "lib/pbrbake"}) fs::create_directories(folder / name);
    fs::copy_file(PBRBAKE_PROGRAM, folder / "bin/pbrbake");
    const fs::path module = "lib/pbrbake/pbrbake_oiio.so";
    fs::create_symlink(fs::path(PBRBAKE_PROGRAM).parent_path().parent_path() / module,
                       folder / module.string());
    const std::string command = (folder / "bin/pbrbake").string() + " study --shading --size 8 -o " +
                                (folder / "study").string() + " > " + (folder / "out").string();
    ASSERT_EQ(std::system(command.c_str()), 0);
    const std::string page = read_file(folder / "study/index.html");
    if (page.find("by OpenColorIO") != std::string::npos) GTEST_SKIP() << "the modules are installed";
    EXPECT_THAT(page, testing::HasSubstr("pictures go through sRGB, clipped (OpenColorIO is not installed)"));
}

TEST(StudyShading, KeepsAJobOfSomeoneElse) {
    const TemporaryFolder folder;
    folder.write("job.json", "{}");
    const Outcome outcome = run_program({"study", "--shading", "-o", folder.path().string()});
    EXPECT_EQ(outcome.code, 5);
    EXPECT_EQ(read_file(folder / "job.json"), "{}");
}

}  // namespace
}  // namespace pbrbake::test
