#pragma once
// The quadrature kernel of dfg_ggx_anisotropic_row.

#include <span>

#include "pbr/brdf/ggx_anisotropic.hpp"
#include "pbr/ibl/dfg_anisotropic.hpp"

namespace pbr {

/// E and Fc of many views at one azimuth and one pair of positive widths; see dfg_anisotropic_kernel.cpp.
void dfg_anisotropic_quadrature_row(std::span<const double> NoV, const TangentAzimuth& azimuth,
                                    const AnisotropicAlpha<double>& alpha, const DfgRule& rule,
                                    std::span<double> E, std::span<double> Fc);

}  // namespace pbr
