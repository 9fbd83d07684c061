#pragma once
// Compensated summation.

#include <cmath>

namespace pbr {

/// Neumaier's variant of Kahan summation: the error of a sum of n terms is about one rounding of the result
/// plus n * 2^-106 times the sum of magnitudes, whatever the order of magnitude of the terms. Must not be
/// compiled with fast-math. (Neumaier 1974, "Rundungsfehleranalyse einiger Verfahren zur Summation endlicher
/// Summen".)
class CompensatedSum {
  public:
    /// Adds a finite term.
    CompensatedSum& operator+=(double term) {
        const double sum = sum_ + term;
        compensation_ += std::abs(sum_) >= std::abs(term) ? (sum_ - sum) + term : (term - sum) + sum_;
        sum_ = sum;
        return *this;
    }
    /// The sum so far; 0 of nothing.
    double value() const { return sum_ + compensation_; }

  private:
    double sum_ = 0;
    double compensation_ = 0;
};

}  // namespace pbr
