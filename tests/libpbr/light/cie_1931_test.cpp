#include "pbr/light/cie_1931.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "pbr/light/colour.hpp"
#include "pbr/light/colour_temperature.hpp"

namespace pbr {
namespace {

TEST(Cie1931, HasThePublishedSums) {
    // The columns' check sums, from the metadata of the CIE's data set (doi 10.25039/CIE.DS.xvudnb9b).
    const glm::dvec3 sum = tristimulus([](double) { return 1.0; });
    EXPECT_NEAR(sum.x, 106.865469489595, 1e-12);
    EXPECT_NEAR(sum.y, 106.8569171011719, 1e-12);
    EXPECT_NEAR(sum.z, 106.892251278636, 1e-12);
    // So that equal energy is a third each, but for the table's own 5e-5.
    EXPECT_NEAR(chromaticity_of(sum).x, 1.0 / 3, 5e-5);
    EXPECT_NEAR(chromaticity_of(sum).y, 1.0 / 3, 5e-5);
}

TEST(Cie1931, HasThePublishedValues) {
    const auto at = [](int wavelength_nm) { return cie_1931_observer()[wavelength_nm - kCieFirst_nm]; };
    EXPECT_EQ(at(555).y, 1);
    EXPECT_EQ(at(450), glm::dvec3(.3362, .038, 1.77211));
    EXPECT_EQ(at(500), glm::dvec3(.0049, .323, .272));
    EXPECT_EQ(at(600), glm::dvec3(1.0622, .631, .0008));
    EXPECT_EQ(at(780), glm::dvec3(.00004150994, .00001499, 0));
    for (int l = kCieFirst_nm; l <= kCieLast_nm; ++l) EXPECT_LE(at(l).y, 1) << l;
}

TEST(Cie1931, IsSmooth) {
    // A wrong digit would stand out of its neighbours. The table was once interpolated from every fifth
    // nanometre: its largest third difference is the kink of z at 425 nm.
    const auto table = cie_1931_observer();
    for (int i = 3; i < kCieSamples; ++i) {
        const glm::dvec3 third = table[i] - 3.0 * table[i - 1] + 3.0 * table[i - 2] - table[i - 3];
        EXPECT_LT(std::abs(third.x), 1.5e-3) << kCieFirst_nm + i;
        EXPECT_LT(std::abs(third.y), 5e-4) << kCieFirst_nm + i;
        EXPECT_LT(std::abs(third.z), 2.5e-3) << kCieFirst_nm + i;
    }
}

TEST(Cie1931, AbridgedTableWouldMoveBlackBodies) {
    for (const auto& [kelvin, error] : {std::pair{2856.0, 6.3e-6}, std::pair{40'000.0, 9.6e-5}}) {
        glm::dvec3 sum(0);
        for (int l = 380; l <= 780; l += 5)
            sum += planck_radiance(l * 1e-9, kelvin) * cie_1931_observer()[l - kCieFirst_nm];
        const Chromaticity every_fifth = chromaticity_of(sum), all = planckian_chromaticity(kelvin);
        EXPECT_NEAR(std::max(std::abs(every_fifth.x - all.x), std::abs(every_fifth.y - all.y)), error,
                    .05 * error);
    }
}

}  // namespace
}  // namespace pbr
