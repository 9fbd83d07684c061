#include <gtest/gtest.h>

#include "bakers/job/paths.hpp"
#include "tests/bakers/job/temporary_folder.hpp"

namespace pbrbake::job {
namespace {

namespace fs = std::filesystem;

TEST(PlaceOf, PartsAFileFromAPictureInside) {
    const Place place = place_of("/data/scene.glb#/images/12");
    EXPECT_EQ(place.file, "/data/scene.glb");
    EXPECT_EQ(place.image, 12u);
    EXPECT_EQ(place.name(), "scene.glb#/images/12");
    for (const char* path : {"a.png", "a#b.png", "a.glb#/images/", "a.glb#/images/x", "a.glb#/images/-1",
                             "a.glb#/images/1x", "a.glb#/images/99999999999999999999", ""}) {
        EXPECT_FALSE(place_of(path).image) << path;
        EXPECT_EQ(place_of(path).file, path);
    }
}

TEST(Fence, KeepsPathsInsideTheFolder) {
    const test::TemporaryFolder folder;
    const Fence fence(folder / "job", {});
    EXPECT_FALSE(fence.refusal("a.hdr"));
    EXPECT_FALSE(fence.refusal("deep/er/a.hdr"));
    EXPECT_FALSE(fence.refusal("deep/../a.hdr"));
    EXPECT_TRUE(fence.refusal("../a.hdr"));
    EXPECT_TRUE(fence.refusal("deep/../../a.hdr"));
    EXPECT_TRUE(fence.refusal("../job2/a.hdr")) << "a longer name is another folder";
    EXPECT_TRUE(fence.refusal("/etc/passwd"));
    EXPECT_TRUE(fence.refusal(std::string("a\0b", 3)));
}

TEST(Fence, FollowsSymbolicLinks) {
    const test::TemporaryFolder folder;
    folder.write("outside/a.hdr", "");
    folder.write("job/inside/a.hdr", "");
    fs::create_directory_symlink(folder / "outside", folder / "job/out");
    fs::create_directory_symlink(folder / "job/inside", folder / "job/in");
    fs::create_symlink(folder / "outside/a.hdr", folder / "job/a.hdr");
    const Fence fence(folder / "job", {});
    EXPECT_TRUE(fence.refusal("out/a.hdr"));
    EXPECT_TRUE(fence.refusal("out/absent.hdr"));
    EXPECT_TRUE(fence.refusal("a.hdr"));
    EXPECT_FALSE(fence.refusal("in/a.hdr"));
}

TEST(Fence, OpensForRoots) {
    const test::TemporaryFolder folder;
    EXPECT_FALSE(Fence(folder / "job", {"../shared"}).refusal("../shared/a.hdr"));
    EXPECT_FALSE(Fence(folder / "job", {folder / "shared/"}).refusal("../shared/a.hdr"));
    EXPECT_TRUE(Fence(folder / "job", {"../shared"}).refusal("../a.hdr"));
}

TEST(Fence, CanBeAJobInTheCurrentFolder) {
    EXPECT_FALSE(Fence("", {}).refusal("a.hdr"));
    EXPECT_TRUE(Fence("", {}).refusal("../a.hdr"));
    EXPECT_EQ(Fence("", {}).resolve("a.hdr"), "a.hdr");
}

TEST(Fence, TrustsTheCommandLine) {
    EXPECT_FALSE(Fence::open().refusal("/etc/passwd"));
    EXPECT_FALSE(Fence::open().refusal("../a.hdr"));
}

}  // namespace
}  // namespace pbrbake::job
