#include "pbr/numerics/elementary.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

namespace pbr {
namespace {

constexpr double kLn2High = 0x1.62e42fefa38p-1;   // 43 bits of ln 2: its product with an exponent is exact
constexpr double kLn2Low = 0x1.ef35793c7673p-45;  // the rest

/// Taylor series of sin and cos about 0, |a| <= pi/4: the first term left out is below 1e-19.
SinCos sin_cos_taylor(double a) {
    const double a2 = a * a;
    double s = 0, c = 0;
    for (int n = 8; n >= 1; --n) {
        s = -a2 / ((2 * n) * (2 * n + 1)) * (1 + s);
        c = -a2 / ((2 * n - 1) * (2 * n)) * (1 + c);
    }
    return {a + a * s, 1 + c};
}

}  // namespace

SinCos sin_cos_pi(double x) {
    const double quarter_turns = std::nearbyint(2 * x);
    const SinCos reduced =
        sin_cos_taylor((x - quarter_turns / 2) * std::numbers::pi);  // the difference is exact
    switch (static_cast<int>(std::fmod(quarter_turns, 4.0)) & 3) {
        case 0:
            return reduced;
        case 1:
            return {reduced.cos, -reduced.sin};
        case 2:
            return {-reduced.sin, -reduced.cos};
        default:
            return {-reduced.cos, reduced.sin};
    }
}

double log_exact(double x) {
    if (!(x > 0)) return std::numeric_limits<double>::quiet_NaN();
    if (std::isinf(x)) return x;
    int exponent = 0;
    double mantissa = std::frexp(x, &exponent);
    if (mantissa < std::numbers::sqrt2 / 2) {
        mantissa *= 2;
        --exponent;
    }
    // log m = 2 atanh s, s = (m-1)/(m+1), |s| <= .1716: the first term left out is below 1e-19.
    const double s = (mantissa - 1) / (mantissa + 1);
    const double s2 = s * s;
    double series = 0;
    for (int k = 25; k >= 3; k -= 2) series = s2 * (1.0 / k + series);
    return exponent * kLn2High + (2 * s + (2 * s * series + exponent * kLn2Low));
}

double exp_exact(double x) {
    // 2^k e^r with |r| <= ln(2)/2 and the Taylor series of e^r: the first term left out is below 1e-19.
    const double k = std::nearbyint(x * std::numbers::log2e);
    const double r = (x - k * kLn2High) - k * kLn2Low;
    double series = 1;
    for (int n = 14; n >= 1; --n) series = series * r / n + 1;
    return std::ldexp(series, static_cast<int>(k));
}

double log2_exact(double x) { return log_exact(x) * std::numbers::log2e; }

double cbrt_exact(double x) {
    if (x == 0) return 0;
    // A double's bits are nearly its logarithm, so a third of them, with the exponent's offset put back, is a
    // root within 4 %. Each of Halley's steps cubes that, and the last one's result is rounded only in its
    // correction.
    constexpr std::uint64_t kOffset = std::uint64_t{1023} * 2 / 3 << 52;
    double root = std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) / 3 + kOffset);
    for (int step = 0; step < 3; ++step) {
        const double cube = root * root * root;
        root -= root * ((cube - x) / (2 * cube + x));
    }
    return root;
}

double atan2_exact(double y, double x) {
    const double ay = std::abs(y), ax = std::abs(x);
    const bool steep = ay > ax;
    const double larger = steep ? ay : ax, smaller = steep ? ax : ay;
    if (larger == 0) return 0;
    // Halve the angle twice: tan(a/2) = t / (1 + sqrt(1 + t^2)). What is left is at most tan(pi/16) = .199.
    double t = smaller / larger;
    t = t / (1 + std::sqrt(1 + t * t));
    t = t / (1 + std::sqrt(1 + t * t));
    const double t2 = t * t;
    double series = 0;
    for (int k = 25; k >= 3; k -= 2) series = -t2 * (1.0 / k + series);
    double angle = 4 * (t + t * series);
    if (steep) angle = std::numbers::pi / 2 - angle;
    if (x < 0) angle = std::numbers::pi - angle;
    return y < 0 ? -angle : angle;
}

}  // namespace pbr
