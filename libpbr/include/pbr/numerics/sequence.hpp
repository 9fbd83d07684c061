#pragma once
// Counter-based random numbers and low-discrepancy sequences: every value is a function of its indices alone,
// so results cannot depend on threads or on the order of evaluation.

#include <cstdint>

namespace pbr {

/// A point of the unit square; both coordinates lie in [0, 1).
struct Sample2 {
    double u1;
    double u2;
};

/// 64 well-mixed bits of a counter (the finaliser of SplitMix64: Steele et al. 2014, "Fast splittable
/// pseudorandom number generators"). A bijection: equal outputs need equal inputs.
constexpr std::uint64_t mix_bits(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/// Bits that depend on all the counters given: random_bits(seed, texel, sample).
template <class... Counters>
constexpr std::uint64_t random_bits(std::uint64_t seed, Counters... counters) {
    std::uint64_t bits = mix_bits(seed);
    ((bits = mix_bits(bits ^ static_cast<std::uint64_t>(counters))), ...);
    return bits;
}

/// The top 53 bits as a double in [0, 1).
constexpr double unit_double(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

/// A uniform double in [0, 1) from counters.
template <class... Counters>
constexpr double random_unit(std::uint64_t seed, Counters... counters) {
    return unit_double(random_bits(seed, counters...));
}

/// The van der Corput radical inverse of `index` in base 2.
constexpr double radical_inverse_base2(std::uint32_t index) {
    index = (index << 16) | (index >> 16);
    index = ((index & 0x00ff00ffu) << 8) | ((index & 0xff00ff00u) >> 8);
    index = ((index & 0x0f0f0f0fu) << 4) | ((index & 0xf0f0f0f0u) >> 4);
    index = ((index & 0x33333333u) << 2) | ((index & 0xccccccccu) >> 2);
    index = ((index & 0x55555555u) << 1) | ((index & 0xaaaaaaaau) >> 1);
    return index * 0x1p-32;
}

/// Point `index` of the `count`-point Hammersley set, the first coordinate at the middle of its stratum, the
/// second turned by `rotation` (Cranley & Patterson 1976). count >= 1, index < count, rotation in [0, 1).
constexpr Sample2 hammersley(std::uint32_t index, std::uint32_t count, double rotation = 0) {
    const double turned = radical_inverse_base2(index) + rotation;
    return {(index + 0.5) / count, turned < 1 ? turned : turned - 1};
}

/// Point `index` of the R2 sequence, the two-dimensional extension of the golden-ratio sequence (Roberts
/// 2018, "The unreasonable effectiveness of quasirandom sequences"), shifted by hashes of `seed`. For use
/// when the number of points isn't known beforehand. Exact modular arithmetic: no precision is lost with
/// growing index.
constexpr Sample2 r2_sequence(std::uint64_t index, std::uint64_t seed = 0) {
    constexpr std::uint64_t kStep1 =
        0xc13fa9a902a6328fu;  // 2^64 / rho,   rho^3 = rho + 1 (the plastic number)
    constexpr std::uint64_t kStep2 = 0x91e10da5c79e7b1du;  // 2^64 / rho^2
    return {unit_double(index * kStep1 + random_bits(seed, 0)),
            unit_double(index * kStep2 + random_bits(seed, 1))};
}

}  // namespace pbr
