// Kernels give the same bits at every vector width that the machine has, the scalar one included.

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <cmath>
#include <vector>

#include "pbr/ibl/bright_texels.hpp"
#include "pbr/ibl/dfg.hpp"
#include "pbr/ibl/harmonic_filter.hpp"
#include "pbr/ibl/ld.hpp"
#include "pbr/ibl/ld_harmonic.hpp"
#include "pbr/ibl/ld_mis.hpp"
#include "pbr/ibl/near_field.hpp"
#include "pbr/legacy/energy.hpp"
#include "pbr/legacy/texel_planes.hpp"
#include "pbr/numerics/sequence.hpp"

namespace pbr {
namespace {

/// Restricts dispatch to one target while it lives.
class OneTarget {
  public:
    explicit OneTarget(std::int64_t target) { force(target); }
    ~OneTarget() { force(0); }

  private:
    static void force(std::int64_t target) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    }
};

struct Results {
    std::vector<double> dfg, exact, near, bright, spectrum;
    std::vector<float> sampled, mis, harmonic, means, bilinear, planes;
    bool operator==(const Results&) const = default;
};

/// Metallic, confidence, materials of both kinds, what neighbours say, and the f0 of lobes, of noise, a plane
/// each;
/// and the largest metallic.
std::vector<float> texel_planes() {
    constexpr std::size_t kTexels = 301, kPlanes = 9;
    std::vector<float> noise(kPlanes * kTexels), planes(18 * kTexels);
    for (std::size_t i = 0; i < noise.size(); ++i)
        noise[i] = static_cast<float>(random_unit(2, i)) * (i < 6 * kTexels ? 1.f : .003f);
    const auto colours = [&](std::size_t first) {
        return ColourPlanes{&noise[first * kTexels], &noise[(first + 1) * kTexels],
                            &noise[(first + 2) * kTexels]};
    };
    const ReflectedPlanes reflected{colours(0), colours(3)};
    const auto to = [&](std::size_t plane) { return &planes[plane * kTexels]; };
    constexpr auto kCoupling = DiffuseCoupling::fresnel;
    estimate_metallic(reflected, {.04f, .02f, .01f}, {colours(6), colours(6)}, kCoupling, kTexels, to(0),
                      to(1));
    material_with_residual(reflected, to(0), .04f, colours(6), kCoupling, .0035f, kTexels,
                           {{to(2), to(3), to(4)}, {to(5), to(6), to(7)}});
    material_without_residual(reflected, to(0), .04f, .16f, kCoupling, kTexels,
                              {{to(8), to(9), to(10)}, {to(11), to(12), to(13)}});
    const std::vector<std::ptrdiff_t> apart{1, 2, 3, 4};
    metallic_of_alike(reflected, to(0), to(1), apart, kTexels - 4, to(14));
    std::vector<std::uint8_t> clamped(kTexels);
    f0_from_mean_albedo(colours(0)[0], colours(1)[0], Scattering::multiple, kTexels, to(15), clamped.data());
    std::ranges::copy(clamped, to(16));
    largest_metallic(reflected, .0035f, kTexels, to(17));
    return planes;
}

Results run_kernels() {
    Results results;
    std::vector<double> NoV, E(21), Fc(21);
    for (int i = 0; i < 21; ++i) NoV.push_back(i / 20.0);
    for (const double alpha : {1e-4, 0.1, 1.0}) {
        dfg_ggx_row(NoV, alpha, DfgMethod::quadrature(1e-4), E, Fc);
        results.dfg.insert(results.dfg.end(), E.begin(), E.end());
        results.dfg.insert(results.dfg.end(), Fc.begin(), Fc.end());
    }
    std::vector<float> cube(std::size_t{16} * 16 * 18);
    for (std::size_t i = 0; i < cube.size(); ++i)
        cube[i] = static_cast<float>(std::pow(random_unit(1, i), 6));
    std::vector<CubeTexel> texels;
    std::vector<glm::dvec3> directions;
    for (int i = 0; i < 50; ++i) {
        texels.push_back({i % 6, i % 8, i / 8});
        directions.push_back(cubemap_texel_direction(texels.back(), 8));
    }
    const CubePyramid pyramid(cube, 16);
    for (const int count : {1, 37, 300}) {  // not multiples of any width
        std::vector<float> rgb(150);
        ld_sampled(pyramid, make_ld_samples(LdEstimator::filtered_importance_sampling, 0.2, count, 16, 1), 3,
                   8, texels, rgb);
        results.sampled.insert(results.sampled.end(), rgb.begin(), rgb.end());
    }
    const EnvironmentSampler of_cube(CubeView{cube.data(), 16}),
        of_equirect(EquirectView{cube.data(), 48, 32});
    for (const EnvironmentSampler* sampler : {&of_cube, &of_equirect})
        for (const int count : {1, 37, 600}) {
            std::vector<float> rgb(150);
            LdMis(*sampler, 0.2, count, 3).integrate(8, texels, rgb);
            results.mis.insert(results.mis.end(), rgb.begin(), rgb.end());
        }
    results.exact.resize(150);
    std::uint64_t evaluations = 0;
    ld_exact(PatchBlocks(CubeView{cube.data(), 16}), 0.2, directions, results.exact, evaluations);
    results.harmonic.resize(150);
    LdHarmonic(CubeView{cube.data(), 16}, 0.05, 1e-3, for_each_in_turn)
        .level(0.05, for_each_in_turn)
        .integrate(directions, results.harmonic);
    // The same numbers as an equirect, with an odd height and a texel apart.
    const EquirectView equirect{cube.data(), 48, 31};
    const std::vector<CubeTexel> apart{{0, 30, 20}};
    results.means.resize(std::size_t{9} * 9 * 18);
    resample_area(EquirectView{cube.data(), 64, 23}, 9, for_each_in_turn, results.means);
    results.bilinear.resize(std::size_t{40} * 40 * 18);
    resample_bilinear(equirect, 40, for_each_in_turn, results.bilinear);
    results.near.resize(150);
    results.bright.resize(150);
    NearField(equirect, {apart, {0.1f, 0.1f, 0.1f}}, SplitKernel(GgxZonalKernel(0.02), 0.2))
        .add(directions, results.near);
    BrightTexels(PatchBlocks(equirect, apart), {0.1f, 0.1f, 0.1f}, 1e-3, false)
        .integrate(0.1, directions, results.bright);
    const HarmonicSpectrum spectrum(equirect, {6, 1}, for_each_in_turn, {apart});
    for (int m = 0; m <= 6; ++m)
        results.spectrum.insert(results.spectrum.end(), spectrum.of_order(m).begin(),
                                spectrum.of_order(m).end());
    results.planes = texel_planes();
    return results;
}

TEST(Simd, EveryVectorWidthGivesTheSameBits) {
    const Results widest = run_kernels();
    int compared = 0;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        const OneTarget only(target);
        const Results results = run_kernels();
        EXPECT_EQ(results.dfg, widest.dfg) << hwy::TargetName(target);
        EXPECT_EQ(results.sampled, widest.sampled) << hwy::TargetName(target);
        EXPECT_EQ(results.mis, widest.mis) << hwy::TargetName(target);
        EXPECT_EQ(results.exact, widest.exact) << hwy::TargetName(target);
        EXPECT_EQ(results.harmonic, widest.harmonic) << hwy::TargetName(target);
        EXPECT_EQ(results.means, widest.means) << hwy::TargetName(target);
        EXPECT_EQ(results.bilinear, widest.bilinear) << hwy::TargetName(target);
        EXPECT_EQ(results.near, widest.near) << hwy::TargetName(target);
        EXPECT_EQ(results.bright, widest.bright) << hwy::TargetName(target);
        EXPECT_EQ(results.spectrum, widest.spectrum) << hwy::TargetName(target);
        EXPECT_EQ(results.planes, widest.planes) << hwy::TargetName(target);
        ++compared;
    }
    EXPECT_GE(compared, 2);  // else no second width was there to compare
}

}  // namespace
}  // namespace pbr
