#include "pbr/brdf/fresnel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "pbr/numerics/sequence.hpp"
#include "tests/libpbr/support/float_error.hpp"
#include "tests/libpbr/support/property.hpp"

namespace pbr {
namespace {

/// Fresnel's equations in complex arithmetic, by Snell's law.
double F_complex(double cosine, std::complex<double> index) {
    const std::complex<double> refracted = std::sqrt(1.0 - (1 - cosine * cosine) / (index * index));
    const std::complex<double> p = (index * cosine - refracted) / (index * cosine + refracted),
                               s = (cosine - index * refracted) / (cosine + index * refracted);
    return (std::norm(p) + std::norm(s)) / 2;
}

/// Largest distance of Schlick from a truth over all angles.
template <class Truth>
double schlick_error(double f0, const Truth& truth) {
    double largest = 0;
    for (int i = 0; i <= 4000; ++i)
        largest = std::max(largest, std::abs(F_schlick(f0, 1.0, i / 4000.0) - truth(i / 4000.0)));
    return largest;
}

TEST(Fresnel, SchlickHasItsEndsExactly) {
    EXPECT_EQ(F_schlick(0.04, 1.0, 1.0), 0.04);
    EXPECT_EQ(F_schlick(0.04, 0.9, 0.0), 0.9);
    EXPECT_EQ(schlick_weight(1 + 1e-12), 0);
    EXPECT_EQ(schlick_weight(-1e-12), 1);
}

TEST(Fresnel, DielectricHasItsKnownAngles) {
    for (const double ior : {1.1, 1.33, 1.5, 2.4}) {
        EXPECT_NEAR(F_dielectric(1.0, ior), f0_from_ior(ior), 1e-15);
        EXPECT_EQ(F_dielectric(0.0, ior), 1);
        // At Brewster's angle, tan = ior, only s polarisation returns: ((ior^2 - 1)/(ior^2 + 1))^2 of it.
        const double r_s = (ior * ior - 1) / (ior * ior + 1);
        EXPECT_NEAR(F_dielectric(1 / std::hypot(1.0, ior), ior), r_s * r_s / 2, 1e-15);
        // Total reflection from within starts at sin = 1 / ior.
        const double critical = std::sqrt(1 - 1 / (ior * ior));
        EXPECT_EQ(F_dielectric(critical - 1e-9, 1 / ior), 1);
        EXPECT_LT(F_dielectric(critical + 1e-3, 1 / ior), .95);
    }
    EXPECT_EQ(F_dielectric(.3, 1.0), 0);
    EXPECT_NEAR(F_dielectric(.5, 1.5), .0892, 5e-5);  // 60 degrees on glass, as optics tables have it
}

TEST(Fresnel, BothWaysThroughADielectricReflectAlike) {
    for (int i = 1; i < 100; ++i) {
        const double cosine = i / 100.0, inside = std::sqrt(1 - (1 - cosine * cosine) / (1.5 * 1.5));
        EXPECT_NEAR(F_dielectric(cosine, 1.5), F_dielectric(inside, 1 / 1.5), 1e-13);
    }
}

TEST(Fresnel, ConductorAgreesWithComplexArithmeticAndDielectric) {
    for (int i = 0; i < 20'000; ++i) {
        const double cosine = random_unit(1, i), ior = .05 + 5 * random_unit(2, i), k = 8 * random_unit(3, i);
        ASSERT_NEAR(F_conductor(cosine, ior, k), F_complex(cosine, {ior, k}), 1e-13)
            << cosine << ' ' << ior << ' ' << k;
        const double g2 = (ior - 1) * (ior + 1) + cosine * cosine;  // 0 at the critical angle
        ASSERT_NEAR(F_conductor(cosine, ior, 0.0), F_dielectric(cosine, ior),
                    2e-14 / std::min(1.0, std::sqrt(std::abs(g2))))
            << cosine << ' ' << ior;
    }
    EXPECT_EQ(F_conductor(0.0, .2, 3.4), 1);
    EXPECT_NEAR(F_conductor(1.0, .183, 3.42), (.817 * .817 + 3.42 * 3.42) / (1.183 * 1.183 + 3.42 * 3.42),
                1e-15);
}

TEST(Fresnel, SchlickIsAsFarFromTheTruthAsStated) {
    const double stated[][2] = {{1.33, .060}, {1.5, .036}, {1.8, .035}, {2, .045}, {2.5, .083}, {3, .125}};
    for (const auto& [ior, error] : stated) {
        const double measured =
            schlick_error(f0_from_ior(ior), [ior = ior](double c) { return F_dielectric(c, ior); });
        EXPECT_LE(measured, error + 5e-4) << ior;
        EXPECT_GT(measured, error - 1.5e-3) << ior;
    }
    EXPECT_NEAR(schlick_error(.04, [](double c) { return F_dielectric(c, 1 / 1.5); }), .96, 2e-3);
    const auto metal = [](double ior, double k) {
        return schlick_error(F_conductor(1.0, ior, k), [&](double c) { return F_conductor(c, ior, k); });
    };
    EXPECT_NEAR(std::max({metal(.183, 3.42), metal(.42, 2.35), metal(1.37, 1.77)}), .022, 5e-4);  // gold
    EXPECT_NEAR(metal(1.35, 7.47), .117, 5e-4);                                                   // aluminium
    EXPECT_NEAR(metal(3.18, 3.30), .198, 1e-3);                                                   // chromium
}

TEST(Fresnel, ReflectanceAndIorAreF0sOwnWords) {
    EXPECT_DOUBLE_EQ(f0_from_reflectance(.5), .04);
    EXPECT_DOUBLE_EQ(f0_from_reflectance(1.0), .16);
    EXPECT_DOUBLE_EQ(f0_from_ior(1.5), .04);
    EXPECT_NEAR(f0_from_ior(2.42), .172, 5e-4);  // diamond
    EXPECT_EQ(ior_from_f0(0.0), 1);
    EXPECT_TRUE(std::isinf(ior_from_f0(1.0)));
}

RC_GTEST_PROP(Fresnel, ConversionsInvert, ()) {
    const double f0 = *uniform(0, .99);
    RC_ASSERT(std::abs(f0_from_ior(ior_from_f0(f0)) - f0) < 1e-14);
    RC_ASSERT(std::abs(f0_from_reflectance(reflectance_from_f0(f0)) - f0) < 1e-15);
}

RC_GTEST_PROP(Fresnel, ReflectsBetweenNothingAndAll, ()) {
    const double cosine = *unit_interval(), ior = *log_uniform(.2, 5), k = *uniform(0, 9);
    for (const double F :
         {F_dielectric(cosine, ior), F_conductor(cosine, ior, k), F_conductor(cosine, ior, 0.0)})
        RC_ASSERT(F >= 0 && F <= 1 + 1e-15);
}

TEST(Fresnel, MicroOcclusionEndsAtTwoPercent) {
    EXPECT_EQ(f90_from_f0(Vec3<double>(0)), 0);
    EXPECT_NEAR(f90_from_f0(Vec3<double>(.01)), .495, 1e-15);
    EXPECT_LT(f90_from_f0(Vec3<double>(.0201)), 1);
    EXPECT_EQ(f90_from_f0(Vec3<double>(.0203)), 1);
    EXPECT_EQ(f90_from_f0(Vec3<double>(.04)), 1);
}

TEST(Fresnel, FloatIsWithinTheUlpStated) {
    for (int i = 0; i < 100'000; ++i) {
        const float c = static_cast<float>(random_unit(4, i)),
                    ior = static_cast<float>(.3 + 4 * random_unit(5, i)),
                    k = static_cast<float>(8 * random_unit(6, i));
        const double dc = c, di = ior, dk = k;
        EXPECT_LT(ulp_error(schlick_weight(c), schlick_weight(dc)), 5);
        const double g2 = (di - 1) * (di + 1) + dc * dc;
        if (di >= 1 || std::abs(g2) > 1e-6) {
            EXPECT_LT(ulp_error_of(1, F_dielectric(c, ior), F_dielectric(dc, di)),
                      di >= 1 ? 8 : 8 + 4 / std::sqrt(std::abs(g2)))
                << c << ' ' << ior;
        }
        EXPECT_LT(ulp_error_of(1, F_conductor(c, ior, k), F_conductor(dc, di, dk)), 16)
            << c << ' ' << ior << ' ' << k;
        EXPECT_LT(ulp_error(f0_from_ior(ior), f0_from_ior(di)), 4);
        EXPECT_LT(ulp_error(ior_from_f0(c), ior_from_f0(dc)), 4 / (1 - std::sqrt(dc)));
        EXPECT_LT(ulp_error(f0_from_reflectance(c), f0_from_reflectance(dc)), 2);
        EXPECT_LT(ulp_error(reflectance_from_f0(c), reflectance_from_f0(dc)), 2);
    }
}

}  // namespace
}  // namespace pbr
