// One entry of a DFG table, and one value of the lobe that a probe is filtered with.

#include <cstdio>
#include <pbr/brdf/roughness.hpp>
#include <pbr/ibl/dfg.hpp>
#include <pbr/ibl/zonal_kernel.hpp>

int main() {
    const double NoV = 0.5, perceptual_roughness = 0.5;
    const double alpha = pbr::alpha_from_perceptual_roughness(perceptual_roughness);

    const pbr::DirectionalAlbedo albedo = pbr::dfg_ggx(NoV, alpha, pbr::DfgMethod::quadrature(1e-6));
    std::printf("NoV %g, perceptual roughness %g: scale %.6f, bias %.6f\n", NoV, perceptual_roughness,
                albedo.E - albedo.Fc, albedo.Fc);

    const pbr::GgxZonalKernel kernel(alpha);
    std::printf("alpha %g: lobe's density at its axis %.6f / sr\n", alpha, kernel.value(0));
}
