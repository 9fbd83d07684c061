#include "pbr/brdf/material.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>

#include "pbr/brdf/material_effects.hpp"
#include "tests/libpbr/support/property.hpp"
#include "tests/libpbr/support/reflections.hpp"

namespace pbr {
namespace {

// What is absent takes no room, and an effect takes its own.
static_assert(sizeof(Material<float>) == sizeof(Surface<float>));
static_assert(sizeof(Material<double>) == sizeof(Surface<double>));
static_assert(sizeof(Material<float, Anisotropy<float>>) ==
              sizeof(Surface<float>) + sizeof(Anisotropy<float>));
static_assert(std::is_trivially_copyable_v<Material<float>>);

// Which hooks an effect has is seen by the compiler.
static_assert(CoversSurface<ClearCoat<float>, float> && PreparesSurface<ClearCoat<float>, float>);
static_assert(!ReplacesSpecular<ClearCoat<float>, float> && !AddsLobe<ClearCoat<float>, float>);
static_assert(ReplacesSpecular<Anisotropy<float>, float> && !CoversSurface<Anisotropy<float>, float>);
static_assert(ReplacesDiffuse<EonDiffuse<float>, float>);

constexpr StandardMaterial<double> kPaint{{.7, .3, .2}, .55, .1, .5};

/// A counter of each hook's calls, for order and number.
struct Trace {
    mutable int covered = 0;
    int* sequence;
    Vec3<float> over(const Reflection<float>&, const Vec3<float>& below) const {
        covered = ++*sequence;
        return below;
    }
};

TEST(Material, BareIsTheBareLobesToTheBit) {
    for (int i = 0; i < 20'000; ++i) {
        const auto u = [i](int stream) { return static_cast<float>(random_unit(stream, i)); };
        const StandardMaterial<float> authored{{u(1), u(2), u(3)}, u(4) * .98f, u(5), u(6)};
        const Reflection<double> any = sample_reflection(i);
        const Vec3<float> wo(any.wo), wi(any.wi);
        const Reflection<float> r = reflection(wo, wi);
        const Surface<float> s = surface_from_material(authored);
        const float diffuse = f_disney_diffuse(r.NoL, r.NoV, r.LoH, s.perceptual_roughness);
        const float DV = D_ggx(r.NoH, r.sin2, s.alpha) * V_smith_ggx_correlated(r.NoL, r.NoV, s.alpha);
        Vec3<float> lobes;
        for (int c = 0; c < 3; ++c)
            lobes[c] = s.diffuse_albedo[c] * diffuse + F_schlick(s.f0[c], s.f90, r.LoH) * DV;
        ASSERT_EQ(Material<float>(authored).f(wo, wi), r.NoL > 0 && r.NoV > 0 ? lobes : Vec3<float>(0));
    }
}

TEST(Material, EffectsWithoutStrengthChangeNothing) {
    const Material<double> bare(kPaint);
    const auto white = [](double, double) { return 1.0; };
    const Material isotropic(kPaint, Anisotropy<double>{0});
    const Material compensated(kPaint, EnergyCompensation<double, decltype(white)>{white});
    const Material uncoated(kPaint, ClearCoat<double>{0, .1});
    const Material naked(kPaint, Cloth<double, decltype(white)>{Vec3<double>(0), .3, white});
    for (int i = 0; i < 2000; ++i) {
        const Reflection<double> r = sample_reflection(i);
        for (int c = 0; c < 3; ++c) {
            const double f = bare.f(r.wo, r.wi)[c];
            EXPECT_NEAR(isotropic.f(r.wo, r.wi)[c] / f, 1, 1e-13);
            EXPECT_DOUBLE_EQ(compensated.f(r.wo, r.wi)[c], f);
            EXPECT_DOUBLE_EQ(uncoated.f(r.wo, r.wi)[c], f);
            EXPECT_DOUBLE_EQ(naked.f(r.wo, r.wi)[c], f);
        }
    }
}

TEST(Material, EffectsActOnceInTheirOrder) {
    int sequence = 0;
    const Trace lower{0, &sequence}, upper{0, &sequence};
    const Material material(StandardMaterial<float>{Vec3<float>(.5f), .5f, 0, .5f}, lower, upper);
    static_assert(sizeof(material) >= 2 * sizeof(Trace));
    material.f({0, 0, 1}, {0, 0, 1});
    EXPECT_EQ(sequence, 2);
}

TEST(Material, LayersDoNotCommute) {
    const auto albedo = [](double, double) { return .3; };
    const Cloth<double, decltype(albedo)> cloth{Vec3<double>(.8), .3, albedo};
    const ClearCoat<double> coat{1, .05};
    const Vec3<double> wo = direction_at(.4, 0), wi = direction_at(.5, .3);
    const Vec3<double> coat_on_top = Material(kPaint, cloth, coat).f(wo, wi);
    const Vec3<double> cloth_on_top = Material(kPaint, coat, cloth).f(wo, wi);
    EXPECT_GT(std::abs(coat_on_top.x - cloth_on_top.x), 1e-3);
    // By hand, from the outside in.
    const Reflection<double> r = reflection(wo, wi);
    EXPECT_EQ(coat_on_top, coat.over(r, cloth.over(r, Material(kPaint, coat).diffuse(r) +
                                                          Material(kPaint, coat).specular(r))));
}

TEST(Material, IsFiniteAtItsHazards) {
    const auto albedo = [](float, float) { return .5f; };
    const Material material(StandardMaterial<float>{Vec3<float>(1), .99f, .5f, .5f}, EonDiffuse<float>{1},
                            Anisotropy<float>{1}, MultipleScattering<float, decltype(albedo)>{albedo, .999f},
                            Cloth<float, decltype(albedo)>{Vec3<float>(1), 1e-3f, albedo},
                            ClearCoat<float>{1, 1e-4f});
    for (const float cosine : {1e-20f, 1e-8f, 1e-3f, .5f, 1.f})
        for (const float turns : {0.f, .25f, .5f}) {
            const Vec3<float> wo(direction_at(cosine, 0)), wi(direction_at(1e-20, turns));
            for (const auto& f : {material.f(wo, wi), material.f(wi, wo), material.f(wo, wo)})
                for (int c = 0; c < 3; ++c) {
                    EXPECT_TRUE(std::isfinite(f[c])) << cosine << ' ' << turns;
                    EXPECT_GE(f[c], 0);
                }
        }
}

TEST(Material, NothingReturnsFromBelow) {
    const Material<float> material(StandardMaterial<float>{Vec3<float>(.5f), .5f, 0, .5f});
    EXPECT_EQ(material.f({0, 0, 1}, {1, 0, 0}), Vec3<float>(0));
    EXPECT_EQ(material.f({.6f, 0, -.8f}, {0, 0, 1}), Vec3<float>(0));
}

TEST(Material, IsFiniteForTheSmoothestThatFloatKnows) {
    for (const float smoothness : {.999f, .999999f, 1 - 0x1p-24f}) {
        const Material<float> material({Vec3<float>(1), smoothness, 1, .5f});
        EXPECT_GT(material.surface().alpha, 3e-15f);
        for (const float cosine : {1.0f, .3f, 1e-2f, 1e-4f}) {
            const float sine = std::sqrt((1 - cosine) * (1 + cosine));
            const float f = material.f({sine, 0, cosine}, {-sine, 0, cosine}).x;
            EXPECT_TRUE(std::isfinite(f)) << smoothness << ' ' << cosine;
            EXPECT_GT(f, 0);
        }
    }
}

}  // namespace
}  // namespace pbr
