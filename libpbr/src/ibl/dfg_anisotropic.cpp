#include "pbr/ibl/dfg_anisotropic.hpp"

#include <cassert>

#include "src/ibl/dfg_rules.hpp"
#include "src/simd/dfg_anisotropic_kernel.hpp"

namespace pbr {
namespace {

/// The azimuth's nodes are those of a half panel; for widths that differ by up to ten times, held by
/// tests/libpbr/ibl/dfg_anisotropic_test.cpp.
constexpr DfgRuleSize kRuleSizes[] = {{1e-3, {{{10, 24}, {6, 16}, {6, 16}, {5, 12}}}},
                                      {1e-4, {{{12, 28}, {12, 20}, {12, 20}, {10, 20}}}},
                                      {1e-5, {{{20, 34}, {24, 24}, {24, 20}, {24, 20}}}},
                                      {1e-6, {{{36, 40}, {36, 28}, {44, 24}, {36, 24}}}},
                                      {1e-7, {{{60, 50}, {60, 40}, {72, 36}, {60, 40}}}}};

}  // namespace

DfgRule dfg_anisotropic_rule(double max_error) {
    assert(max_error > 0);
    return dfg_rule_of(kRuleSizes, max_error);
}

void dfg_ggx_anisotropic_row(std::span<const double> NoV, const TangentAzimuth& azimuth,
                             const AnisotropicAlpha<double>& alpha, const DfgRule& rule, std::span<double> E,
                             std::span<double> Fc) {
    assert(alpha.x > 0 && alpha.y > 0);
    dfg_anisotropic_quadrature_row(NoV, azimuth, alpha, rule, E, Fc);
}

DirectionalAlbedo dfg_ggx_anisotropic(double NoV, const TangentAzimuth& azimuth,
                                      const AnisotropicAlpha<double>& alpha, const DfgRule& rule) {
    DirectionalAlbedo albedo{};
    dfg_ggx_anisotropic_row({&NoV, 1}, azimuth, alpha, rule, {&albedo.E, 1}, {&albedo.Fc, 1});
    return albedo;
}

}  // namespace pbr
