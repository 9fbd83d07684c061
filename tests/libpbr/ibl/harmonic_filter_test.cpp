#include "pbr/ibl/harmonic_filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "libpbr/src/simd/legendre_kernel.hpp"
#include "pbr/ibl/patches.hpp"
#include "pbr/ibl/spherical_harmonics.hpp"
#include "pbr/ibl/zonal_harmonics.hpp"
#include "pbr/ibl/zonal_kernel.hpp"
#include "pbr/numerics/quadrature.hpp"
#include "pbr/numerics/sequence.hpp"
#include "tests/libpbr/ibl/pictures.hpp"

namespace pbr {
namespace {

/// The sum over orders and channels of squared coefficients of a degree, by the real harmonics of
/// ibl/spherical_harmonics.hpp summed over points of the picture: what no rotation or choice of basis
/// changes.
std::vector<double> power_by_points(const PatchBlocks& blocks, int bands) {
    std::vector<double> sums(static_cast<std::size_t>(bands) * bands * 3),
        basis(static_cast<std::size_t>(bands) * bands);
    for (int block = 0; block < blocks.count(); ++block) {
        PatchPoints points;
        blocks.points(block, 4, points);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Vec3<double> d(points.x[i], points.y[i], points.z[i]);
            sh_evaluate<double>(bands, glm::normalize(d), basis);
            for (std::size_t k = 0; k < basis.size(); ++k) {
                const double weight = basis[k] * static_cast<double>(points.weight[i]);
                sums[k * 3] += weight * static_cast<double>(points.r[i]);
                sums[k * 3 + 1] += weight * static_cast<double>(points.g[i]);
                sums[k * 3 + 2] += weight * static_cast<double>(points.b[i]);
            }
        }
    }
    std::vector<double> power;
    for (int l = 0; l < bands; ++l) {
        power.push_back(0);
        for (int k = l * l; k < (l + 1) * (l + 1); ++k)
            for (int c = 0; c < 3; ++c) power.back() += sums[k * 3 + c] * sums[k * 3 + c];
    }
    return power;
}

TEST(HarmonicSpectrum, HasThePowerThatRealHarmonicsFindAtPoints) {
    for (const auto& [width, height] : {std::pair{64, 32}, {37, 19}, {40, 21}}) {
        const std::vector<float> picture = noise_picture(width, height);
        const EquirectView view{picture.data(), width, height};
        const HarmonicSpectrum spectrum(view, {15, 6}, for_each_in_turn);
        const std::vector<double> expected = power_by_points(PatchBlocks(view), 16);
        for (int l = 0; l <= 15; ++l)
            EXPECT_NEAR(spectrum.powers()[static_cast<std::size_t>(l)] / expected[l], 1, 1e-6)
                << width << " " << l;
    }
}

TEST(HarmonicSpectrum, OfACubeHasTheSamePowerToo) {
    const std::vector<float> cube = noise_cube(16);
    const CubeView view{cube.data(), 16};
    const HarmonicSpectrum spectrum(view, {40, 3, 84, 168}, for_each_in_turn);
    const std::vector<double> expected = power_by_points(PatchBlocks(view), 16);
    for (int l = 0; l <= 15; ++l)
        EXPECT_NEAR(spectrum.powers()[static_cast<std::size_t>(l)] / expected[l], 1, 1e-4) << l;
}

TEST(HarmonicSpectrum, OfOneTexelIsThatOfAPointWhereverItLies) {
    // |E_lm|^2 summed over m is flux^2 (2l + 1) / 4 pi for a point; a texel of height h lowers it by about (l
    // h)^2 / 12, and the coarser grid that so fine a picture is spread over adds its own error.
    for (const int y : {0, 1, 40, 127, 128, 255}) {
        std::vector<float> picture(std::size_t{512} * 256 * 3);
        picture[(static_cast<std::size_t>(y) * 512 + 77) * 3] = 1e6f;
        const HarmonicSpectrum spectrum(EquirectView{picture.data(), 512, 256}, {30, 2, 62, 128},
                                        for_each_in_turn);
        const double flux = 1e6 * equirect_texel_solid_angle(512, 256, y);
        for (int l = 0; l <= 30; ++l) {
            const double lost = std::pow(l * std::numbers::pi / 256, 2) + 2 * std::pow(l / 60.0, 6);
            EXPECT_NEAR(spectrum.powers()[static_cast<std::size_t>(l)] /
                            (flux * flux * (2 * l + 1) / (4 * std::numbers::pi)),
                        1, lost + 5e-7)
                << y << " " << l;
        }
    }
}

TEST(HarmonicSpectrum, TakesTexelsLeftOutForTheConstant) {
    const std::vector<CubeTexel> texels{{0, 3, 2}, {0, 30, 2}, {0, 7, 13}};
    const std::vector<float> picture = noise_picture(32, 16);
    const PicturePart part{texels, {0.2f, 0.4f, 0.6f}}, whole{{}, part.constant};
    std::vector<float> without = picture;
    for (const CubeTexel& texel : texels)
        std::ranges::copy(part.constant, &without[(static_cast<std::size_t>(texel.y) * 32 + texel.x) * 3]);
    const HarmonicSpectrum a(EquirectView{picture.data(), 32, 16}, {8, 1}, for_each_in_turn, part);
    const HarmonicSpectrum b(EquirectView{without.data(), 32, 16}, {8, 1}, for_each_in_turn, whole);
    for (int m = 0; m <= 8; ++m)
        for (std::size_t i = 0; i < a.of_order(m).size(); ++i) EXPECT_EQ(a.of_order(m)[i], b.of_order(m)[i]);
}

TEST(HarmonicSpectrum, OfACubeTakesTexelsLeftOutForTheConstant) {
    const std::vector<CubeTexel> texels{{0, 3, 2}, {0, 6, 2}, {5, 7, 7}};
    const std::vector<float> cube = noise_cube(8);
    const PicturePart part{texels, {0.2f, 0.4f, 0.6f}}, whole{{}, part.constant};
    std::vector<float> without = cube;
    for (const CubeTexel& texel : texels)
        std::ranges::copy(part.constant, &without[((texel.face * 8 + texel.y) * 8 + texel.x) * 3]);
    const HarmonicRule rule{8, 2, 32, 64};
    const HarmonicSpectrum a(CubeView{cube.data(), 8}, rule, for_each_in_turn, part);
    const HarmonicSpectrum b(CubeView{without.data(), 8}, rule, for_each_in_turn, whole);
    for (int m = 0; m <= 8; ++m)
        for (std::size_t i = 0; i < a.of_order(m).size(); ++i) EXPECT_EQ(a.of_order(m)[i], b.of_order(m)[i]);
}

TEST(HarmonicSpectrum, OfWhatAPartLacksIsTheRest) {
    for (const int height : {16, 17}) {  // without and with a middle row
        const std::vector<float> picture = noise_picture(32, height);
        const std::vector<CubeTexel> texels{{0, 3, 0}, {0, 0, 2}, {0, 30, 2}, {0, 31, 8}, {0, 7, height - 3}};
        const PicturePart part{texels, {0.2f, 0.4f, 0.6f}}, whole{{}, part.constant};
        const HarmonicRule rule{12, 2};
        const EquirectView view{picture.data(), 32, height};
        const HarmonicSpectrum without(view, rule, for_each_in_turn, part),
            all(view, rule, for_each_in_turn, whole), lacking(view, part, rule, for_each_in_turn);
        for (int m = 0; m <= rule.bands; ++m)
            for (std::size_t i = 0; i < all.of_order(m).size(); ++i)
                EXPECT_NEAR(without.of_order(m)[i] + lacking.of_order(m)[i], all.of_order(m)[i], 1e-14)
                    << height << " " << m;
    }
}

/// The field with coefficients kernel[l] E_lm, by the standard library's harmonics.
glm::dvec3 field_of(const HarmonicSpectrum& spectrum, const std::vector<double>& kernel,
                    const glm::dvec3& direction) {
    const glm::dvec2 at = equirect_point(spectrum.world_to_source() * direction);
    glm::dvec3 sum(0);
    for (unsigned l = 0; l < kernel.size(); ++l)
        for (unsigned m = 0; m <= l; ++m) {
            // std::sph_legendre has the Condon-Shortley phase, the spectrum doesn't.
            const double p =
                std::sph_legendre(l, m, std::numbers::pi * at.y) * (m % 2 == 0 ? 1 : -1) * (m == 0 ? 1 : 2);
            const double azimuth = 2 * std::numbers::pi * m * at.x;
            const auto c = spectrum.coefficient(static_cast<int>(l), static_cast<int>(m));
            for (int k = 0; k < 3; ++k)
                sum[k] += kernel[l] * p * (c[2 * k] * std::cos(azimuth) - c[2 * k + 1] * std::sin(azimuth));
        }
    return sum;
}

TEST(HarmonicGrid, IsTheSumOfHarmonics) {
    const std::vector<float> picture = noise_picture(48, 25);
    const double t = 0.7;
    const glm::dmat3 turn(std::cos(t), 0, -std::sin(t), 0, 1, 0, std::sin(t), 0, std::cos(t));
    const HarmonicSpectrum spectrum(EquirectView{picture.data(), 48, 25, turn}, {30, 2}, for_each_in_turn);
    const std::vector<double> kernel = zonal_ggx(GgxZonalKernel(0.15), 31);
    const std::vector<HarmonicGrid::Term> term{{&spectrum, kernel}};
    // Root mean square; single values may err by some times that.
    const HarmonicGrid grid(term, {2e-6, 2e-6}, for_each_in_turn);
    std::vector<glm::dvec3> directions{{0, 1, 0}, {0, -1, 0}, {0, 0, -1}, {1e-9, 0, -1}, {1e-6, -1, 1e-6}};
    for (int i = 0; i < 300; ++i) directions.push_back(random_direction(3, i));
    for (const glm::dvec3& d : directions) {
        std::array<float, 3> found;
        grid.sample(std::array{glm::normalize(d)}, found);
        const glm::dvec3 expected = field_of(spectrum, kernel, glm::normalize(d));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c] / expected[c], 1, 3e-5);
    }
}

