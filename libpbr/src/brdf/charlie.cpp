#include "pbr/brdf/charlie.hpp"

#include "pbr/brdf/reflection.hpp"
#include "pbr/numerics/quadrature.hpp"

namespace pbr {

double albedo_charlie(double NoV, double alpha, CharlieVisibility visibility) {
    // Over NoL and the azimuth from the antipode of wo, where the lobe is sharpest; both squared, so that nodes crowd there
    // and at the horizon.
    static const QuadratureRule height = gauss_legendre(64), azimuth = gauss_legendre(128);
    const Vec3<double> wo(std::sqrt((1 - NoV) * (1 + NoV)), 0, NoV);
    double albedo = 0;
    for (int i = 0; i < height.size(); ++i) {
        const double NoL = height.nodes[i] * height.nodes[i];
        const double V = visibility == CharlieVisibility::neubelt ? V_neubelt(NoL, NoV) : V_charlie(NoL, NoV, alpha);
        const double sine = std::sqrt((1 - NoL) * (1 + NoL));
        double ring = 0;
        for (int j = 0; j < azimuth.size(); ++j) {
            const double t = azimuth.nodes[j];
            const SinCos from_antipode = sin_cos_pi(t * t);
            const Vec3<double> wi(-sine * from_antipode.cos, sine * from_antipode.sin, NoL);
            ring += azimuth.weights[j] * 2 * t * D_charlie(reflection(wo, wi).NoH, alpha);
        }
        albedo += height.weights[i] * 2 * height.nodes[i] * 2 * std::numbers::pi * ring * V * NoL;
    }
    return albedo;
}

}  // namespace pbr
