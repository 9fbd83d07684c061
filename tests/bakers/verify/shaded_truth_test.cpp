#include "bakers/verify/shaded_truth.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "pbr/ibl/dfg.hpp"
#include "pbr/reference/reflected_radiance.hpp"
#include "tests/bakers/verify/baked_folder.hpp"

namespace pbrbake::verify {
namespace {

/// An equirect whose texels are a function of their row, the same all round.
Level equirect(int height, const std::function<double(double y)>& radiance_of_height) {
    Level level{2 * height, height, {}};
    for (int row = 0; row < height; ++row)
        for (int i = 0; i < 2 * height * 3; ++i)
            level.texels.push_back(
                static_cast<float>(radiance_of_height(std::cos((row + 0.5) / height * std::acos(-1.0)))));
    return level;
}

BakedImage constant_probe(float value) {
    BakedImage probe{{}, 1, {0, 0.5, 1}};
    probe.image.channels = {"R", "G", "B"};
    probe.image.faces = 6;
    for (int n = 8; n > 1; n /= 2)
        probe.image.levels.push_back({n, n, std::vector<float>(static_cast<std::size_t>(n) * n * 18, value)});
    return probe;
}

BakedImage table() { return {io::read_product(pbrbake::test::baked_folder() / "table.exr").image, 1, {}}; }

pbr::Surface<double> gold(double perceptual_roughness) {
    return pbr::surface_from_material<double>({{1, 0.77, 0.34}, 1 - perceptual_roughness, 1, 0.5});
}

VisiblePoint seen_at(double NoV) { return {{0, 1, 0}, {std::sqrt(1 - NoV * NoV), NoV, 0}}; }

TEST(ShadedTruth, AllWaysAgreeInAFurnace) {
    const Level sky = equirect(16, [](double) { return 2.0; });
    const BakedImage probe = constant_probe(2), dfg = table();
    const ShadedTruth truth(sky, probe, dfg);
    const pbr::Surface<double> paint = pbr::surface_from_material<double>({{0.5, 0.2, 0.1}, 0.4, 0, 0.5});
    for (const pbr::Surface<double>& surface : {gold(0.4), gold(0.8), paint})
        for (const double NoV : {0.1, 0.4, 0.95}) {
            const glm::dvec3 exact = truth.radiance(Shading::exact, surface, seen_at(NoV));
            for (const Shading shading : {Shading::split_sum, Shading::split_sum_dominant}) {
                const glm::dvec3 split = truth.radiance(shading, surface, seen_at(NoV));
                // A bilinear look-up of a table of 64 in half, and texels that the horizon cuts.
                for (int c = 0; c < 3; ++c) EXPECT_NEAR(split[c], exact[c], 0.006) << NoV << " " << c;
            }
        }
}

TEST(ShadedTruth, ExactIsTheIntegralOverDirections) {
    // Rows of constant radiance, fine enough that they stand for the function itself.
    const auto radiance = [](double y) { return 1 + 0.5 * y; };
    const Level sky = equirect(128, radiance);
    const BakedImage probe = constant_probe(1), dfg = table();
    const ShadedTruth truth(sky, probe, dfg);
    for (const double NoV : {0.15, 0.7}) {
        const pbr::Surface<double> surface = gold(0.6);
        const auto brdf = [&](const glm::dvec3& wo, const glm::dvec3& wi) {
            const auto r = pbr::reflection(wo, wi);
            return pbr::F_schlick(surface.f0.y, surface.f90, r.LoH) * pbr::DV_standard_specular(surface, r);
        };
        // In the frame of the surface the normal, the world's y, is z.
        const double expected = pbr::reflected_radiance_half_vector(
                                    brdf, {std::sqrt(1 - NoV * NoV), 0, NoV},
                                    [&](const glm::dvec3& wi) { return radiance(wi.z); }, surface.alpha)
                                    .value;
        EXPECT_NEAR(truth.radiance(Shading::exact, surface, seen_at(NoV)).y, expected, 2e-3 * expected);
    }
}

TEST(ShadedScene, SphereIsSeenHeadOnInItsMiddleAndGrazingAtItsRim) {
    const ShadedScene scene = sphere_scene(31, {0, 0, -1});
    const auto at = [&](int x, int y) { return scene.points[static_cast<std::size_t>(y) * 31 + x]; };
    EXPECT_NEAR(at(15, 15)->NoV(), 1, 1e-12);
    EXPECT_LT(at(0, 15)->NoV(), 0.3);
    EXPECT_FALSE(at(0, 0));
    EXPECT_GT(at(15, 5)->normal.y, 0.5);
    EXPECT_GT(at(25, 15)->normal.x, 0.5);
}

TEST(ShadedScene, PlaneIsSeenMoreGrazingFartherUp) {
    const ShadedScene scene = plane_scene(8, 16, {0, -0.3, -1});
    double previous = 0;
    for (int y = 0; y < 16; ++y) {
        const VisiblePoint& point = *scene.points[static_cast<std::size_t>(y) * 8 + 4];
        EXPECT_GT(point.NoV(), previous);
        EXPECT_NEAR(glm::length(point.view), 1, 1e-12);
        previous = point.NoV();
    }
    EXPECT_NEAR(previous, std::sin(29.125 * std::acos(-1.0) / 180), 1e-9);
}

TEST(ShadingErrors, AreSortedByNoV) {
    const ShadedScene scene = sphere_scene(32, {0, 0, -1});
    LinearPicture exact(32, 32), off(32, 32);
    for (std::size_t i = 0; i < scene.points.size(); ++i) {
        if (!scene.points[i]) continue;
        exact.rgb[i] = glm::dvec3(2);
        off.rgb[i] = glm::dvec3(scene.points[i]->NoV() < 0.3 ? 3.0 : 2.0);
    }
    const std::vector<ShadingError> errors = shading_errors(off, exact, scene);
    EXPECT_NEAR(errors[1].relative_rms, 0.5, 1e-12);
    EXPECT_NEAR(errors[1].bias, 0.5, 1e-12);
    EXPECT_EQ(errors[2].relative_rms, 0);
    EXPECT_EQ(errors[3].relative_rms, 0);
    EXPECT_EQ(errors[0].points + errors[1].points + errors[2].points + errors[3].points, errors[4].points);
}

}  // namespace
}  // namespace pbrbake::verify
