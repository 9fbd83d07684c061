#include "pbr/brdf/disney_diffuse.hpp"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>

#include "tests/libpbr/support/float_error.hpp"
#include "tests/libpbr/support/reflections.hpp"

namespace pbr {
namespace {

/// The albedo by brute two-dimensional quadrature over directions, with LoH from the half vector itself.
template <class Brdf>
double albedo_by_directions(const Brdf& f, double NoV, double perceptual_roughness) {
    using boost::math::quadrature::gauss_kronrod;
    const double sin_v = std::sqrt(1 - NoV * NoV);
    const auto ring = [&](double NoL) {
        const double sin_l = std::sqrt(1 - NoL * NoL);
        const auto at = [&](double phi) {
            const double hx = sin_v + sin_l * std::cos(phi), hy = sin_l * std::sin(phi), hz = NoV + NoL;
            const double length = std::sqrt(hx * hx + hy * hy + hz * hz);
            const double LoH = length > 0 ? (sin_v * hx + NoV * hz) / length : 0;
            return f(NoL, NoV, LoH, perceptual_roughness) * NoL;
        };
        return 2 * gauss_kronrod<double, 31>::integrate(at, 0.0, std::numbers::pi, 6, 1e-12);
    };
    return gauss_kronrod<double, 31>::integrate(ring, 0.0, 1.0, 6, 1e-12);
}

TEST(DisneyDiffuse, ClosedFormAlbedoAgreesWithQuadratureOverDirections) {
    for (const double r : {0.0, 0.3, 0.5, 1.0})
        for (const double NoV : {0.0, 0.1, 0.5, 1.0}) {
            EXPECT_NEAR(albedo_disney_diffuse(NoV, r), albedo_by_directions(f_disney_diffuse<double>, NoV, r),
                        1e-13);
            EXPECT_NEAR(albedo_disney_diffuse_original(NoV, r),
                        albedo_by_directions(f_disney_diffuse_original<double>, NoV, r), 1e-13);
        }
}

TEST(DisneyDiffuse, HasThePublishedAlbedos) {
    const double expected[3][4] = {
        {0, .390, .923, .952}, {.620, .719, .822, .826}, {1.0315, .914, .700, .686}};
    const double roughness[] = {0, .5, 1}, NoV[] = {0, .1, .5, 1};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j)
            EXPECT_NEAR(albedo_disney_diffuse(NoV[j], roughness[i]), expected[i][j], 6e-4)
                << roughness[i] << " " << NoV[j];
}

TEST(DisneyDiffuse, RenormalisedModelExceedsOneAtGrazingAndFullRoughness) {
    EXPECT_NEAR(albedo_disney_diffuse(0, 1), 1.0315,
                5e-5);  // Frostbite's choice is not strictly energy conserving
    double largest = 0;
    for (int i = 0; i <= 100; ++i)
        for (int j = 0; j <= 100; ++j)
            largest = std::max(largest, albedo_disney_diffuse(i / 100.0, j / 100.0));
    EXPECT_NEAR(largest, albedo_disney_diffuse(0, 1), 1e-12);
    double original = 0;
    for (int j = 0; j <= 100; ++j)
        original = std::max(original, albedo_disney_diffuse_original(0, j / 100.0));
    EXPECT_NEAR(original, 1.5577, 5e-3);
}

TEST(DisneyDiffuse, IsReciprocal) {
    EXPECT_EQ(f_disney_diffuse(0.3, 0.8, 0.9, 0.6), f_disney_diffuse(0.8, 0.3, 0.9, 0.6));
    EXPECT_EQ(f_disney_diffuse_original(0.3f, 0.8f, 0.9f, 0.6f),
              f_disney_diffuse_original(0.8f, 0.3f, 0.9f, 0.6f));
}

TEST(DisneyDiffuse, FloatIsWithinTheUlpStated) {
    for (int i = 0; i < 50'000; ++i) {
        const Reflection<float> r = as_float(sample_reflection(i));
        const Reflection<double> d = as_double(r);
        const float p = static_cast<float>(random_unit(1, i));
        const double q = p;
        EXPECT_LT(ulp_error(f_disney_diffuse_original(r.NoL, r.NoV, r.LoH, p),
                            f_disney_diffuse_original(d.NoL, d.NoV, d.LoH, q)),
                  16);
        EXPECT_LT(ulp_error_of(1 / std::numbers::pi, f_disney_diffuse(r.NoL, r.NoV, r.LoH, p),
                               f_disney_diffuse(d.NoL, d.NoV, d.LoH, q)),
                  16);
    }
    EXPECT_DOUBLE_EQ(f_disney_diffuse_original(0.0, 0.0, 1.0, 1.0), 6.25 / std::numbers::pi);
}

}  // namespace
}  // namespace pbr
