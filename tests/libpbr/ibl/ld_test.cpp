#include "pbr/ibl/ld.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/zonal_kernel.hpp"
#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/sequence.hpp"

namespace pbr {
namespace {

/// A picture of soft blobs and one small bright lamp.
std::vector<float> lamp_room(int width, int height, float lamp) {
    std::vector<float> rgb(static_cast<std::size_t>(width) * height * 3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::dvec3 d = equirect_direction((x + 0.5) / width, (y + 0.5) / height);
            for (int c = 0; c < 3; ++c)
                rgb[(static_cast<std::size_t>(y) * width + x) * 3 + c] =
                    static_cast<float>(0.2 + std::pow(std::abs(d[c]), 3));
        }
    const std::size_t at = (static_cast<std::size_t>(height / 3) * width + width / 5) * 3;
    for (std::size_t c = 0; c < 3; ++c) rgb[at + c] += lamp;
    return rgb;
}

std::vector<float> cube_of(const EquirectView& view, int size) {
    std::vector<float> cube(static_cast<std::size_t>(size) * size * 18);
    for (int row = 0; row < 6 * size; ++row)
        resample_area(view, size, row / size, row % size,
                      {&cube[static_cast<std::size_t>(row) * size * 3], static_cast<std::size_t>(size) * 3});
    return cube;
}

std::vector<glm::dvec3> directions_of(int size) {
    std::vector<glm::dvec3> directions;
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) directions.push_back(cubemap_texel_direction({face, x, y}, size));
    return directions;
}

std::vector<double> exact(const PatchBlocks& blocks, double alpha,
                          const std::vector<glm::dvec3>& directions) {
    std::vector<double> rgb(directions.size() * 3);
    std::uint64_t evaluations = 0;
    ld_exact(blocks, alpha, directions, rgb, evaluations);
    return rgb;
}

std::vector<float> sampled(const CubePyramid& pyramid, LdEstimator estimator, double alpha, int count,
                           int size, double bias = 1, std::uint64_t seed = 0) {
    const LdIntegrator integrator({estimator, count, bias, seed}, alpha, nullptr, &pyramid);
    std::vector<CubeTexel> texels;
    for (int i = 0; i < 6 * size * size; ++i)
        texels.push_back({i / (size * size), i % size, i / size % size});
    std::vector<float> rgb(texels.size() * 3);
    EXPECT_EQ(integrator.integrate(size, texels, rgb), texels.size() * static_cast<std::uint64_t>(count));
    return rgb;
}

double relative_rmse(const std::vector<float>& value, const std::vector<double>& truth) {
    double squared = 0, mean = 0;
    for (std::size_t i = 0; i < value.size(); ++i) {
        squared += (value[i] - truth[i]) * (value[i] - truth[i]);
        mean += truth[i];
    }
    return std::sqrt(squared / static_cast<double>(value.size())) /
           (mean / static_cast<double>(value.size()));
}

TEST(LdExact, KernelIntegratesToOneWithinItsStatedError) {
    const std::vector<float> picture = lamp_room(128, 64, 0);
    const std::vector<glm::dvec3> directions = directions_of(4);
    for (const double alpha : {0.0036, 0.01, 0.04, 0.16, 0.36, 0.64, 1.0}) {
        std::vector<double> rgb(directions.size() * 3);
        std::uint64_t evaluations = 0;
        EXPECT_LE(
            ld_exact(PatchBlocks(EquirectView{picture.data(), 128, 64}), alpha, directions, rgb, evaluations),
            3e-5)
            << alpha;
        EXPECT_GT(evaluations, directions.size() * 64);
    }
}

TEST(LdExact, AgreesWithUniformFineSubdivision) {
    // The second witness: every texel cut into 40 texel/(2 alpha) parts a side, kernel in double, no blocks,
    // no orders.
    constexpr int kWidth = 32, kHeight = 16;
    const std::vector<float> picture = lamp_room(kWidth, kHeight, 50);
    const EquirectView view{picture.data(), kWidth, kHeight};
    for (const double alpha : {0.04, 0.16, 0.5, 1.0}) {
        const GgxZonalKernel kernel(alpha);
        const int parts =
            std::max(2, static_cast<int>(std::ceil(40 * (2 * std::numbers::pi / kWidth) / (2 * alpha))));
        std::vector<glm::dvec3> directions;
        for (int i = 0; i < 4; ++i) directions.push_back(cubemap_texel_direction({i + 1, i, 3 - i}, 4));
        directions.push_back(
            equirect_direction((kWidth / 5 + 0.5) / kWidth, (kHeight / 3 + 0.2) / kHeight));  // into the lamp
        const std::vector<double> ours = exact(PatchBlocks(view), alpha, directions);
        for (std::size_t k = 0; k < directions.size(); ++k) {
            glm::dvec3 sum(0);
            double weight = 0;
            for (int y = 0; y < kHeight * parts; ++y)
                for (int x = 0; x < kWidth * parts; ++x) {
                    const glm::dvec3 d =
                        equirect_direction((x + 0.5) / (kWidth * parts), (y + 0.5) / (kHeight * parts));
                    const glm::dvec3 chord = d - directions[k];
                    const double w =
                        kernel.value(glm::dot(chord, chord) / 2) * std::sqrt(d.x * d.x + d.z * d.z);
                    const float* texel = view.texel(x / parts, y / parts);
                    sum += w * glm::dvec3(texel[0], texel[1], texel[2]);
                    weight += w;
                }
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(ours[k * 3 + static_cast<std::size_t>(c)] / (sum[c] / weight), 1, 1e-3)
                    << alpha << " direction " << k;
        }
    }
}

TEST(LdExact, CubeAndEquirectOfTheSameFunctionAgree) {
    // A function constant on octants is the same in both pictures.
    std::vector<float> equirect(static_cast<std::size_t>(64) * 32 * 3),
        cube(static_cast<std::size_t>(16) * 16 * 18);
    const auto octant = [](const glm::dvec3& d, int c) {
        return static_cast<float>(1 + (d.x > 0) + 2 * (d.y > 0) + 4 * (d.z > 0) + c);
    };
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c)
                equirect[static_cast<std::size_t>(y * 64 + x) * 3 + c] =
                    octant(equirect_direction((x + 0.5) / 64, (y + 0.5) / 32), c);
    const std::vector<glm::dvec3> texels = directions_of(16);
    for (std::size_t i = 0; i < texels.size(); ++i)
        for (int c = 0; c < 3; ++c) cube[i * 3 + static_cast<std::size_t>(c)] = octant(texels[i], c);
    const std::vector<glm::dvec3> directions = directions_of(3);
    for (const double alpha : {0.16, 0.64, 1.0}) {
        const std::vector<double> a =
            exact(PatchBlocks(EquirectView{equirect.data(), 64, 32}), alpha, directions);
        const std::vector<double> b = exact(PatchBlocks(CubeView{cube.data(), 16}), alpha, directions);
        for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i] / b[i], 1, 1e-4);
    }
}

