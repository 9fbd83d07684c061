#include "pbr/ibl/dfg.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "pbr/brdf/fresnel.hpp"
#include "pbr/brdf/ggx_sampling.hpp"
#include "pbr/numerics/sequence.hpp"
#include "src/simd/dfg_kernel.hpp"

namespace pbr {
namespace {

/// Node counts and the largest error they leave, found by tests/libpbr/ibl/dfg_test.cpp over the whole
/// domain.
struct RuleSize {
    double max_error;
    int azimuth;
    int radial;
};
constexpr RuleSize kRuleSizes[] = {{1e-2, 14, 18}, {1e-3, 16, 22}, {1e-4, 24, 26}, {1e-5, 28, 30},
                                   {1e-6, 32, 36}, {1e-7, 40, 46}, {1e-8, 48, 60}};

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

DfgRule dfg_rule(double max_error) {
    assert(max_error > 0);
    const RuleSize* size = std::begin(kRuleSizes);
    while (size + 1 != std::end(kRuleSizes) && size->max_error > max_error) ++size;
    return {gauss_legendre(size->azimuth), gauss_legendre(size->radial), size->max_error};
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
