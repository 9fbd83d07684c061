#include "pbr/ibl/environment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/patches.hpp"
#include "pbr/numerics/sequence.hpp"
#include "pbr/numerics/sum.hpp"

namespace pbr {
namespace {

std::vector<float> noise(int texels) {
    std::vector<float> rgb(static_cast<std::size_t>(texels) * 3);
    for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = static_cast<float>(std::pow(random_unit(3, i), 4));
    return rgb;
}

std::vector<float> resample_all(const EquirectView& view, int size) {
    std::vector<float> cube(static_cast<std::size_t>(size) * size * 18);
    for (int row = 0; row < 6 * size; ++row)
        resample_area(view, size, row / size, row % size,
                      {&cube[static_cast<std::size_t>(row) * size * 3], static_cast<std::size_t>(size) * 3});
    return cube;
}

double cube_flux(const std::vector<float>& cube, int size, int channel) {
    CompensatedSum flux;
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x)
                flux += cubemap_texel_solid_angle(size, x, y) *
                        cube[((static_cast<std::size_t>(face) * size + y) * size + x) * 3 + channel];
    return flux.value();
}

TEST(Equirect, DirectionAndPointAreInverse) {
    for (int i = 0; i < 1000; ++i) {
        const double u = random_unit(1, i), v = random_unit(2, i);
        const glm::dvec2 back = equirect_point(equirect_direction(u, v));
        EXPECT_NEAR(back.x, u, 1e-12);
        EXPECT_NEAR(back.y, v, 1e-12);
    }
    EXPECT_NEAR(equirect_direction(0.5, 0.5).z, 1, 1e-15);   // the middle looks at +z
    EXPECT_NEAR(equirect_direction(0.25, 0.5).x, 1, 1e-15);  // +x a quarter to the left
    EXPECT_NEAR(equirect_direction(0.3, 0).y, 1, 1e-15);     // the top row surrounds +y
}

TEST(Equirect, AreaResamplingKeepsTheFluxAndConstants) {
    for (const auto& [width, height, size] :
         {std::tuple{64, 32, 16}, {64, 32, 7}, {37, 19, 5}, {16, 8, 32}, {2, 1, 1}}) {
        const std::vector<float> picture = noise(width * height);
        const EquirectView view{picture.data(), width, height};
        const std::vector<float> cube = resample_all(view, size);
        for (int c = 0; c < 3; ++c) {
            CompensatedSum flux;
            for (int y = 0; y < height; ++y) {
                const double texel =
                    2 * std::numbers::pi / width *
                    (std::cos(std::numbers::pi * y / height) - std::cos(std::numbers::pi * (y + 1) / height));
                for (int x = 0; x < width; ++x) flux += texel * view.texel(x, y)[c];
            }
            EXPECT_NEAR(cube_flux(cube, size, c) / flux.value(), 1, 1e-4)
                << width << "x" << height << " to " << size;
        }
        std::vector<float> constant(picture.size(), 0.7f);
        for (const float value : resample_all({constant.data(), width, height}, size)) ASSERT_EQ(value, 0.7f);
    }
}

TEST(Equirect, AreaResamplingAgreesWithBruteForceSubdivision) {
    const std::vector<float> picture = noise(24 * 12);
    const EquirectView view{picture.data(), 24, 12};
    constexpr int kSize = 4, kSub = 200;
    const std::vector<float> cube = resample_all(view, kSize);
    for (const CubeTexel texel : {CubeTexel{0, 1, 2}, {2, 1, 1}, {3, 0, 3}, {5, 3, 0}, {4, 2, 2}}) {
        double sum = 0, weight = 0;
        for (int k = 0; k < kSub * kSub; ++k) {
            const double s = 2 * (texel.x + (k % kSub + 0.5) / kSub) / kSize - 1,
                         t = 2 * (texel.y + (k / kSub + 0.5) / kSub) / kSize - 1;
            const double q = 1 + s * s + t * t, w = 1 / (q * std::sqrt(q));
            const glm::dvec2 uv = equirect_point(cube_vector(texel.face, s, t));
            sum += w * view.texel(static_cast<int>(uv.x * 24), std::min(11, static_cast<int>(uv.y * 12)))[1];
            weight += w;
        }
        const float ours =
            cube[((static_cast<std::size_t>(texel.face) * kSize + texel.y) * kSize + texel.x) * 3 + 1];
        EXPECT_NEAR(ours, sum / weight, 1e-3);
    }
}

TEST(Equirect, ManyPointsAtOnceAreThoseOneByOne) {
    std::vector<glm::dvec3> directions;
    for (int x = -2; x <= 2; ++x)  // axes, diagonals and the origin's neighbours in all octants
        for (int y = -2; y <= 2; ++y)
            for (int z = -2; z <= 2; ++z)
                if (x != 0 || y != 0 || z != 0) directions.emplace_back(x, y, z);
    for (int i = 0; i < 10000; ++i) {
        const double scale = std::pow(10, 200 * random_unit(4, i) - 100);
        directions.push_back(scale * glm::dvec3(random_unit(1, i) - 0.5, random_unit(2, i) - 0.5,
                                                std::pow(random_unit(3, i), 20)));
    }
    std::vector<glm::dvec2> points(directions.size());
    equirect_points(directions, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec2 truth = equirect_point(directions[i]);
        ASSERT_NEAR(std::remainder(points[i].x - truth.x, 1.0), 0, 1e-15);
        ASSERT_NEAR(points[i].y, truth.y, 1e-15);
        ASSERT_TRUE(points[i].x >= 0 && points[i].x < 1 && points[i].y >= 0 && points[i].y <= 1);
    }
}

/// Frames in which the picture's axis is an axis of the cube, and one in which it isn't.
std::vector<glm::dmat3> frames() {
    const double c = std::cos(0.3), s = std::sin(0.3);
    return {glm::dmat3(1),
            glm::dmat3(c, 0, -s, 0, 1, 0, s, 0, c),
            glm::dmat3(-1, 0, 0, 0, 1, 0, 0, 0, 1),
            glm::dmat3(1, 0, 0, 0, 0, -1, 0, 1, 0),
            glm::dmat3(c, 0, -s, 0, 1, 0, s, 0, c) * glm::dmat3(0, 0, 1, 1, 0, 0, 0, 1, 0),
            glm::dmat3(1, 0, 0, 0, c, s, 0, -s, c)};
}

TEST(Equirect, AWholeCubeAtOnceHasTheMeansOfItsRows) {
    for (const glm::dmat3& frame : frames())
        for (const auto& [width, height, size] : {std::tuple{256, 128, 32},
                                                  {128, 64, 33},
                                                  {100, 50, 7},
                                                  {200, 101, 1},
                                                  {64, 32, 64},
                                                  {16, 8, 5},
                                                  {1, 1, 3}}) {
            const std::vector<float> picture = noise(width * height);
            const EquirectView view{picture.data(), width, height, frame};
            std::vector<float> whole(static_cast<std::size_t>(size) * size * 18);
            resample_area(view, size, for_each_in_turn, whole);
            const std::vector<float> rows = resample_all(view, size);
            double squared = 0, largest = 0;
            for (std::size_t i = 0; i < whole.size(); ++i) {
                const double error = std::abs(static_cast<double>(whole[i]) - static_cast<double>(rows[i]));
                squared += error * error;
                largest = std::max(largest, error);
            }
            EXPECT_LT(std::sqrt(squared / static_cast<double>(whole.size())), 1.2e-3)
                << width << " to " << size;
            EXPECT_LT(largest, 2.5e-2) << width << " to " << size;
            const std::vector<float> constant(picture.size(), 0.7f);
            resample_area({constant.data(), width, height, frame}, size, for_each_in_turn, whole);
            for (const float value : whole) ASSERT_EQ(value, 0.7f);
            resample_bilinear(view, size, for_each_in_turn, whole);
            for (int row = 0; row < 6 * size; ++row) {
                std::vector<float> alone(static_cast<std::size_t>(size) * 3);
                resample_bilinear(view, size, row / size, row % size, alone);
                for (std::size_t i = 0; i < alone.size(); ++i)
                    ASSERT_NEAR(whole[static_cast<std::size_t>(row) * alone.size() + i], alone[i], 1e-6);
            }
        }
}

TEST(Equirect, MeansOverTexelsStayWhenColumnsAreSplit) {
    // The same function in 16 times as many columns: quadrature cut in other places.
    constexpr int kSplit = 16;
    for (const glm::dmat3& frame : frames())
        for (const auto& [width, height, size] : {std::tuple{32, 16, 8}, {40, 20, 7}, {12, 31, 3}}) {
            const std::vector<float> picture = noise(width * height);
            std::vector<float> split;
            for (int texel = 0; texel < width * height; ++texel)
                for (int copy = 0; copy < kSplit; ++copy)
                    split.insert(split.end(), &picture[static_cast<std::size_t>(texel) * 3],
                                 &picture[static_cast<std::size_t>(texel) * 3] + 3);
            const std::vector<float> few = resample_all({picture.data(), width, height, frame}, size),
                                     many = resample_all({split.data(), width * kSplit, height, frame}, size);
            for (std::size_t i = 0; i < few.size(); ++i)
                ASSERT_NEAR(few[i], many[i], 1e-5) << width << ' ' << i;
        }
}

TEST(Equirect, ASunInAWholeCubeIsAsExactAsInItsRows) {
    constexpr int kWidth = 256, kHeight = 128, kSize = 24;
    for (const glm::dmat3& frame : frames())
        for (const auto& [x, y] : {std::pair{35, 20}, {64, 64}, {32, 45}, {0, 127}}) {
            std::vector<float> picture(kWidth * kHeight * 3, 1.f);
            std::fill_n(&picture[static_cast<std::size_t>(y * kWidth + x) * 3], 3, 1e6f);
            const EquirectView view{picture.data(), kWidth, kHeight, frame};
            std::vector<float> whole(kSize * kSize * 18);
            resample_area(view, kSize, for_each_in_turn, whole);
            const std::vector<float> rows = resample_all(view, kSize);
            const float peak = *std::ranges::max_element(rows);
            for (std::size_t i = 0; i < whole.size(); ++i)
                ASSERT_NEAR(whole[i], rows[i], 1e-5 * static_cast<double>(peak)) << x << ' ' << y << ' ' << i;
        }
}

TEST(Equirect, ResamplingIsContinuousAtSeamAndPoles) {
    // A smooth picture stays smooth: texels on both sides of the seam (behind, -z) and around the poles
    // differ little.
    constexpr int kWidth = 128, kHeight = 64, kSize = 32;
    std::vector<float> picture(kWidth * kHeight * 3);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const glm::dvec3 d = equirect_direction((x + 0.5) / kWidth, (y + 0.5) / kHeight);
            for (int c = 0; c < 3; ++c)
                picture[static_cast<std::size_t>(y * kWidth + x) * 3 + c] = static_cast<float>(1 + d[c]);
        }
    const EquirectView view{picture.data(), kWidth, kHeight};
    std::vector<float> bilinear(kSize * 3), area(kSize * 3);
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < kSize; ++y) {
            resample_bilinear(view, kSize, face, y, bilinear);
            resample_area(view, kSize, face, y, area);
            for (int x = 0; x < kSize; ++x) {
                const glm::dvec3 d = cubemap_texel_direction({face, x, y}, kSize);
                for (int c = 0; c < 3; ++c) {
                    EXPECT_NEAR(bilinear[x * 3 + c], 1 + d[c], 2e-3);
                    EXPECT_NEAR(area[x * 3 + c], 1 + d[c], 2e-2);
                }
            }
        }
}

