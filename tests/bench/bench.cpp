// Hot loops of libpbr, CPU time of one thread.

#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "pbr/brdf/disney_diffuse.hpp"
#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/dfg.hpp"
#include "pbr/ibl/environment.hpp"
#include "pbr/ibl/ld.hpp"
#include "pbr/ibl/ld_mis.hpp"
#include "pbr/numerics/sequence.hpp"

namespace {

std::vector<float> noise(std::size_t values) {
    std::vector<float> picture(values);
    for (std::size_t i = 0; i < values; ++i) picture[i] = static_cast<float>(pbr::random_unit(1, i));
    return picture;
}

/// A 128 x 128 ggx table at an accuracy of 10^-range(0).
void DfgTable128(benchmark::State& state) {
    const auto method = pbr::DfgMethod::quadrature(std::pow(10.0, -static_cast<double>(state.range(0))));
    std::vector<double> NoV(128), E(128), Fc(128);
    for (int x = 0; x < 128; ++x) NoV[x] = (x + 0.5) / 128;
    for (auto _ : state)
        for (int y = 0; y < 128; ++y) {
            pbr::dfg_ggx_row(NoV, std::pow((y + 0.5) / 128, 2), method, E, Fc);
            benchmark::DoNotOptimize(E.data());
        }
    int evaluations = 0;
    for (const double view : NoV) evaluations += method.evaluations(view);
    state.counters["evaluations/texel"] = evaluations / 128.0;
}
BENCHMARK(DfgTable128)->DenseRange(2, 8)->Unit(benchmark::kMillisecond);

/// A table of range(0) x range(0) texels at 1e-6: its cost is linear in texels.
void DfgTableOfSize(benchmark::State& state) {
    const auto method = pbr::DfgMethod::quadrature(1e-6);
    const auto side = static_cast<std::size_t>(state.range(0));
    std::vector<double> NoV(side), E(side), Fc(side);
    for (std::size_t x = 0; x < side; ++x)
        NoV[x] = (static_cast<double>(x) + 0.5) / static_cast<double>(side);
    for (auto _ : state)
        for (const double perceptual_roughness : NoV) {
            pbr::dfg_ggx_row(NoV, perceptual_roughness * perceptual_roughness, method, E, Fc);
            benchmark::DoNotOptimize(E.data());
        }
    state.SetItemsProcessed(state.iterations() * state.range(0) * state.range(0));
}
BENCHMARK(DfgTableOfSize)->RangeMultiplier(2)->Range(32, 512)->Unit(benchmark::kMillisecond);

/// DfgTable128 by Monte Carlo with range(0) samples a texel.
void DfgTable128MonteCarlo(benchmark::State& state) {
    const auto method = pbr::DfgMethod::importance_sampling(static_cast<int>(state.range(0)), 0);
    for (auto _ : state)
        for (int i = 0; i < 128 * 128; ++i)
            benchmark::DoNotOptimize(
                pbr::dfg_ggx((i % 128 + 0.5) / 128, std::pow((i / 128 + 0.5) / 128, 2), method));
}
BENCHMARK(DfgTable128MonteCarlo)->Arg(64)->Arg(1024)->Unit(benchmark::kMillisecond);

void DisneyAlbedo(benchmark::State& state) {
    double NoV = 0;
    for (auto _ : state) {
        NoV = NoV < 0.99 ? NoV + 0.01 : 0;
        benchmark::DoNotOptimize(pbr::albedo_disney_diffuse(NoV, 0.5));
    }
}
BENCHMARK(DisneyAlbedo);

/// Level 1 of a 256-texel probe with six levels, filtered importance sampling, range(0) samples.
void LdSampledLevel(benchmark::State& state) {
    const std::vector<float> cube = noise(std::size_t{256} * 256 * 18);
    const pbr::CubePyramid pyramid(cube, 256);
    const pbr::LdSamples samples = pbr::make_ld_samples(pbr::LdEstimator::filtered_importance_sampling, 0.04,
                                                        static_cast<int>(state.range(0)), 256, 1);
    std::vector<float> row(128 * 3);
    std::vector<pbr::CubeTexel> texels(128);
    int at = 0;
    for (auto _ : state) {
        for (int x = 0; x < 128; ++x) texels[x] = {at / 128 % 6, x, at % 128};
        pbr::ld_sampled(pyramid, samples, 0, 128, texels, row);
        benchmark::DoNotOptimize(row.data());
        ++at;
    }
    state.counters["time/sample"] = benchmark::Counter(
        static_cast<double>(state.iterations()) * 128 * static_cast<double>(state.range(0)),
        benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(LdSampledLevel)->Arg(32)->Arg(1024);

/// The same level by multiple importance sampling of a 512 x 256 picture, and the making of its samples.
void LdMisLevel(benchmark::State& state) {
    const std::vector<float> picture = noise(std::size_t{512} * 256 * 3);
    const pbr::EnvironmentSampler sampler(pbr::EquirectView{picture.data(), 512, 256});
    const pbr::LdMis mis(sampler, 0.04, static_cast<int>(state.range(0)), 0);
    std::vector<float> row(128 * 3);
    std::vector<pbr::CubeTexel> texels(128);
    int at = 0;
    for (auto _ : state) {
        for (int x = 0; x < 128; ++x) texels[x] = {at / 128 % 6, x, at % 128};
        mis.integrate(128, texels, row);
        benchmark::DoNotOptimize(row.data());
        ++at;
    }
    state.counters["time/sample"] = benchmark::Counter(
        static_cast<double>(state.iterations()) * 128 * static_cast<double>(state.range(0)),
        benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(LdMisLevel)->Arg(32)->Arg(1024);

void LdMisSamples(benchmark::State& state) {
    const std::vector<float> picture = noise(std::size_t{512} * 256 * 3);
    const pbr::EnvironmentSampler sampler(pbr::EquirectView{picture.data(), 512, 256});
    for (auto _ : state) pbr::LdMis(sampler, 0.04, static_cast<int>(state.range(0)), 0);
}
BENCHMARK(LdMisSamples)->Arg(32)->Arg(1024)->Unit(benchmark::kMillisecond);

/// The exact sum over a 512 x 256 picture for a row of 128 directions; range(0) thousandths of alpha.
void LdExactRow(benchmark::State& state) {
    const std::vector<float> picture = noise(std::size_t{512} * 256 * 3);
    const pbr::PatchBlocks blocks(pbr::EquirectView{picture.data(), 512, 256});
    std::vector<glm::dvec3> directions;
    for (int x = 0; x < 128; ++x) directions.push_back(pbr::cubemap_texel_direction({0, x, 64}, 128));
    std::vector<double> rgb(128 * 3);
    std::uint64_t evaluations = 0;
    for (auto _ : state)
        pbr::ld_exact(blocks, static_cast<double>(state.range(0)) / 1000, directions, rgb, evaluations);
    state.counters["time/evaluation"] = benchmark::Counter(
        static_cast<double>(evaluations), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(LdExactRow)->Arg(10)->Arg(40)->Arg(360)->Arg(1000)->Unit(benchmark::kMillisecond);

/// A face of range(0) texels a side, the mean of a 1024 x 512 picture over each texel.
void ResampleAreaFace(benchmark::State& state) {
    const std::vector<float> picture = noise(std::size_t{1024} * 512 * 3);
    const pbr::EquirectView view{picture.data(), 1024, 512};
    const int size = static_cast<int>(state.range(0));
    std::vector<float> row(static_cast<std::size_t>(size) * 3);
    for (auto _ : state)
        for (int y = 0; y < size; ++y) pbr::resample_area(view, size, 4, y, row);
}
BENCHMARK(ResampleAreaFace)->Arg(64)->Arg(256)->Unit(benchmark::kMillisecond);

}  // namespace
