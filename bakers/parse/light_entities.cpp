// Lights of Quake maps (as ericw-tools' light reads them: GetLightValue, SetSpotlight; id's light.exe where
// no key asks for more) and of Source's VMF (vrad's lightmap.cpp: LightForString, SetLightFalloffParams,
// ParseLightSpot).
//
// Quake: 128 lights a white surface to white, as engines scale lightmaps by 264/256 * 2 (GLQuake,
// R_BuildLightMap). Source: 255 does, colours are 2.2 gamma, and brightness is that at 100 units.

#include <algorithm>
#include <array>
#include <cmath>

#include "bakers/parse/light_formats.hpp"
#include "bakers/parse/map_entities.hpp"
#include "bakers/parse/text.hpp"
#include "pbr/numerics/elementary.hpp"

namespace pbrbake::parse {
namespace {

constexpr double kQuakeWhite = 128, kSourceWhite = 255;
constexpr double kQuakeUnit_m = 1. / 32, kSourceUnit_m = .01905;
constexpr double kQuakeScale = 128;  ///< LF_SCALE: where inverse laws leave the light as stated

/// An entity's numbers, with errors that name its line.
class Values {
  public:
    Values(const MapEntity& entity, const std::string& file) : entity_(entity), file_(file) {}

    const MapEntity& entity() const { return entity_; }

    /// All numbers of a value; none where the key is absent or empty.
    std::vector<double> numbers(std::string_view key) const {
        std::vector<double> list;
        std::string_view rest = trimmed(entity_.value(key));
        while (!rest.empty()) {
            const std::size_t end = std::min(rest.find_first_of(" \t"), rest.size());
            const auto value = finite_number(rest.substr(0, end));
            if (!value)
                throw malformed(file_, entity_.line,
                                "found " + parse::quoted(entity_.value(key)) + " as " + parse::quoted(key) +
                                    " of the entity that begins here; allowed: finite numbers");
            list.push_back(*value);
            rest = trimmed(rest.substr(end));
        }
        return list;
    }
    double number(std::string_view key, double fallback) const {
        const std::vector<double> list = numbers(key);
        return list.empty() ? fallback : list.front();
    }
    /// Quake's keys come with an underscore or without.
    double either(const std::string& key, double fallback) const {
        return number(key, number("_" + key, fallback));
    }
    glm::dvec3 vector(std::string_view key, const glm::dvec3& fallback) const {
        const std::vector<double> list = numbers(key);
        return list.size() == 3 ? glm::dvec3(list[0], list[1], list[2]) : fallback;
    }

