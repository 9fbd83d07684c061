#include "pbr/brdf/subsurface.hpp"

#include <array>

#include "pbr/numerics/quadrature.hpp"

namespace pbr {
namespace {

/// Mean of max(0, cosine to the light) over the circle of points at angle theta from one whose normal has
/// cosine NoL: cosines are a + b cos(phi).
double ring_irradiance(double NoL, double half_sine) {
    const double cosine = 1 - 2 * half_sine * half_sine;
    const double sine = 2 * half_sine * std::sqrt(std::max(0.0, 1 - half_sine * half_sine));
    const double a = cosine * NoL, b = sine * std::sqrt((1 - NoL) * (1 + NoL));
    if (a >= b) return a;
    if (a <= -b) return 0;
    const double lit = std::acos(-a / b);
    return (a * lit + std::sqrt((b - a) * (b + a))) / std::numbers::pi;
}

}  // namespace

double preintegrated_diffusion(double NoL, double curvature_d) {
    if (curvature_d <= 0) return std::max(NoL, 0.0);
    // Chord lengths x in units of d. Panels end where a ring begins or ceases to cross the terminator, and by
    // thirds in between, since the profile falls off exponentially.
    static const QuadratureRule rule = gauss_legendre(32);
    constexpr double kNothingBeyond = 130;  // e^(-130/3) < 2^-62
    const double diameter = 2 / curvature_d, end = std::min(diameter, kNothingBeyond);
    const double to_terminator = std::abs(std::numbers::pi / 2 - std::acos(std::clamp(NoL, -1.0, 1.0)));
    std::array<double, 9> ends{
        0,  diameter * std::sin(to_terminator / 2), diameter * std::cos(to_terminator / 2), 1, 4, 10, 25, 60,
        end};
    for (double& x : ends) x = std::min(x, end);
    std::sort(ends.begin(), ends.end());
    double sum = 0;
    for (std::size_t panel = 0; panel + 1 < ends.size(); ++panel) {
        const double start = ends[panel], length = ends[panel + 1] - start;
        if (length <= 0) continue;
        for (int i = 0; i < rule.size(); ++i) {
            // u^2 (3 - 2u) takes the square roots off both ends of the panel.
            const double u = rule.nodes[i], x = start + length * u * u * (3 - 2 * u);
            sum += rule.weights[i] * length * 6 * u * (1 - u) * pdf_burley_radius(x, 1.0) *
                   ring_irradiance(NoL, x / diameter);
        }
    }
    return sum / burley_cdf(diameter, 1.0);
}

}  // namespace pbr
