#pragma once
// The quadrature kernel of dfg_ggx_row.

#include <span>

#include "pbr/ibl/dfg.hpp"

namespace pbr {

/// E and Fc of many views at one alpha > 0; see simd/dfg_kernel.cpp.
void dfg_quadrature_row(std::span<const double> NoV, double alpha, const DfgMethod& method,
                        std::span<double> E, std::span<double> Fc);

}  // namespace pbr