TEST(LdExact, AlphaOneIsIrradianceOverPi) {
    // E = (1, mu): irradiance of a linear environment a + b d.n is pi a + 2/3 pi b.
    std::vector<float> picture(static_cast<std::size_t>(256) * 128 * 3);
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 256; ++x)
            for (int c = 0; c < 3; ++c)
                picture[static_cast<std::size_t>(y * 256 + x) * 3 + c] =
                    static_cast<float>(1 + equirect_direction((x + 0.5) / 256, (y + 0.5) / 128)[c]);
    const std::vector<glm::dvec3> directions = directions_of(3);
    const std::vector<double> rgb = exact(PatchBlocks(EquirectView{picture.data(), 256, 128}), 1, directions);
    for (std::size_t i = 0; i < directions.size(); ++i)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(rgb[i * 3 + static_cast<std::size_t>(c)], 1 + directions[i][c] * 2 / 3, 2e-4);
}

TEST(Ld, ConstantEnvironmentStaysConstant) {
    const std::vector<float> picture(static_cast<std::size_t>(16) * 8 * 3, 3.25f);
    const EquirectView view{picture.data(), 16, 8};
    const CubePyramid pyramid(cube_of(view, 16), 16);
    for (const double alpha : {1e-4, 0.04, 0.5, 1.0}) {
        for (const double value : exact(PatchBlocks(view), alpha, directions_of(4)))
            EXPECT_NEAR(value, 3.25, 3.25 * 1e-6);
        for (const LdEstimator estimator :
             {LdEstimator::importance_sampling, LdEstimator::filtered_importance_sampling})
            for (const float value : sampled(pyramid, estimator, alpha, 100, 8))
                EXPECT_NEAR(value, 3.25f, 3.25f * 1e-5f);
    }
}

