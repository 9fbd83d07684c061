// libpbr in a program of its own: an entry of a DFG table, a camera set by the rule of Sunny 16, and a grey
// plastic ball under the sun and under a lamp, from lux and lumens to pixel values.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <pbr/brdf/disney_diffuse.hpp>
#include <pbr/brdf/ggx.hpp>
#include <pbr/brdf/roughness.hpp>
#include <pbr/camera/exposure.hpp>
#include <pbr/ibl/dfg.hpp>
#include <pbr/ibl/zonal_kernel.hpp>
#include <pbr/light/punctual.hpp>
#include <pbr/light/solid_angle.hpp>
#include <pbr/light/unit_conversions.hpp>
#include <pbr/numerics/vector.hpp>

namespace {

using Vec = pbr::Vec3<double>;

constexpr double kAlbedo = 0.18, kF0 = 0.04, kPerceptualRoughness = 0.5;
const Vec kView(0, 0, 1);  // from the ball to the camera

/// What the ball's surface makes of light from l: luminance over illuminance, 1/sr.
double brdf(const Vec& normal, const Vec& l) {
    const Vec h = glm::normalize(l + kView);
    const double NoL = glm::dot(normal, l), NoV = glm::dot(normal, kView), LoH = glm::dot(l, h);
    const double alpha = pbr::alpha_from_perceptual_roughness(kPerceptualRoughness);
    const double diffuse = kAlbedo * pbr::f_disney_diffuse(NoL, NoV, LoH, kPerceptualRoughness);
    return diffuse + pbr::D_ggx(std::min(glm::dot(normal, h), 1.0), alpha) *
                         pbr::V_smith_ggx_correlated(NoL, NoV, alpha) * pbr::F_schlick(kF0, 1.0, LoH);
}

/// Points of the ball from near its top, past the one that faces the camera, to its dark side; light from l.
void print_ball(const Vec& l, const auto& illuminance, double exposure) {
    for (const int degrees : {60, 30, 0, -60}) {
        const double angle = degrees * std::numbers::pi / 180;
        const Vec normal(0, std::sin(angle), std::cos(angle));
        const pbr::Lux<double> received = illuminance(normal);
        const double luminance_nit = received.value() > 0 ? brdf(normal, l) * received.value() : 0;
        std::printf("    normal %3d deg up: %9.2f lx, %8.2f nit, pixel %.4f\n", degrees, received.value(),
                    luminance_nit, luminance_nit * exposure);
    }
}

}  // namespace

int main() {
    const double NoV = 0.5, alpha = pbr::alpha_from_perceptual_roughness(kPerceptualRoughness);
    const pbr::DirectionalAlbedo albedo = pbr::dfg_ggx(NoV, alpha, pbr::DfgMethod::quadrature(1e-6));
    std::printf("NoV %g, perceptual roughness %g: scale %.6f, bias %.6f\n", NoV, kPerceptualRoughness,
                albedo.E - albedo.Fc, albedo.Fc);
    std::printf("alpha %g: lobe's density at its axis %.6f / sr\n", alpha,
                pbr::GgxZonalKernel(alpha).value(0));

    const pbr::Ev100<double> sunny =
        pbr::ev100_from_settings(pbr::CameraSettings<double>{16, 1.0 / 100, 100});
    std::printf("Sunny 16, f/16 1/100 s ISO 100: EV %.2f, mean %.0f nit, saturates at %.0f nit\n",
                sunny.value(), pbr::luminance_from_ev100(sunny).value(),
                pbr::saturation_luminance(sunny).value());

    // The sun stands 60 degrees up behind the camera and is stated by what a surface that faces it receives.
    const pbr::Lux<double> sun(100'000);
    const double height = std::numbers::pi / 3;
    const Vec to_sun(0, std::sin(height), std::cos(height));
    std::printf("  ball under a sun of %.0f lx\n", sun.value());
    print_ball(
        to_sun, [&](const Vec& normal) { return sun * std::max(glm::dot(normal, to_sun), 0.0); },
        pbr::exposure_by_saturation(sunny));

    // A lamp in the same direction, 2 m away, is stated by the lumens on its box. The ball is small against
    // that.
    const pbr::Candelas<double> lamp =
        pbr::intensity_from_power(pbr::Lumens<double>(800), pbr::solid_angle_whole_sphere<double>());
    const pbr::Ev100<double> indoors =
        pbr::ev100_from_settings(pbr::CameraSettings<double>{2.8, 1.0 / 60, 1600});
    std::printf("Indoors, f/2.8 1/60 s ISO 1600: EV %.2f\n  ball under a lamp of 800 lm, %.2f cd\n",
                indoors.value(), lamp.value());
    constexpr double kNoWindow = std::numeric_limits<double>::infinity();
    print_ball(
        to_sun,
        [&](const Vec& normal) { return pbr::illuminance_of_point(lamp, 2.0 * to_sun, normal, kNoWindow); },
        pbr::exposure_by_saturation(indoors));
}
