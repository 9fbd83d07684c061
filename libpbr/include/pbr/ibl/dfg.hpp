#pragma once
// The DFG term of the split sum: directional albedo of the GGX lobe, and its Fresnel-weighted part.
//
//     E(NoV, alpha)  = integral of D V NoL over the hemisphere       (Smith, correlated unless asked
//     otherwise) Fc(NoV, alpha) = the same with the integrand times (1 - VoH)^5
//
// so that the lobe of a material with Schlick's Fresnel has the albedo f0 (E - Fc) + f90 Fc: scale E - Fc,
// bias Fc (Karis 2013, "Real shading in Unreal Engine 4"; Lagarde & de Rousiers 2014, 4.9.2). 0 <= Fc <= E
// <= 1. Limits: alpha = 0 is the mirror, E = 1 and Fc = (1 - NoV)^5; NoV = 0 at alpha > 0 gives E = 1; the
// two limits do not commute (along NoV = alpha -> 0, E tends to .89).

#include <array>
#include <cstdint>
#include <span>

#include "pbr/numerics/quadrature.hpp"

namespace pbr {

struct DirectionalAlbedo {
    double E;
    double Fc;
};

/// Nodes of the product quadrature. The nearer to the horizon a view is, the more it needs.
struct DfgRule {
    /// The rules of views from `lowest_NoV` up to the next band's.
    struct Band {
        double lowest_NoV;
        QuadratureRule azimuth;  ///< over the azimuth of the half vector
        QuadratureRule radial;   ///< from the normal up to the horizon
    };
    std::array<Band, 4> bands;  ///< ascending, the first from 0
    double max_error;  ///< largest error of E and Fc over NoV in [0, 1] and alpha in [1e-8, 1], and alpha = 0

    /// The band that a view in [0, 1] belongs to.
    const Band& band_of(double NoV) const;
    /// Evaluations of the integrand that a view costs.
    int evaluations(double NoV) const {
        const Band& band = band_of(NoV);
        return band.azimuth.size() * band.radial.size();
    }
};

/// The cheapest rule whose error is at most `max_error`; below 1e-8 the one of 1e-8. max_error > 0.
DfgRule dfg_rule(double max_error);

enum class DfgEstimator {
    quadrature,           ///< deterministic, error as its rule states
    importance_sampling,  ///< Monte Carlo over visible normals, as other renderers have it
};

/// How masking and shadowing go together in Smith's visibility.
enum class DfgVisibility {
    correlated,    ///< V_smith_ggx_correlated, by height
    uncorrelated,  ///< V_smith_ggx_uncorrelated, G1 G1: darker, at NoV = 0 too
};

/// How E and Fc are had.
struct DfgMethod {
    DfgEstimator estimator = DfgEstimator::quadrature;
    DfgRule rule{};          ///< of quadrature
    int samples = 0;         ///< of importance sampling
    std::uint64_t seed = 0;  ///< of importance sampling; every (NoV, alpha) hashes it anew
    DfgVisibility visibility = DfgVisibility::correlated;

    /// Quadrature by dfg_rule(max_error).
    static DfgMethod quadrature(double max_error) { return {DfgEstimator::quadrature, dfg_rule(max_error)}; }
    /// Monte Carlo with `samples` >= 1 a table entry.
    static DfgMethod importance_sampling(int samples, std::uint64_t seed) {
        return {DfgEstimator::importance_sampling, {}, samples, seed};
    }
    /// The same with another visibility; the rules' errors hold for both.
    DfgMethod with(DfgVisibility other) const {
        DfgMethod method = *this;
        method.visibility = other;
        return method;
    }
    /// Evaluations of the integrand that a view costs at alpha > 0.
    int evaluations(double NoV) const {
        return estimator == DfgEstimator::quadrature ? rule.evaluations(NoV) : samples;
    }
};

/// E and Fc of many views at one alpha. NoV in [0, 1], alpha in [0, 1]; the spans have equal sizes.
/// Quadrature is vectorised over views, each view's bits the same in any row; its error is
/// method.rule.max_error. Importance sampling takes the R2 sequence: its error falls like samples^-1 while
/// smooth, samples^-1/2 at worst.
void dfg_ggx_row(std::span<const double> NoV, double alpha, const DfgMethod& method, std::span<double> E,
                 std::span<double> Fc);

/// E and Fc of one view.
DirectionalAlbedo dfg_ggx(double NoV, double alpha, const DfgMethod& method);

}  // namespace pbr
