#include "bakers/texture/difference.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "pbr/brdf/fresnel.hpp"
#include "pbr/numerics/elementary.hpp"

namespace pbrbake::texture {
namespace {

/// CIE 15:2004, 8.2.1.1.
double lab_curve(double t) {
    constexpr double kEdge = 6. / 29;
    return t > kEdge * kEdge * kEdge ? pbr::exp_exact(pbr::log_exact(t) / 3)
                                     : t / (3 * kEdge * kEdge) + 4. / 29;
}

std::array<double, 3> lab(const Colour& colour) {
    const double r = colour.x, g = colour.y, b = colour.z;
    // IEC 61966-2-1's matrix, each row over the white it makes.
    const double x = lab_curve((.4124 * r + .3576 * g + .1805 * b) / .9505);
    const double y = lab_curve(.2126 * r + .7152 * g + .0722 * b);
    const double z = lab_curve((.0193 * r + .1192 * g + .9505 * b) / 1.089);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

}  // namespace

Albedo pbr_albedo(const pbr::Reflected<float>& reflected, float f90, float perceptual_roughness,
                  pbr::Scattering scattering) {
    const pbr::MeanAlbedo lobe = pbr::mean_albedo_ggx(static_cast<double>(perceptual_roughness));
    Colour specular;
    for (int c = 0; c < 3; ++c)
        specular[c] = static_cast<float>(pbr::mean_specular_albedo(
            static_cast<double>(reflected.f0[c]), static_cast<double>(f90), lobe, scattering));
    return {reflected.diffuse, specular};
}

float source_f90(const Sources& sources, const Colour& f0) {
    return sources.has_legacy_lobe() ? pbr::f90_from_f0(f0) : 1;
}

Albedo source_albedo(const Sources& sources, const Calibration& calibration, const LegacyTexel& calibrated) {
    if (sources.has_legacy_lobe() && calibration.kind == Calibration::Kind::none)
        return {calibrated.reflected.diffuse, calibrated.specular_albedo};
    return pbr_albedo(calibrated.reflected, source_f90(sources, calibrated.reflected.f0),
                      calibrated.perceptual_roughness, scattering_of(sources.params()));
}

pbr::Scattering scattering_of(const TextureParams& params) {
    return params.multiscatter ? pbr::Scattering::multiple : pbr::Scattering::single;
}

double delta_e(const Colour& a, const Colour& b) {
    const std::array<double, 3> p = lab(a), q = lab(b);
    return std::sqrt((p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]) +
                     (p[2] - q[2]) * (p[2] - q[2]));
}

}  // namespace pbrbake::texture
