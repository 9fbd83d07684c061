#include "pbr/legacy/energy.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace pbr {
namespace {

/// Fits at Chebyshev nodes; lowest power first.
constexpr std::array kE{.99999978,   4.2863883e-05, .000575394657, -.132804113, -4.99341348, 13.324337,
                        -23.7703342, 31.5947027,    -25.8141901,   11.152991,   -1.9527692};
constexpr std::array kFc{.0476217617, -.00066311233, .0281961339, -.59658902, -3.88473752, 28.175411,
                         -72.3342107, 99.9956362,    -79.6328315, 34.5652046, -6.36028471};

double polynomial(const std::array<double, 11>& coefficients, double x) {
    double sum = 0;
    for (std::size_t i = coefficients.size(); i-- > 0;) sum = sum * x + coefficients[i];
    return sum;
}

constexpr double kF90Slope = 50 * .33 * 3;  ///< of f90_from_f0 over grey f0
constexpr double kFullF90 = 1 / kF90Slope;  ///< the f0 from which f90 is 1
constexpr double kMeanWeight = 1. / 21;     ///< mean of Schlick's weight

/// Single-scattering albedo is k0 + k1 F_avg, on either side of kFullF90.
struct Piece {
    double k0, k1;
    double f0_of(double F_avg) const { return offset + slope * F_avg; }
    double offset, slope;
};

Piece piece_below(const MeanAlbedo& lobe) {
    const double F_per_f0 = 1 + (kF90Slope - 1) * kMeanWeight;
    return {0, (lobe.E + (kF90Slope - 1) * lobe.Fc) / F_per_f0, 0, 1 / F_per_f0};
}

Piece piece_above(const MeanAlbedo& lobe) {
    const double F_per_f0 = 1 - kMeanWeight, direct = lobe.E - lobe.Fc;
    return {lobe.Fc - direct * kMeanWeight / F_per_f0, direct / F_per_f0, -kMeanWeight / F_per_f0,
            1 / F_per_f0};
}

}  // namespace

MeanAlbedo mean_albedo_ggx(double perceptual_roughness) {
    return {polynomial(kE, perceptual_roughness), polynomial(kFc, perceptual_roughness)};
}

double mean_specular_albedo(double f0, const MeanAlbedo& lobe, Scattering scattering) {
    return mean_specular_albedo(f0, std::min(1., kF90Slope * f0), lobe, scattering);
}

double mean_specular_albedo(double f0, double f90, const MeanAlbedo& lobe, Scattering scattering) {
    const double single = f0 * (lobe.E - lobe.Fc) + f90 * lobe.Fc;
    if (scattering == Scattering::single) return single;
    const double F_avg = f0 + (f90 - f0) * kMeanWeight, lost = 1 - lobe.E;
    return single + F_avg * F_avg * lobe.E * lost / (1 - F_avg * lost);
}

SolvedF0 f0_from_mean_albedo(double mean_albedo, const MeanAlbedo& lobe, Scattering scattering) {
    if (!(mean_albedo > 0)) return {0, false};
    if (mean_albedo >= mean_specular_albedo(1, lobe, scattering))
        return {1, mean_albedo > mean_specular_albedo(1, lobe, scattering) * (1 + 1e-6)};
    const Piece piece = mean_albedo < mean_specular_albedo(kFullF90, lobe, scattering) ? piece_below(lobe)
                                                                                       : piece_above(lobe);
    const double c = mean_albedo - piece.k0;
    if (scattering == Scattering::single) return {std::clamp(piece.f0_of(c / piece.k1), 0., 1.), false};
    // (A - k0 - k1 F)(1 - F r) = r E F^2 with r = 1 - E, as a F^2 - b F + c = 0; the smaller root, without
    // cancellation.
    const double r = 1 - lobe.E, a = r * (piece.k1 - lobe.E), b = piece.k1 + c * r;
    const double F_avg = 2 * c / (b + std::sqrt(std::max(0., b * b - 4 * a * c)));
    return {std::clamp(piece.f0_of(F_avg), 0., 1.), false};
}

}  // namespace pbr
