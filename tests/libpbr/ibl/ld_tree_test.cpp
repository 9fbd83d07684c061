// The exact sum over a tree against the plain one.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <vector>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/ld.hpp"
#include "pbr/ibl/moment_tree.hpp"
#include "pbr/ibl/spherical_harmonics.hpp"
#include "pbr/numerics/sequence.hpp"

namespace pbr {
namespace {

/// Noise with a soft side, and a lamp of one texel.
std::vector<float> noise(std::size_t texels, float lamp) {
    std::vector<float> rgb(texels * 3);
    for (std::size_t i = 0; i < texels; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            rgb[i * 3 + c] =
                static_cast<float>(std::pow(random_unit(7, i, c), 4) + (i < texels / 3 ? 1.0 : 0.05));
    for (std::size_t c = 0; c < 3; ++c) rgb[texels / 4 * 3 + c] += lamp;
    return rgb;
}

/// 4 x 4 texels of a face, close together or far apart as `size` is large or small.
std::vector<glm::dvec3> tile(int face, int left, int top, int size) {
    std::vector<glm::dvec3> directions;
    for (int i = 0; i < 16; ++i)
        directions.push_back(cubemap_texel_direction({face, left + i % 4, top + i / 4}, size));
    return directions;
}

/// `of_points`: the relative error of ld_exact's points, at this size of picture.
void expect_within_bound(const PatchBlocks& blocks, double tolerance, double of_points = 1e-4) {
    const MomentTree tree(blocks, for_each_in_turn);
    const glm::dvec3 mean = tree.mean();
    const double mean_of_channels = (mean.x + mean.y + mean.z) / 3;
    for (const double alpha : {0.003, 0.04, 0.16, 0.36, 0.64, 1.0})
        for (const int size : {4, 256}) {
            std::vector<glm::dvec3> directions = tile(static_cast<int>(100 * alpha) % 6, 0, 0, size);
            std::vector<double> plain(48), quick(48);
            std::uint64_t evaluations = 0, fewer = 0;
            ld_exact(blocks, alpha, directions, plain, evaluations);
            const LdTreeError error = ld_exact(tree, alpha, tolerance, directions, quick, fewer);
            EXPECT_LE(error.far_field, 2 * tolerance) << alpha;
            EXPECT_GE(error.far_field, 0);
            for (std::size_t i = 0; i < 48; ++i) {
                // Beyond the proven figure, both have the error of their points.
                EXPECT_LE(std::abs(quick[i] - plain[i]),
                          error.far_field * (mean_of_channels + quick[i]) + 2 * of_points * plain[i])
                    << "alpha " << alpha << " size " << size << " tolerance " << tolerance;
            }
        }
}

TEST(LdTree, StaysWithinItsProvenBoundOnEquirects) {
    const std::vector<float> dim = noise(256 * 128, 0), lit = noise(256 * 128, 100);
    for (const double tolerance : {1e-2, 1e-4}) {
        expect_within_bound(PatchBlocks(EquirectView{dim.data(), 256, 128}), tolerance);
        expect_within_bound(
            PatchBlocks(EquirectView{lit.data(), 256, 128, glm::dmat3(0, 0, 1, 0, 1, 0, -1, 0, 0)}),
            tolerance);
    }
}

TEST(LdTree, StaysWithinItsProvenBoundOnCubes) {
    const std::vector<float> lit = noise(std::size_t{6} * 64 * 64, 30);
    for (const double tolerance : {1e-2, 1e-4})
        expect_within_bound(PatchBlocks(CubeView{lit.data(), 64}), tolerance);
}

TEST(LdTree, ErrorIsFarBelowTheBound) {
    // What the header says of the error itself: a hundredth of the tolerance, here a tenth.
    const std::vector<float> picture = noise(512 * 256, 0);
    const PatchBlocks blocks(EquirectView{picture.data(), 512, 256});
    const MomentTree tree(blocks, for_each_in_turn);
    for (const double alpha : {0.04, 0.16}) {
        std::vector<double> plain(48), quick(48);
        std::uint64_t evaluations = 0, fewer = 0;
        const std::vector<glm::dvec3> directions = tile(2, 40, 60, 128);
        ld_exact(blocks, alpha, directions, plain, evaluations);
        ld_exact(tree, alpha, 1e-3, directions, quick, fewer);
        EXPECT_LT(fewer * 16, evaluations);
        for (std::size_t i = 0; i < 48; ++i) EXPECT_NEAR(quick[i], plain[i], 1e-4 * tree.mean()[0]) << alpha;
    }
}

TEST(LdTree, TinyAndOddPicturesWork) {
    for (const auto& [width, height] : {std::pair{1, 1}, {2, 1}, {3, 2}, {7, 5}, {33, 17}, {101, 49}}) {
        const std::vector<float> picture = noise(static_cast<std::size_t>(width) * height, 5);
        expect_within_bound(PatchBlocks(EquirectView{picture.data(), width, height}), 1e-3,
                            2e-2);  // a horizon through few texels
    }
    for (const int size : {1, 2, 3, 5, 11}) {
        const std::vector<float> picture = noise(static_cast<std::size_t>(size) * size * 6, 5);
        expect_within_bound(PatchBlocks(CubeView{picture.data(), size}), 1e-3,
                            2e-2);  // a horizon through few texels
    }
}

TEST(LdTree, ConstantEnvironmentStaysConstantAndLargeRadianceFinite) {
    for (const float value : {3.25f, 3e38f}) {
        const std::vector<float> picture(std::size_t{64} * 32 * 3, value);
        const PatchBlocks blocks(EquirectView{picture.data(), 64, 32});
        const MomentTree tree(blocks, for_each_in_turn);
        for (const double alpha : {0.01, 0.3, 1.0}) {
            std::vector<double> rgb(48);
            std::uint64_t evaluations = 0;
            ld_exact(tree, alpha, 1e-3, tile(0, 3, 3, 16), rgb, evaluations);
            for (const double result : rgb) EXPECT_NEAR(result / value, 1, 1e-5);
        }
    }
}

TEST(MomentTree, LowBandsAreThoseOfItsTexels) {
    const std::vector<float> picture = noise(512 * 256, 100), cube = noise(std::size_t{6} * 128 * 128, 100);
    const auto compare = [](const PatchBlocks& blocks) {
        const MomentTree tree(blocks, for_each_in_turn);
        const std::vector<glm::dvec3> exact = sh_project(blocks, kMomentBands),
                                      ours = sh_project(tree, kMomentBands);
        for (std::size_t i = 0; i < exact.size(); ++i)
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(ours[i][c], exact[i][c], 1e-4 * tree.mean()[c]) << i;
    };
    compare(PatchBlocks(EquirectView{picture.data(), 512, 256}));
    compare(PatchBlocks(CubeView{cube.data(), 128}));
}

}  // namespace
}  // namespace pbr
