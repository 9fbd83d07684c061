#include "pbr/ibl/zonal_harmonics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "pbr/ibl/spherical_harmonics.hpp"
#include "pbr/ibl/split_kernel.hpp"
#include "pbr/ibl/zonal_kernel.hpp"
#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/legendre.hpp"
#include "pbr/numerics/quadrature.hpp"

namespace pbr {

double zonal_cosine(int l) {
    assert(l >= 0);
    constexpr double kPi = std::numbers::pi;
    if (l == 1) return 2 * kPi / 3;
    if (l % 2 == 1) return 0;
    double binomial = 1;  // l! / (2^l (l/2)!^2)
    for (int k = 2; k <= l; k += 2) binomial *= (k - 1.0) / k;
    const double sign = l % 4 == 0 ? -1 : 1;
    return 2 * kPi * sign * binomial / ((l + 2.0) * (l - 1.0));
}

namespace {

/// Points for integrals of a kernel of 1 - mu over the hemisphere; weights hold 2 pi sin(theta).
struct ZonalRule {
    std::vector<double> mu, weight, value;  ///< value of the kernel
};

/// A rule for a kernel that is 0 below the horizon, as wide as `width_of_core` at its core and smooth but at
/// one angle, times Legendre polynomials below degree `bands`.
template <class Kernel>
ZonalRule zonal_rule(const Kernel& kernel, double width_of_core, double break_rad, int bands) {
    assert(bands >= 1);
    // Panels of the polar angle as wide as what happens there: the core's own width, half the distance beyond
    // it, and a wave of the highest band everywhere. Sixteen points leave rounding alone.
    static const QuadratureRule rule = gauss_legendre(16);
    const double wave = 2 * std::numbers::pi / bands;
    ZonalRule points;
    for (double from = 0; from < std::numbers::pi / 2;) {
        const double end = from < break_rad * (1 - 1e-12) ? break_rad : std::numbers::pi / 2;
        const double rest = end - from, width = std::min(std::max(width_of_core, from / 2), wave);
        const bool last = rest < width * (1 + 1e-9);
        for (int i = 0; i < rule.size(); ++i) {
            const double turns = (from + (last ? rest : width) * rule.nodes[i]) / std::numbers::pi;
            const SinCos half = sin_cos_pi(turns / 2), whole = sin_cos_pi(turns);
            points.mu.push_back(whole.cos);
            points.weight.push_back(rule.weights[i] * (last ? rest : width) * 2 * std::numbers::pi *
                                    whole.sin);
            points.value.push_back(kernel(2 * half.sin * half.sin));
        }
        if (last && end > break_rad) break;
        from = last ? end : from + width;
    }
    return points;
}

/// k_0 ... k_{bands-1}.
std::vector<double> funk_hecke(const ZonalRule& rule, int bands) {
    // Bonnet's recurrence, all angles together.
    std::vector<double> before(rule.mu.size(), 0.0), now(rule.mu.size()), coefficients;
    for (std::size_t i = 0; i < now.size(); ++i) now[i] = rule.weight[i] * rule.value[i];
    for (int l = 0; l < bands; ++l) {
        const double a = (2 * l + 1.0) / (l + 1), b = static_cast<double>(l) / (l + 1);
        double sum = 0;
        for (std::size_t i = 0; i < now.size(); ++i) {
            sum += now[i];
            const double next = a * rule.mu[i] * now[i] - b * before[i];
            before[i] = now[i];
            now[i] = next;
        }
        coefficients.push_back(sum);
    }
    return coefficients;
}

ZonalRule far_rule(const SplitKernel& split, int bands) {
    const double cosine = 1 - split.limit(), sine = std::sqrt(split.limit() * (1 + cosine));
    const double radius = atan2_exact(sine, cosine);
    return zonal_rule([&](double x) { return split.far(x); }, std::max(split.kernel().alpha(), radius / 4),
                      radius, bands);
}

}  // namespace

std::vector<double> zonal_ggx(const GgxZonalKernel& kernel, int bands) {
    return funk_hecke(zonal_rule([&](double x) { return kernel.value(x); }, kernel.alpha(), 0, bands), bands);
}

std::vector<double> zonal_far(const SplitKernel& split, int bands) {
    return funk_hecke(far_rule(split, bands), bands);
}

double zonal_far_tail(const SplitKernel& split, std::span<const double> coefficients) {
    const ZonalRule rule = far_rule(split, static_cast<int>(coefficients.size()));
    double square = 0, kept = 0;
    for (std::size_t i = 0; i < rule.mu.size(); ++i) square += rule.weight[i] * rule.value[i] * rule.value[i];
    for (std::size_t l = 0; l < coefficients.size(); ++l)
        kept += (2 * static_cast<double>(l) + 1) * coefficients[l] * coefficients[l];
    return std::max(0.0, 4 * std::numbers::pi * square - kept);
}

namespace {

/// The least value of a function of a few bands: a grid of directions finer than the highest band's waves,
/// then plain descent from the lowest of them by shrinking steps along the tangents.
class MinimumFinder {
  public:
    explicit MinimumFinder(int bands) : bands_(bands) {
        const int count = 64 * sh_count(bands);
        const double golden_turn = std::numbers::phi - 1;
        for (int i = 0; i < count; ++i) {  // spherical Fibonacci points (Gonzalez 2010)
            const double z = 1 - (2 * i + 1.0) / count;
            const SinCos azimuth = sin_cos_pi(2 * std::fmod(i * golden_turn, 1.0));
            const double sine = std::sqrt((1 - z) * (1 + z));
            directions_.emplace_back(sine * azimuth.cos, sine * azimuth.sin, z);
            basis_.resize(basis_.size() + sh_count(bands));
            sh_evaluate<double>(bands, directions_.back(), std::span(basis_).last(sh_count(bands)));
        }
    }

