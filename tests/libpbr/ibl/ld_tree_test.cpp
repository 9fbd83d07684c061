// The exact sum over a tree against the plain one.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>
#include <vector>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/environment.hpp"
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

TEST(LdTree, CutsALampWhereTheHorizonRunsThroughIt) {
    // Against 200 x 200 midpoints of the lamp's texel, by cosine: alpha 1.
    constexpr int kWidth = 64, kX = 11, kParts = 200;
    for (const int row : {3, 15, 20}) {
        std::vector<float> picture(std::size_t{kWidth} * kWidth / 2 * 3, 0.0f);
        for (std::size_t c = 0; c < 3; ++c)
            picture[(static_cast<std::size_t>(row) * kWidth + kX) * 3 + c] = 1e4f;
        const PatchBlocks blocks(EquirectView{picture.data(), kWidth, kWidth / 2});
        const MomentTree tree(blocks, for_each_in_turn);
        const glm::dvec3 lamp = equirect_direction((kX + 0.5) / kWidth, (row + 0.5) / (kWidth / 2));
        const glm::dvec3 side = glm::normalize(glm::cross(lamp, glm::dvec3(0.3, -0.5, 0.8)));
        for (const double above : {-0.03, -0.01, 0.0, 0.02, 0.04}) {
            const glm::dvec3 n = glm::normalize(side + above * lamp);
            double truth = 0, whole = 0;
            for (int i = 0; i < kParts * kParts; ++i) {
                const double v = (row + (i / kParts + 0.5) / kParts) / (kWidth / 2);
                const double weight = std::sin(std::numbers::pi * v);
                const glm::dvec3 d = equirect_direction((kX + (i % kParts + 0.5) / kParts) / kWidth, v);
                truth += weight * std::max(0.0, glm::dot(n, d));
                whole += weight;
            }
            truth *= 1e4 * equirect_texel_solid_angle(kWidth, kWidth / 2, row) / (whole * std::numbers::pi);
            std::vector<double> rgb(3);
            std::uint64_t evaluations = 0;
            ld_exact(tree, 1, 1e-3, {&n, 1}, rgb, evaluations);
            EXPECT_NEAR(rgb[0], truth, 3e-4 * tree.mean()[0]) << row << " " << above;
        }
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

/// All nodes against points of their texels, about the nodes' own centres.
void expect_moments_of_texels(const PatchBlocks& blocks) {
    const MomentTree tree(blocks, for_each_in_turn);
    const PatchBlocks::Grid& grid = blocks.grid();
    for (int index = 0; index < tree.levels(); ++index) {
        const MomentTree::Level& level = tree.level(index);
        std::vector<std::array<std::array<double, 4>, kMomentCount>> sums(level.cones.size());
        for (int block = 0; block < blocks.count(); ++block) {
            const int x = block % grid.columns >> index, y = block / grid.columns % grid.rows >> index,
                      face = block / grid.columns / grid.rows;
            const std::size_t node = static_cast<std::size_t>((face * level.rows + y) * level.columns + x);
            const glm::dvec3 centre = level.cones[node].centre();
            PatchPoints points;
            blocks.points(block, 3, points);
            for (std::size_t i = 0; i < points.size(); ++i) {
                const glm::dvec3 d = glm::dvec3(points.x[i], points.y[i], points.z[i]) - centre;
                const std::array<float, 4> values{points.r[i], points.g[i], points.b[i], 1};
                for (std::size_t k = 0; k < kMomentCount; ++k) {
                    const auto [a, b, c] = kMonomials[k];
                    const double share = points.weight[i] * std::pow(d.x, a) * std::pow(d.y, b) *
                                         std::pow(d.z, c) / std::tgamma(a + 1.0) / std::tgamma(b + 1.0) /
                                         std::tgamma(c + 1.0);
                    for (std::size_t v = 0; v < 4; ++v) sums[node][k][v] += share * values[v];
                }
            }
        }
        for (std::size_t node = 0; node < sums.size(); ++node)
            for (std::size_t k = 0; k < kMomentCount; ++k) {
                // Points are rounded to float.
                const int degree = kMonomials[k].a + kMonomials[k].b + kMonomials[k].c;
                const double reach = level.cones[node].reach, solid_angle = level.cones[node].solid_angle;
                for (std::size_t v = 0; v < 4; ++v)
                    EXPECT_NEAR(
                        level.moments[node].mean[k][v], sums[node][k][v] / solid_angle,
                        2e-6 * level.moments[node].mean[0][v] * std::pow(reach, std::max(0, degree - 1)))
                        << "level " << index << " node " << node << " moment " << k << " channel " << v;
            }
    }
}

TEST(MomentTree, NodesHoldTheMomentsOfTheirTexels) {
    const std::vector<float> picture = noise(64 * 32, 100), odd = noise(27 * 13, 100);
    expect_moments_of_texels(PatchBlocks(EquirectView{picture.data(), 64, 32}));
    // About an axis that is no picture's, by .8 and .6, and mirrored.
    const glm::dmat3 turned =
        glm::dmat3(0.8, 0.6, 0, -0.6, 0.8, 0, 0, 0, -1) * glm::dmat3(1, 0, 0, 0, 0.8, 0.6, 0, -0.6, 0.8);
    expect_moments_of_texels(PatchBlocks(EquirectView{odd.data(), 27, 13, turned}));
}

TEST(MomentTree, LowBandsAreThoseOfItsTexels) {
    const std::vector<float> picture = noise(512 * 256, 100), cube = noise(std::size_t{6} * 128 * 128, 100);
    const auto compare = [](const PatchBlocks& blocks) {
        const MomentTree tree(blocks, for_each_in_turn);
        const std::vector<glm::dvec3> exact = sh_project(blocks, kMomentBands),
                                      ours = sh_project(sphere_moments(tree), kMomentBands);
        for (std::size_t i = 0; i < exact.size(); ++i)
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(ours[i][c], exact[i][c], 1e-4 * tree.mean()[c]) << i;
    };
    compare(PatchBlocks(EquirectView{picture.data(), 512, 256}));
    compare(PatchBlocks(CubeView{cube.data(), 128}));
}

}  // namespace
}  // namespace pbr