TEST(Ld, EstimatorsApproachTheExactSumDownToTheirFloor) {
    const std::vector<float> picture = lamp_room(128, 64, 30);
    const EquirectView view{picture.data(), 128, 64};
    const CubePyramid pyramid(cube_of(view, 64), 64);
    const PatchBlocks blocks(view);
    const std::vector<glm::dvec3> directions = directions_of(8);
    for (const double alpha : {0.16, 0.36, 1.0}) {
        const std::vector<double> truth = exact(blocks, alpha, directions);
        const auto error = [&](LdEstimator estimator, int count) {
            return relative_rmse(sampled(pyramid, estimator, alpha, count, 8), truth);
        };
        constexpr double kFloor =
            5e-4;  // of a 64-texel pyramid for a 128-texel picture: its own texels' limit
        for (const LdEstimator estimator :
             {LdEstimator::importance_sampling, LdEstimator::filtered_importance_sampling}) {
            const double at_64 = error(estimator, 64), at_1024 = error(estimator, 1024),
                         at_16384 = error(estimator, 16384);
            // 256 times the samples: at least the 16 of Monte Carlo's slope, or the floor; and always
            // downhill.
            EXPECT_LT(at_16384, std::max(at_64 / 16, kFloor)) << "alpha " << alpha;
            EXPECT_LT(at_1024, at_64 / 2) << "alpha " << alpha;
            EXPECT_LT(at_16384, std::max(at_1024 / 2, kFloor)) << "alpha " << alpha;
        }
        EXPECT_LT(error(LdEstimator::filtered_importance_sampling, 64),
                  error(LdEstimator::importance_sampling, 64));
    }
}

TEST(Ld, IntegratorGivesTheExactSumAsFloats) {
    const std::vector<float> picture = lamp_room(64, 32, 20);
    const PatchBlocks blocks(EquirectView{picture.data(), 64, 32});
    const LdIntegrator integrator({}, 0.36, &blocks, nullptr);
    const std::vector<CubeTexel> texels{{0, 1, 2}, {3, 0, 3}, {5, 2, 2}};
    std::vector<float> rgb(9);
    EXPECT_GT(integrator.integrate(4, texels, rgb), 0u);
    std::vector<glm::dvec3> directions;
    for (const CubeTexel& texel : texels) directions.push_back(cubemap_texel_direction(texel, 4));
    const std::vector<double> truth = exact(blocks, 0.36, directions);
    for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(rgb[i], static_cast<float>(truth[i]));
}

TEST(Ld, FilteredSamplingIsLinear) {
    const std::vector<float> a = lamp_room(64, 32, 10), b = lamp_room(64, 32, 0);
    std::vector<float> sum(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) sum[i] = a[i] + b[i];
    const auto bake = [](const std::vector<float>& picture) {
        return sampled(CubePyramid(cube_of({picture.data(), 64, 32}, 16), 16),
                       LdEstimator::filtered_importance_sampling, 0.3, 64, 4);
    };
    const std::vector<float> of_a = bake(a), of_b = bake(b), of_sum = bake(sum);
    for (std::size_t i = 0; i < of_a.size(); ++i)
        EXPECT_NEAR(of_sum[i], of_a[i] + of_b[i], 1e-5f * of_sum[i]);
}

