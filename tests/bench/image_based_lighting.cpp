// Run-time formulas of image-based lighting, harmonics and the reference integrals.

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <vector>

#include "pbr/brdf/ggx.hpp"
#include "pbr/ibl/dominant_direction.hpp"
#include "pbr/ibl/parallax.hpp"
#include "pbr/ibl/sh_rotation.hpp"
#include "pbr/ibl/spherical_harmonics.hpp"
#include "pbr/ibl/zonal_harmonics.hpp"
#include "pbr/ibl/zonal_kernel.hpp"
#include "pbr/numerics/sequence.hpp"
#include "pbr/reference/reflected_radiance.hpp"

namespace pbr {
namespace {

constexpr int kDirections = 1024;

template <class T>
std::vector<Vec3<T>> directions() {
    std::vector<Vec3<T>> result;
    for (int i = 0; i < kDirections; ++i) {
        const double z = 2 * random_unit(1, i) - 1, phi = 6.28 * random_unit(2, i), s = std::sqrt(1 - z * z);
        result.emplace_back(static_cast<T>(s * std::cos(phi)), static_cast<T>(s * std::sin(phi)),
                            static_cast<T>(z));
    }
    return result;
}

template <class T>
void ShEvaluateThreeBands(benchmark::State& state) {
    const auto d = directions<T>();
    for (auto _ : state)
        for (const Vec3<T>& direction : d) benchmark::DoNotOptimize(sh_evaluate3(direction));
    state.SetItemsProcessed(state.iterations() * kDirections);
}
BENCHMARK(ShEvaluateThreeBands<float>);
BENCHMARK(ShEvaluateThreeBands<double>);

template <class T>
void ShEvaluate(benchmark::State& state) {
    const int bands = static_cast<int>(state.range(0));
    const auto d = directions<T>();
    std::vector<T> out(sh_count(bands));
    for (auto _ : state)
        for (const Vec3<T>& direction : d) {
            sh_evaluate<T>(bands, direction, out);
            benchmark::DoNotOptimize(out.data());
            benchmark::ClobberMemory();
        }
    state.SetItemsProcessed(state.iterations() * kDirections);
}
BENCHMARK(ShEvaluate<float>)->Arg(3)->Arg(8);
BENCHMARK(ShEvaluate<double>)->Arg(8)->Arg(32);

void EvaluateIrradiance(benchmark::State& state) {
    const auto d = directions<float>();
    std::array<float, 9> c;
    c.fill(0.5f);
    for (auto _ : state)
        for (const Vec3<float>& n : d) benchmark::DoNotOptimize(evaluate_irradiance<float, float>(c, n));
    state.SetItemsProcessed(state.iterations() * kDirections);
}
BENCHMARK(EvaluateIrradiance);

void ShRotationBuild(benchmark::State& state) {
    const int bands = static_cast<int>(state.range(0));
    const glm::mat3 turn(0, 1, 0, 0, 0, 1, 1, 0, 0);
    for (auto _ : state) benchmark::DoNotOptimize(ShRotation<float>(bands, turn).at(bands - 1, 0, 0));
}
BENCHMARK(ShRotationBuild)->Arg(3)->Arg(8);

void ZonalGgx(benchmark::State& state) {
    const GgxZonalKernel kernel(0.1);
    for (auto _ : state) benchmark::DoNotOptimize(zonal_ggx(kernel, static_cast<int>(state.range(0))).data());
}
BENCHMARK(ZonalGgx)->Arg(5)->Arg(64);

void ParallaxBox(benchmark::State& state) {
    const auto d = directions<float>();
    const OrientedBox<float> box{{0, 0, 0}, glm::mat3(1), {3, 2, 4}};
    for (auto _ : state)
        for (const Vec3<float>& direction : d)
            benchmark::DoNotOptimize(
                parallax_corrected(box, box.centre, Vec3<float>(1, 0.5f, -2), direction));
    state.SetItemsProcessed(state.iterations() * kDirections);
}
BENCHMARK(ParallaxBox);

void ParallaxSphere(benchmark::State& state) {
    const auto d = directions<float>();
    const ProxySphere<float> sphere{{0, 0, 0}, 5};
    for (auto _ : state)
        for (const Vec3<float>& direction : d)
            benchmark::DoNotOptimize(
                parallax_corrected(sphere, sphere.centre, Vec3<float>(1, 0.5f, -2), direction));
    state.SetItemsProcessed(state.iterations() * kDirections);
}
BENCHMARK(ParallaxSphere);

void DominantFactorFrostbite(benchmark::State& state) {
    for (auto _ : state)
        for (int i = 0; i < kDirections; ++i)
            benchmark::DoNotOptimize(dominant_factor_frostbite(static_cast<float>(i) / kDirections));
    state.SetItemsProcessed(state.iterations() * kDirections);
}
BENCHMARK(DominantFactorFrostbite);

/// A GGX lobe under a smooth sky to 1e-6; the argument is -log10(alpha).
void ReferenceGgx(benchmark::State& state) {
    const double alpha = std::pow(10, -static_cast<double>(state.range(0)));
    const auto brdf = [&](const Vec3<double>& wo, const Vec3<double>& wi) {
        const Vec3<double> h = glm::normalize(wo + wi);
        return D_ggx(h.z, h.x * h.x + h.y * h.y, alpha) * V_smith_ggx_correlated(wi.z, wo.z, alpha);
    };
    const auto sky = [](const Vec3<double>& w) { return 1 + 0.5 * w.x; };
    std::int64_t evaluations = 0;
    for (auto _ : state)
        evaluations =
            reflected_radiance_half_vector(brdf, Vec3<double>(0.8, 0, 0.6), sky, alpha, {1e-6}).evaluations;
    state.counters["evaluations"] = static_cast<double>(evaluations);
}
BENCHMARK(ReferenceGgx)->Arg(0)->Arg(1)->Arg(3);

}  // namespace
}  // namespace pbr
