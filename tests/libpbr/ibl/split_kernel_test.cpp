#include "pbr/ibl/split_kernel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "pbr/ibl/ld.hpp"
#include "pbr/ibl/ld_harmonic.hpp"
#include "pbr/ibl/near_field.hpp"
#include "pbr/ibl/zonal_harmonics.hpp"
#include "pbr/numerics/quadrature.hpp"
#include "tests/libpbr/ibl/pictures.hpp"

namespace pbr {
namespace {

TEST(SplitKernel, FarIsTheKernelBeyondTheRadiusAndMeetsItSmoothly) {
    for (const double alpha : {1e-4, 0.0036, 0.1, 0.7}) {
        const GgxZonalKernel kernel(alpha);
        const SplitKernel split(kernel, 6 * std::min(alpha, 0.1));
        const double x = split.limit();
        EXPECT_EQ(split.far(x), kernel.value(x));
        EXPECT_EQ(split.far(1.5), 0);
        // What Taylor's theorem leaves of three derivatives.
        for (const double share : {0.001, 0.01})
            EXPECT_NEAR(split.far(x * (1 - share)) / kernel.value(x * (1 - share)), 1,
                        10 * std::pow(share, 4) + 1e-13);
        for (int i = 0; i < 100; ++i) EXPECT_GE(kernel.value(x * i / 100), split.far(x * i / 100));
    }
}

TEST(SplitKernel, FarNeedsFewDegrees) {
    for (const double alpha : {0.001, 0.0036, 0.02})
        for (const double radius : {0.03, 0.1}) {
            if (radius < 2 * alpha) continue;
            const SplitKernel split(GgxZonalKernel(alpha), radius);
            const std::vector<double> k = zonal_far(split, static_cast<int>(25 / radius));
            for (const auto& [reach, allowed] : {std::pair{9, 1e-3}, {13, 1e-4}, {22, 1e-5}})
                for (auto l = static_cast<std::size_t>(reach / radius) + 1; l < k.size(); ++l)
                    ASSERT_LT(std::abs(k[l]), allowed) << alpha << " " << radius << " " << l;
        }
}

TEST(SplitKernel, FarCoefficientsAreThoseOfADirectIntegral) {
    const SplitKernel split(GgxZonalKernel(0.02), 0.1);
    const std::vector<double> k = zonal_far(split, 41);
    const QuadratureRule rule = gauss_legendre(64);
    for (const unsigned l : {0u, 1u, 7u, 40u}) {
        double sum = 0;  // over 1 - mu, from the axis to the radius, and on in panels that double
        for (double from = 0, to = split.limit(); from < 1; from = to, to = std::min(1.0, 2 * to))
            for (int i = 0; i < rule.size(); ++i) {
                const double x = from + (to - from) * rule.nodes[i];
                sum += rule.weights[i] * (to - from) * 2 * std::numbers::pi * split.far(x) *
                       std::legendre(l, 1 - x);
            }
        EXPECT_NEAR(k[l], sum, 1e-12) << l;
    }
}

TEST(SplitKernel, FarTailIsWhatHigherDegreesHold) {
    for (const double alpha : {0.01, 0.04, 0.3, 1.0})
        for (const double radius : {0.1, 0.3}) {
            const SplitKernel split(GgxZonalKernel(alpha), radius);
            const std::vector<double> k = zonal_far(split, 2001);
            for (const std::size_t bands : {40, 120}) {
                double sum = 0;
                for (std::size_t l = bands; l < k.size(); ++l)
                    sum += (2 * static_cast<double>(l) + 1) * k[l] * k[l];
                // Beyond 2000 degrees the kink at the horizon has .85 l^-3 and less.
                EXPECT_NEAR(zonal_far_tail(split, std::span(k).first(bands)), sum, 1.2e-10 + 1e-9 * sum)
                    << alpha << " " << radius << " " << bands;
            }
        }
}

/// Directions at random, and at poles, seams and corners.
std::vector<glm::dvec3> directions() {
    std::vector<glm::dvec3> result{{0, 1, 0}, {0, -1, 0}, {0, 0, -1}, {1e-3, 0, -1}, {1e-4, 1, 1e-4}};
    for (glm::dvec3& d : result) d /= std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
    for (int i = 0; i < 50; ++i) result.push_back(random_direction(8, i));
    return result;
}

TEST(NearField, WithTheFarPartIsTheWholeLobe) {
    // With bright texels at a pole and on both sides of the seam; in a turned frame.
    const double t = 0.7;
    const glm::dmat3 turn(std::cos(t), 0, -std::sin(t), 0, 1, 0, std::sin(t), 0, std::cos(t));
    for (const int width : {512, 100}) {
        std::vector<float> rgb = noise_picture(width, width / 2);
        for (const int texel : {5, width * 30, width * 31 - 1, width * width / 2 - 9})
            rgb[static_cast<std::size_t>(texel) * 3 + 1] = 1e5f;
        const EquirectView view{rgb.data(), width, width / 2, turn};
        const PatchBlocks blocks(view);
        const std::vector<glm::dvec3> at = directions();
        std::vector<double> truth(at.size() * 3);
        std::uint64_t evaluations = 0;
        constexpr double kAlpha = 0.0036;
        ld_exact(blocks, kAlpha, at, truth, evaluations);
        for (const double max_error : {1e-3, 1e-4}) {
            const LdHarmonic harmonic(view, kAlpha, max_error, for_each_in_turn);
            EXPECT_EQ(harmonic.bands(), 600);
            std::vector<float> found(truth.size());
            harmonic.level(kAlpha, for_each_in_turn).integrate(at, found);
            for (std::size_t channel = 0; channel < 3; ++channel) {
                double squared = 0, mean = 0;
                for (std::size_t i = channel; i < found.size(); i += 3) {
                    squared += std::pow(static_cast<double>(found[i]) - truth[i], 2);
                    mean += truth[i];
                }
                EXPECT_LT(std::sqrt(squared * static_cast<double>(at.size())) / mean, max_error)
                    << width << " " << channel;
            }
        }
    }
}

TEST(NearField, OfAConstantIsNothingAndOfAnyPictureFinite) {
    for (const int width : {1, 2, 7, 8, 9, 64})
        for (const float value : {0.0f, 0.7f, 3e38f}) {
            const int height = std::max(1, width / 2);
            std::vector<float> rgb(static_cast<std::size_t>(width) * height * 3, value);
            const EquirectView view{rgb.data(), width, height};
            const SplitKernel split(GgxZonalKernel(0.005), 0.03);
            const std::vector<glm::dvec3> at = directions();
            std::vector<double> sums(at.size() * 3);
            NearField(view, {{}, {value, value, value}}, split).add(at, sums);
            for (const double sum : sums) ASSERT_EQ(sum, 0);
            if (width != 9) continue;
            const LdHarmonic harmonic(view, 0.005, 1e-3, for_each_in_turn);
            std::vector<float> found(at.size() * 3);
            harmonic.level(0.005, for_each_in_turn).integrate(at, found);
            for (const float each : found) ASSERT_NEAR(each, value, 2.4e-7f * value);
        }
}

}  // namespace
}  // namespace pbr