/// Integral over the sphere of a level's lookups, before the quotient: by the midpoints of 12 x 12 parts a
/// texel.
glm::dvec4 integral_of_lookups(const CubePyramid& pyramid, int level) {
    const int n = pyramid.size_of(level), of_texel = std::max(12, 96 / n), parts = n * of_texel;
    glm::dvec4 sum(0);
    for (int i = 0; i < 6 * parts * parts; ++i) {
        const double x = (i % parts + 0.5) / of_texel, y = (i / parts % parts + 0.5) / of_texel;
        const double s = 2 * x / n - 1, t = 2 * y / n - 1;
        const double angle = std::pow(1 + s * s + t * t, -1.5) * 4 / (static_cast<double>(parts) * parts);
        const int ix = static_cast<int>(x + 0.5), iy = static_cast<int>(y + 0.5);  // of the padded face
        for (const int dx : {0, 1})
            for (const int dy : {0, 1}) {
                const double fx = x + 0.5 - ix, fy = y + 0.5 - iy;
                const double weight = angle * (dx ? fx : 1 - fx) * (dy ? fy : 1 - fy);
                const float* texel =
                    pyramid.face(level, i / (parts * parts)) + ((iy + dy) * (n + 2) + ix + dx) * 4;
                for (int c = 0; c < 4; ++c) sum[c] += weight * static_cast<double>(texel[c]);
            }
    }
    return sum;
}

TEST(CubePyramid, EveryLevelsLookupsHoldThePicturesFlux) {
    for (const CubeTexel lamp : {CubeTexel{0, 15, 15}, {2, 31, 9}, {5, 0, 0}, {3, 30, 1}}) {
        std::vector<float> cube(std::size_t{32} * 32 * 18, 0.25f);
        for (std::size_t c = 0; c < 3; ++c)
            cube[(static_cast<std::size_t>((lamp.face * 32 + lamp.y) * 32) + lamp.x) * 3 + c] += 1000;
        const double flux = std::numbers::pi +
                            1000 * cubemap_texel_solid_angle(32, lamp.x, lamp.y);  // 4 pi / 4, and the lamp
        const CubePyramid pyramid(cube, 32);
        EXPECT_EQ(pyramid.levels(), 6);
        for (int level = 0; level < pyramid.levels(); ++level) {
            const glm::dvec4 integral = integral_of_lookups(pyramid, level);
            EXPECT_NEAR(integral[0] / flux, 1, 5e-4) << "level " << level;
            EXPECT_NEAR(integral[3] / (4 * std::numbers::pi), 1, 5e-4) << "level " << level;
        }
    }
}

TEST(CubePyramid, EveryLevelHoldsALampsFluxAndCentroid) {
    constexpr int kBase = 32, kParts = 96;
    const std::vector<double> solid_angles = cubemap_solid_angles(kParts);
    std::vector<CubeTexel> lamps{{0, 15, 15}, {2, 31, 9}, {5, 0, 0}, {3, 30, 1}};
    for (int i = 0; i < 12; ++i)
        lamps.push_back({i % 6, static_cast<int>(random_bits(7, i, 0) % kBase),
                         static_cast<int>(random_bits(7, i, 1) % kBase)});
    for (const CubeTexel& lamp : lamps) {
        std::vector<float> cube(std::size_t{kBase} * kBase * 18, 0.0f);
        cube[(static_cast<std::size_t>((lamp.face * kBase + lamp.y) * kBase) + lamp.x) * 3] = 1000;
        const double flux = 1000 * cubemap_texel_solid_angle(kBase, lamp.x, lamp.y);
        const CubePyramid pyramid(cube, kBase);
        for (int level = 0; level < pyramid.levels(); ++level) {
            double sum = 0;
            glm::dvec3 moment(0);
            for (int i = 0; i < 6 * kParts * kParts; ++i) {
                const CubeTexel part{i / (kParts * kParts), i % kParts, i / kParts % kParts};
                const glm::dvec3 direction = cubemap_texel_direction(part, kParts);
                const double share =
                    solid_angles[static_cast<std::size_t>(i % (kParts * kParts))] *
                    static_cast<double>(pyramid.sample(glm::vec3(direction), static_cast<float>(level)).x);
                sum += share;
                moment += share * direction;
            }
            const glm::dvec3 shift = glm::normalize(moment) - cubemap_texel_direction(lamp, kBase);
            EXPECT_NEAR(sum / flux, 1, 0.015) << "face " << lamp.face << " level " << level;
            EXPECT_LT(glm::length(shift), 0.02 * 2 / pyramid.size_of(level))
                << "face " << lamp.face << " x " << lamp.x << " y " << lamp.y << " level " << level;
        }
    }
}

