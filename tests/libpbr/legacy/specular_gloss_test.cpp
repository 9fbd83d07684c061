#include "pbr/legacy/specular_gloss.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "pbr/numerics/sequence.hpp"

namespace pbr {
namespace {

using Colour = Vec3<double>;
using enum DiffuseCoupling;

double distance(const Colour& a, const Colour& b) {
    return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}

double srgb_to_linear(double v) { return v <= .04045 ? v / 12.92 : std::pow((v + .055) / 1.055, 2.4); }
double linear_to_srgb(double v) { return v <= .0031308 ? v * 12.92 : 1.055 * std::pow(v, 1 / 2.4) - .055; }
double code8(int code) { return srgb_to_linear(code / 255.); }

/// Half the linear interval of an 8-bit sRGB code.
double half_step8(double linear) {
    return .5 / 255 *
           (linear <= .0031308 ? 1 / 12.92
                               : 2.4 / 1.055 * std::pow((linear_to_srgb(linear) + .055) / 1.055, 1.4));
}

MetallicEstimate<double> estimate(double d, double s, double tolerance = .02, double half_step = 0) {
    return estimate_metallic<double>({Colour(d), Colour(s)}, {.04, tolerance, .01},
                                     {Colour(half_step), Colour(half_step)}, none);
}

// --- the hard cases, right answers first
// -----------------------------------------------------------------------

TEST(MetallicHardCases, BlackThatReflectsFourPerCentIsADielectricAndUnsure) {
    for (const double tolerance : {0., .02}) {
        EXPECT_EQ(estimate(0, .04, tolerance).metallic, 0);
        EXPECT_LT(estimate(0, .04, tolerance, .0007).confidence, .01);
        EXPECT_LT(estimate(0, .04, tolerance).confidence, .01);
    }
}

TEST(MetallicHardCases, NeighbouringCodes56And57AreNeighbours) {
    // .0395 and .0409, on either side of .04: known converters go from 0 to 1.
    const double step = half_step8(.04);
    for (const double tolerance : {0., .02}) {
        const auto lower = estimate(0, code8(56), tolerance, step),
                   upper = estimate(0, code8(57), tolerance, step);
        EXPECT_NEAR(lower.metallic, 0, 1e-12);
        EXPECT_NEAR(upper.metallic, 0, .05);
        EXPECT_LT(std::max(lower.confidence, upper.confidence), .05);
    }
}

TEST(MetallicHardCases, NothingReflectedIsNoSurfaceAnyoneIsSureOf) {
    const auto m = estimate(0, 0);
    EXPECT_EQ(m.metallic, 0);
    EXPECT_EQ(m.confidence, 0);
}

TEST(MetallicHardCases, WhiteMirrorWithoutDiffuseIsMetal) {
    const auto m = estimate(0, 1);
    EXPECT_NEAR(m.metallic, 1, 1e-4);
    EXPECT_GT(m.confidence, .99);
}

TEST(MetallicHardCases, MoreThanAllLightStaysFiniteAndKeepsItsParts) {
    const auto m = estimate(.9, .9);
    EXPECT_GE(m.metallic, 0);
    EXPECT_LE(m.metallic, 1);
    const auto material =
        material_with_residual<double>({Colour(.9), Colour(.9)}, m.metallic, .04, Colour(1e-5), none);
    const auto back = reflected_from_metallic(material, none);
    EXPECT_NEAR(back.f0.x, .9, 1e-12);
    EXPECT_LE(max_channel(material.base_color), 1);
}

TEST(MetallicHardCases, DimColouredSpecularKeepsItsColourAndIsUnsure) {
    const Reflected<double> red{Colour(.05, .02, .02), Colour(.12, .05, .04)};
    const auto m = estimate_metallic(red, {.04, .02, .01}, {Colour(1e-3), Colour(1e-3)}, none);
    EXPECT_LT(m.metallic, .9);
    EXPECT_LT(m.confidence, .8);
    const auto back =
        reflected_from_metallic(material_with_residual(red, m.metallic, .04, Colour(1e-5), none), none);
    EXPECT_LT(distance(back.f0, red.f0), 1e-12);
    EXPECT_LT(distance(back.diffuse, red.diffuse), 2e-5);
}

TEST(MetallicHardCases, LessThanWaterReflectsIsNeverSilentlyADielectric) {
    for (const double s : {0., .005, .01, .019}) {
        const auto m = estimate(.5, s);
        EXPECT_EQ(m.metallic, 0);
        EXPECT_LE(m.confidence, s / .02 + 1e-12);
        const auto material =
            material_with_residual<double>({Colour(.5), Colour(s)}, 0, .04, Colour(1e-5), none);
        EXPECT_NEAR(material.dielectric_f0.x, s, 1e-15);  // kept, not lifted to .04
    }
}

TEST(MetallicHardCases, NaNAndInfinityAreNumbersAfterwards) {
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 inf = std::numeric_limits<double>::infinity();
    for (const double d : {nan, inf, -1.})
        for (const double s : {nan, inf, -1.}) {
            const auto m = estimate(d, s);
            EXPECT_TRUE(m.metallic >= 0 && m.metallic <= 1 && m.confidence >= 0 && m.confidence <= 1)
                << d << s;
        }
}

// --- the estimate
// ------------------------------------------------------------------------------------------------

TEST(Metallic, RootSolvesTheModelItComesFrom) {
    for (int i = 0; i < 2000; ++i) {
        const double base = random_unit(1, i), m = random_unit(2, i);
        if (base * (1 - m) < .04 || base < .05) continue;  // below, two materials look the same
        const auto r = reflected_from_metallic<double>({Colour(base), m, Colour(.04)}, none);
        EXPECT_NEAR(metallic_root(r.diffuse.x, r.f0.x, .04), m, 1e-11);
    }
}

TEST(Metallic, IsContinuousInItsData) {
    // Steps of 1e-4 of specular, over all diffuse: the steepest is that of the odds, tolerance .02 wide.
    for (const double d : {0., .001, .01, .039, .04, .1, .5, 1.})
        for (int i = 0; i < 10000; ++i) {
            const double s = i * 1e-4;
            EXPECT_LT(std::abs(estimate(d, s + 1e-4).metallic - estimate(d, s).metallic), .006)
                << d << " " << s;
        }
    for (const double s : {.03, .04, .05, .08, .2, .9})
        for (int i = 0; i < 10000; ++i) {
            const double d = i * 1e-4;
            EXPECT_LT(std::abs(estimate(d + 1e-4, s).metallic - estimate(d, s).metallic), .006)
                << d << " " << s;
        }
}

TEST(Metallic, ClearCasesAreClear) {
    EXPECT_LT(estimate(.5, .04).metallic, 1e-12);
    EXPECT_GT(estimate(.5, .04).confidence, .85);
    EXPECT_GT(estimate(0, .56).metallic, .99);  // iron
    EXPECT_GT(estimate(0, .56).confidence, .95);
    EXPECT_LT(estimate(.3, .05).metallic, .01);  // a glossier dielectric
}

/// Gems and coated paint: no metal has a grey f0 below a quarter beside a colour, and a residual can hold it.
TEST(Metallic, GreyF0AboveDielectricsOverASaturatedColourIsNoMetal) {
    for (const double s : {.06, .08, .1, .15, .2})
        for (const Colour& diffuse :
             {Colour(.5, .05, .02), Colour(.05, .35, .05), Colour(.02, .1, .4), Colour(.6, .4, .02)}) {
            const Reflected<double> gem{diffuse, Colour(s)};
            for (const double step : {0., .002}) {
                const auto m = estimate_metallic(gem, {.04, .02, .01}, {Colour(step), Colour(step)}, none);
                EXPECT_LT(m.metallic, .02) << s << " " << diffuse.x << " " << step;
                EXPECT_LT(m.confidence, .8) << s << " " << diffuse.x;
            }
        }
    // The same f0 in the colours of a metal in part is one.
    const auto copper = reflected_from_metallic<double>({Colour(.95, .64, .54), .5, Colour(.04)}, none);
    EXPECT_NEAR(estimate_metallic(copper, {.04, .02, .01}, {Colour(.002), Colour(.002)}, none).metallic, .5,
                .01);
}

// --- there and back
// ----------------------------------------------------------------------------------------------

struct RoundTrip {
    double worst_diffuse = 0, worst_f0 = 0, metallic_error = 0, weight = 0;
    void add(const MetallicMaterial<double>& truth, double (*store)(double), double (*half_step)(double),
             double (*code)(double), DiffuseCoupling coupling, double tolerance) {
        const auto coded = [&](const Colour& c) { return Colour(code(c.x), code(c.y), code(c.z)); };
        const auto original = reflected_from_metallic(truth, coupling);
        Colour d = diffuse_colour(original, coupling), s = original.f0;
        for (int c = 0; c < 3; ++c) d[c] = store(d[c]), s[c] = store(s[c]);
        const auto r = reflected_from_specular(d, s, coupling);
        Quantisation<double> q;
        for (int c = 0; c < 3; ++c)
            q.diffuse[c] = std::max(half_step(d[c]) * (coupling == fresnel ? 1 - max_channel(s) : 1), 1e-6),
            q.f0[c] = half_step(r.f0[c]);
        const auto m = estimate_metallic(r, {.04, tolerance, .01}, q, coupling);
        const auto material = material_with_residual(r, m.metallic, .04, q.diffuse, coupling);
        const auto back = reflected_from_metallic(material, coupling);
        // Against what was stored: the texel's own code is the most that its file can say.
        worst_diffuse = std::max(worst_diffuse, distance(coded(back.diffuse), coded(r.diffuse)));
        worst_f0 = std::max(worst_f0, distance(coded(back.f0), coded(s)));
        if (m.confidence < .5) return;
        metallic_error += std::abs(m.metallic - truth.metallic);
        ++weight;
    }
};

double exactly(double v) { return v; }
double in_float(double v) { return static_cast<float>(v); }
double in_16_bits(double v) { return std::round(std::clamp(v, 0., 1.) * 65535) / 65535; }
double in_8_bits(double v) {
    return srgb_to_linear(std::round(linear_to_srgb(std::clamp(v, 0., 1.)) * 255) / 255);
}
double no_step(double) { return 0; }
double step_16(double) { return .5 / 65535; }

/// All corners of base colour and metallic, gradients between, and random colours.
template <class Visit>
void for_each_material(Visit visit) {
    for (int corner = 0; corner < 8; ++corner)
        for (int m = 0; m <= 32; ++m)
            visit({Colour(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1), m / 32., Colour(.04)});
    for (int b = 0; b <= 64; ++b)
        for (int m = 0; m <= 64; ++m) visit({Colour(b / 64.), m / 64., Colour(.04)});
    for (int i = 0; i < 4000; ++i)
        visit({Colour(random_unit(1, i), random_unit(2, i), random_unit(3, i)), random_unit(4, i),
               Colour(.04)});
}

RoundTrip round_trip(double (*store)(double), double (*half_step)(double), DiffuseCoupling coupling,
                     double tolerance, double (*code)(double) = exactly) {
    RoundTrip trip;
    for_each_material(
        [&](const MetallicMaterial<double>& m) { trip.add(m, store, half_step, code, coupling, tolerance); });
    return trip;
}

TEST(MetallicRoundTrip, ReturnsEverythingInFloat) {
    for (const DiffuseCoupling coupling : {none, fresnel})
        for (const auto store : {exactly, in_float}) {
            const RoundTrip trip = round_trip(store, no_step, coupling, 0);
            EXPECT_LT(trip.worst_diffuse, 1e-4);
            EXPECT_LT(trip.worst_f0, 1e-4);
            EXPECT_LT(trip.metallic_error / trip.weight, 1e-3);
            EXPECT_GT(trip.weight, 7000);
        }
}

TEST(MetallicRoundTrip, ReturnsDiffuseAndF0WithinACodeInEightAndSixteenBits) {
    for (const DiffuseCoupling coupling : {none, fresnel}) {
        const RoundTrip eight = round_trip(in_8_bits, half_step8, coupling, 0, linear_to_srgb);
        EXPECT_LT(eight.worst_diffuse, 1. / 255);
        EXPECT_LT(eight.worst_f0, 1. / 255);
        EXPECT_LT(eight.metallic_error / eight.weight, .01);
        const RoundTrip sixteen = round_trip(in_16_bits, step_16, coupling, 0);
        EXPECT_LT(sixteen.worst_diffuse, 1e-4);
        EXPECT_LT(sixteen.worst_f0, 1e-4);
        EXPECT_LT(sixteen.metallic_error / sixteen.weight, 2e-3);
    }
}

TEST(MetallicRoundTrip, KeepsDiffuseAndF0WhateverMetallicIs) {
    // A library's tolerance changes metallic, not what is reflected.
    const RoundTrip trip = round_trip(in_float, no_step, fresnel, .02);
    EXPECT_LT(trip.worst_diffuse, 1e-4);
    EXPECT_LT(trip.worst_f0, 1e-4);
}

TEST(MetallicRoundTrip, WithoutResidualIsContinuousAndExactWhereTheModelIs) {
    for (const DiffuseCoupling coupling : {none, fresnel})
        for (int i = 0; i < 500; ++i) {
            const MetallicMaterial<double> truth{
                Colour(random_unit(1, i), random_unit(2, i), random_unit(3, i)), random_unit(4, i),
                Colour(.04)};
            const auto r = reflected_from_metallic(truth, coupling);
            const auto found = material_without_residual(r, truth.metallic, .04, 0., coupling);
            EXPECT_LT(distance(found.base_color, truth.base_color), 1e-9);
        }
    // Quartz to gems: a grey dielectric is told from base colour alone where there is no metal.
    const auto gem = material_without_residual<double>({Colour(.2), Colour(.1)}, 0, .04, .16, none);
    EXPECT_NEAR(gem.dielectric_f0.x, .1, 1e-3);
    EXPECT_NEAR(gem.base_color.x, .2, 1e-12);
}

// --- which metallic is possible
// ----------------------------------------------------------------------------------

/// Whether a material of this metallic reflects that, found by bisection for what the dielectric leaves of
/// diffuse light: the more that is, the less base colour takes of f0, and the less the dielectric may leave.
bool has_material(const Reflected<double>& reflected, double metallic) {
    constexpr double kClose = 1e-13;
    const double rest = 1 - metallic;
    const auto base = [&](int c, double left) { return reflected.diffuse[c] / (rest * left); };
    const auto dielectric = [&](int c, double left) {
        return (reflected.f0[c] - base(c, left) * metallic) / rest;
    };
    const auto brightest = [&](double left) {
        return std::max({dielectric(0, left), dielectric(1, left), dielectric(2, left)});
    };
    double low = 0, high = 1;
    if (1 - brightest(high) > high) return false;
    for (int i = 0; i < 100; ++i) {
        const double middle = (low + high) / 2;
        (1 - brightest(middle) > middle ? low : high) = middle;
    }
    for (int c = 0; c < 3; ++c)
        if (base(c, high) > 1 + kClose || dielectric(c, high) < -kClose || dielectric(c, high) > 1 + kClose)
            return false;
    return true;
}

/// What surfaces reflect, with black channels, greys and near greys among them; all of it within all light.
template <class Visit>
void for_each_reflected(std::uint64_t seed, int count, Visit visit) {
    for (int i = 0; i < count; ++i) {
        const auto random = [&](int channel) { return random_unit(seed + channel, i); };
        const double diffuse_scale = random(0) * random(1) * (i % 3 == 0 ? .01 : 1), f0_scale = random(2);
        Reflected<double> reflected{diffuse_scale * Colour(random(3), random(4), random(5)),
                                    f0_scale * Colour(random(6), random(7), random(8))};
        if (i % 4 == 0) reflected.f0 = Colour(f0_scale) - .01 * reflected.f0;
        if (i % 5 == 0) reflected.diffuse[i % 3] = 0;
        if (i % 7 == 0) reflected.diffuse = Colour(diffuse_scale) - .01 * reflected.diffuse;
        reflected.f0 = glm::max(reflected.f0, Colour(0));
        reflected.diffuse = glm::max(reflected.diffuse, Colour(0));
        if (max_channel(reflected.diffuse) + max_channel(reflected.f0) <= 1) visit(reflected, random(9));
    }
}

TEST(LargestMetallic, IsWhereASearchForMaterialsEnds) {
    int compared = 0;
    for_each_reflected(20, 5000, [&](const Reflected<double>& reflected, double) {
        if (max_channel(reflected.diffuse) == 0) return;
        const double largest = largest_metallic(reflected, 0.);
        for (int step = 1; step < 20; ++step) {
            const double metallic = step / 20.;
            if (std::abs(metallic - largest) < 1e-7) continue;
            ASSERT_EQ(has_material(reflected, metallic), metallic < largest) << largest << " " << metallic;
            ++compared;
        }
        for (const double close : {-1e-6, 1e-6}) {
            if (largest + close <= 0 || largest + close >= 1) continue;
            ASSERT_EQ(has_material(reflected, largest + close), close < 0) << largest;
        }
    });
    EXPECT_GT(compared, 40000);
}

TEST(LargestMetallic, IsNoLessThanThatOfTheMaterialBehind) {
    for (int i = 0; i < 20000; ++i) {
        const auto random = [&](int channel) { return random_unit(40 + channel, i); };
        const MetallicMaterial<double> truth{Colour(random(0), random(1), random(2)), random(3),
                                             random(4) * Colour(random(5), random(6), random(7))};
        EXPECT_GE(largest_metallic(reflected_from_metallic(truth, fresnel), 0.), truth.metallic - 1e-9);
        // Its own limit: base colour takes all of the f0 of its brightest ratio of diffuse to f0, or is
        // white.
        MetallicMaterial<double> edge = truth;
        edge.dielectric_f0[i % 3] = 0;
        edge.base_color = glm::max(edge.base_color, Colour(.05));
        const auto reflected = reflected_from_metallic(edge, fresnel);
        const Colour ratio = reflected.diffuse / reflected.f0;
        if (ratio[i % 3] < max_channel(ratio)) continue;
        EXPECT_NEAR(largest_metallic(reflected, 0.), edge.metallic, 1e-9);
    }
    for (const double s : {.1, .5, .9})
        EXPECT_NEAR(largest_metallic<double>({Colour(.1), Colour(s)}, 0.), s / (s + .1), 1e-15);
    EXPECT_EQ(largest_metallic<double>({Colour(0), Colour(.5)}, 0.), 1);
    EXPECT_EQ(largest_metallic<double>({Colour(.1), Colour(0, .5, .5)}, 0.), 0);
}

TEST(LargestMetallic, LeavesDiffuseWithinTheErrorAllowed) {
    constexpr double kPassingOver = 4e-6;  // to the usual dielectric's f0, nearest to metallic 1
    for (const double tolerance : {0., 1e-6, 5e-4, 4e-3})
        for_each_reflected(60, 20000, [&](const Reflected<double>& reflected, double share) {
            const double largest = largest_metallic(reflected, tolerance);
            for (const double metallic : {largest, share * largest})
                for (const double half_step : {0., tolerance / 30, tolerance}) {
                    const auto back =
                        reflected_from_metallic(material_with_residual(reflected, metallic, .04,
                                                                       Colour(half_step), fresnel, tolerance),
                                                fresnel);
                    ASSERT_LE(distance(back.diffuse, reflected.diffuse), tolerance + kPassingOver)
                        << metallic;
                    ASSERT_LE(distance(back.f0, reflected.f0), kPassingOver) << metallic;
                }
        });
}

/// A tolerance of half a code's interval allows the mask that a set was made from.
TEST(LargestMetallic, DoesNotTouchWhatWasMadeFromAMaterial) {
    for_each_material([](const MetallicMaterial<double>& truth) {
        const auto original = reflected_from_metallic(truth, fresnel);
        Colour d = diffuse_colour(original, fresnel), s = original.f0;
        for (int c = 0; c < 3; ++c) d[c] = in_16_bits(d[c]), s[c] = in_16_bits(s[c]);
        const auto stored = reflected_from_specular(d, s, fresnel);
        const Colour half(std::max(1e-6, step_16(0) * (1 - max_channel(s))));
        const auto m = estimate_metallic<double>(stored, {.04, 0, .01}, {half, Colour(step_16(0))}, fresnel);
        EXPECT_GE(largest_metallic(stored, step_16(0)), m.metallic - 1e-4);
    });
}

TEST(MetallicMaterials, NearlyMetalHasTheUsualDielectric) {
    for (const float rest : {1e-7f, 2e-6f})
        for (const Vec3<float> f0 : {Vec3<float>(1.f, .766f, .336f), Vec3<float>(.56f, .57f, .58f)}) {
            const auto material = material_with_residual<float>({Vec3<float>(0), f0}, 1 - rest, .04f,
                                                                Vec3<float>(1e-6f), fresnel);
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(material.dielectric_f0[c], .04f, .05f) << rest;
        }
    // Black with the f0 of a metal beyond doubt is metal, and no more.
    for (const double f0 : {.25, .56, .9, 1.}) EXPECT_NEAR(estimate(0, f0).metallic, 1, 1e-15) << f0;
}

}  // namespace
}  // namespace pbr
