// The stages of a probe of 256 x 256 x 6 from an equirect whose width is the argument, by the harmonic
// solver.

#include <benchmark/benchmark.h>

#include <vector>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/environment.hpp"
#include "pbr/ibl/ld_harmonic.hpp"
#include "pbr/numerics/sequence.hpp"

namespace pbr {
namespace {

constexpr int kSize = 256;
constexpr double kAlpha = 0.04, kMaxError = 1e-3;  // of level 1 of six, and of accuracy "production"

/// Noise below 1, and `lamps` texels of 3000.
std::vector<float> picture(int width, int lamps = 0) {
    std::vector<float> rgb(static_cast<std::size_t>(width) * width / 2 * 3);
    for (std::size_t i = 0; i < rgb.size(); ++i) rgb[i] = static_cast<float>(random_unit(1, i));
    for (int i = 0; i < lamps; ++i)
        rgb[static_cast<std::size_t>(random_unit(2, i) * static_cast<double>(rgb.size()))] = 3000;
    return rgb;
}

EquirectView view(const std::vector<float>& rgb, int width) { return {rgb.data(), width, width / 2}; }

std::vector<glm::dvec3> directions(int size) {
    std::vector<glm::dvec3> result;
    for (int i = 0; i < 6 * size * size; ++i)
        result.push_back(cubemap_texel_direction({i / (size * size), i % size, i / size % size}, size));
    return result;
}

void ProbeLevel0(benchmark::State& state) {
    const int width = static_cast<int>(state.range(0));
    const std::vector<float> rgb = picture(width);
    std::vector<float> cube(std::size_t{kSize} * kSize * 18);
    for (auto _ : state) {
        resample_area(view(rgb, width), kSize, for_each_in_turn, cube);
        benchmark::ClobberMemory();
    }
}
BENCHMARK(ProbeLevel0)->Arg(2048)->Arg(8192)->Unit(benchmark::kMillisecond);

void ProbeLevel0Bilinear(benchmark::State& state) {
    const int width = static_cast<int>(state.range(0));
    const std::vector<float> rgb = picture(width);
    std::vector<float> cube(std::size_t{kSize} * kSize * 18);
    for (auto _ : state) {
        resample_bilinear(view(rgb, width), kSize, for_each_in_turn, cube);
        benchmark::ClobberMemory();
    }
}
BENCHMARK(ProbeLevel0Bilinear)->Arg(512)->Unit(benchmark::kMillisecond);

void ProbeAnalysis(benchmark::State& state) {
    const int width = static_cast<int>(state.range(0));
    const std::vector<float> rgb = picture(width);
    for (auto _ : state)
        benchmark::DoNotOptimize(LdHarmonic(view(rgb, width), kAlpha, kMaxError, for_each_in_turn).bands());
}
BENCHMARK(ProbeAnalysis)->Arg(512)->Arg(2048)->Unit(benchmark::kMillisecond);

void ProbeSynthesis(benchmark::State& state) {
    const std::vector<float> rgb = picture(2048);
    const LdHarmonic harmonic(view(rgb, 2048), kAlpha, kMaxError, for_each_in_turn);
    for (auto _ : state) benchmark::DoNotOptimize(harmonic.level(kAlpha, for_each_in_turn).bands());
}
BENCHMARK(ProbeSynthesis)->Unit(benchmark::kMillisecond);

/// Level 1, 128 x 128; the argument counts lamps.
void ProbeSampling(benchmark::State& state) {
    const std::vector<float> rgb = picture(2048, static_cast<int>(state.range(0)));
    const LdHarmonic harmonic(view(rgb, 2048), kAlpha, kMaxError, for_each_in_turn);
    const LdHarmonic::Level level = harmonic.level(kAlpha, for_each_in_turn);
    const std::vector<glm::dvec3> of_texels = directions(kSize / 2);
    std::vector<float> out(of_texels.size() * 3);
    for (auto _ : state) level.integrate(of_texels, out);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(of_texels.size()));
    state.counters["apart"] = harmonic.bright_texels();
}
BENCHMARK(ProbeSampling)->Arg(0)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace pbr
