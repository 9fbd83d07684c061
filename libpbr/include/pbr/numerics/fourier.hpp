#pragma once
// Discrete Fourier transforms of several signals side by side.

#include <vector>

namespace pbr {

/// Signals that a FourierPlan transforms together, whatever the CPU's vector width.
inline constexpr int kFourierLanes = 8;

/// X_k = sum over j of x_j exp(-2 pi i j k / size), of kFourierLanes complex signals at once.
///
/// Signals are interleaved: element j is kFourierLanes real parts, then as many imaginary parts, doubles.
/// Exchange the parts before and after for the inverse (times size). Relative error about 3e-16 log2(size) of
/// the root mean square. The bits depend neither on the CPU nor on its vector width. (Stockham's self-sorting
/// mixed-radix FFT: Van Loan 1992, "Computational frameworks for the fast Fourier transform", 1.7 and 2.2.)
class FourierPlan {
  public:
    /// size >= 1. Time grows with size times the sum of its prime factors: fast for products of 2, 3 and 5.
    explicit FourierPlan(int size);

    /// As constructed.
    int size() const { return size_; }

    /// Doubles that a batch of signals takes.
    int batch_doubles() const { return size_ * 2 * kFourierLanes; }

    /// Transforms `data` in place; `work` is scratch. Both hold batch_doubles(). Thread-safe.
    void transform(double* data, double* work) const;

  private:
    int size_;
    std::vector<int> radices_;
    std::vector<double> twiddles_;  ///< exp(-2 pi i k / size): cosine, sine
};

/// The smallest n >= `at_least` that has no prime factor above 5.
int fast_fourier_size(int at_least);

}  // namespace pbr
