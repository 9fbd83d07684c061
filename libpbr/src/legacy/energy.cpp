#include "pbr/legacy/energy.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "src/legacy/mean_albedo_fit.hpp"

namespace pbr {
namespace {

double polynomial(const std::array<double, 11>& coefficients, double x) {
    double sum = 0;
    for (std::size_t i = coefficients.size(); i-- > 0;) sum = sum * x + coefficients[i];
    return sum;
}

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
    return {polynomial(kMeanE, perceptual_roughness), polynomial(kMeanFc, perceptual_roughness)};
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

double coloured_f0_scale(const Vec3<double>& f0, double mean_albedo, const MeanAlbedo& lobe,
                         Scattering scattering) {
    const auto albedo_at = [&](double scale) {
        const auto scaled = [&](int c) { return std::min(1., f0[c] * scale); };
        const double f90 = std::min(1., kF90Slope * (scaled(0) + scaled(1) + scaled(2)) / 3);
        double albedo = 0;
        for (int c = 0; c < 3; ++c) albedo += mean_specular_albedo(scaled(c), f90, lobe, scattering) / 3;
        return albedo;
    };
    // Regula falsi between nothing and too much, with Illinois' halving, so that neither end stays.
    constexpr int kTurns = 20;
    constexpr double kNear = 1e-4;
    double low = 0, high = 1, below = -mean_albedo, above = albedo_at(1) - mean_albedo;
    if (above <= kNear * mean_albedo) return 1;
    for (int turn = 0; turn < kTurns; ++turn) {
        const double scale = (low * above - high * below) / (above - below),
                     off = albedo_at(scale) - mean_albedo;
        if (std::abs(off) <= kNear * mean_albedo) return scale;
        (off < 0 ? low : high) = scale;
        (off < 0 ? below : above) = off;
        (off < 0 ? above : below) /= 2;
    }
    return high;
}

}  // namespace pbr
