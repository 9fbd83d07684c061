#include "pbr/brdf/disney_diffuse.hpp"

#include <algorithm>

#include "pbr/numerics/quadrature.hpp"

namespace pbr {
namespace {

/// Albedo of (1/pi)(1 + g a)(1 + g b) with a, b Schlick's weights of NoL, NoV and g = f90 - 1, f90 = base + 2
/// r LoH^2.
///
/// LoH^2 = (1 + LoV)/2 and LoV = NoL NoV + sinL sinV cos(phi), so g = g0 + g1 cos(phi), and the mean over phi
/// of (1 + g a)(1 + g b) is 1 + (a + b) g0 + a b (g0^2 + g1^2 / 2): a polynomial of degree 7 in NoL, 8 with
/// the cosine.
double albedo(double NoV, double perceptual_roughness, double base) {
    static const QuadratureRule rule = gauss_legendre(5);  // exact to degree 9
    const double b = schlick_weight(NoV);
    double sum = 0;
    for (int i = 0; i < rule.size(); ++i) {
        const double NoL = rule.nodes[i];
        const double a = schlick_weight(NoL);
        const double g0 = base - 1 + perceptual_roughness * (1 + NoL * NoV);
        const double g1_squared =
            perceptual_roughness * perceptual_roughness * (1 - NoL * NoL) * (1 - NoV * NoV);
        sum += rule.weights[i] * 2 * NoL * (1 + (a + b) * g0 + a * b * (g0 * g0 + g1_squared / 2));
    }
    return std::max(0.0, sum);  // 0 at NoV = r = 0, but for rounding
}

}  // namespace

double albedo_disney_diffuse(double NoV, double perceptual_roughness) {
    const double energy_factor = 1 + perceptual_roughness * (1 / 1.51 - 1);
    return energy_factor * albedo(NoV, perceptual_roughness, 0.5 * perceptual_roughness);
}

double albedo_disney_diffuse_original(double NoV, double perceptual_roughness) {
    return albedo(NoV, perceptual_roughness, 0.5);
}

}  // namespace pbr
