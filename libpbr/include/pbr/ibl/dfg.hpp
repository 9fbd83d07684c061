#pragma once
// The DFG term of the split sum: directional albedo of the GGX lobe, and its Fresnel-weighted part.
//
//     E(NoV, alpha)  = integral of D V NoL over the hemisphere            (height-correlated Smith)
//     Fc(NoV, alpha) = the same with the integrand times (1 - VoH)^5
//
// so that the lobe of a material with Schlick's Fresnel has the albedo f0 (E - Fc) + f90 Fc: scale E - Fc, bias Fc
// (Karis 2013, "Real shading in Unreal Engine 4"; Lagarde & de Rousiers 2014, 4.9.2). 0 <= Fc <= E <= 1.
// Limits: alpha = 0 is the mirror, E = 1 and Fc = (1 - NoV)^5; NoV = 0 at alpha > 0 gives E = 1; the two limits do not
// commute (along NoV = alpha -> 0, E tends to .89).

#include <cstdint>
#include <span>

#include "pbr/numerics/quadrature.hpp"

namespace pbr {

struct DirectionalAlbedo {
    double E;
    double Fc;
};

/// How E and Fc are had.
enum class DfgEstimator {
    quadrature,           ///< deterministic, error as DfgRule states
    importance_sampling,  ///< Monte Carlo over visible normals
};

/// Nodes of the product quadrature: over the azimuth of the half vector, and radially up to the horizon.
struct DfgRule {
    QuadratureRule azimuth;
    QuadratureRule radial;
    double max_error;  ///< largest error of E and Fc over NoV in [0, 1] and alpha in [1e-8, 1]

    /// Evaluations of the integrand a table entry costs.
    int evaluations() const { return azimuth.size() * radial.size(); }
};

/// The cheapest rule whose error is at most `max_error`; below 1e-8 the one of 1e-8. max_error > 0.
DfgRule dfg_rule(double max_error);

/// E and Fc by quadrature. NoV in [0, 1], alpha in [0, 1]. Error rule.max_error.
DirectionalAlbedo dfg_ggx(double NoV, double alpha, const DfgRule& rule);

/// E and Fc of many views at one alpha, vectorised: bit for bit what dfg_ggx gives. The spans have equal sizes.
void dfg_ggx_row(std::span<const double> NoV, double alpha, const DfgRule& rule, std::span<double> E,
                 std::span<double> Fc);

/// E and Fc by Monte Carlo over visible normals with `samples` points of the R2 sequence, shifted by `seed`; the estimate
/// of every other renderer. Error falls like samples^-1 or faster while smooth, samples^-1/2 at worst.
DirectionalAlbedo dfg_ggx_importance_sampled(double NoV, double alpha, int samples, std::uint64_t seed);

}  // namespace pbr
