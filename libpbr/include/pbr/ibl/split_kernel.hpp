#pragma once
// A narrow GGX lobe as the sum of what is near its axis and a smooth rest, in the manner of Ewald (1921).
//
// Narrow lobes need high degrees for their cores alone: GGX's long tails are smooth. Within an angle R of the
// axis the rest is the third-order Taylor polynomial of k at R, in 1 - mu; beyond, it is k itself. Its k_l
// fall below e like l R = 9, 13, 22 for e = 1e-3, 1e-4, 1e-5, for any alpha.

#include <array>
#include <span>
#include <vector>

#include "pbr/ibl/zonal_kernel.hpp"

namespace pbr {

/// k = near + far; `near` is 0 beyond a radius.
class SplitKernel {
  public:
    /// radius R of the near part, in (0, pi/2) radians.
    SplitKernel(const GgxZonalKernel& kernel, double radius);

    /// The whole kernel.
    const GgxZonalKernel& kernel() const { return kernel_; }

    /// As constructed.
    double radius() const { return radius_; }

    /// 1 - mu at the radius.
    double limit() const { return limit_; }

    /// The far part at 1 - mu in [0, 2], 1/sr. Continuous with three derivatives.
    double far(double one_minus_mu) const;

    /// The polynomial that the far part is within the radius: coefficients of (1 - mu - limit())^n.
    const std::array<double, 4>& polynomial() const { return polynomial_; }

    /// Radius beyond which the far part needs no degree above `bands`, for values within about max_error
    /// / 10 where that is 1e-4 or more, and half of max_error at 1e-5.
    static double radius_for(int bands, double max_error);

  private:
    GgxZonalKernel kernel_;
    double radius_, limit_;
    std::array<double, 4> polynomial_;
};

/// Funk-Hecke coefficients k_0 ... k_{bands-1} of the far part, as zonal_ggx() has them of the whole.
/// Absolute error below 1e-12.
std::vector<double> zonal_far(const SplitKernel& split, int bands);

/// The sum of (2l + 1) k_l^2 over the degrees that zonal_far(split, bands) hasn't, by Parseval's theorem: its
/// root is the error over the mean, root mean square, of leaving these out where all light is one point.
/// Absolute error below 1e-10.
double zonal_far_tail(const SplitKernel& split, std::span<const double> coefficients);

}  // namespace pbr
