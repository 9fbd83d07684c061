// What photometric profiles cost: parsing, and one direction's intensity.

#include <benchmark/benchmark.h>

#include <string>

#include "bakers/parse/grid.hpp"

namespace {

using namespace pbrbake;

/// A type C file of 73 x 17 angles, as common as any.
std::string lamp() {
    std::string text = "IESNA:LM-63-2002\n[TEST] 1\nTILT=NONE\n1 -1 1 73 17 1 2 0 0 0 1 1 10\n";
    for (int v = 0; v < 73; ++v) text += std::to_string(2.5 * v) + " ";
    for (int h = 0; h < 17; ++h) text += std::to_string(22.5 * h) + " ";
    for (int i = 0; i < 73 * 17; ++i) text += std::to_string(i % 97) + (i % 10 == 9 ? "\n" : " ");
    return text;
}

parse::PhotometricFile parsed(const std::string& text) {
    return parse::parse_photometry({reinterpret_cast<const std::byte*>(text.data()), text.size()},
                                   "lamp.ies");
}

void BM_ParseLm63(benchmark::State& state) {
    const std::string text = lamp();
    for (auto _ : state) benchmark::DoNotOptimize(parsed(text));
}
BENCHMARK(BM_ParseLm63);

void BM_PhotometricWebEvaluate(benchmark::State& state) {
    std::vector<parse::Diagnostic> unused;
    const pbr::PhotometricWeb web = parse::make_web(parsed(lamp()), 0, unused);
    double x = -.9;
    for (auto _ : state) {
        x = x > .9 ? -.9 : x + .0123;
        benchmark::DoNotOptimize(web.evaluate_cd({x, .4 - x, -.5}));
    }
}
BENCHMARK(BM_PhotometricWebEvaluate);

void BM_PhotometricWebFlux(benchmark::State& state) {
    std::vector<parse::Diagnostic> unused;
    const pbr::PhotometricWeb web = parse::make_web(parsed(lamp()), 0, unused);
    for (auto _ : state) benchmark::DoNotOptimize(web.flux_lm());
}
BENCHMARK(BM_PhotometricWebFlux);

}  // namespace