  private:
    const MapEntity& entity_;
    const std::string& file_;
};

/// Of yaw and pitch in degrees, pitch upwards; x is east, z is up.
glm::dvec3 direction_of(double yaw_deg, double pitch_deg) {
    const auto bounded = [](double degrees) { return std::fmod(degrees, 360.) / 180; };
    const pbr::SinCos yaw = pbr::sin_cos_pi(bounded(yaw_deg)), pitch = pbr::sin_cos_pi(bounded(pitch_deg));
    return {yaw.cos * pitch.cos, yaw.sin * pitch.cos, pitch.sin};
}

const MapEntity* target_of(const MapEntity& entity, const std::vector<MapEntity>& all) {
    if (!entity.has("target") || entity.value("target").empty()) return nullptr;
    for (const MapEntity& other : all)
        if (other.value("targetname") == entity.value("target")) return &other;
    return nullptr;
}

// --- Quake ---------------------------------------------------------------------------------------------

pbr::Falloff quake_falloff(const Values& values, double light) {
    const double wait = std::max(values.either("wait", 1), 0.), range = values.either("falloff", 0);
    const double slope = wait / kQuakeScale;
    pbr::Falloff law;
    switch (static_cast<int>(std::clamp(values.either("delay", 0), 0., 5.))) {
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
            if (wait == 0 && !(range > 0)) break;
            law.window = pbr::FalloffWindow::ramp;
            law.range = range > 0 ? range : std::abs(light) / wait;
    }
    return law;
}

glm::dvec3 quake_colour(const Values& values) {
    const glm::dvec3 colour = values.vector("_color", values.vector("color", glm::dvec3(1)));
    const bool is_bytes = colour.x > 1 || colour.y > 1 || colour.z > 1;
    return is_bytes ? colour / 255. : colour;
}

void quake_spot(const Values& values, const std::vector<MapEntity>& all, const std::string& file,
                LegacyLight& light) {
    const std::vector<double> mangle = values.numbers(values.entity().has("mangle") ? "mangle" : "_mangle");
    const MapEntity* target = target_of(values.entity(), all);
    if (mangle.size() == 3)
        light.direction = direction_of(mangle[0], mangle[1]);
    else if (target)
        light.direction = Values(*target, file).vector("origin", glm::dvec3(0)) - light.position;
    else
        return;
    light.type = LightType::spot;
    pbr::SpotFalloff& spot = light.spot.emplace();
    spot.outer_rad = values.either("angle", 40) / 2 * kRadPerDegree;
    const double soft = values.either("softangle", 0);
    if (soft > 0) {
        spot.law = pbr::SpotLaw::cosine_ramp;
        spot.inner_rad = soft / 2 * kRadPerDegree;
        spot.exponent = 1;
    }
}

void read_quake(const Values& values, const std::vector<MapEntity>& all, const std::string& file,
                LegacyLight light, LightFile& lights) {
    const double value = values.either("light", 300);
    light.intensity = value / kQuakeWhite;
    light.colour = quake_colour(values);
    light.falloff = quake_falloff(values, value);
    quake_spot(values, all, file, light);
    lights.lights.push_back(std::move(light));
}

/// A map's sun and its minimum light are keys of its world.
void read_quake_world(const Values& values, LightFile& lights) {
    const double sun = values.number("_sunlight", 0),
                 least = values.either("minlight", values.number("light", 0));
    LegacyLight light;
    light.line = values.entity().line;
    if (sun != 0) {
        light.name = "sunlight";
        light.type = LightType::directional;
        light.intensity = sun / kQuakeWhite;
        light.colour = values.vector("_sunlight_color", glm::dvec3(1));
        const std::vector<double> mangle = values.numbers("_sun_mangle");
        light.direction = mangle.size() == 3 ? direction_of(mangle[0], mangle[1]) : glm::dvec3(0, 0, -1);
        lights.lights.push_back(light);
    }
    if (least != 0) {
        light.name = "minlight";
        light.type = LightType::ambient;
        light.intensity = least / kQuakeWhite;
        light.colour = values.vector("_minlight_color", glm::dvec3(1));
        lights.lights.push_back(light);
    }
}

// --- Source --------------------------------------------------------------------------------------------

/// Colour and brightness of "r g b brightness"; false where the key has none.
bool source_light(const Values& values, std::string_view key, LegacyLight& light) {
    const std::vector<double> list = values.numbers(key);
    const bool is_undefined = list.size() >= 3 && list[0] == -1 && list[1] == -1 && list[2] == -1;
    if (list.empty() || is_undefined) return false;
    const bool is_grey = list.size() < 3;
    light.colour = is_grey ? glm::dvec3(list[0] / 255) : glm::dvec3(list[0], list[1], list[2]) / 255.;
    light.intensity = list.size() > 3 ? list[3] / kSourceWhite : 1;
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

void source_falloff(const Values& values, LegacyLight& light) {
    constexpr double kNothing = 1e-3;  // vrad's EQUAL_EPSILON
    const double d50 = values.number("_fifty_percent_distance", 0);
    if (d50 > 0) {
        double d0 = values.number("_zero_percent_distance", 0);
        if (d0 <= d50) {
            light.diagnostics.push_back({Severity::warning, "zero_percent_distance", light.line,
                                         "has a _zero_percent_distance that isn't beyond its "
                                         "_fifty_percent_distance; twice the latter is taken"});
            d0 = 2 * d50;
        }
        light.falloff = half_and_zero(d50, d0);
        if (values.number("_hardfalloff", 0) != 0) {
            light.falloff.window = pbr::FalloffWindow::smootherstep;
            light.falloff.begin = .75 * d0 + .25 * d50;
            light.falloff.range = d0;
        }
        return;
    }
    const auto coefficient = [&](std::string_view key) {
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

glm::dvec3 source_direction(const Values& values, const std::vector<MapEntity>& all, const std::string& file,
                            const LegacyLight& light) {
    if (const MapEntity* target = target_of(values.entity(), all))
        return Values(*target, file).vector("origin", glm::dvec3(0)) - light.position;
    const glm::dvec3 angles = values.vector("angles", glm::dvec3(0));
    return direction_of(angles.y, values.number("pitch", angles.x));
}

void source_spot(const Values& values, LegacyLight& light) {
    light.type = LightType::spot;
    double inner = values.number("_inner_cone", 0), outer = values.number("_cone", 0);
    if (inner == 0) inner = 10;
    if (outer < inner) outer = inner;  // as vrad has it: there the inner cone wins
    if (inner == 180 && outer == 180) {
        light.type = LightType::point;
        return;
    }
    const double exponent = values.number("_exponent", 0);
    light.spot = {pbr::SpotLaw::cosine_ramp, inner * kRadPerDegree, outer * kRadPerDegree,
                  exponent == 0 ? 1 : exponent};
}

void read_source(const Values& values, const std::vector<MapEntity>& all, const std::string& file,
                 LegacyLight light, LightFile& lights) {
    const std::string_view kind = values.entity().value("classname");
    const bool is_hdr = source_light(values, "_lightHDR", light);
    if (!is_hdr && !source_light(values, "_light", light)) light.intensity = 0;
    if (is_hdr) light.intensity *= values.number("_lightscaleHDR", 1);
    light.direction = source_direction(values, all, file, light);
    if (kind != "light_environment") {
        source_falloff(values, light);
        if (kind == "light_spot") source_spot(values, light);
        lights.lights.push_back(std::move(light));
        return;
    }
    light.type = LightType::directional;
    LegacyLight ambient = light;
    lights.lights.push_back(std::move(light));
    ambient.type = LightType::ambient;
    ambient.name += " ambient";
    if (source_light(values, "_ambientHDR", ambient) || source_light(values, "_ambient", ambient))
        lights.lights.push_back(std::move(ambient));
}

bool is_source_light(const MapEntity& entity) {
    constexpr std::array<std::string_view, 5> kKeys{"_constant_attn", "_linear_attn", "_quadratic_attn",
                                                    "_fifty_percent_distance", "_lightHDR"};
    return std::any_of(kKeys.begin(), kKeys.end(), [&](std::string_view key) { return entity.has(key); }) ||
           std::count(entity.value("_light").begin(), entity.value("_light").end(), ' ') >= 2;
}

}  // namespace

LightFile parse_entity_lights(std::string_view text, const std::string& file) {
    const std::vector<MapEntity> entities = read_map_entities(text, file);
    const auto is_light = [](const MapEntity& entity) {
        return entity.value("classname").starts_with("light") && entity.value("classname") != "light_dynamic";
    };
    const bool is_source = std::any_of(entities.begin(), entities.end(), [&](const MapEntity& entity) {
        return is_light(entity) && is_source_light(entity);
    });
    LightFile lights;
    lights.format = is_source ? "Source map" : "Quake map";
    lights.meaning = is_source
                         ? "_light r g b 255 at 100 units lights a white surface to white (vrad); a unit is "
                           "1/16 foot, 0.01905 m"
                         : "light 128 lights a white surface to white (GLQuake's lightmaps, 264/128); a unit "
                           "is taken as 1/32 m";
    lights.unit_m = is_source ? kSourceUnit_m : kQuakeUnit_m;
    lights.up = UpAxis::z;
    for (const MapEntity& entity : entities) {
        const Values values(entity, file);
        if (!is_source && entity.value("classname") == "worldspawn") read_quake_world(values, lights);
        if (!is_light(entity)) continue;
        if (lights.lights.size() >= kMostLights) throw malformed(file, entity.line, "is past 100000 lights");
        LegacyLight light;
        light.line = entity.line;
        const std::string_view name = entity.value("targetname");
        light.name = name.empty()
                         ? std::string(entity.value("classname")) + " " + std::to_string(lights.lights.size())
                         : std::string(name);
        light.position = values.vector("origin", glm::dvec3(0));
        if (is_source)
            read_source(values, entities, file, std::move(light), lights);
        else
            read_quake(values, entities, file, std::move(light), lights);
    }
    return lights;
}

}  // namespace pbrbake::parse
