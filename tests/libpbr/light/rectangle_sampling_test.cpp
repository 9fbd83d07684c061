#include "pbr/light/rectangle_sampling.hpp"

#include <gtest/gtest.h>

#include "tests/libpbr/light/area_reference.hpp"
#include "tests/libpbr/support/chi_square.hpp"
#include "tests/libpbr/support/property.hpp"

namespace pbr {
namespace {

RectangleLight<double> random_rectangle() {
    const auto [x, y] = plane_of(*direction());
    return {*log_uniform(0.3, 10) * *direction(), *log_uniform(0.01, 3) * x, *log_uniform(0.01, 3) * y,
            Emission::two_sided};
}

RC_GTEST_PROP(SphericalRectangle, SampleAndInverseAreARoundTrip, ()) {
    const RectangleLight<double> light = random_rectangle();
    const SphericalRectangle seen(light, Vec(0));
    RC_PRE(seen.solid_angle() > 1e-6);
    const double u1 = *unit_interval(), u2 = *unit_interval();
    const Vec wi = seen.sample(u1, u2);
    RC_ASSERT(std::abs(glm::length(wi) - 1) < 1e-14);
    RC_ASSERT(seen.pdf(wi) == 1 / seen.solid_angle());
    const Sample2 back = seen.inverse(wi);
    const double slant = std::abs(glm::dot(front_normal(light), glm::normalize(light.centre)));
    const double tolerance = 1e-12 / seen.solid_angle() / std::max(slant, 1e-3);
    RC_ASSERT(std::abs(back.u1 - u1) < tolerance);
    RC_ASSERT(std::abs(back.u2 - u2) < tolerance);
}

TEST(SphericalRectangle, SamplesFollowTheirDensity) {
    // Cells are those of a 16 x 16 grid on the light. Their probability is the density's integral over each,
    // by the area form, which shares nothing with the sampler.
    const RectangleLight<double> lights[] = {
        {{0, 0, 1}, {1, 0, 0}, {0, 0.5, 0}, Emission::two_sided},         // head-on
        {{2, -1, 0.3}, {1, 0, 0}, {0, 1.5, 0}, Emission::two_sided},      // aslant
        {{0, 0, 1e-2}, {1, 0, 0}, {0, 1, 0}, Emission::two_sided},        // nearly touching
        {{0, 0, 1e3}, {0.03, 0, 0}, {0, 0.01, 0}, Emission::two_sided}};  // below the smallest: by area
    constexpr int kSide = 16, kCount = 100'000;
    const QuadratureRule rule = gauss_legendre(16);
    for (const RectangleLight<double>& light : lights) {
        const SphericalRectangle seen(light, Vec(0));
        std::vector<double> observed(kSide * kSide), expected(kSide * kSide);
        const Vec normal = front_normal(light);
        const auto cell = [&](double x) {
            return std::clamp(static_cast<int>((x + 1) / 2 * kSide), 0, kSide - 1);
        };
        for (int i = 0; i < kCount; ++i) {
            const Vec wi = seen.sample(random_unit(3, i, 0), random_unit(3, i, 1));
            const Vec x = wi * (glm::dot(light.centre, normal) / glm::dot(wi, normal)) - light.centre;
            const double a = glm::dot(x, light.half_x) / glm::dot(light.half_x, light.half_x);
            const double b = glm::dot(x, light.half_y) / glm::dot(light.half_y, light.half_y);
            ASSERT_LT(std::max(std::abs(a), std::abs(b)), 1 + 1e-9);
            observed[cell(a) * kSide + cell(b)] += 1;
        }
        double total = 0;
        for (int i = 0; i < kSide * kSide; ++i)
            for (int k = 0; k < 256; ++k) {
                const double a = (i / kSide + rule.nodes[k / 16]) * 2.0 / kSide - 1;
                const double b = (i % kSide + rule.nodes[k % 16]) * 2.0 / kSide - 1;
                const Vec x = light.centre + a * light.half_x + b * light.half_y;
                const double d = glm::length(x);
                const double per_area = std::abs(glm::dot(x, normal)) / (d * d * d);
                expected[i] += seen.pdf(x / d) * per_area * surface_area(light) / (kSide * kSide) * kCount *
                               rule.weights[k / 16] * rule.weights[k % 16];
            }
        for (const double e : expected) total += e;
        EXPECT_NEAR(total / kCount, 1, 1e-3);
        EXPECT_GT(pearson_p_value(observed, expected), kSignificance);
    }
}

TEST(SphericalRectangle, DensityIsZeroBesideTheLightAndBehindIt) {
    const RectangleLight<double> light{{0, 0, 1}, {1, 0, 0}, {0, -1, 0}, Emission::one_sided};
    EXPECT_GT(pdf_solid_angle(light, Vec(0), Vec(0, 0, 1)), 0);
    EXPECT_EQ(pdf_solid_angle(light, Vec(0), Vec(0, 0, -1)), 0);
    EXPECT_EQ(pdf_solid_angle(light, Vec(0), Vec(1, 0, 0)), 0);
    EXPECT_EQ(pdf_solid_angle(light, Vec(0), Vec(0.8, 0, 0.6)), 0);
    EXPECT_EQ(pdf_solid_angle(light, Vec(0, 0, 2), Vec(0, 0, -1)), 0);  // p behind
    EXPECT_EQ(pdf_solid_angle(light, Vec(0, 0, 1), Vec(0, 0, 1)), 0);   // p in the plane
}

RC_GTEST_PROP(SphericalRectangle, StaysOnTheLightForAnyPlace, ()) {
    const Vec p = *log_uniform(1e-6, 1e6) * *direction();
    const RectangleLight<double> light{Vec(0), {1, 0, 0}, {0, 1, 0}, Emission::two_sided};
    RC_PRE(std::abs(p.z) > 1e-9 * glm::length(p));
    const SphericalRectangle seen(light, p);
    const Vec wi = seen.sample(*unit_interval(), *unit_interval());
    RC_ASSERT(std::isfinite(wi.x) && std::abs(glm::length(wi) - 1) < 1e-14);
    RC_ASSERT(wi.z * p.z < 0);
}

TEST(SphericalRectangle, FloatSamplesAreTheRoundedDoubles) {
    const RectangleLight<float> light{{0.5f, 0, 1}, {1, 0, 0}, {0, 0.5f, 0}, Emission::two_sided};
    const Vec3<float> wi = sample_rectangle_light(light, Vec3<float>(0), 0.25f, 0.75f);
    const Vec exact = sample_rectangle_light(in_double(light), Vec(0), 0.25, 0.75);
    EXPECT_LT(glm::length(Vec(wi) - exact), 1e-7);
    EXPECT_NEAR(inverse_rectangle_light(light, Vec3<float>(0), wi).u1, 0.25, 1e-6);
}

}  // namespace
}  // namespace pbr