TEST(CubePyramid, NoTexelIsNegativeWhereverALampIs) {
    const auto least = [](int base, int x, int y) {
        std::vector<float> cube(static_cast<std::size_t>(base) * base * 18, 0.0f);
        cube[(static_cast<std::size_t>(y) * base + x) * 3] = 1;
        const CubePyramid pyramid(cube, base);
        return *std::min_element(pyramid.texels().begin(), pyramid.texels().end());
    };
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x <= y; ++x) ASSERT_GE(least(32, x, y), 0.0f) << x << " " << y;
    for (int y = 0; y < 4; ++y)  // corners of larger ones, where exchange is most
        for (int x = 0; x <= y; ++x) ASSERT_GE(least(256, x, y), 0.0f) << x << " " << y;
}

/// The flux of a level (solid-angle weighted sum of red), and the direction of its first moment: blur
/// shortens the moment and leaves its direction.
struct Moments {
    double flux;
    glm::dvec3 centroid;
};
Moments moments(const std::vector<double>& rgb, int size) {
    double flux = 0;
    glm::dvec3 moment(0);
    for (int i = 0; i < 6 * size * size; ++i) {
        const CubeTexel texel{i / (size * size), i % size, i / size % size};
        const double share =
            cubemap_texel_solid_angle(size, texel.x, texel.y) * rgb[static_cast<std::size_t>(i) * 3];
        flux += share;
        moment += share * cubemap_texel_direction(texel, size);
    }
    return {flux, glm::normalize(moment)};
}

/// The mean of a level over seeds.
std::vector<double> mean_over_seeds(const CubePyramid& pyramid, double alpha, int count, int size,
                                    int seeds) {
    std::vector<double> mean(static_cast<std::size_t>(size) * size * 18);
    for (int seed = 0; seed < seeds; ++seed) {
        const std::vector<float> rgb = sampled(pyramid, LdEstimator::filtered_importance_sampling, alpha,
                                               count, size, 1, static_cast<std::uint64_t>(seed));
        for (std::size_t i = 0; i < rgb.size(); ++i) mean[i] += static_cast<double>(rgb[i]) / seeds;
    }
    return mean;
}

/// Places of a lamp of one texel on a cube of 64: the middle of a face, off it, at an edge, at a corner; and
/// anywhere.
constexpr CubeTexel kLamps[] = {{4, 32, 32}, {0, 20, 45}, {2, 63, 17}, {1, 0, 63},
                                {3, 1, 30},  {5, 48, 19}, {0, 9, 27},  {2, 16, 16}};

std::vector<float> lamp_cube(const CubeTexel& lamp) {
    std::vector<float> cube(std::size_t{64} * 64 * 18, 0.0f);
    cube[(static_cast<std::size_t>((lamp.face * 64 + lamp.y) * 64) + lamp.x) * 3] = 1e4f;
    return cube;
}

TEST(Ld, FilteredSamplesKeepALampsEnergyAndItsCentroid) {
    // Sizes and alphas of a chain from 64.
    for (const CubeTexel& lamp : kLamps) {
        const std::vector<float> cube = lamp_cube(lamp);
        const CubePyramid pyramid(cube, 64);
        const PatchBlocks lit(CubeView{cube.data(), 64}, {&lamp, 1});  // all else is black
        for (const int level : {1, 2, 3}) {
            const int size = 64 >> level;
            const double alpha = level * level / 9.0;
            std::vector<double> of_lamp(static_cast<std::size_t>(size) * size * 18);
            std::uint64_t evaluations = 0;
            ld_partial(lit, alpha, directions_of(size), of_lamp, evaluations);
            const Moments truth = moments(of_lamp, size);
            for (const int count : {32, 128}) {
                const Moments found = moments(mean_over_seeds(pyramid, alpha, count, size, 24), size);
                EXPECT_NEAR(found.flux / truth.flux, 1, 0.01)
                    << "face " << lamp.face << " level " << level << " samples " << count;
                EXPECT_LT(glm::length(found.centroid - truth.centroid), 0.02 * 2 / size)
                    << "face " << lamp.face << " level " << level << " samples " << count;
            }
        }
    }
}

