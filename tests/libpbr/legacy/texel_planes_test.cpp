#include "pbr/legacy/texel_planes.hpp"

#include <gtest/gtest.h>

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

TEST(TexelPlanes, MaterialsAreThoseOfOneTexel) {
    for (const std::size_t count : {1, 37, 3000})
        for (const DiffuseCoupling coupling : {none, fresnel}) {
            const Texels texels(count, false);
            std::array<std::vector<float>, 3> base, residual;
            for (auto* colours : {&base, &residual})
                for (auto& plane : *colours) plane.resize(count);
            material_with_residual({Texels::planes(texels.diffuse), Texels::planes(texels.f0)},
                                   texels.metallic.data(), .04f, Texels::planes(texels.step), coupling, count,
                                   {{base[0].data(), base[1].data(), base[2].data()},
                                    {residual[0].data(), residual[1].data(), residual[2].data()}});
            for (std::size_t i = 0; i < count; ++i) {
                const auto one = material_with_residual<float>(
                    {Texels::at(texels.diffuse, i), Texels::at(texels.f0, i)}, texels.metallic[i], .04f,
                    Texels::at(texels.step, i), coupling);
                ASSERT_EQ(Texels::at(base, i), one.base_color) << i;
                ASSERT_EQ(Texels::at(residual, i), one.dielectric_f0) << i;
            }
        }
}

}  // namespace
}  // namespace pbr
