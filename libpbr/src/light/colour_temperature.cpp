#include "pbr/light/colour_temperature.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "pbr/light/cie_1931.hpp"
#include "pbr/light/luminous_efficacy.hpp"

namespace pbr {
namespace {

// SI, 9th edition, all exact.
constexpr double kPlanck = 6.62607015e-34;                    // J s
constexpr double kSpeedOfLight = 299792458;                   // m/s
constexpr double kBoltzmann = 1.380649e-23;                   // J/K
constexpr double kC2 = kPlanck * kSpeedOfLight / kBoltzmann;  // m K
constexpr double kNanometre = 1e-9;

/// x / (1 - e^-x) for x >= 0; 1 at 0.
double bose(double x) { return x > 0 ? x / -std::expm1(-x) : 1; }

/// A point of the locus in homogeneous coordinates, and its derivative by reciprocal temperature.
struct LocusXyz {
    glm::dvec3 xyz;
    glm::dvec3 derivative;
};

// A black body's spectrum relative to its own value at the longest wavelength. With x = c2/(lambda T) it is
// (l/lambda)^4 e^(x_l - x) bose(x)/bose(x_l): no power of e above 0, and nothing cancels when T grows.
LocusXyz locus_xyz(double reciprocal_k) {
    constexpr double kLongest = kCieLast_nm * kNanometre;
    const double x_longest = kC2 / kLongest * reciprocal_k, bose_longest = bose(x_longest);
    LocusXyz sum{glm::dvec3(0), glm::dvec3(0)};
    int wavelength_nm = kCieFirst_nm;
    for (const glm::dvec3& weight : cie_1931_observer()) {
        const double wavelength = wavelength_nm++ * kNanometre;
        const double x = kC2 / wavelength * reciprocal_k, ratio = kLongest / wavelength,
                     ratio2 = ratio * ratio;
        const double density = ratio2 * ratio2 * std::exp(x_longest - x) * bose(x) / bose_longest;
        // d ln(density) / d(1/T) is -bose(x)/(1/T) but for a factor common to all wavelengths, which doesn't
        // move a chromaticity; less the longest wavelength's it stays small.
        sum.xyz += weight * density;
        sum.derivative += weight * density * (bose_longest - bose(x));
    }
    if (reciprocal_k > 0) sum.derivative /= reciprocal_k;
    return sum;
}

/// A point of the locus in (u, v), and the unit tangent in the direction of falling temperature.
struct LocusUv {
    glm::dvec2 uv;
    glm::dvec2 tangent;
};

LocusUv locus_uv(double reciprocal_k) {
    const LocusXyz at = locus_xyz(reciprocal_k);
    // u = 4X/D, v = 6Y/D with D = X + 15Y + 3Z.
    const auto denominator = [](const glm::dvec3& c) { return c.x + 15 * c.y + 3 * c.z; };
    const double d = denominator(at.xyz), dd = denominator(at.derivative);
    const glm::dvec2 n(4 * at.xyz.x, 6 * at.xyz.y), dn(4 * at.derivative.x, 6 * at.derivative.y);
    return {n / d, glm::normalize(dn * d - n * dd)};
}

}  // namespace

double planck_radiance(double wavelength_m, double temperature_k) {
    const double lambda2 = wavelength_m * wavelength_m;
    const double c1 = 2 * kPlanck * kSpeedOfLight * kSpeedOfLight;
    return c1 / (lambda2 * lambda2 * wavelength_m) / std::expm1(kC2 / (wavelength_m * temperature_k));
}

LumensPerWatt<double> efficacy_of_black_body(double temperature_k) {
    const Lumens<double> luminance = power_of_spectrum([=](double wavelength_nm) {
        return planck_radiance(wavelength_nm * kNanometre, temperature_k) * kNanometre;
    });
    // Stefan-Boltzmann, sigma T^4 / pi with sigma = 2 pi^5 k^4 / (15 h^3 c^2).
    const double pi2 = std::numbers::pi * std::numbers::pi, kT = kBoltzmann * temperature_k;
    const double per_photon = kT / (kPlanck * kSpeedOfLight);
    const double radiance = 2 * pi2 * pi2 / 15 * kT * per_photon * per_photon * per_photon * kSpeedOfLight;
    return LumensPerWatt<double>(luminance.value() / radiance);
}

Chromaticity planckian_chromaticity(double temperature_k) {
    return chromaticity_of(locus_xyz(1 / temperature_k).xyz);
}

Chromaticity daylight_chromaticity(double temperature_k) {
    const double m = 1e3 / std::clamp(temperature_k, 4000.0, 25'000.0);
    const double x = m > 1 / 7.0 ? ((-4.6070 * m + 2.9678) * m + 0.09911) * m + 0.244063
                                 : ((-2.0064 * m + 1.9018) * m + 0.24748) * m + 0.237040;
    return {x, (-3.000 * x + 2.870) * x - 0.275};
}

CorrelatedTemperature correlated_temperature(const Chromaticity& c) {
    // The nearest point of the locus lies where the way to it is normal to the tangent. In reciprocal
    // temperature the locus is nearly evenly paced; a grid finds the neighbourhood, bisection the place.
    constexpr double kLeast = 1 / kHottestBlackBody_k, kMost = 1 / kCoolestBlackBody_k;
    constexpr int kCells = 24, kHalvings = 48;  // two cells / 2^48: 4e-19 of 1/K, a rounding
    const glm::dvec2 uv = uv_1960(c);
    const auto reciprocal = [=](int i) {
        return kLeast + (kMost - kLeast) * std::clamp(i, 0, kCells) / kCells;
    };
    int nearest = 0;
    double least = glm::distance(uv, locus_uv(reciprocal(0)).uv);
    for (int i = 1; i <= kCells; ++i)
        if (const double d = glm::distance(uv, locus_uv(reciprocal(i)).uv); d < least) {
            least = d;
            nearest = i;
        }
    double low = reciprocal(nearest - 1), high = reciprocal(nearest + 1);
    for (int i = 0; i < kHalvings; ++i) {
        const double middle = 0.5 * (low + high);
        const LocusUv at = locus_uv(middle);
        (glm::dot(uv - at.uv, at.tangent) > 0 ? low : high) = middle;
    }
    const double found = 0.5 * (low + high);
    const LocusUv at = locus_uv(found);
    const glm::dvec2 off = uv - at.uv;
    const double side = at.tangent.x * off.y - at.tangent.y * off.x;
    return {1 / found, std::copysign(glm::length(off), side)};
}

Chromaticity from_correlated_temperature(const CorrelatedTemperature& t) {
    const LocusUv at = locus_uv(1 / t.temperature_k);
    return chromaticity_from_uv(at.uv + t.duv * glm::dvec2(-at.tangent.y, at.tangent.x));
}

glm::dvec3 rgb_from_temperature(double temperature_k) {
    return rgb_into_gamut(rgb_of(planckian_chromaticity(temperature_k)));
}

}  // namespace pbr
