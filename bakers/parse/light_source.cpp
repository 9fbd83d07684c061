// Lights of Source's VMF as its compiler reads them (Source SDK 2013, utils/vrad/lightmap.cpp:
// LightForString, SetLightFalloffParams, ParseLightSpot, ParseLightEnvironment, GatherSampleStandardLightSSE;
// map_utils.cpp: SetupLightNormalFromProps; mathlib_base.cpp: SolveInverseQuadraticMonotonic). A map that has
// numbers for HDR is read with them, as vrad -hdr does.

#include <algorithm>
#include <cmath>

#include "bakers/parse/entity_values.hpp"
#include "bakers/parse/light_formats.hpp"
#include "bakers/parse/text.hpp"

namespace pbrbake::parse {
namespace {

constexpr double kWhite = 255;
constexpr double kUnit_m = .01905;  ///< 1/16 foot

/// Colour and brightness of "r g b brightness", or of the second four of eight; false where the key has none,
/// negative ones, or a count that vrad doesn't know.
bool read_brightness(const EntityValues& values, std::string_view key, LegacyLight& light) {
    std::vector<double> list = values.numbers(key);
    if (list.size() == 8) list.erase(list.begin(), list.begin() + 4);
    if (list.size() != 1 && list.size() != 3 && list.size() != 4) return false;
    if (*std::min_element(list.begin(), list.end()) < 0) return false;
    light.colour = list.size() == 1 ? glm::dvec3(list[0]) : glm::dvec3(list[0], list[1], list[2]);
    light.colour /= kWhite;
    light.intensity = list.size() > 3 ? list[3] / kWhite : 1;
    light.encoding = ColourEncoding::gamma_2_2;
    return true;
}

/// 1/f through (0, 1), (d50, 2), (d0, 256); drawn towards a straight line until it rises from the start.
pbr::Falloff half_and_zero(double d50, double d0) {
    pbr::Falloff law;
    for (int blend = 0; blend <= 20; ++blend) {
        const double middle = 2 + (1 + 255 * d50 / d0 - 2) * (blend / 20.);
        law.quadratic = (255 / d0 - (middle - 1) / d50) / (d0 - d50);
        law.linear = (middle - 1) / d50 - law.quadratic * d50;
        if (2 * law.quadratic + law.linear >= 0) break;
    }
    law.linear = std::max(law.linear, 0.);  // at most 2 units of distance are lost by this
    law.quadratic = std::max(law.quadratic, 0.);
    const double scale = 2 / (1 + d50 * (law.linear + d50 * law.quadratic));
    law.constant *= scale, law.linear *= scale, law.quadratic *= scale;
    return law;
}

void read_distances(const EntityValues& values, double d50, LegacyLight& light) {
    double d0 = values.number("_zero_percent_distance", 0);
    if (d0 <= d50) {
        light.diagnostics.push_back({Severity::warning, "zero_percent_distance", light.line,
                                     "has a _zero_percent_distance that isn't beyond its "
                                     "_fifty_percent_distance; twice the latter is taken"});
        d0 = 2 * d50;
    }
    light.falloff = half_and_zero(d50, d0);
    if (values.number("_hardfalloff", 0) == 0) return;
    light.falloff.window = pbr::FalloffWindow::smootherstep;
    light.falloff.begin = .75 * d0 + .25 * d50;
    light.falloff.range = d0;
}

void read_falloff(const EntityValues& values, LegacyLight& light) {
    const double d50 = values.number("_fifty_percent_distance", 0);
    if (d50 > 0) return read_distances(values, d50, light);
    const auto coefficient = [&](std::string_view key) {
        constexpr double kNothing = 1e-3;  // vrad's EQUAL_EPSILON
        const double value = values.number(key, 0);
        return value < kNothing ? 0 : value;
    };
    light.falloff = {coefficient("_constant_attn"), coefficient("_linear_attn"),
                     coefficient("_quadratic_attn")};
    const double at_100 =
        light.falloff.constant + 100 * (light.falloff.linear + 100 * light.falloff.quadratic);
    if (at_100 > 0) light.intensity *= at_100;
    const double distance = values.number("_distance", 0);
    if (distance > 0) light.falloff.window = pbr::FalloffWindow::cut, light.falloff.range = distance;
}

/// Where vrad takes a 0 for no number, so does this.
glm::dvec3 direction_of_angles(const EntityValues& values) {
    const glm::dvec3 angles = values.vector("angles", glm::dvec3(0));
    const double yaw = values.number("angle", 0), pitch = values.number("pitch", 0);
    return direction_of(yaw != 0 ? yaw : angles.y, pitch != 0 ? pitch : angles.x);
}

void read_spot(const EntityValues& values, LegacyLight& light) {
    double inner = values.number("_inner_cone", 0), outer = values.number("_cone", 0);
    if (inner == 0) inner = 10;
    if (outer < inner) outer = inner;  // in vrad the inner cone wins
    if (inner == 180 && outer == 180) return;
    constexpr double kWidest_deg = 90;
    const double exponent = values.number("_exponent", 0);
    light.type = LightType::spot;
    light.spot = {pbr::SpotLaw::cosine_ramp, std::min(inner, kWidest_deg) * kRadPerDegree,
                  std::min(outer, kWidest_deg) * kRadPerDegree, exponent == 0 ? 1 : exponent, 1};
}

/// A sky: its sun, and what comes from all of it.
void add_environment(const EntityValues& values, LegacyLight sun, LightFile& file) {
    sun.type = LightType::directional;
    LegacyLight ambient = sun;
    ambient.type = LightType::ambient;
    ambient.name += " ambient";
    const double scale = values.number("_AmbientScaleHDR", 1);
    if (read_brightness(values, "_ambientHDR", ambient) || read_brightness(values, "_ambient", ambient))
        ambient.intensity *= scale;
    else
        ambient.intensity *= .5 * scale;
    file.lights.push_back(std::move(sun));
    file.lights.push_back(std::move(ambient));
}

void add_light(const EntityValues& values, const Targets& targets, LightFile& file) {
    LegacyLight light = values.light(file.lights.size());
    const std::string_view kind = values.entity().value("classname");
    if (!read_brightness(values, "_lightHDR", light) && !read_brightness(values, "_light", light)) {
        light.intensity = 0;
        if (values.entity().has("_light"))
            light.diagnostics.push_back(
                {Severity::warning, "light_illegal", light.line,
                 "has a negative number in its _light, or a count that isn't 1, 3, 4 or 8, which vrad "
                 "takes for no light"});
    }
    light.intensity *= values.number("_lightscaleHDR", 1);
    const auto target = targets.towards(values.entity(), light.position);
    light.direction = target ? *target : direction_of_angles(values);
    if (kind == "light_environment") return add_environment(values, std::move(light), file);
    read_falloff(values, light);
    if (kind == "light_spot") read_spot(values, light);
    file.lights.push_back(std::move(light));
}

}  // namespace

LightFile parse_source_lights(const std::vector<MapEntity>& entities, const std::string& file) {
    LightFile result;
    result.format = "Source map";
    result.meaning =
        "_light r g b 255 at 100 units lights a white surface to white (vrad); a unit is 1/16 "
        "foot, 0.01905 m";
    result.unit_m = kUnit_m;
    result.up = UpAxis::z;
    const Targets targets(entities, file);
    for (const MapEntity& entity : entities)
        if (is_light(entity)) add_light(EntityValues(entity, file), targets, result);
    return result;
}

}  // namespace pbrbake::parse
