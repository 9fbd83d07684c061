#include "pbr/ibl/bright_texels.hpp"

#include <gtest/gtest.h>

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
        EXPECT_GT(BrightTexels(texels).integrate(alpha, at, found), 0u);
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

}  // namespace
}  // namespace pbr
