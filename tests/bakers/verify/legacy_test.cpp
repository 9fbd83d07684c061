#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bakers/io/io.hpp"
#include "bakers/run/bake_one.hpp"
#include "bakers/verify/legacy_pictures.hpp"
#include "bakers/verify/study_against.hpp"
#include "bakers/verify/study_job.hpp"
#include "pbr/light/colour.hpp"
#include "tests/bakers/job/temporary_folder.hpp"

namespace pbrbake::verify {
namespace {

using pbrbake::test::TemporaryFolder;
using testing::HasSubstr;

double mean_luminance(const LinearPicture& picture) {
    double sum = 0;
    for (const glm::dvec3& rgb : picture.rgb) sum += pbr::luminance_of_rgb(rgb);
    return sum / static_cast<double>(picture.rgb.size());
}

/// What a set's own bake wrote, and its report.
run::BakeReport converted(const LegacySet& set, const TemporaryFolder& folder) {
    const Json bake = with_overrides(
        write_legacy_maps(set, 64, folder.path()),
        {{"multiscatter", false}, {"calibrate", "none"}, {"packing", "separate"}, {"pixel", "float"}});
    const job::Job job = single_bake_job({}, bake, set.name, folder.path());
    run::BakeReport report = run::run_bake(job, job.bakes.front(), {});
    EXPECT_EQ(report.error, "");
    return report;
}

TEST(LegacySets, MapsAreWhatIsPaintedFirstRowFirst) {
    const TemporaryFolder folder;
    constexpr int kSize = 64;
    for (const LegacySet& set : legacy_sets()) {
        const Json bake = write_legacy_maps(set, kSize, folder.path());
        const Image diffuse = io::read_source({.path = bake["diffuse"].get<std::string>()}).image;
        double off = 0, flipped = 0, mirrored = 0;
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x) {
                const double painted = legacy_texel(set, (x + 0.5) / kSize, (y + 0.5) / kSize).diffuse.x;
                off += std::abs(diffuse.texel(0, 0, y, x)[0] - painted);
                flipped += std::abs(diffuse.texel(0, 0, kSize - 1 - y, x)[0] - painted);
                mirrored += std::abs(diffuse.texel(0, 0, y, kSize - 1 - x)[0] - painted);
            }
        // A texel is a mean over 16 points, and what is painted has edges.
        EXPECT_LT(off / (kSize * kSize), 0.02) << set.name;
        EXPECT_LT(2 * off, std::min(flipped, mirrored)) << set.name;
    }
}

TEST(LegacyPictures, BeforeAndAfterReflectAlike) {
    for (const LegacySet& set : legacy_sets()) {
        const TemporaryFolder folder;
        const run::BakeReport report = converted(set, folder);
        const LinearPicture before = legacy_sphere(set, 24), after = converted_sphere(report.writes, 24);
        ASSERT_EQ(after.rgb.size(), before.rgb.size()) << set.name;
        // The room isn't an even sky, under which energy is kept; a Phong lobe and GGX have different tails.
        EXPECT_NEAR(mean_luminance(after) / mean_luminance(before), 1, 0.05) << set.name;
        EXPECT_LT(sphere_flip(after, before), 0.1) << set.name;
    }
}

TEST(LegacyPictures, AnotherPackingHasNoSphere) {
    EXPECT_TRUE(converted_sphere({"x.exr", "x_orm.exr"}, 24).rgb.empty());
}

TEST(StudyAgainst, TellsTheFurthestRatio) {
    const auto study = [](double fis, double mis) {
        return Json::parse(R"({"cases": [{"name": "room", "base": 0, "points": [
            {"series": "is", "step": "8", "time_ratio": {"median": 1}},
            {"series": "is", "step": "9", "failure": "none"},
            {"series": "fis", "step": "8", "time_ratio": {"median": )" +
                           std::to_string(fis) + R"(}},
            {"series": "mis", "step": "8", "time_ratio": {"median": )" +
                           std::to_string(mis) + "}}]}]}");
    };
    EXPECT_EQ(ratio_agreement(study(2, 3), study(2.1, 4.5), .1),
              "1 of 2 ratios agree within 10.0 %; furthest apart by 50.0 % (room, mis 8: 3.00, before 4.50)");
    EXPECT_EQ(ratio_agreement(study(2, 3), Json::parse(R"({"cases": []})"), .1), "no setting in common");
}

}  // namespace
}  // namespace pbrbake::verify
