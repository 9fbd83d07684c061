#include "pbr/legacy/texel_planes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "pbr/numerics/sequence.hpp"

namespace pbr {
namespace {

using enum DiffuseCoupling;

/// Noise with corners and hard cases between: 0, 1, the usual f0 and, where they are allowed, NaN and
/// infinity.
std::vector<float> numbers(std::uint64_t seed, std::size_t count, bool has_non_finite) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const std::vector<float> hard{0, 1, .04f, std::numeric_limits<float>::quiet_NaN(), kInfinity, -1};
    std::vector<float> values(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto pick = static_cast<std::size_t>(random_unit(seed + 100, i) * 40);
        values[i] =
            pick < (has_non_finite ? hard.size() : 3) ? hard[pick] : static_cast<float>(random_unit(seed, i));
    }
    return values;
}

struct Texels {
    Texels(std::size_t count, bool has_non_finite) {
        for (std::uint64_t c = 0; c < 3; ++c) {
            diffuse[c] = numbers(c, count, has_non_finite);
            f0[c] = numbers(c + 3, count, has_non_finite);
            step[c] = numbers(c + 6, count, false);
            for (float& value : step[c]) value *= .003f;
        }
        metallic = numbers(9, count, false);
    }
    static ColourPlanes planes(const std::array<std::vector<float>, 3>& colours) {
        return {colours[0].data(), colours[1].data(), colours[2].data()};
    }
    static Vec3<float> at(const std::array<std::vector<float>, 3>& colours, std::size_t i) {
        return {colours[0][i], colours[1][i], colours[2][i]};
    }
    std::array<std::vector<float>, 3> diffuse, f0, step;
    std::vector<float> metallic;
};

TEST(TexelPlanes, EstimatesAreThoseOfOneTexel) {
    for (const std::size_t count : {1, 37, 3000})
        for (const DiffuseCoupling coupling : {none, fresnel})
            for (const float tolerance : {0.f, .02f}) {
                const Texels texels(count, true);
                const MetallicPrior<float> prior{.04f, tolerance, .01f};
                std::vector<float> metallic(count), confidence(count);
                estimate_metallic({Texels::planes(texels.diffuse), Texels::planes(texels.f0)}, prior,
                                  {Texels::planes(texels.step), Texels::planes(texels.step)}, coupling, count,
                                  metallic.data(), confidence.data());
                for (std::size_t i = 0; i < count; ++i) {
                    const auto step = Texels::at(texels.step, i);
                    const auto one =
                        estimate_metallic<float>({Texels::at(texels.diffuse, i), Texels::at(texels.f0, i)},
                                                 prior, {step, step}, coupling);
                    ASSERT_EQ(metallic[i], one.metallic) << i;
                    ASSERT_EQ(confidence[i], one.confidence) << i;
                }
            }
}

/// Room for materials.
struct Materials {
    explicit Materials(std::size_t count) {
        for (auto* colours : {&base, &dielectric})
            for (auto& plane : *colours) plane.resize(count);
    }
    MaterialPlanes planes() {
        return {{base[0].data(), base[1].data(), base[2].data()},
                {dielectric[0].data(), dielectric[1].data(), dielectric[2].data()}};
    }
    std::array<std::vector<float>, 3> base, dielectric;
};

TEST(TexelPlanes, LargestMetallicIsThatOfOneTexel) {
    for (const std::size_t count : {1, 37, 3000}) {
        const Texels texels(count, true);
        std::vector<float> largest(count);
        largest_metallic({Texels::planes(texels.diffuse), Texels::planes(texels.f0)}, .0035f, count,
                         largest.data());
        for (std::size_t i = 0; i < count; ++i)
            ASSERT_EQ(largest[i], largest_metallic<float>(
                                      {Texels::at(texels.diffuse, i), Texels::at(texels.f0, i)}, .0035f))
                << i;
    }
}

TEST(TexelPlanes, MaterialsAreThoseOfOneTexel) {
    for (const std::size_t count : {1, 37, 3000})
        for (const DiffuseCoupling coupling : {none, fresnel}) {
            const Texels texels(count, false);
            Materials materials(count);
            material_with_residual({Texels::planes(texels.diffuse), Texels::planes(texels.f0)},
                                   texels.metallic.data(), .04f, Texels::planes(texels.step), coupling, .002f,
                                   count, materials.planes());
            for (std::size_t i = 0; i < count; ++i) {
                const auto one = material_with_residual<float>(
                    {Texels::at(texels.diffuse, i), Texels::at(texels.f0, i)}, texels.metallic[i], .04f,
                    Texels::at(texels.step, i), coupling, .002f);
                ASSERT_EQ(Texels::at(materials.base, i), one.base_color) << i;
                ASSERT_EQ(Texels::at(materials.dielectric, i), one.dielectric_f0) << i;
            }
        }
}

TEST(TexelPlanes, GreyMaterialsAreThoseOfOneTexel) {
    for (const std::size_t count : {1, 37, 3000})
        for (const DiffuseCoupling coupling : {none, fresnel})
            for (const float largest : {0.f, .08f, 1.f}) {
                const Texels texels(count, false);
                Materials materials(count);
                material_without_residual({Texels::planes(texels.diffuse), Texels::planes(texels.f0)},
                                          texels.metallic.data(), .04f, largest, coupling, count,
                                          materials.planes());
                for (std::size_t i = 0; i < count; ++i) {
                    const auto one = material_without_residual<float>(
                        {Texels::at(texels.diffuse, i), Texels::at(texels.f0, i)}, texels.metallic[i], .04f,
                        largest, coupling);
                    ASSERT_EQ(Texels::at(materials.base, i), one.base_color) << i;
                    ASSERT_EQ(Texels::at(materials.dielectric, i), one.dielectric_f0) << i;
                }
            }
}

TEST(TexelPlanes, MetallicComesFromTexelsThatLookAlike) {
    // A row of two materials, the first a sure metal, the second a sure dielectric; unsure where they meet.
    const std::vector<float> diffuse{0, 0, 0, .5f, .5f, .5f}, f0{.6f, .6f, .6f, .04f, .04f, .04f};
    const std::vector<float> metallic{1, 1, .5f, .5f, 0, 0}, confidence{1, 1, 0, 0, 1, 1};
    const auto planes = [](const std::vector<float>& grey) {
        return ColourPlanes{&grey[2], &grey[2], &grey[2]};
    };
    const std::vector<std::ptrdiff_t> apart{-2, -1, 1, 2};
    std::vector<float> means(2);
    metallic_of_alike({planes(diffuse), planes(f0)}, &metallic[2], &confidence[2], apart, 2, means.data());
    // Of the first: two metals of its colours, its own .5, and a dielectric 3 (.5^2 + .56^2) away.
    const double alike = .0025 / (.0025 + 3 * (.25 + .56 * .56)), other = alike * alike;
    EXPECT_NEAR(means[0], (2 + .5e-3) / (2 + other + 1e-3), 1e-6);
    EXPECT_NEAR(means[1], (other + .5e-3) / (2 + other + 1e-3), 1e-6);
    metallic_of_alike({planes(diffuse), planes(f0)}, &metallic[2], &confidence[2], {}, 2, means.data());
    EXPECT_EQ(means, std::vector<float>({.5f, .5f}));
}

TEST(TexelPlanes, MeansOfAlikeTexelsAreThoseOfDoublePrecision) {
    constexpr std::ptrdiff_t kPitch = 104, kRows = 5, kFirst = 2 * kPitch + 2;
    const Texels texels(kPitch * kRows, false);
    const std::vector<float> confidence = numbers(10, kPitch * kRows, false);
    std::vector<std::ptrdiff_t> apart;
    for (std::ptrdiff_t dy = -2; dy <= 2; ++dy)
        for (std::ptrdiff_t dx = -2; dx <= 2; ++dx)
            if (dx != 0 || dy != 0) apart.push_back(dy * kPitch + dx);
    const auto from = [](const std::array<std::vector<float>, 3>& colours) {
        return ColourPlanes{&colours[0][kFirst], &colours[1][kFirst], &colours[2][kFirst]};
    };
    for (const std::size_t count : {1, 7, 100}) {
        std::vector<float> means(count);
        metallic_of_alike({from(texels.diffuse), from(texels.f0)}, &texels.metallic[kFirst],
                          &confidence[kFirst], apart, count, means.data());
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t here = kFirst + i;
            double sum = 1e-3 * static_cast<double>(texels.metallic[here]), weights = 1e-3;
            for (const std::ptrdiff_t offset : apart) {
                const std::size_t there = here + static_cast<std::size_t>(offset);
                double far = 0;
                for (const auto* colours : {&texels.diffuse, &texels.f0})
                    for (const std::vector<float>& plane : *colours)
                        far +=
                            std::pow(static_cast<double>(plane[there]) - static_cast<double>(plane[here]), 2);
                const double weight = static_cast<double>(confidence[there]) / std::pow(1 + far / .0025, 2);
                sum += weight * static_cast<double>(texels.metallic[there]);
                weights += weight;
            }
            EXPECT_NEAR(means[i], sum / weights, 1e-5 * sum / weights) << i;
        }
    }
}

}  // namespace
}  // namespace pbr