TEST(Ld, FilteredSamplingTurnsWithTheEnvironmentWithinItsNoise) {
    // Turned by 30 degrees about an axis askew, as pictures of one smooth function: the same mean error.
    const SinCos turn = sin_cos_pi(1.0 / 6);
    const glm::dmat3 about_y(turn.cos, 0, -turn.sin, 0, 1, 0, turn.sin, 0, turn.cos);
    const glm::dmat3 about_x(1, 0, 0, 0, turn.cos, turn.sin, 0, -turn.sin, turn.cos);
    const std::vector<float> picture = lamp_room(128, 64, 30);
    const auto error = [&](const glm::dmat3& world_to_source, double alpha) {
        const EquirectView view{picture.data(), 128, 64, world_to_source};
        const CubePyramid pyramid(cube_of(view, 64), 64);
        return relative_rmse(sampled(pyramid, LdEstimator::filtered_importance_sampling, alpha, 256, 8),
                             exact(PatchBlocks(view), alpha, directions_of(8)));
    };
    for (const double alpha : {0.16, 0.36, 1.0}) {
        const double upright = error(glm::dmat3(1), alpha), turned = error(about_x * about_y, alpha);
        EXPECT_LT(turned, 1.5 * upright) << alpha;
        EXPECT_GT(turned, upright / 1.5) << alpha;
    }
}

TEST(CubePyramid, LookupIsContinuousAcrossEdgesAndCorners) {
    const std::vector<float> picture = lamp_room(64, 32, 5);
    const CubePyramid pyramid(cube_of({picture.data(), 64, 32}, 16), 16);
    for (int i = 0; i < 2000; ++i) {
        // Two points a hair apart on either side of an edge of the cube.
        const double t = 2 * random_unit(1, i) - 1, lod = 4 * random_unit(2, i);
        const int face = static_cast<int>(random_bits(3, i) % 6);
        const glm::vec3 inside(cube_vector(face, 1 - 1e-6, t)), outside(cube_vector(face, 1 + 1e-6, t));
        const glm::vec3 a = pyramid.sample(inside, static_cast<float>(lod)),
                        b = pyramid.sample(outside, static_cast<float>(lod));
        EXPECT_LT(glm::length(a - b), 0.02f * glm::length(a))
            << "face " << face << " t " << t << " lod " << lod;
    }
}

TEST(Ld, KernelAgreesWithItsScalarTwin) {
    // Samples along the normal don't depend on a texel's turn: each must be the scalar twin's lookup.
    const std::vector<float> picture = lamp_room(64, 32, 20);
    const CubePyramid pyramid(cube_of({picture.data(), 64, 32}, 32), 32);
    for (const float lod : {-2.0f, 0.0f, 0.3f, 1.5f, 2.9f, 4.99f, 9.0f}) {
        LdSamples samples;
        samples.add({0, 0, 1}, lod, pyramid.levels(), 1);
        samples.pad();
        for (int i = 0; i < 6 * 12 * 12; ++i) {
            const CubeTexel texel{i / 144, i % 12, i / 12 % 12};
            const glm::dvec3 n = cubemap_texel_direction(texel, 12);
            const glm::vec3 expected = pyramid.sample(glm::vec3(n), lod);
            std::vector<float> rgb(3);
            ld_sampled(pyramid, samples, 0, 12, {&texel, 1}, rgb);
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(rgb[static_cast<std::size_t>(c)], expected[c], 2e-5f * expected[c])
                    << i << " lod " << lod;
        }
    }
}

TEST(Ld, PlainSamplesReadTheFinestLevelEverywhere) {
    const std::vector<float> picture = lamp_room(64, 32, 20);
    const CubePyramid pyramid(cube_of({picture.data(), 64, 32}, 32), 32);
    LdSamples samples =
        make_ld_samples(LdEstimator::importance_sampling, 1e-4, 1, 32, 1);       // along the normal, nearly
    for (const CubeTexel texel : {CubeTexel{0, 0, 0}, {2, 11, 0}, {4, 6, 6}}) {  // corners and a middle
        std::vector<float> rgb(3);
        ld_sampled(pyramid, samples, 0, 12, {&texel, 1}, rgb);
        const glm::vec3 expected = pyramid.sample(glm::vec3(cubemap_texel_direction(texel, 12)), 0);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(rgb[static_cast<std::size_t>(c)], expected[c], 1e-2f * expected[c]);
    }
}

}  // namespace
}  // namespace pbr
