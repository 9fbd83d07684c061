#pragma once
// Errors of single precision, for "relative error below n ulp" in a header.

#include <cmath>

namespace pbr {

/// Relative error of a float against its double evaluation from the same inputs, in units of 2^-23. 0 if both
/// are 0, or the same infinity; infinite or NaN if just one is.
inline double ulp_error(float value, double truth) {
    if (static_cast<double>(value) == truth) return 0;
    return std::abs(static_cast<double>(value) - truth) / (std::abs(truth) * 0x1p-23);
}

/// Absolute error in units of 2^-23 times `scale`.
inline double ulp_error_of(double scale, float value, double truth) {
    return std::abs(static_cast<double>(value) - truth) / (scale * 0x1p-23);
}

}  // namespace pbr
