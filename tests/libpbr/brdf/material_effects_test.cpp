#include "pbr/brdf/material_effects.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "pbr/brdf/material.hpp"
#include "pbr/ibl/dfg.hpp"
#include "tests/libpbr/support/property.hpp"
#include "tests/libpbr/support/reflections.hpp"

namespace pbr {
namespace {

/// E itself instead of a table.
struct ExactE {
    double operator()(double cosine, double alpha) const {
        static const DfgMethod method = DfgMethod::quadrature(1e-4);
        return dfg_ggx(cosine, alpha, method).E;
    }
};

/// The white lobe's albedo, by linear interpolation of 33 views at the one alpha that the tests use.
struct ClothAlbedo {
    double operator()(double cosine, double alpha) const {
        static const std::vector<double> table = [alpha] {
            std::vector<double> values;
            for (int i = 0; i <= 32; ++i)
                values.push_back(albedo_charlie(i * i / 1024.0, alpha, CharlieVisibility::charlie));
            return values;
        }();
        const double x = 32 * std::sqrt(cosine);
        const auto cell = std::min<std::size_t>(31, static_cast<std::size_t>(x));
        return std::lerp(table[cell], table[cell + 1], x - static_cast<double>(cell));
    }
};

template <class M>
double albedo(const M& material, double NoV) {
    return reflection_albedo_fixed([&](const Reflection<double>& r) { return material.f(r.wo, r.wi).x; },
                                   NoV);
}

constexpr StandardMaterial<double> kWhiteMetal{{1, 1, 1}, .2, 1, .5};  // alpha .64
constexpr StandardMaterial<double> kWhitePaint{{1, 1, 1}, .5, 0, .5};
constexpr double kClothAlpha = .36;

TEST(MaterialEffects, WhiteMetalReturnsOneWithEitherCompensation) {
    const double E_avg = average_albedo_ggx(.64);
    for (const double NoV : {.1, .9}) {
        EXPECT_LT(albedo(Material(kWhiteMetal), NoV), .95);
        EXPECT_NEAR(albedo(Material(kWhiteMetal, EnergyCompensation<double, ExactE>{}), NoV), 1, 2e-4);
        EXPECT_NEAR(albedo(Material(kWhiteMetal, MultipleScattering<double, ExactE>{{}, E_avg}), NoV), 1,
                    2e-4);
    }
}

TEST(MaterialEffects, LayersOverWhiteStayWithinOne) {
    const EonDiffuse<double> eon{.5};
    for (const double NoV : {.02, .2, .7, 1.0}) {
        // EON without specular: a base whose albedo is 1.
        const StandardMaterial<double> chalk{{1, 1, 1}, .5, 0, 0};
        EXPECT_NEAR(albedo(Material(chalk, eon), NoV), 1, 2e-4) << NoV;
        const Cloth<double, ClothAlbedo> cloth{{.9, .9, .9}, kClothAlpha, {}};
        EXPECT_LT(albedo(Material(chalk, eon, cloth), NoV), 1 + 2e-3) << NoV;
    }
}

TEST(MaterialEffects, FibresReturnMoreThanArrivedOnlyBelowTheAlphaStated) {
    // Over black the albedo is the lobe's own; over white it is 1 as long as the lobe's isn't more.
    const auto most = [](double alpha) {
        double result = 0;
        for (double NoV = 1e-3; NoV <= 1; NoV *= 1.08)
            result = std::max(result, albedo_charlie(NoV, alpha, CharlieVisibility::charlie));
        return result;
    };
    for (const double alpha : {.07, .08, .1, .2, .5, 1.0}) EXPECT_LT(most(alpha), 1) << alpha;
    EXPECT_NEAR(most(.05), 1.103, 1e-3);
    EXPECT_NEAR(most(.03), 1.335, 1e-3);
    EXPECT_NEAR(most(.01), 2.129, 1e-3);
}

TEST(MaterialEffects, CoatOverADielectricOfItsOwnIndexLeavesNoBoundary) {
    const Material coated(kWhitePaint, ClearCoat<double>{1, .05});
    EXPECT_NEAR(coated.surface().f0.x, 0, 1e-15);
    EXPECT_NEAR(coated.surface().f90, 0, 1e-13);
    const Material half(kWhitePaint, ClearCoat<double>{.5, .05});
    EXPECT_NEAR(half.surface().f0.x, .02, 1e-15);
}

TEST(MaterialEffects, DiffuseModelsReplaceDisneys) {
    const Reflection<double> r = reflection(direction_at(.6, 0), direction_at(.3, .2));
    EXPECT_EQ(Material(kWhitePaint, LambertDiffuse<double>{}).diffuse(r).x, f_lambert<double>());
    EXPECT_EQ(Material(kWhitePaint, EonDiffuse<double>{.4}).diffuse(r).x,
              f_eon(1.0, .4, r.NoL, r.NoV, r.LoV));
    EXPECT_EQ(Material(kWhitePaint, ChanDiffuse<double>{}).diffuse(r).x,
              f_chan(r.NoL, r.NoV, r.NoH, r.LoH, .25));
    EXPECT_EQ(Material(kWhitePaint, HammonDiffuse<double>{}).diffuse(r).x,
              f_hammon(1.0, r.NoL, r.NoV, r.NoH, r.LoV, .25));
}

RC_GTEST_PROP(MaterialEffects, AreReciprocalFiniteAndPositive, ()) {
    const Vec3<double> wo = *direction(1e-9), wi = *direction(1e-9);
    const StandardMaterial<double> authored{
        Vec3<double>(*unit_interval(), *unit_interval(), *unit_interval()), *uniform(0, .98),
        *unit_interval(), *unit_interval()};
    const auto E = [](double, double) { return .6; };
    const auto check = [&](const auto& material) {
        const Vec3<double> there = material.f(wo, wi), back = material.f(wi, wo);
        for (int c = 0; c < 3; ++c) {
            RC_ASSERT(std::isfinite(there[c]) && there[c] >= -1e-15);
            RC_ASSERT(std::abs(there[c] - back[c]) <= 1e-12 * (1 + there[c]));
        }
    };
    const double strength = *unit_interval(), alpha = *log_uniform(1e-3, 1);
    check(Material(authored));
    check(Material(authored, ClearCoat<double>{strength, alpha}));
    check(Material(authored, Cloth<double, decltype(E)>{Vec3<double>(strength), alpha, E}));
    check(Material(authored, Anisotropy<double>{strength}));
    check(Material(authored, MultipleScattering<double, decltype(E)>{E, .6}));
    check(Material(authored, EonDiffuse<double>{strength}, Anisotropy<double>{strength},
                   ClearCoat<double>{strength, alpha}));
}

}  // namespace
}  // namespace pbr
