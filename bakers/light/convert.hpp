#pragma once
// One light of an older format to a photometric one, in metres, candela and lux.

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bakers/light/params.hpp"
#include "bakers/parse/lights.hpp"
#include "pbr/legacy/light_fit.hpp"
#include "pbr/light/colour_temperature.hpp"

namespace pbrbake::light {

/// The largest finite half float.
inline constexpr double kHalfMax = 65504;

/// What a light's numbers are taken to be worth.
struct Anchor {
    double reference_lx;  ///< illuminance that a relative 1 stands for
    double unit_m;        ///< metres of a length of 1
    double efficacy_lm_per_w;
    double tolerance_stops;  ///< below this, a point light is as good as one with a source radius
};

/// The reference illuminance of an exposure: under it a white Lambertian surface comes out at pixel value 1,
/// as one lit by 1 did in the old renderer. pi over pbr::exposure_by_saturation, 1.2 pi 2^EV lx.
double reference_illuminance_lx(double ev100);

/// Its inverse.
double ev100_of_reference(double illuminance_lx);

/// A light after conversion, or what is known of one that has no photometric twin.
struct ConvertedLight {
    std::string name;
    int line = 0;
    parse::LightType type = parse::LightType::point;
    bool is_negative = false;  ///< takes light away: all figures are of its magnitude
    bool is_dark = false;
    bool is_fill = false;  ///< no point, spot or sun can do it: constant, ambient or negative
    glm::dvec3 rgb{1};     ///< linear Rec. 709 of luminance 1
    std::optional<pbr::CorrelatedTemperature> temperature;
    glm::dvec3 position_m{0};        ///< y up
    glm::dvec3 direction{0, 0, -1};  ///< unit, y up

    pbr::Falloff law;   ///< of distance in metres
    double law_lx = 0;  ///< illuminance where the law is 1
    pbr::DistanceSpan span_m{0, 0};
    std::optional<pbr::LightFit> fit;    ///< the light that is written
    std::optional<pbr::LightFit> point;  ///< without a source radius
    std::optional<pbr::LightFit> gltf;   ///< as glTF can say it: a point with glTF's window
    std::optional<pbr::SpotFit> spot;
    std::optional<pbr::SpotFalloff> spot_law;

    double illuminance_lx = 0;         ///< of directional and ambient lights, and of a constant fill
    double width_m = 0, height_m = 0;  ///< of a rectangle
    double flux_lm = 0;                ///< of point, spot, sphere, rectangle
    double luminance_nit = 0;          ///< of a source with an area, else 0
    std::vector<parse::Diagnostic> flags;

    bool has(std::string_view code) const;
    /// A light that glTF can hold: positive, lit, and a point, spot or sun.
    bool is_punctual() const { return !is_fill && !is_dark; }
};

/// Converts a light. `colours` replaces the file's own encoding where it isn't automatic.
ConvertedLight convert(const parse::LegacyLight& light, parse::UpAxis up, const Anchor& anchor,
                       const LightParams& params);

}  // namespace pbrbake::light
