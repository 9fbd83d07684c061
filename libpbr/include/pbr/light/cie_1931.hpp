#pragma once
// The CIE 1931 standard observer: what an eye makes of a spectrum.
//
// At 1 nm, as the standard defines it. The abridged table of every fifth nanometre moves a black body's
// chromaticity by up to 1e-4 (at 40,000 K; 6e-6 at 2856 K), so it is not offered.

#include <glm/vec3.hpp>
#include <span>

namespace pbr {

inline constexpr int kCieFirst_nm = 360;
inline constexpr int kCieLast_nm = 830;
inline constexpr int kCieSamples = kCieLast_nm - kCieFirst_nm + 1;

/// The colour-matching functions x, y, z of the 2-degree observer at 360, 361 ... 830 nm (ISO/CIE
/// 11664-1:2019, table 1). y is V(lambda), the luminous efficiency, 1 at 555 nm. Seven digits.
std::span<const glm::dvec3, kCieSamples> cie_1931_observer();

/// Sums of the colour-matching functions times density(wavelength in nm), which is per nm; wavelengths beyond
/// 360-830 don't count. The integral by steps of 1 nm: for a density that is smooth over some nanometres
/// exact to the table's digits; a spectral line needs its width. Not multiplied by 683 lm/W.
template <class Density>
glm::dvec3 tristimulus(const Density& density) {
    glm::dvec3 sum(0);
    int wavelength_nm = kCieFirst_nm;
    for (const glm::dvec3& weight : cie_1931_observer())
        sum += weight * double(density(double(wavelength_nm++)));
    return sum;
}

}  // namespace pbr
