// Lights of a Quake map, as id's light.exe (qutils/LIGHT/LTFACE.C, SingleLightFace) and its successor
// ericw-tools (light/ltface.cc, GetLightValue; light/entities.cc, SetupSpotlights) read them.
//
// The compilers scale what they write by `_range`, 1/2 unless a map says otherwise, and engines what they
// read by 264/128 (WinQuake/gl_rsurf.c, R_BuildLightMap; r_light.c, style "m"); 255 of that is white. So a
// light of 247.27 lights a white surface to white.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/parse/entity_values.hpp"
#include "bakers/parse/light_formats.hpp"
#include "bakers/parse/text.hpp"

namespace pbrbake::parse {
namespace {

constexpr double kUnit_m = 1. / 32;
constexpr double kEngineScale = 264. / 128 / 255;
constexpr double kInverseScale = 128;  ///< LF_SCALE: where inverse laws leave the light as stated

/// Keys come with an underscore or without.
double either(const EntityValues& values, const std::string& key, double fallback) {
    return values.number(key, values.number("_" + key, fallback));
}

/// From 0 to 1, or bytes if any component is out of that.
glm::dvec3 colour_of(const glm::dvec3& colour) {
    const bool is_unit =
        std::min({colour.x, colour.y, colour.z}) >= 0 && std::max({colour.x, colour.y, colour.z}) <= 1;
    return is_unit ? colour : colour / 255.;
}

constexpr int kUnknownDelay = -1;

int delay_of(const EntityValues& values) {
    const double delay = either(values, "delay", 0);
    return delay >= 0 && delay < 6 ? static_cast<int>(delay) : kUnknownDelay;
}

pbr::Falloff falloff_of(const EntityValues& values, double light) {
    const double stated = either(values, "wait", 1), wait = stated > 0 ? stated : 1,
                 range = either(values, "falloff", 0), slope = wait / kInverseScale;
    pbr::Falloff law;
    switch (delay_of(values)) {
        case 1:
            law.constant = 0, law.linear = slope;
            break;
        case 2:
            law.constant = 0, law.quadratic = slope * slope;
            break;
        case 3:
        case 4:
            break;
        case 5:
            law = {1, 2 * slope, slope * slope};
            break;
        default:
            law.window = pbr::FalloffWindow::ramp;
            law.range = range > 0 ? range : std::abs(light) / wait;
    }
    return law;
}

void read_spot(const EntityValues& values, const Targets& targets, LegacyLight& light) {
    const std::vector<double> mangle = values.numbers(values.entity().has("mangle") ? "mangle" : "_mangle");
    const auto target = targets.towards(values.entity(), light.position);
    if (mangle.size() == 3)
        light.direction = direction_of(mangle[0], mangle[1]);
    else if (target)
        light.direction = *target;
    else
        return;
    constexpr double kDefault_deg = 40;
    const double cone = 2 * either(values, "cone", 0), angle = cone != 0 ? cone : either(values, "angle", 0);
    light.type = LightType::spot;
    pbr::SpotFalloff& spot = light.spot.emplace();
    spot.outer_rad = (angle != 0 ? angle : kDefault_deg) / 2 * kRadPerDegree;
    const double soft = either(values, "softangle", 0);
    if (soft > 0) {
        spot.law = pbr::SpotLaw::cosine_ramp;
        spot.inner_rad = soft / 2 * kRadPerDegree;
    }
}

/// `unit` is what a light of 1 is of white.
LegacyLight read_light(const EntityValues& values, const Targets& targets, double unit, LegacyLight light) {
    const std::vector<double> stated =
        values.numbers(values.entity().has("light") || !values.entity().has("_light") ? "light" : "_light");
    constexpr double kDefault = 300;
    const double value = stated.size() == 4                     ? stated[3]
                         : stated.empty() || stated.size() == 3 ? kDefault
                                                                : stated[0];
    glm::dvec3 colour(1);
    if (stated.size() >= 3) colour = {stated[0], stated[1], stated[2]};
    light.intensity = value * unit;
    light.colour = colour_of(values.vector("_color", values.vector("color", colour)));
    light.falloff = falloff_of(values, value);
    if (delay_of(values) == kUnknownDelay) {
        light.intensity = 0;
        light.diagnostics.push_back(
            {Severity::warning, "delay_unknown", light.line,
             "has a delay that compilers know no law for, and leave dark; allowed: 0 to 5"});
    }
    read_spot(values, targets, light);
    return light;
}

/// A map's sun and its minimum light are keys of its world.
void read_world(const EntityValues& world, double unit, LightFile& file) {
    const double sun = world.number("_sunlight", 0),
                 least = either(world, "minlight", world.number("light", 0));
    LegacyLight light;
    light.line = world.entity().line;
    if (sun != 0) {
        light.name = "sunlight";
        light.type = LightType::directional;
        light.intensity = sun * unit;
        light.colour = colour_of(world.vector("_sunlight_color", glm::dvec3(1)));
        const std::vector<double> mangle = world.numbers("_sun_mangle");
        light.direction = mangle.size() == 3 ? direction_of(mangle[0], mangle[1]) : glm::dvec3(0, 0, -1);
        file.lights.push_back(light);
    }
    if (least != 0) {
        light.name = "minlight";
        light.type = LightType::ambient;
        light.intensity = least * unit;
        light.colour = colour_of(world.vector("_minlight_color", glm::dvec3(1)));
        file.lights.push_back(light);
    }
    if (world.number("_sunlight2", 0) != 0 || world.number("_sunlight3", 0) != 0)
        file.diagnostics.push_back(
            {Severity::warning, "sky_dome", world.entity().line,
             "has a dome of light (_sunlight2, _sunlight3), which is left out; a probe or "
             "sky takes its place"});
}

}  // namespace

LightFile parse_quake_lights(const std::vector<MapEntity>& entities, const std::string& file) {
    LightFile result;
    result.format = "Quake map";
    result.meaning =
        "light 247.3 lights a white surface to white (light.exe's 1/2, GLQuake's 264/128); a unit is "
        "taken as 1/32 m";
    result.unit_m = kUnit_m;
    result.up = UpAxis::z;
    const Targets targets(entities, file);
    double unit = .5 * kEngineScale;
    for (const MapEntity& entity : entities) {
        const EntityValues values(entity, file);
        if (entity.value("classname") == "worldspawn") {
            unit = std::max(values.number("_range", .5), 0.) * kEngineScale;
            read_world(values, unit, result);
        } else if (is_light(entity)) {
            LegacyLight light = values.light(result.lights.size());
            result.lights.push_back(read_light(values, targets, unit, std::move(light)));
        }
    }
    return result;
}

}  // namespace pbrbake::parse
