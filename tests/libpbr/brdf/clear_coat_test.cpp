#include "pbr/brdf/clear_coat.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pbr/brdf/lambert.hpp"
#include "pbr/ibl/dfg.hpp"
#include "tests/libpbr/support/float_error.hpp"
#include "tests/libpbr/support/property.hpp"
#include "tests/libpbr/support/reflections.hpp"

namespace pbr {
namespace {

TEST(ClearCoat, LobeHasTheAlbedoOfTheDfgTables) {
    for (const double alpha : {.1, .4, 1.0})
        for (const double NoV : {.1, .6, 1.0}) {
            const DirectionalAlbedo table = dfg_ggx(NoV, alpha, DfgMethod::quadrature(1e-8));
            const double albedo = reflection_albedo(
                [&](const Reflection<double>& r) { return f_clear_coat(r, alpha, .7); }, NoV);
            EXPECT_NEAR(albedo, .7 * (.04 * (table.E - table.Fc) + table.Fc), 1e-6) << alpha << ' ' << NoV;
        }
}

TEST(ClearCoat, KelemensLobeConservesEnergyBelowTheTables) {
    double below = 0;
    for (const double alpha : {.1, .2, .3, .5, .7, 1.0})
        for (const double NoV : {0.0, .02, .1, .3, .5, 1.0}) {
            const double kelemen = reflection_albedo_fixed(
                [&](const Reflection<double>& r) { return D_ggx(r.NoH, r.sin2, alpha) * V_kelemen(r.LoH); },
                NoV);
            EXPECT_LE(kelemen, 1 + 2e-4) << alpha << ' ' << NoV;
            below = std::max(below, dfg_ggx(NoV, alpha, DfgMethod::quadrature(1e-8)).E - kelemen);
        }
    EXPECT_LT(below, .11);
    EXPECT_GT(below, .10);
}

TEST(ClearCoat, OverWhiteReturnsAsMuchAsStated) {
    double least = 2, most = 0, filament = 0;
    for (const double alpha : {.05, .1, .3, 1.0})
        for (const double NoV : {.01, .05, .2, .5, 1.0}) {
            const double albedo = reflection_albedo_fixed(
                [&](const Reflection<double>& r) {
                    return f_clear_coat(r, alpha, 1.0) +
                           f_lambert<double>() * clear_coat_transmission(r.NoL, r.NoV, 1.0);
                },
                NoV);
            least = std::min(least, albedo);
            most = std::max(most, albedo);
        }
    EXPECT_NEAR(least, .122, 2e-3);
    EXPECT_LT(most, .93);
    // A mirror coat in closed form: it reflects F(NoV); Lambert's albedo is what both ways let through, by
    // F's mean 1/21.
    for (const double NoV : {0.0, .02, .1, .3, 1.0}) {
        const double F = F_schlick(.04, 1.0, NoV), mean = .04 + .96 / 21;
        const double ours = F + (1 - F) * (1 - mean);
        EXPECT_GT(ours, .90);
        EXPECT_LE(ours, 1);
        const double theirs =
            F + reflection_albedo_fixed(
                    [](const Reflection<double>& r) {
                        return f_lambert<double>() * clear_coat_transmission_filament(r.LoH, 1.0);
                    },
                    NoV);
        filament = std::max(filament, theirs);
    }
    EXPECT_GT(filament, 1.7);
}

TEST(ClearCoat, BaseUnderTheCoatFollowsFromIndices) {
    for (const double ior : {1.0, 1.2, 1.5, 1.8, 2.4})
        EXPECT_NEAR(f0_under_clear_coat(f0_from_ior(ior)), f0_from_ior(ior / 1.5), 1e-15) << ior;
    EXPECT_NEAR(f0_under_clear_coat(.04), 0, 1e-30);
    EXPECT_DOUBLE_EQ(f0_under_clear_coat(0.0), .04);
    EXPECT_DOUBLE_EQ(f0_under_clear_coat(1.0), 1);
    const double s = std::sqrt(.3);  // Filament's form of it
    EXPECT_NEAR(f0_under_clear_coat(.3), std::pow((1 - 5 * s) / (5 - s), 2), 1e-15);
}

RC_GTEST_PROP(ClearCoat, TransmissionIsReciprocalAndWithinOne, ()) {
    const double NoL = *unit_interval(), NoV = *unit_interval(), strength = *unit_interval();
    const double t = clear_coat_transmission(NoL, NoV, strength);
    RC_ASSERT(t >= 0 && t <= 1);
    RC_ASSERT(ulp_distance(t, clear_coat_transmission(NoV, NoL, strength)) <= 1);
    RC_ASSERT(clear_coat_transmission(NoL, NoV, 0.0) == 1);
    RC_ASSERT(F_clear_coat(NoL, strength) >= 0 && F_clear_coat(NoL, strength) <= strength);
}

TEST(ClearCoat, FloatIsWithinTheUlpStated) {
    for (int i = 0; i < 50'000; ++i) {
        const Reflection<float> r = as_float(sample_reflection(i));
        const Reflection<double> d = as_double(r);
        const float alpha = static_cast<float>(std::pow(random_unit(1, i), 3) + 1e-3),
                    strength = static_cast<float>(random_unit(2, i)),
                    f0 = static_cast<float>(random_unit(3, i));
        EXPECT_LT(ulp_error(f_clear_coat(r, alpha, strength), f_clear_coat<double>(d, alpha, strength)), 24);
        EXPECT_LT(ulp_error(F_clear_coat(r.LoH, strength), F_clear_coat<double>(d.LoH, strength)), 8);
        EXPECT_LT(ulp_error(V_kelemen(r.LoH), V_kelemen(d.LoH)), 2);
        EXPECT_LT(ulp_error_of(1, f0_under_clear_coat(f0), f0_under_clear_coat(static_cast<double>(f0))), 4);
    }
}

}  // namespace
}  // namespace pbr
