#pragma once
// The GGX lobe of the split sum as a zonal kernel.
//
// With N = V = R, prefiltering by D weighted with NoL is a convolution of the sphere with
//     k(mu) = alpha^2 mu+ / (pi f^2 N_a),   mu = n.l,   f = alpha^2 + (1 - alpha^2)(1 - mu)/2,
// N_a making its integral over the sphere 1. (D at half the angle, D/4 being the density of reflected
// directions: Karis 2013, "Real shading in Unreal Engine 4"; Lagarde & de Rousiers 2014, 4.9.2.) f is written
// from 1 - mu, which for unit vectors is |n - l|^2 / 2 and does not cancel.

#include "pbr/numerics/sequence.hpp"

namespace pbr {

/// k for one alpha in (0, 1].
class GgxZonalKernel {
  public:
    /// alpha in (0, 1]; 1 is the cosine lobe mu / pi.
    explicit GgxZonalKernel(double alpha);

    /// As constructed.
    double alpha() const { return alpha_; }

    /// k, 1/sr, from 1 - mu in [0, 2]; 0 from the horizon (1) on. Relative error below 1e-14.
    double value(double one_minus_mu) const;

    /// The factor so that k = normalisation() * mu / f^2.
    double normalisation() const { return normalisation_; }

    /// Share of the kernel within the cone of 1 - mu, in [0, 1]; domain [0, 1]. Absolute error below 1e-14.
    double cdf(double one_minus_mu) const;

    /// 1 - mu for a share u in [0, 1]: samples with density k, azimuth uniform. Inverse of cdf:
    /// cdf(sample(u)) is within 1e-12 of u.
    double sample(double u) const;

  private:
    double alpha_, alpha2_, b_, c_;  ///< f = c - b mu
    double tail_at_one_;             ///< integral of m / f^2 over [0, 1], times c^2
    double normalisation_;
};

}  // namespace pbr
