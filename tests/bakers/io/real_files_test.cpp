// Real HDRIs, where they are at hand.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/bakers/io/fixtures.hpp"

namespace pbrbake::io::test {
namespace {

TEST(RealFiles, EveryHdriIsReadFiniteAndNonNegative) {
    const auto data = shared_data();
    if (data.empty()) GTEST_SKIP() << "no shared data: set PBRBAKE_SHARED_DATA to its folder";
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(data / "hdri")) {
        SCOPED_TRACE(entry.path().filename().string());
        const SourceImage source = read_source({entry.path()});
        const bool exr = entry.path().extension() == ".exr";
        EXPECT_EQ(source.image.levels[0].width, exr ? 512 : 2048);
        EXPECT_EQ(source.image.levels[0].height, exr ? 256 : 1024);
        EXPECT_EQ(source.repairs.negative > 0, exr);
        EXPECT_EQ(source.repairs.non_finite, 0u);
        if (entry.path().filename() == "park.exr") {
            EXPECT_EQ(source.repairs.lowest, -1876);
        }
        bool sound = true;
        for (const float value : source.image.levels[0].texels)
            sound = sound && std::isfinite(value) && value >= 0;
        EXPECT_TRUE(sound);
        ++files;
    }
    EXPECT_GE(files, 7);
}

}  // namespace
}  // namespace pbrbake::io::test
