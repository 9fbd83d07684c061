#include "pbr/ibl/environment_sampler.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/quadrature.hpp"
#include "tests/libpbr/ibl/pictures.hpp"
#include "tests/libpbr/support/chi_square.hpp"

namespace pbr {
namespace {

constexpr int kParts = 2;  // cells a texel's side

/// A turn about no axis of the picture.
glm::dmat3 some_turn() {
    const SinCos a = sin_cos_pi(0.2), b = sin_cos_pi(0.37);
    return glm::dmat3(a.cos, 0, -a.sin, 0, 1, 0, a.sin, 0, a.cos) *
           glm::dmat3(1, 0, 0, 0, b.cos, b.sin, 0, -b.sin, b.cos);
}

/// Noise that a lamp outshines.
std::vector<float> lamp_picture(int width, int height) {
    std::vector<float> rgb = noise_picture(width, height);
    for (std::size_t c = 0; c < 3; ++c) rgb[rgb.size() / 3 / 3 * 3 + c] = 30;
    return rgb;
}

/// Cells of a picture's texels: where a direction falls, and the integral of the density over each.
struct Cells {
    std::vector<double> observed, expected;
};

Cells equirect_cells(const EquirectView& view, const EnvironmentSampler& sampler, int draws) {
    const int width = view.width * kParts, height = view.height * kParts;
    const QuadratureRule rule = gauss_legendre(4);
    Cells cells{std::vector<double>(width * height), std::vector<double>(width * height)};
    for (int i = 0; i < width * height; ++i)
        for (int a = 0; a < 4; ++a)
            for (int b = 0; b < 4; ++b) {
                const double u = (i % width + rule.nodes[a]) / width,
                             v = (i / width + rule.nodes[b]) / height;
                const glm::dvec3 d = equirect_direction(u, v);
                cells.expected[i] += draws * rule.weights[a] * rule.weights[b] * 2 * std::numbers::pi *
                                     std::numbers::pi * std::hypot(d.x, d.z) / (width * height) *
                                     sampler.pdf(glm::transpose(view.world_to_source) * d);
            }
    for (int i = 0; i < draws; ++i) {
        const glm::dvec3 d = sampler.sample(random_unit(21, i), random_unit(22, i)).direction;
        const glm::dvec2 uv = equirect_point(view.world_to_source * d);
        cells.observed[static_cast<int>(uv.y * height) * width + static_cast<int>(uv.x * width)] += 1;
    }
    return cells;
}

Cells cube_cells(int size, const EnvironmentSampler& sampler, int draws) {
    const int n = size * kParts;
    const QuadratureRule rule = gauss_legendre(4);
    Cells cells{std::vector<double>(6 * n * n), std::vector<double>(6 * n * n)};
    for (int i = 0; i < 6 * n * n; ++i)
        for (int a = 0; a < 4; ++a)
            for (int b = 0; b < 4; ++b) {
                const double s = 2 * (i % n + rule.nodes[a]) / n - 1,
                             t = 2 * (i / n % n + rule.nodes[b]) / n - 1;
                cells.expected[i] += draws * rule.weights[a] * rule.weights[b] * 4 / (n * n) *
                                     std::pow(1 + s * s + t * t, -1.5) *
                                     sampler.pdf(cube_vector(i / (n * n), s, t));
            }
    for (int i = 0; i < draws; ++i) {
        const CubeTexel at =
            cubemap_texel(sampler.sample(random_unit(21, i), random_unit(22, i)).direction, n);
        cells.observed[(at.face * n + at.y) * n + at.x] += 1;
    }
    return cells;
}

double total(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum;
}

TEST(EnvironmentSampler, DrawsFollowTheirDensityOnEquirects) {
    const std::vector<float> picture = lamp_picture(24, 12);
    const EquirectView view{picture.data(), 24, 12, some_turn()};
    const EnvironmentSampler sampler(view);
    const Cells cells = equirect_cells(view, sampler, 200'000);
    EXPECT_NEAR(total(cells.expected) / 200'000, 1, 1e-6);
    EXPECT_GT(pearson_p_value(cells.observed, cells.expected), kSignificance);
}

TEST(EnvironmentSampler, DrawsFollowTheirDensityOnCubeMaps) {
    const std::vector<float> picture = lamp_picture(5, 30);
    const EnvironmentSampler sampler(CubeView{picture.data(), 5});
    const Cells cells = cube_cells(5, sampler, 200'000);
    EXPECT_NEAR(total(cells.expected) / 200'000, 1, 1e-6);
    EXPECT_GT(pearson_p_value(cells.observed, cells.expected), kSignificance);
}

TEST(EnvironmentSampler, ADrawKnowsItsTexelAndItsDensity) {
    const std::vector<float> picture = lamp_picture(24, 12), cube = lamp_picture(5, 30);
    for (const EnvironmentSampler& sampler :
         {EnvironmentSampler(EquirectView{picture.data(), 24, 12, some_turn()}),
          EnvironmentSampler(CubeView{cube.data(), 5})})
        for (int i = 0; i < 5000; ++i) {
            const EnvironmentSampler::Draw draw = sampler.sample(random_unit(1, i), random_unit(2, i));
            EXPECT_NEAR(glm::length(draw.direction), 1, 1e-14);
            EXPECT_EQ(draw.texel, sampler.texel_at(draw.direction));
            EXPECT_NEAR(draw.pdf / sampler.pdf(draw.direction), 1, 1e-12);
            EXPECT_GT(draw.pdf, 0);
        }
}

TEST(EnvironmentSampler, ATexelsShareIsItsLightAboveTheMean) {
    // Two texels stand out of black, one twice as bright: the mean is below both, and taken off each.
    std::vector<float> picture(std::size_t{16} * 8 * 3, 0.0f);
    const auto set = [&](int x, int y, float value) {
        for (std::size_t c = 0; c < 3; ++c) picture[static_cast<std::size_t>(y * 16 + x) * 3 + c] = value;
    };
    set(3, 2, 1);
    set(9, 5, 2);
    const EnvironmentSampler sampler(EquirectView{picture.data(), 16, 8});
    const double angle = equirect_texel_solid_angle(16, 8, 2);  // rows 2 and 5 mirror each other
    const double mean = 3 * angle / (4 * std::numbers::pi), sum = (1 - mean + 2 - mean) * angle;
    EXPECT_NEAR(sampler.pdf(equirect_direction(3.5 / 16, 2.5 / 8)), (1 - mean) / sum, 1e-6);
    EXPECT_NEAR(sampler.pdf(equirect_direction(9.5 / 16, 5.5 / 8)), (2 - mean) / sum, 1e-6);
    EXPECT_EQ(sampler.pdf({0, 1, 0}), 0);
}

TEST(EnvironmentSampler, ConstantAndBlackPicturesAreFlat) {
    for (const float value : {0.0f, 1e-30f, 0.1f, 3.7f, 3e38f})
        for (const int width : {1, 2, 64}) {
            const std::vector<float> picture(static_cast<std::size_t>(width) * width * 18, value);
            EXPECT_TRUE(EnvironmentSampler(EquirectView{picture.data(), width, width}).flat()) << value;
            EXPECT_TRUE(EnvironmentSampler(CubeView{picture.data(), width}).flat()) << value;
        }
}

TEST(EnvironmentSampler, OneHugeTexelIsAllThatIsDrawn) {
    for (const float huge : {1e9f, 3e38f})
        for (const int y : {0, 5, 15}) {
            std::vector<float> picture(std::size_t{32} * 16 * 3, 1.0f);
            picture[static_cast<std::size_t>(y * 32 + 20) * 3 + 1] = huge;
            const EnvironmentSampler sampler(EquirectView{picture.data(), 32, 16});
            for (const double u : {0.0, 0.3, 1 - 0x1p-53})
                for (const double v : {0.0, 0.6, 1 - 0x1p-53}) {
                    const EnvironmentSampler::Draw draw = sampler.sample(u, v);
                    EXPECT_EQ(draw.texel, y * 32 + 20);
                    EXPECT_NEAR(draw.pdf * equirect_texel_solid_angle(32, 16, y), 1, 1e-6);
                }
        }
}

}  // namespace
}  // namespace pbr