TEST(HarmonicGrid, ErrsByWhatItMayAndNotByMuchLess) {
    const std::vector<float> picture = noise_picture(64, 32);
    const HarmonicSpectrum spectrum(EquirectView{picture.data(), 64, 32}, {40, 4}, for_each_in_turn);
    for (const double alpha : {0.06, 0.2})
        for (const double max_error : {1e-3, 1e-4, 1e-5}) {
            const std::vector<double> kernel = zonal_ggx(GgxZonalKernel(alpha), 41);
            const std::vector<HarmonicGrid::Term> term{{&spectrum, kernel}};
            const HarmonicGrid grid(term, {max_error, max_error}, for_each_in_turn);
            double squares = 0;
            constexpr int kCount = 400;
            for (int i = 0; i < kCount; ++i) {
                const glm::dvec3 d = random_direction(4, i), expected = field_of(spectrum, kernel, d);
                std::array<float, 3> found;
                grid.sample(std::array{d}, found);
                for (int c = 0; c < 3; ++c) squares += std::pow(found[c] - expected[c], 2);
            }
            const double error = std::sqrt(squares / (3 * kCount));
            EXPECT_LT(error, max_error) << alpha;
            // As fine as its degrees need by themselves it errs less.
            if (alpha < 0.1) {
                EXPECT_GT(error, max_error / 30) << alpha;
            }
        }
}

