// What a material costs: an evaluation of f in float, bare and with one effect; and the functions behind.
// Inputs are many random pairs of directions, so that nothing is predicted or folded.

#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "pbr/brdf/material.hpp"
#include "pbr/brdf/material_effects.hpp"
#include "pbr/brdf/subsurface.hpp"
#include "pbr/ibl/dfg.hpp"
#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/sequence.hpp"

namespace {

using pbr::Material, pbr::Reflection, pbr::Vec3;

constexpr std::size_t kPairs = 1024;
constexpr pbr::StandardMaterial<float> kPaint{{.7f, .3f, .2f}, .5f, 0, .5f};

Vec3<float> direction(std::uint64_t stream, std::uint64_t i) {
    const double z = .01 + .99 * pbr::random_unit(stream, i), s = std::sqrt(1 - z * z);
    const pbr::SinCos phi = pbr::sin_cos_pi(2 * pbr::random_unit(stream + 1, i));
    return Vec3<float>(s * phi.cos, s * phi.sin, z);
}

const std::vector<Reflection<float>>& reflections() {
    static const std::vector<Reflection<float>> all = [] {
        std::vector<Reflection<float>> r;
        for (std::uint64_t i = 0; i < kPairs; ++i)
            r.push_back(pbr::reflection(direction(1, i), direction(3, i)));
        return r;
    }();
    return all;
}

/// A bilinear look-up of E on 32 x 32 texels, as a renderer on the CPU would have it.
struct TableE {
    static constexpr int kSize = 32;
    std::vector<float> E;
    TableE() {
        const auto method = pbr::DfgMethod::quadrature(1e-4);
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x)
                E.push_back(static_cast<float>(
                    pbr::dfg_ggx(x / (kSize - 1.0), std::pow(std::max(y, 1) / (kSize - 1.0), 2), method).E));
    }
    float at(float NoV, float alpha) const {
        const float x = NoV * (kSize - 1), y = std::sqrt(alpha) * (kSize - 1);
        const int i = std::min(static_cast<int>(x), kSize - 2), j = std::min(static_cast<int>(y), kSize - 2);
        const float u = x - static_cast<float>(i), v = y - static_cast<float>(j);
        const float* row = E.data() + j * kSize + i;
        return (row[0] * (1 - u) + row[1] * u) * (1 - v) + (row[kSize] * (1 - u) + row[kSize + 1] * u) * v;
    }
};

struct LookUpE {
    const TableE* table;
    float operator()(float cosine, float alpha) const { return table->at(cosine, alpha); }
};

LookUpE look_up() {
    static const TableE table;
    return {&table};
}

/// Nanoseconds an evaluation of f(reflection) -> value.
template <class F>
void each_reflection(benchmark::State& state, const F& f) {
    const auto& all = reflections();
    std::size_t i = 0;
    for (auto _ : state) {
        auto value = f(all[i++ % kPairs]);
        benchmark::DoNotOptimize(value);
    }
}

template <class M>
void evaluate(benchmark::State& state, const M& material) {
    each_reflection(state, [&](const Reflection<float>& r) { return material.f(r.wo, r.wi); });
}

/// The lobes by hand, without Material: what Material<float> must cost.
void BareLobes(benchmark::State& state) {
    const pbr::Surface<float> s = pbr::surface_from_material(kPaint);
    each_reflection(state, [&](const Reflection<float>& in) {
        if (in.wo.z <= 0 || in.wi.z <= 0) return Vec3<float>(0);
        const Reflection<float> r = pbr::reflection(in.wo, in.wi);
        return pbr::f_standard_diffuse(s, r) +
               pbr::F_schlick(s.f0, Vec3<float>(s.f90), r.LoH) * pbr::DV_standard_specular(s, r);
    });
}
BENCHMARK(BareLobes);

void MaterialStandard(benchmark::State& state) { evaluate(state, Material<float>(kPaint)); }
BENCHMARK(MaterialStandard);

void MaterialClearCoat(benchmark::State& state) {
    evaluate(state, Material(kPaint, pbr::ClearCoat<float>{1, .01f}));
}
BENCHMARK(MaterialClearCoat);

void MaterialCloth(benchmark::State& state) {
    evaluate(state, Material(kPaint, pbr::Cloth<float, LookUpE>{Vec3<float>(.5f), .3f, look_up()}));
}
BENCHMARK(MaterialCloth);

void MaterialAnisotropy(benchmark::State& state) {
    evaluate(state, Material(kPaint, pbr::Anisotropy<float>{.6f}));
}
BENCHMARK(MaterialAnisotropy);

