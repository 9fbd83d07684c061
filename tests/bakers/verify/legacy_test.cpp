#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/io/io.hpp"
#include "bakers/run/bake_one.hpp"
#include "bakers/verify/legacy_sets.hpp"
#include "bakers/verify/study_against.hpp"
#include "bakers/verify/study_job.hpp"
#include "bakers/verify/texture_proof.hpp"
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

/// A texel of a map as its 8-bit codes decode: diffuse and specular by sRGB's curve.
LegacyTexel decoded(const LegacyTexel& painted) {
    const auto through_codes = [](const glm::dvec3& linear) {
        glm::dvec3 encoded;
        for (int c = 0; c < 3; ++c) encoded[c] = srgb_byte(linear[c]) / 255.0;
        return linear_of_display(encoded);
    };
    return {through_codes(painted.diffuse), through_codes(painted.specular),
            std::round(255 * painted.gloss) / 255};
}

/// A set's maps baked with some properties replaced. A report points into its job.
struct Converted {
    Converted(const LegacySet& set, const TemporaryFolder& folder, const Json& overrides, int size = 64)
        : job(single_bake_job(
              {}, with_overrides(write_legacy_maps(set, size, folder.path()), all_texels(overrides)),
              set.name, folder.path())),
          report(run::run_bake(job, job.bakes.front(), {})) {
        EXPECT_EQ(report.error, "");
    }
    static Json all_texels(Json overrides) {
        overrides["certify"] = "full";
        return overrides;
    }
    double figure(const char* metric) const {
        for (const Json& figure : report.entry["certificate"]["figures"])
            if (figure["metric"] == metric) return figure["value"].get<double>();
        return NAN;
    }

    job::Job job;
    run::BakeReport report;
};

const Json kAtItsWord{{"calibrate", "none"}, {"pixel", "float"}};

TEST(LegacySets, MapsAreWhatIsPaintedFirstRowFirst) {
    const TemporaryFolder folder;
    constexpr int kSize = 64;
    for (const LegacySet& set : legacy_sets()) {
        const Json bake = write_legacy_maps(set, kSize, folder.path());
        const Image diffuse = io::read_source({.path = bake["diffuse"].get<std::string>()}).image;
        double off = 0, flipped = 0, mirrored = 0;
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x) {
                const double painted = decoded(set.painted((x + 0.5) / kSize, (y + 0.5) / kSize)).diffuse.x;
                off += std::abs(diffuse.texel(0, 0, y, x)[0] - painted);
                flipped += std::abs(diffuse.texel(0, 0, kSize - 1 - y, x)[0] - painted);
                mirrored += std::abs(diffuse.texel(0, 0, y, kSize - 1 - x)[0] - painted);
            }
        // A texel is a mean over 16 points, and what is painted has edges.
        EXPECT_LT(off / (kSize * kSize), 0.02) << set.name;
        EXPECT_LT(2 * off, std::min(flipped, mirrored)) << set.name;
    }
}

LegacyTexel painted_flat(double, double) { return {{.2, .3, .1}, {.05, .1, .02}, .5}; }
constexpr LegacySet kFlat{"flat", "", "", true, painted_flat};

TEST(BeforeAndAfter, AsReadIsTheLegacyLobe) {
    const TemporaryFolder folder;
    const LegacyTexel painted = decoded(painted_flat(0, 0));
    const double n = std::exp2(10 * painted.gloss);
    const auto expect_colour = [](const texture::Colour& found, const glm::dvec3& expected,
                                  double most = 2e-6) {
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(static_cast<double>(found[c]), expected[c], most);
    };
    for (const char* norm : {"energy", "none"}) {
        Json overrides = kAtItsWord;
        overrides["norm"] = norm;
        const Converted bake(kFlat, folder, overrides, 4);
        const texture::Appearance seen = ReadBackSet(bake.report, 1)->as_read(1, 2);
        ASSERT_TRUE(seen.phong.has_value());
        EXPECT_EQ(seen.phong->lobe, pbr::PhongLobe::blinn);
        EXPECT_NEAR(seen.phong->exponent / n, 1, 1e-5);
        expect_colour(seen.diffuse, painted.diffuse);
        // cos^n returns 4 pi / (n + 4) of an even sky; over its albedo at normal view where that is the norm.
        const double over = norm == std::string("none")
                                ? 1
                                : 8 * std::numbers::pi * (n + std::exp2(-n / 2)) / ((n + 2) * (n + 4));
        expect_colour(seen.phong->mean_albedo, painted.specular * 4. * std::numbers::pi / (n + 4) / over);
    }
    Json overrides = kAtItsWord;
    overrides["model"] = "specular_gloss";
    overrides["gloss_is"] = "smoothness";
    const Converted bake(kFlat, folder, overrides, 4);
    ReadBackSet set(bake.report, 1);
    // A bake may move diffuse light by half its file's interval.
    for (const auto& [seen, most] :
         {std::pair{set->as_read(0, 0), 2e-6}, std::pair{set->stored(0, 0), .5 / 255 + 1e-6}}) {
        EXPECT_FALSE(seen.phong.has_value());
        expect_colour(seen.diffuse, painted.diffuse * (1 - painted.specular.y), most);
        expect_colour(seen.f0, painted.specular);
        EXPECT_NEAR(static_cast<double>(seen.perceptual_roughness), 1 - painted.gloss, 1e-6);
    }
}