TEST(Cube, AreaResamplingToTheSameSizeIsBitExactAndKeepsFluxOtherwise) {
    constexpr int kSize = 12;
    const std::vector<float> cube = noise(6 * kSize * kSize);
    const CubeView view{cube.data(), kSize};
    for (const int size : {12, 24, 6, 5, 1}) {
        std::vector<float> out(static_cast<std::size_t>(size) * size * 18);
        for (int row = 0; row < 6 * size; ++row)
            resample_area(
                view, size, row / size, row % size,
                {&out[static_cast<std::size_t>(row) * size * 3], static_cast<std::size_t>(size) * 3});
        if (size == kSize) {
            EXPECT_EQ(out, cube);
        }
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(cube_flux(out, size, c), cube_flux(cube, kSize, c), 2e-6);
    }
}

TEST(Patches, WeightsSumToTheSphere) {
    const std::vector<float> picture = noise(6 * 20 * 20);
    for (const PatchBlocks& blocks :
         {PatchBlocks(EquirectView{picture.data(), 40, 20}), PatchBlocks(CubeView{picture.data(), 20})})
        for (const int order_index : {0, 1, 3}) {
            CompensatedSum total;
            PatchPoints points;
            for (int block = 0; block < blocks.count(); ++block) {
                blocks.points(block, order_index, points);
                for (std::size_t i = 0; i < points.size(); ++i) {
                    total += static_cast<double>(points.weight[i]);
                    const glm::dvec3 d(points.x[i], points.y[i], points.z[i]);
                    EXPECT_LE(2 * std::asin(glm::length(d - blocks.cone(block).axis) / 2),
                              blocks.cone(block).half_angle + 1e-6);
                }
            }
            EXPECT_NEAR(total.value(), 4 * std::numbers::pi, 2e-6);
        }
}

TEST(EquirectTexel, SolidAngleIsTheDifferenceOfCosines) {
    // In long double, whose 11 more bits leave the plain difference enough digits away from the poles' first
    // rows.
    const long double pi = std::numbers::pi_v<long double>;
    for (const auto& [width, height] :
         {std::pair(8, 4), std::pair(64, 32), std::pair(4, 1), std::pair(256, 128)})
        for (int y = 0; y < height; ++y) {
            const long double difference = std::cos(pi * y / height) - std::cos(pi * (y + 1) / height);
            const double ratio = static_cast<double>(equirect_texel_solid_angle(width, height, y) /
                                                     (2 * pi / width * difference));
            EXPECT_NEAR(ratio, 1, 1e-14) << height << ' ' << y;
        }
}

}  // namespace
}  // namespace pbr
