#pragma once
// Sums over associated Legendre functions on rings of latitude, for one order m.
//
// P_lm are orthonormal: the integral of (P_lm e^(i m phi))^2 over the sphere is 1. Their start sin^m
// underflows where m is large, so they carry an exponent of their own until they matter (Reinecke & Seljebotn
// 2013, "libsharp - spherical harmonic transforms revisited", 3.2).

#include <vector>

namespace pbr {

/// Doubles that are treated together, whatever the vector width.
inline constexpr int kRingLanes = 8;
/// Rings are padded to a multiple of this.
inline constexpr int kRingGroup = 4 * kRingLanes;
/// Real and imaginary parts of three channels.
inline constexpr int kParts = 6;

/// Rings of the northern hemisphere from the pole to the equator; each stands for its mirror image too.
struct Rings {
    std::vector<double> cosine, log2_sine;  ///< of the colatitude, padded

    explicit Rings(const std::vector<double>& colatitudes_rad);
    int padded() const { return static_cast<int>(cosine.size()); }
    /// The first ring, rounded down to a group, on which a function of this order and degrees up to `bands`
    /// isn't negligible.
    int first(int order, int bands) const;
};

/// What the recurrence over degrees needs for one order: P_l = a_l (x P_(l-1) - b_l P_(l-2)).
struct LegendreOrder {
    int order, bands;
    double log2_start;         ///< of P_mm / sin^m
    std::vector<double> a, b;  ///< of degrees order … bands

    LegendreOrder(int order, int bands);
    int degrees() const { return bands - order + 1; }
};

/// coefficients[degree - order][part] = sum over rings of P_lm times even[part][ring] where degree - order is
/// even, odd where it is odd. `even` and `odd` hold kParts * padded doubles and are not read before `first`.
void legendre_analyse(const Rings& rings, const LegendreOrder& legendre, int first, const double* even,
                      const double* odd, double* coefficients);

/// even[part][ring] = sum over even degree - order of P_lm times coefficients[degree - order][part]; odd
/// likewise. Zero before `first`.
void legendre_synthesise(const Rings& rings, const LegendreOrder& legendre, int first,
                         const double* coefficients, double* even, double* odd);

}  // namespace pbr
