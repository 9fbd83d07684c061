// What the split sum loses, by the reference integrals, and what a dominant direction gives back.
//
// The environment is a clamped cosine sky, max(0, w.e), turned every way: the rms over all rotations follows
// exactly from the lobe's and the split sum's harmonics, since turning mixes the harmonics of a band evenly.
// Errors are relative to the rms of the exact radiance. So "none" below is the usual look-up along the mirror
// direction.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "pbr/ibl/dominant_direction.hpp"
#include "pbr/ibl/spherical_harmonics.hpp"
#include "pbr/ibl/split_sum.hpp"
#include "pbr/ibl/zonal_harmonics.hpp"
#include "pbr/ibl/zonal_kernel.hpp"
#include "pbr/reference/reflected_radiance.hpp"
#include "tests/libpbr/reference/lobes.hpp"

namespace pbr {
namespace {

constexpr int kBands = 5;  // the sky's later bands hold 1e-4 of its power

/// A white GGX lobe seen from NoV, in harmonics.
struct LobeInHarmonics {
    double alpha, NoV;
    std::vector<double> lobe;   ///< integrals of brdf NoL Y
    std::vector<double> zonal;  ///< k_l of LD

    LobeInHarmonics(double alpha_of, double NoV_of)
        : alpha(alpha_of),
          NoV(NoV_of),
          lobe(sh_count(kBands)),
          zonal(zonal_ggx(GgxZonalKernel(alpha_of), kBands)) {
        const Vec3<double> wo(std::sqrt(1 - NoV * NoV), 0, NoV);
        for (int i = 0; i < sh_count(kBands); ++i) {
            const auto Y = [i](const Vec3<double>& w) {
                double basis[sh_count(kBands)];
                sh_evaluate<double>(kBands, w, basis);
                return basis[i];
            };
            lobe[i] = reflected_radiance_half_vector(Ggx{alpha}, wo, Y, alpha, {1e-5, 1e-6}).value;
        }
    }

    Vec3<double> direction(double factor) const {
        return dominant_direction(Vec3<double>(0, 0, 1), Vec3<double>(-std::sqrt(1 - NoV * NoV), 0, NoV),
                                  factor);
    }
    Vec3<double> mean() const { return glm::normalize(Vec3<double>(lobe[3], lobe[1], lobe[2])); }

    /// rms error of E LD(direction) over all rotations of the sky.
    double error(const Vec3<double>& d) const {
        std::vector<double> basis(sh_count(kBands));
        sh_evaluate<double>(kBands, d, basis);
        const double E = lobe[0] * std::sqrt(4 * kPi);
        double wrong = 0, exact = 0;
        for (int l = 0; l < kBands; ++l) {
            // Power a coefficient: the zonal sky has all of band l's power, k_l² (2l+1) / 4pi, in one of 2l+1
            // coefficients.
            const double power = zonal_cosine(l) * zonal_cosine(l) / (4 * kPi);
            for (int m = -l; m <= l; ++m) {
                const int i = sh_index(l, m);
                wrong +=
                    power * std::pow(split_sum_specular(zonal[l] * basis[i], 1.0, 1.0, E, 0.0) - lobe[i], 2);
                exact += power * lobe[i] * lobe[i];
            }
        }
        return std::sqrt(wrong / exact);
    }
};

TEST(SplitSumError, IsThatOfTheIntegralForOneSky) {
    // The route over harmonics against the integral itself, and the split sum against both.
    const double alpha = 0.5;
    const LobeInHarmonics lobe(alpha, 0.3);
    const Vec3<double> e = glm::normalize(Vec3<double>(-1, 0.5, 0.4)), wo(std::sqrt(1 - 0.09), 0, 0.3);
    const auto sky = [&](const Vec3<double>& w) { return 1 + glm::dot(w, e) + std::pow(glm::dot(w, e), 2); };
    double basis[sh_count(kBands)];
    sh_evaluate<double>(kBands, e, basis);
    // 1 + mu + mu² = 4/3 P_0 + P_1 + 2/3 P_2, and P_l = 4pi/(2l+1) sum of Y Y.
    const double zonal[kBands] = {4.0 / 3, 1, 2.0 / 3, 0, 0};
    double by_harmonics = 0;
    for (int l = 0; l < kBands; ++l)
        for (int m = -l; m <= l; ++m)
            by_harmonics +=
                zonal[l] * 4 * kPi / (2 * l + 1) * basis[sh_index(l, m)] * lobe.lobe[sh_index(l, m)];
    EXPECT_NEAR(by_harmonics, reflected_radiance_half_vector(Ggx{alpha}, wo, sky, alpha).value, 1e-4);
}

struct Row {
    double alpha, NoV;
    double mirror, frostbite, peak, filament, mean;  ///< rms errors
};

/// Measured; the classes of error that dominant_direction.hpp states are read off here.
constexpr Row kRows[] = {
    {0.1, 0.1, .221, .169, .221, .212, .051}, {0.1, 0.5, .048, .016, .048, .040, .016},
    {0.1, 0.9, .011, .019, .011, .010, .010}, {0.25, 0.3, .298, .163, .298, .249, .062},
    {0.5, 0.1, .661, .317, .614, .469, .124}, {0.5, 0.3, .521, .205, .452, .337, .089},
    {0.5, 0.9, .144, .063, .115, .080, .063}, {1.0, 0.3, .726, .091, .091, .091, .091},
};

TEST(SplitSumError, HasTheStatedSizeAndDominantDirectionsGiveBackTheirShare) {
    for (const Row& row : kRows) {
        const LobeInHarmonics lobe(row.alpha, row.NoV);
        const auto error = [&](double factor) { return lobe.error(lobe.direction(factor)); };
        const double tolerance = 1.5e-3;
        EXPECT_NEAR(error(1), row.mirror, tolerance) << row.alpha << " " << row.NoV;
        EXPECT_NEAR(error(dominant_factor_frostbite(row.alpha)), row.frostbite, tolerance)
            << row.alpha << " " << row.NoV;
        EXPECT_NEAR(error(dominant_factor_peak_correlated(row.NoV, row.alpha)), row.peak, tolerance)
            << row.alpha << " " << row.NoV;
        EXPECT_NEAR(error(dominant_factor_filament(row.alpha)), row.filament, tolerance)
            << row.alpha << " " << row.NoV;
        EXPECT_NEAR(lobe.error(lobe.mean()), row.mean, tolerance) << row.alpha << " " << row.NoV;
    }
}

TEST(SplitSumError, FrostbitesDirectionHarmsSmoothSurfacesSeenFromAbove) {
    const Row& above = kRows[2];
    const LobeInHarmonics lobe(above.alpha, above.NoV);
    EXPECT_GT(lobe.error(lobe.direction(dominant_factor_frostbite(above.alpha))),
              1.5 * lobe.error(lobe.direction(1)));
}

}  // namespace
}  // namespace pbr