TEST(HarmonicGrid, AddsUpItsTerms) {
    const std::vector<float> a = noise_picture(32, 16, 1), b = noise_picture(32, 16, 2);
    const HarmonicSpectrum of_a(EquirectView{a.data(), 32, 16}, {20, 2}, for_each_in_turn,
                                {{}, {0.5f, 0.4f, 0.6f}}),
        of_b(EquirectView{b.data(), 32, 16}, {20, 2}, for_each_in_turn);
    const std::vector<double> wide = zonal_ggx(GgxZonalKernel(0.5), 11),
                              narrow = zonal_ggx(GgxZonalKernel(0.1), 21);
    const std::vector<HarmonicGrid::Term> terms{{&of_a, wide}, {&of_b, narrow}};
    const HarmonicGrid grid(terms, {1e-6, 1e-6}, for_each_in_turn);
    for (int i = 0; i < 50; ++i) {
        const glm::dvec3 d = random_direction(4, i);
        const glm::dvec3 expected = field_of(of_a, wide, d) + field_of(of_b, narrow, d);
        std::array<float, 3> found;
        grid.sample(std::array{d}, found);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1e-5);
    }
}

TEST(LegendreSums, RoundTripOnGaussRingsAtHighOrders) {
    // Coefficients -> rings of a Gauss rule -> coefficients is the identity. sin^m underflows here from m =
    // 700 on.
    constexpr int kBands = 1800;
    const QuadratureRule rule = gauss_legendre(kBands + 2);
    std::vector<double> colatitudes, weights;
    for (int i = 0; i < rule.size() / 2; ++i) {
        colatitudes.push_back(2 * std::asin(std::sqrt(rule.nodes[i])));
        // dmu = 2 dnode with nodes (1 - mu) / 2; analysis takes sums of both hemispheres, twice what
        // synthesis gives.
        weights.push_back(8 * std::numbers::pi * rule.weights[i]);
    }
    const Rings rings(colatitudes);
    for (const int order : {0, 1, 2, 17, 700, 900, 1500, 1799, 1800}) {
        const LegendreOrder legendre(order, kBands);
        const std::size_t values = static_cast<std::size_t>(kParts) * rings.padded();
        std::vector<double> given(static_cast<std::size_t>(legendre.degrees()) * kParts), found(given.size());
        for (std::size_t i = 0; i < given.size(); ++i) given[i] = random_unit(9, order, i) - 0.5;
        std::vector<double> even(values), odd(values);
        const int first = rings.first(order, kBands);
        legendre_synthesise(rings, legendre, first, given.data(), even.data(), odd.data());
        for (std::size_t part = 0; part < static_cast<std::size_t>(kParts); ++part)
            for (int i = 0; i < rings.padded(); ++i) {
                const double weight = static_cast<std::size_t>(i) < weights.size() ? weights[i] : 0;
                even[part * rings.padded() + i] *= weight;
                odd[part * rings.padded() + i] *= weight;
            }
        legendre_analyse(rings, legendre, first, even.data(), odd.data(), found.data());
        double largest = 0;
        for (std::size_t i = 0; i < given.size(); ++i)
            largest = std::max(largest, std::abs(found[i] - given[i]));
        EXPECT_LT(largest, 1e-11) << order;
    }
}

TEST(PointsARow, GrowAsLobesNarrow) {
    const auto points_a_row = [](int height, double alpha, double max_error) {
        return harmonic_rule(height, 10, alpha, max_error).points_a_row;
    };
    EXPECT_EQ(points_a_row(1024, 0.04, 1e-3), 1);
    EXPECT_GE(points_a_row(256, 0.04, 1e-3), 2);
    for (double alpha = 1; alpha > 1e-4; alpha /= 2)
        EXPECT_LE(points_a_row(512, alpha, 1e-3), points_a_row(512, alpha / 2, 1e-3));
}

}  // namespace
}  // namespace pbr
