#include "pbr/ibl/ld_mis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/ld.hpp"
#include "tests/libpbr/ibl/pictures.hpp"

namespace pbr {
namespace {

/// A sky with a sun of one texel, which has about half the light.
std::vector<float> sunlit(int width, int height, int sun_texel) {
    std::vector<float> rgb = picture_of(width, height, [](const glm::dvec3& d) {
        return glm::dvec3(0.3 + 0.2 * d.x, 0.5 + 0.4 * d.y, d.y > 0 ? 1 : 0.1);
    });
    for (std::size_t c = 0; c < 3; ++c)
        rgb[static_cast<std::size_t>(sun_texel) * 3 + c] = 0.5f * static_cast<float>(width * height);
    return rgb;
}

std::vector<double> exact(const PatchBlocks& blocks, double alpha, const std::vector<CubeTexel>& texels,
                          int size) {
    std::vector<glm::dvec3> directions;
    for (const CubeTexel& texel : texels) directions.push_back(cubemap_texel_direction(texel, size));
    std::vector<double> rgb(texels.size() * 3);
    std::uint64_t evaluations = 0;
    ld_exact(blocks, alpha, directions, rgb, evaluations);
    return rgb;
}

std::vector<CubeTexel> all_texels(int size) {
    std::vector<CubeTexel> texels;
    for (int i = 0; i < 6 * size * size; ++i)
        texels.push_back({i / (size * size), i % size, i / size % size});
    return texels;
}

/// Means over seeds against the truth, in standard errors: of each channel of some texels, the largest; and
/// of their sum, where rare samples of narrow lobes are frequent enough to be counted on.
struct Deviation {
    double of_values, of_sum;
};
Deviation deviation(const EnvironmentSampler& sampler, const PatchBlocks& blocks, double alpha, int samples) {
    constexpr int kSeeds = 200;
    const std::vector<CubeTexel> texels = all_texels(2);
    const std::vector<double> truth = exact(blocks, alpha, texels, 2);
    const std::size_t count = truth.size();
    std::vector<double> sum(count + 1), squares(count + 1);
    std::vector<float> rgb(count);
    for (int seed = 0; seed < kSeeds; ++seed) {
        LdMis(sampler, alpha, samples, static_cast<std::uint64_t>(seed)).integrate(2, texels, rgb);
        double all = 0;
        const auto add = [&](std::size_t i, double difference) {
            sum[i] += difference;
            squares[i] += difference * difference;
        };
        for (std::size_t i = 0; i < count; ++i) {
            const double difference = static_cast<double>(rgb[i]) / truth[i] - 1;
            add(i, difference);
            all += difference / static_cast<double>(count);
        }
        add(count, all);
    }
    const auto in_standard_errors = [&](std::size_t i) {
        const double mean = sum[i] / kSeeds, variance = squares[i] / kSeeds - mean * mean;
        // The exact sum's own error, and that of the samples' places in floats, count as well.
        return std::abs(mean) / (std::sqrt(variance / kSeeds) + 1e-4);
    };
    Deviation deviation{0, in_standard_errors(count)};
    for (std::size_t i = 0; i < count; ++i)
        deviation.of_values = std::max(deviation.of_values, in_standard_errors(i));
    return deviation;
}

TEST(LdMis, IsUnbiasedAgainstTheExactSumOnASun) {
    // 72 values at a time and 12 times: five standard errors are passed by chance once in 2000.
    const std::vector<float> equirect = sunlit(32, 16, 5 * 32 + 11), cube = sunlit(8, 48, 130);
    const EquirectView equirect_view{equirect.data(), 32, 16, glm::dmat3(0, 0, -1, 0, 1, 0, 1, 0, 0)};
    const CubeView cube_view{cube.data(), 8};
    const EnvironmentSampler of_equirect(equirect_view), of_cube(cube_view);
    const PatchBlocks equirect_blocks(equirect_view), cube_blocks(cube_view);
    for (const double alpha : {0.05, 0.3, 0.6, 1.0})
        for (const int samples : {3, 8})
            for (const auto& [sampler, blocks] :
                 {std::pair{&of_equirect, &equirect_blocks}, {&of_cube, &cube_blocks}}) {
                const Deviation found = deviation(*sampler, *blocks, alpha, samples);
                EXPECT_LT(found.of_sum, 4) << alpha << " " << samples;
                if (alpha >= 0.3) {
                    EXPECT_LT(found.of_values, 5) << alpha << " " << samples;
                }
            }
}

double relative_rmse(const std::vector<float>& value, const std::vector<double>& truth) {
    double squared = 0, mean = 0;
    for (std::size_t i = 0; i < value.size(); ++i) {
        squared += (value[i] - truth[i]) * (value[i] - truth[i]);
        mean += truth[i];
    }
    return std::sqrt(squared * static_cast<double>(value.size())) / mean;
}

TEST(LdMis, ErrorFallsAtLeastAsMonteCarloDoes) {
    const std::vector<float> picture = sunlit(64, 32, 9 * 64 + 20);
    const EquirectView view{picture.data(), 64, 32};
    const EnvironmentSampler sampler(view);
    const PatchBlocks blocks(view);
    const std::vector<CubeTexel> texels = all_texels(6);
    for (const double alpha : {0.04, 0.16, 0.64, 1.0}) {
        const std::vector<double> truth = exact(blocks, alpha, texels, 6);
        std::vector<float> rgb(truth.size());
        const auto error = [&](int samples) {
            EXPECT_EQ(LdMis(sampler, alpha, samples, 1).integrate(6, texels, rgb), texels.size() * samples);
            return relative_rmse(rgb, truth);
        };
        const double few = error(32), many = error(32 * 256);
        EXPECT_LT(few, 0.5) << alpha;
        EXPECT_LT(many, few / 12) << alpha;  // 256 times the samples: a sixteenth, less a quarter
    }
}

TEST(LdMis, ConstantPicturesHaveNoVarianceAndBlackOnesAreBlack) {
    for (const float value : {0.0f, 3.25f}) {
        const std::vector<float> picture(std::size_t{32} * 16 * 3, value);
        const EnvironmentSampler of_equirect(EquirectView{picture.data(), 32, 16});
        const EnvironmentSampler of_cube(CubeView{picture.data(), 8});
        for (const EnvironmentSampler* sampler : {&of_equirect, &of_cube})
            for (const double alpha : {1e-4, 0.04, 1.0})
                for (const int samples : {1, 7, 300}) {
                    std::vector<float> rgb(6 * 4 * 3);
                    LdMis(*sampler, alpha, samples, 1).integrate(2, all_texels(2), rgb);
                    for (const float of_texel : rgb) EXPECT_NEAR(of_texel, value, value * 1e-6f);
                }
    }
}

TEST(LdMis, OneHugeTexelIsFoundByItsOwnSamples) {
    // Nearly all light is in one texel: its own samples give it within the lobe's change over the texel.
    for (const float huge : {1e9f, 1e36f}) {
        std::vector<float> picture(std::size_t{64} * 32 * 3, 1.0f);
        for (std::size_t c = 0; c < 3; ++c) picture[(std::size_t{10} * 64 + 33) * 3 + c] = huge;
        const EquirectView view{picture.data(), 64, 32};
        const EnvironmentSampler sampler(view);
        for (const double alpha : {0.25, 0.5, 1.0}) {
            const std::vector<double> truth = exact(PatchBlocks(view), alpha, all_texels(4), 4);
            std::vector<float> rgb(truth.size());
            LdMis(sampler, alpha, 256, 1).integrate(4, all_texels(4), rgb);
            EXPECT_LT(relative_rmse(rgb, truth), 0.02) << huge << " alpha " << alpha;
        }
    }
}

TEST(LdMis, LobeSamplesReadTheTexelTheyFallInto) {
    // One sample along the normal, and texels that tell which they are: the scalar twin is texel_at. No
    // middle of a texel asked for lies on an edge between the picture's.
    constexpr int kSize = 32;
    std::vector<float> picture(std::size_t{39} * 26 * 3);
    for (std::size_t i = 0; i < picture.size(); ++i) picture[i] = static_cast<float>(i / 3);
    const EnvironmentSampler of_equirect(
        EquirectView{picture.data(), 39, 26, glm::dmat3(0.6, 0, -0.8, 0, 1, 0, 0.8, 0, 0.6)});
    const EnvironmentSampler of_cube(CubeView{picture.data(), 13});
    for (const EnvironmentSampler* sampler : {&of_equirect, &of_cube}) {
        const std::vector<CubeTexel> texels = all_texels(kSize);
        std::vector<float> rgb(texels.size() * 3);
        LdMis(*sampler, 1e-7, 1, 1).integrate(kSize, texels, rgb);
        for (std::size_t i = 0; i < texels.size(); ++i)
            EXPECT_EQ(rgb[i * 3],
                      static_cast<float>(sampler->texel_at(cubemap_texel_direction(texels[i], kSize))))
                << sampler->is_cube() << " texel " << i;
    }
}

}  // namespace
}  // namespace pbr
