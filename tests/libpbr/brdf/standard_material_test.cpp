#include "pbr/brdf/standard_material.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "pbr/ibl/dfg.hpp"
#include "tests/libpbr/support/float_error.hpp"
#include "tests/libpbr/support/property.hpp"
#include "tests/libpbr/support/reflections.hpp"

namespace pbr {
namespace {

TEST(StandardMaterial, DielectricAndMetalAreTheEndsOfTheMask) {
    const Vec3<double> colour(.8, .5, .2);
    const Surface<double> plastic = surface_from_material<double>({colour, .6, 0, .5});
    EXPECT_EQ(plastic.diffuse_albedo, colour);
    for (int c = 0; c < 3; ++c) EXPECT_DOUBLE_EQ(plastic.f0[c], .04);
    EXPECT_EQ(plastic.f90, 1);
    EXPECT_DOUBLE_EQ(plastic.perceptual_roughness, .4);
    EXPECT_DOUBLE_EQ(plastic.alpha, .16);
    const Surface<double> metal = surface_from_material<double>({colour, .6, 1, .5});
    EXPECT_EQ(metal.diffuse_albedo, Vec3<double>(0));
    EXPECT_EQ(metal.f0, colour);
}

TEST(StandardMaterial, LowReflectanceOccludes) {
    EXPECT_EQ(surface_from_material<double>({Vec3<double>(.5), .5, 0, 0}).f90, 0);
    EXPECT_LT(surface_from_material<double>({Vec3<double>(.5), .5, 0, .3}).f90, 1);
    EXPECT_EQ(surface_from_material<double>({Vec3<double>(.5), .5, 0, .36}).f90, 1);
}

RC_GTEST_PROP(StandardMaterial, SurfaceStaysInRange, ()) {
    const StandardMaterial<double> material{
        Vec3<double>(*unit_interval(), *unit_interval(), *unit_interval()), *unit_interval(),
        *unit_interval(), *unit_interval()};
    const Surface<double> s = surface_from_material(material);
    for (int c = 0; c < 3; ++c) {
        RC_ASSERT(s.diffuse_albedo[c] >= 0 && s.diffuse_albedo[c] <= 1);
        RC_ASSERT(s.f0[c] >= 0 && s.f0[c] <= 1);
    }
    RC_ASSERT(s.f90 >= 0 && s.f90 <= 1 && s.alpha >= 0 && s.alpha <= 1);
}

TEST(StandardMaterial, LobesHaveTheAlbedosOfTheTables) {
    const Surface<double> s = surface_from_material<double>({Vec3<double>(.6), .5, 0, .5});
    for (const double NoV : {.1, .7}) {
        EXPECT_NEAR(
            reflection_albedo([&](const Reflection<double>& r) { return f_standard_diffuse(s, r).x; }, NoV),
            .6 * albedo_disney_diffuse(NoV, .5), 1e-7);
        EXPECT_NEAR(
            reflection_albedo([&](const Reflection<double>& r) { return DV_standard_specular(s, r); }, NoV),
            dfg_ggx(NoV, s.alpha, DfgMethod::quadrature(1e-8)).E, 1e-6);
    }
}

TEST(StandardMaterial, WhiteExceedsOneAtGrazingAndFullRoughness) {
    // Frostbite's correction was made for the sum of both lobes; at the roughest it falls short.
    const auto albedo = [](double smoothness, double reflectance, double NoV) {
        const Surface<double> s =
            surface_from_material<double>({Vec3<double>(1), smoothness, 0, reflectance});
        return reflection_albedo_fixed(
            [&](const Reflection<double>& r) {
                return f_standard_diffuse(s, r).x +
                       F_schlick(s.f0.x, s.f90, r.LoH) * DV_standard_specular(s, r);
            },
            NoV);
    };
    for (const auto& [reflectance, stated] : {std::pair(.5, 1.117), std::pair(1.0, 1.231)}) {
        double most = 0;
        for (const double smoothness : {0.0, .1, .3, .5, .7})
            for (const double NoV : {0.0, 1e-3, .01, .1, .5, 1.0})
                most = std::max(most, albedo(smoothness, reflectance, NoV));
        EXPECT_NEAR(most, stated, 1e-3);
        EXPECT_EQ(most, albedo(0, reflectance, 0));  // where the header says
    }
}

TEST(StandardMaterial, FloatIsWithinTheUlpStated) {
    for (int i = 0; i < 50'000; ++i) {
        const auto u = [i](int stream) { return static_cast<float>(random_unit(stream, i)); };
        const Surface<float> s = surface_from_material<float>({{u(1), u(2), u(3)}, u(4) * .95f, u(5), u(6)});
        const Surface<double> d =
            surface_from_material<double>({{u(1), u(2), u(3)}, u(4) * .95f, u(5), u(6)});
        for (int c = 0; c < 3; ++c) {
            EXPECT_LT(ulp_error_of(1, s.f0[c], d.f0[c]), 4);
            EXPECT_LT(ulp_error_of(1, s.diffuse_albedo[c], d.diffuse_albedo[c]), 4);
        }
        const Surface<double> same{Vec3<double>(s.diffuse_albedo), Vec3<double>(s.f0), s.f90,
                                   s.perceptual_roughness, s.alpha};
        const Reflection<float> r = as_float(sample_reflection(i));
        EXPECT_LT(ulp_error(DV_standard_specular(s, r), DV_standard_specular(same, as_double(r))), 16);
    }
}

}  // namespace
}  // namespace pbr