    double minimum(std::span<const double> coefficients) const {
        std::size_t lowest = 0;
        double value = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < directions_.size(); ++i) {
            double sum = 0;
            for (int j = 0; j < sh_count(bands_); ++j)
                sum += coefficients[j] * basis_[i * sh_count(bands_) + j];
            if (sum < value) {
                value = sum;
                lowest = i;
            }
        }
        return descend(coefficients, directions_[lowest], value);
    }

  private:
    double descend(std::span<const double> coefficients, glm::dvec3 at, double value) const {
        // Steps from the grid's spacing down to where a quadratic minimum is flat to 1e-8.
        for (double step = 0.5 / bands_; step > 1e-4;) {
            const glm::dvec3 other = std::abs(at.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
            const glm::dvec3 u = glm::normalize(glm::cross(other, at)), v = glm::cross(at, u);
            bool moved = false;
            for (const glm::dvec3& tangent : {u, -u, v, -v}) {
                const glm::dvec3 candidate = glm::normalize(at + step * tangent);
                const double there = sh_reconstruct<double, double>(bands_, coefficients, candidate);
                if (there < value) {
                    value = there;
                    at = candidate;
                    moved = true;
                }
            }
            if (!moved) step /= 2;
        }
        return value;
    }

    int bands_;
    std::vector<glm::dvec3> directions_;
    std::vector<double> basis_;
};

}  // namespace

double dering_time(int bands, std::span<const double> coefficients) {
    assert(bands >= 1 && bands <= 8);
    const double mean = coefficients[0] * std::sqrt(1 / (4 * std::numbers::pi));
    if (!(mean > 0)) return std::numeric_limits<double>::infinity();
    const MinimumFinder finder(bands);
    const auto is_lifted = [&](double t) {
        std::vector<double> windowed(coefficients.begin(), coefficients.end()), factors(bands);
        for (int l = 0; l < bands; ++l) factors[l] = window_gauss(l, t);
        sh_scale_bands<double, double>(factors, windowed);
        return finder.minimum(windowed) >= -1e-6 * mean;
    };
    if (is_lifted(0)) return 0;
    double high = 1e-3;
    while (!is_lifted(high)) high *= 2;
    double low = high > 1e-3 ? high / 2 : 0;
    while (high - low > 1e-4 * high) {
        const double middle = (low + high) / 2;
        (is_lifted(middle) ? high : low) = middle;
    }
    return high;
}

}  // namespace pbr
