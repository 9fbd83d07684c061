#include "pbr/ibl/bright_texels.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <vector>

#include "pbr/ibl/ld.hpp"
#include "tests/libpbr/ibl/pictures.hpp"

namespace pbr {
namespace {

/// Directions near and far, among them some at texels' centres.
std::vector<glm::dvec3> directions(const PatchBlocks& texels) {
    std::vector<glm::dvec3> result;
    for (int i = 0; i < 150; ++i) result.push_back(random_direction(3, i));
    for (int i = 0; i < texels.count(); i += 5) result.push_back(texels.cone(i).axis);
    return result;
}

void expect_sums(const PatchBlocks& texels) {
    const std::vector<glm::dvec3> at = directions(texels);
    for (const double alpha : {0.0036, 0.04, 0.3, 1.0}) {
        std::vector<double> found(at.size() * 3), truth(at.size() * 3);
        std::uint64_t evaluations = 0;
        ld_partial(texels, alpha, at, truth, evaluations);
        EXPECT_GT(BrightTexels(texels, {}, 0, true).integrate(alpha, at, found), 0u);
        for (std::size_t i = 0; i < found.size(); ++i)
            ASSERT_NEAR(found[i], truth[i], 2e-5 * truth[i]) << alpha << " " << i / 3;
    }
}

TEST(BrightTexels, AddWhatTheExactSumAdds) {
    const std::vector<float> picture = noise_picture(128, 64), cube = noise_cube(32);
    std::vector<CubeTexel> of_picture{{0, 0, 0}, {0, 127, 63}}, of_cube{{0, 0, 0}, {5, 31, 31}};
    for (int i = 0; i < 60; ++i) {
        const auto random = [&](int k, int below) { return static_cast<int>(below * random_unit(9, i, k)); };
        of_picture.push_back({0, random(0, 128), random(1, 64)});
        of_cube.push_back({random(2, 6), random(3, 32), random(4, 32)});
    }
    expect_sums(PatchBlocks(EquirectView{picture.data(), 128, 64}, of_picture));
    expect_sums(PatchBlocks(CubeView{cube.data(), 32}, of_cube));
}

TEST(BrightTexels, NearAndFarPartsMakeTheWhole) {
    const std::vector<float> picture = noise_picture(128, 64);
    std::vector<CubeTexel> apart;
    for (int i = 0; i < 64; ++i) apart.push_back({0, static_cast<int>(128 * random_unit(9, i)), i});
    const PatchBlocks texels(EquirectView{picture.data(), 128, 64}, apart);
    const std::vector<glm::dvec3> at = directions(texels);
    const BrightTexels bright(texels, {}, 0, true);
    for (const double alpha : {0.04, 0.16})
        for (const double radius : {0.1, 0.4}) {
            const SplitKernel split(GgxZonalKernel(alpha), radius);
            std::vector<double> near(at.size() * 3), whole(at.size() * 3);
            bright.integrate(alpha, at, whole);
            bright.integrate(split, at, near);
            for (std::size_t i = 0; i < at.size(); ++i) {
                glm::dvec3 far(0);  // by points that are close against the far part's width
                for (int texel = 0; texel < texels.count(); ++texel) {
                    PatchPoints points;
                    texels.points(texel, 6, points);
                    for (std::size_t k = 0; k < points.size(); ++k) {
                        const glm::dvec3 apart_by = at[i] - glm::dvec3(points.x[k], points.y[k], points.z[k]);
                        far += split.far(glm::dot(apart_by, apart_by) / 2) *
                               static_cast<double>(points.weight[k]) *
                               glm::dvec3(points.r[k], points.g[k], points.b[k]);
                    }
                }
                for (std::size_t c = 0; c < 3; ++c) {
                    const double expected = whole[i * 3 + c];
                    ASSERT_NEAR(near[i * 3 + c] + far[static_cast<int>(c)], expected, 2e-5 * expected + 1e-8)
                        << alpha << " " << radius << " " << i;
                }
            }
        }
}

}  // namespace
}  // namespace pbr