void MaterialEnergyCompensation(benchmark::State& state) {
    evaluate(state, Material(kPaint, pbr::EnergyCompensation<float, LookUpE>{look_up()}));
}
BENCHMARK(MaterialEnergyCompensation);

void MaterialMultipleScattering(benchmark::State& state) {
    const auto E_avg = static_cast<float>(pbr::average_albedo_ggx(.25));
    evaluate(state, Material(kPaint, pbr::MultipleScattering<float, LookUpE>{look_up(), E_avg}));
}
BENCHMARK(MaterialMultipleScattering);

void MaterialEon(benchmark::State& state) { evaluate(state, Material(kPaint, pbr::EonDiffuse<float>{.5f})); }
BENCHMARK(MaterialEon);

void MaterialAllEffects(benchmark::State& state) {
    const auto E_avg = static_cast<float>(pbr::average_albedo_ggx(.25));
    evaluate(state, Material(kPaint, pbr::EonDiffuse<float>{.5f}, pbr::Anisotropy<float>{.6f},
                             pbr::MultipleScattering<float, LookUpE>{look_up(), E_avg},
                             pbr::Cloth<float, LookUpE>{Vec3<float>(.5f), .3f, look_up()},
                             pbr::ClearCoat<float>{1, .01f}));
}
BENCHMARK(MaterialAllEffects);

void DiffuseLambert(benchmark::State& state) {
    each_reflection(state, [](const Reflection<float>& r) { return r.NoL * pbr::f_lambert<float>(); });
}
BENCHMARK(DiffuseLambert);

void DiffuseDisney(benchmark::State& state) {
    each_reflection(
        state, [](const Reflection<float>& r) { return pbr::f_disney_diffuse(r.NoL, r.NoV, r.LoH, .5f); });
}
BENCHMARK(DiffuseDisney);

void DiffuseEon(benchmark::State& state) {
    each_reflection(state,
                    [](const Reflection<float>& r) { return pbr::f_eon(.5f, .5f, r.NoL, r.NoV, r.LoV); });
}
BENCHMARK(DiffuseEon);

void DiffuseEonApproximate(benchmark::State& state) {
    each_reflection(state, [](const Reflection<float>& r) {
        return pbr::f_eon_approximate(.5f, .5f, r.NoL, r.NoV, r.LoV);
    });
}
BENCHMARK(DiffuseEonApproximate);

void DiffuseChan(benchmark::State& state) {
    each_reflection(state,
                    [](const Reflection<float>& r) { return pbr::f_chan(r.NoL, r.NoV, r.NoH, r.LoH, .25f); });
}
BENCHMARK(DiffuseChan);

void DiffuseHammon(benchmark::State& state) {
    each_reflection(state, [](const Reflection<float>& r) {
        return pbr::f_hammon(.5f, r.NoL, r.NoV, r.NoH, r.LoV, .25f);
    });
}
BENCHMARK(DiffuseHammon);

void FresnelSchlick(benchmark::State& state) {
    each_reflection(state, [](const Reflection<float>& r) { return pbr::F_schlick(.04f, 1.f, r.LoH); });
}
BENCHMARK(FresnelSchlick);

void FresnelDielectric(benchmark::State& state) {
    each_reflection(state, [](const Reflection<float>& r) { return pbr::F_dielectric(r.LoH, 1.5f); });
}
BENCHMARK(FresnelDielectric);

void FresnelConductor(benchmark::State& state) {
    each_reflection(state, [](const Reflection<float>& r) { return pbr::F_conductor(r.LoH, .2f, 3.4f); });
}
BENCHMARK(FresnelConductor);

void BurleyRadius(benchmark::State& state) {
    each_reflection(state, [](const Reflection<float>& r) { return pbr::sample_burley_radius(r.NoV, 1.f); });
}
BENCHMARK(BurleyRadius);

void PreintegratedDiffusionTexel(benchmark::State& state) {
    each_reflection(state,
                    [](const Reflection<float>& r) { return pbr::preintegrated_diffusion(r.LoV, r.NoV); });
}
BENCHMARK(PreintegratedDiffusionTexel)->Unit(benchmark::kMicrosecond);

void CharlieAlbedoTexel(benchmark::State& state) {
    each_reflection(state, [](const Reflection<float>& r) {
        return pbr::albedo_charlie(r.NoV, .3, pbr::CharlieVisibility::charlie);
    });
}
BENCHMARK(CharlieAlbedoTexel)->Unit(benchmark::kMicrosecond);

}  // namespace
