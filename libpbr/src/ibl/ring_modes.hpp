#pragma once
// Between rings of latitude and their Fourier coefficients.

#include <complex>
#include <functional>
#include <vector>

#include "pbr/ibl/harmonic_filter.hpp"
#include "pbr/numerics/fourier.hpp"
#include "src/simd/legendre_kernel.hpp"

namespace pbr {

/// Fourier coefficients of pairs of rings, a northern one and its mirror image, as sums and differences: what
/// even and odd degrees need. part(order, parity, part) is an array over pairs, the pole's first.
class RingModes {
  public:
    RingModes(int orders, int pairs);
    int orders() const { return orders_; }
    double* part(int order, int parity, int part) {
        return &modes_[((static_cast<std::size_t>(order) * 2 + parity) * kParts + part) * stride_];
    }

  private:
    int orders_, stride_;
    std::vector<double> modes_;
};

/// Real samples on `height` rings of `width` points.
struct RingSource {
    int width, height;
    /// Writes a channel of ring y: sample x to out[x * 2 * kFourierLanes].
    std::function<void(int y, int channel, double* out)> read;
    /// What the transform at each order is multiplied by.
    std::vector<std::complex<double>> factors;

    int pairs() const { return (height + 1) / 2; }
};

/// factors[m] times the sum over x of sample x e^(-2 pi i m x / width), for all rings and orders below
/// factors.size(), folded beyond Nyquist. The middle ring of an odd number counts as north and south.
RingModes analyse_rings(const RingSource& source, const ForEach& each);

/// The real part of the sum over orders of coefficient e^(2 pi i m x / width): `write` takes sample x of a
/// channel of ring y from in[x * 2 * kFourierLanes]. `height` is even; width >= 2 orders - 1.
void synthesise_rings(RingModes& modes, int width, int height,
                      const std::function<void(int y, int channel, const double* in)>& write,
                      const ForEach& each);

}  // namespace pbr