/// The certificate reads the product in memory, this the files.
TEST(BeforeAndAfter, ChangesAreThoseThatCertificatesCount) {
    for (const LegacySet& set : legacy_sets())
        for (const char* packing : {"gltf", "frostbite", "unity", "specular_gloss"}) {
            SCOPED_TRACE(std::string(set.name) + " " + packing);
            const TemporaryFolder folder;
            const Converted bake(set, folder, {{"packing", packing}, {"format", "png"}});
            const ReadBackSet read(bake.report, 1);
            double sum = 0, most = 0;
            for (int y = 0; y < read->height(); ++y)
                for (int x = 0; x < read->width(); ++x) {
                    const double delta = read->change(x, y).delta_e;
                    sum += delta;
                    most = std::max(most, delta);
                }
            EXPECT_NEAR(most, bake.figure("delta_e_max"), 1e-4 * most);
            EXPECT_NEAR(sum / (64 * 64), bake.figure("delta_e_mean"), 1e-4 * most);
        }
}

SetSpheres spheres_of(const Converted& bake, int size) {
    ReadBackSet set(bake.report, 1);
    return set_spheres(*set, size, set.context());
}

TEST(SetSpheres, BeforeAndAfterReflectAlike) {
    for (const LegacySet& set : legacy_sets())
        for (const bool multiscatter : {false, true}) {
            const TemporaryFolder folder;
            Json overrides = kAtItsWord;
            overrides["multiscatter"] = multiscatter;
            const SetSpheres spheres = spheres_of({set, folder, overrides}, 24);
            EXPECT_TRUE(spheres.calibrated.rgb.empty());
            const LinearPicture &before = spheres.aim(), &after = spheres.stored;
            // The room isn't an even sky, under which energy is kept; a Phong lobe and GGX have different
            // tails.
            EXPECT_NEAR(mean_luminance(after) / mean_luminance(before), 1, 0.05) << set.name;
            EXPECT_LT(sphere_flip(after, before), 0.1) << set.name;
        }
}

LegacyTexel painted_matt(double, double) { return {{.2, .3, .1}, {0, 0, 0}, 0}; }
LegacyTexel painted_even(double, double) { return {{0, 0, 0}, {.2, .3, .1}, 0}; }

TEST(SetSpheres, ALobeOfExponentZeroIsLamberts) {
    Json overrides = kAtItsWord;
    overrides["gloss_is"] = "power";
    const TemporaryFolder folder;
    const SetSpheres matt = spheres_of({{"matt", "", "", true, painted_matt}, folder, overrides, 4}, 16),
                     even = spheres_of({{"even", "", "", true, painted_even}, folder, overrides, 4}, 16);
    for (std::size_t i = 0; i < matt.as_read.rgb.size(); ++i)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(matt.as_read.rgb[i][c], even.as_read.rgb[i][c], 1e-5 * matt.as_read.rgb[i][c]);
}

TEST(SetSpheres, ACalibratedSetIsHeldAgainstItself) {
    const TemporaryFolder folder;
    const SetSpheres spheres = spheres_of(
        {kFlat, folder, {{"surface", "dielectric"}, {"calibrate", "library"}, {"pixel", "float"}}, 4}, 24);
    ASSERT_FALSE(spheres.calibrated.rgb.empty());
    EXPECT_EQ(spheres.aim().rgb, spheres.calibrated.rgb);
    EXPECT_LT(sphere_flip(spheres.stored, spheres.calibrated), 1e-3);
    EXPECT_GT(sphere_flip(spheres.as_read, spheres.calibrated), 1e-2);
}

TEST(TextureProof, ShowsPicturesAndWhatWasRead) {
    const TemporaryFolder folder;
    const Converted bake(kFlat, folder, {{"format", "png"}}, 4);
    const DisplayTransform display;
    std::string html = texture_proof_html(bake.report, display, 1) + texture_reading_html(bake.report);
    for (const char* words : {"<b>before</b><br>as read: Blinn-Phong", "<b>after</b>", "FLIP", "ΔE", "gained",
                              "stated by gloss_is", "confidence"})
        EXPECT_THAT(html, HasSubstr(words));
    const auto figures = [&] {
        std::size_t count = 0;
        for (std::size_t at = 0; (at = html.find("<figure", at)) != std::string::npos; ++at) ++count;
        return count;
    };
    const bool is_calibrated = bake.report.entry["set"]["calibration"] != "none";
    EXPECT_EQ(figures(), is_calibrated ? 6u : 5u);
    std::filesystem::remove(bake.report.writes.front());
    html = texture_proof_html(bake.report, display, 1);
    EXPECT_EQ(figures(), 0u);
    EXPECT_THAT(html, HasSubstr("No pictures: "));
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
