#pragma once
// Elementary functions whose bits do not depend on the C library or the CPU.
//
// The C library picks its sin, log and atan2 by CPU (with or without fused multiply-add), so their last bits
// differ between machines. Baked bytes are promised, so whatever reaches them uses these: only + - * / and
// sqrt, in a fixed order. Errors are against the exact function, measured by tests/libpbr/numerics.

namespace pbr {

struct SinCos {
    double sin;
    double cos;
};

/// sin(pi x) and cos(pi x). Domain: |x| <= 2^51, else meaningless. Absolute error <= 2.3e-16; exact at
/// multiples of 1/2.
SinCos sin_cos_pi(double x);

/// Natural logarithm. Domain: positive normal doubles (x <= 0 or NaN gives NaN, +Inf gives +Inf).
/// Relative error <= 4e-16 apart from |x - 1| < 1e-8, where the absolute error is <= 1e-23.
double log_exact(double x);

/// e^x. Domain |x| <= 700. Relative error <= 4e-16.
double exp_exact(double x);

/// Binary logarithm; domain and error as log_exact.
double log2_exact(double x);

/// Cube root. Domain: 0, and x in [1e-300, 1e300]. Relative error <= 4e-16. A sixth of the time of exp_exact.
double cbrt_exact(double x);

/// Angle of (x, y) in (-pi, pi]; atan2_exact(0, 0) is 0, and y = -0 counts as 0. Absolute error <= 7e-16.
double atan2_exact(double y, double x);

}  // namespace pbr
