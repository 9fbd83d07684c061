#include "pbr/ibl/dfg.hpp"

#include <bit>
#include <cassert>
#include <cmath>

#include "pbr/brdf/fresnel.hpp"
#include "pbr/brdf/ggx_sampling.hpp"
#include "pbr/numerics/sequence.hpp"
#include "src/ibl/dfg_rules.hpp"
#include "src/simd/dfg_kernel.hpp"

namespace pbr {
namespace {

/// Found over alpha in [1e-8, 1] and every view, and held by tests/libpbr/ibl/dfg_test.cpp.
constexpr DfgRuleSize kRuleSizes[] = {
    {1e-2, {{{12, 18}, {8, 12}, {6, 12}, {6, 12}}}},    {1e-3, {{{14, 24}, {10, 16}, {8, 16}, {6, 12}}}},
    {1e-4, {{{18, 28}, {14, 20}, {10, 20}, {6, 20}}}},  {1e-5, {{{22, 30}, {16, 24}, {12, 20}, {8, 20}}}},
    {1e-6, {{{26, 38}, {20, 26}, {14, 26}, {10, 26}}}}, {1e-7, {{{30, 46}, {22, 32}, {16, 32}, {12, 38}}}},
    {1e-8, {{{32, 56}, {24, 50}, {18, 52}, {14, 56}}}}};

DirectionalAlbedo importance_sampled(double NoV, double alpha, const DfgMethod& method) {
    const std::uint64_t seed =
        random_bits(method.seed, std::bit_cast<std::uint64_t>(NoV), std::bit_cast<std::uint64_t>(alpha));
    const Vec3<double> wo(std::sqrt((1 - NoV) * (1 + NoV)), 0, NoV);
    const double root_v = smith_ggx_root(NoV, alpha);
    double E = 0, Fc = 0;
    for (int i = 0; i < method.samples; ++i) {
        const Sample2 u = r2_sequence(static_cast<std::uint64_t>(i), seed);
        const Vec3<double> wm = sample_ggx_vndf(wo, alpha, u.u1, u.u2);
        const double VoH = glm::dot(wo, wm);
        const double NoL = 2 * VoH * wm.z - NoV;
        if (NoL <= 0 || VoH <= 0) continue;
        // D V NoL over the density G1 D / (4 NoV) of reflected directions: G2/G1.
        const double root_l = smith_ggx_root(NoL, alpha);
        const double weight = method.visibility == DfgVisibility::correlated
                                  ? NoL * (NoV + root_v) / (NoL * root_v + NoV * root_l)
                                  : 2 * NoL / (NoL + root_l);
        E += weight;
        Fc += weight * schlick_weight(VoH);
    }
    return {E / method.samples, Fc / method.samples};
}

}  // namespace

const DfgRule::Band& DfgRule::band_of(double NoV) const {
    std::size_t band = bands.size() - 1;
    while (band > 0 && NoV < bands[band].lowest_NoV) --band;
    return bands[band];
}

DfgRule dfg_rule(double max_error) {
    assert(max_error > 0);
    return dfg_rule_of(kRuleSizes, max_error);
}

void dfg_ggx_row(std::span<const double> NoV, double alpha, const DfgMethod& method, std::span<double> E,
                 std::span<double> Fc) {
    if (alpha > 0 && method.estimator == DfgEstimator::quadrature)
        return dfg_quadrature_row(NoV, alpha, method, E, Fc);
    for (std::size_t i = 0; i < NoV.size(); ++i) {
        const DirectionalAlbedo albedo = alpha > 0 ? importance_sampled(NoV[i], alpha, method)
                                                   : DirectionalAlbedo{1, schlick_weight(NoV[i])};
        E[i] = albedo.E;
        Fc[i] = albedo.Fc;
    }
}

DirectionalAlbedo dfg_ggx(double NoV, double alpha, const DfgMethod& method) {
    DirectionalAlbedo albedo{};
    dfg_ggx_row({&NoV, 1}, alpha, method, {&albedo.E, 1}, {&albedo.Fc, 1});
    return albedo;
}

}  // namespace pbr
