// The plain JSON format: {"unit": "relative", "length_m": 1, "lights": [{"type": "point", …}]}. README.md of
// bakers/light describes it.

#include <algorithm>
#include <array>
#include <span>

#include "bakers/parse/json_fields.hpp"
#include "bakers/parse/light_formats.hpp"
#include "bakers/parse/light_plain.hpp"
#include "bakers/parse/text.hpp"

namespace pbrbake::parse {
namespace {

int hex_digit(char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

/// "#rrggbb", which is sRGB, or three numbers.
void read_colour(const JsonFields& fields, LegacyLight& light) {
    const char* key = fields.has("colour") ? "colour" : "color";
    if (!fields.has(key)) return;
    if (!fields.json()[key].is_string()) {
        light.colour = *fields.vector({key});
        return;
    }
    const std::string text = fields.text({key}, "");
    if (text.size() != 7 || text[0] != '#') fields.refuse(key, "three numbers or \"#rrggbb\"");
    for (int i = 0; i < 3; ++i) {
        const int high = hex_digit(text[static_cast<std::size_t>(1 + 2 * i)]),
                  low = hex_digit(text[static_cast<std::size_t>(2 + 2 * i)]);
        if (high < 0 || low < 0) fields.refuse(key, "three numbers or \"#rrggbb\"");
        light.colour[i] = (16 * high + low) / 255.;
    }
    light.encoding = ColourEncoding::srgb;
}

pbr::Falloff read_falloff(const JsonFields& light, LightUnit unit) {
    PlainFalloff plain;
    const auto take = [&](const JsonFields& from) {
        plain.constant = from.number({"constant", "constant_attenuation"}, plain.constant);
        plain.linear = from.number({"linear", "linear_attenuation"}, plain.linear);
        plain.quadratic = from.number({"quadratic", "quadratic_attenuation"}, plain.quadratic);
        plain.exponent = from.number({"exponent"}, plain.exponent);
        plain.window = from.text({"window"}, plain.window);
        if (const auto range = from.number({"range"})) plain.range = *range, plain.range_is_stated = true;
        for (const char* key : {"constant", "linear", "quadratic", "constant_attenuation",
                                "linear_attenuation", "quadratic_attenuation"})
            if (from.has(key) && plain.kind.empty()) plain.kind = "polynomial";
    };
    if (const auto range = light.number({"range"})) plain.range = *range, plain.range_is_stated = true;
    const JsonFields* named = &light;
    std::optional<JsonFields> inner;
    if (light.has("falloff") && light.json()["falloff"].is_string()) {
        plain.kind = light.text({"falloff"}, "");
    } else if ((inner = light.object({"falloff"}))) {
        plain.kind = inner->text({"kind"}, "");
        named = &*inner;
        take(*inner);
    } else if (light.has("attenuation") && light.json()["attenuation"].is_array()) {
        const auto list = light.vector({"attenuation"});
        plain.kind = "polynomial";
        plain.constant = list->x, plain.linear = list->y, plain.quadratic = list->z;
    } else if ((inner = light.object({"attenuation"}))) {
        take(*inner);
    } else {
        take(light);
    }
    const bool is_physical = unit != LightUnit::relative;
    if (plain.kind.empty()) plain.kind = plain.range_is_stated && !is_physical ? "linear" : "inverse_square";
    pbr::Falloff law;
    if (!make_falloff(plain, law)) named->refuse(named == &light ? "falloff" : "kind", kFalloffNames);
    if (law.window == pbr::FalloffWindow::ramp && !plain.range_is_stated)
        named->refuse("range", "the distance at which the ramp is dark");
    return law;
}

pbr::SpotFalloff read_spot(const JsonFields& light) {
    pbr::SpotFalloff spot;
    spot.outer_rad = light.number({"outer_deg"}, 45) * kRadPerDegree;
    spot.inner_rad = light.number({"inner_deg"}, 0) * kRadPerDegree;
    const std::string law = light.text({"spot_law"}, light.has("spot_exponent") ? "cosine_power"
                                                     : light.has("inner_deg")   ? "cosine_ramp"
                                                                                : "hard");
    if (law == "cosine_power") {
        spot.law = pbr::SpotLaw::cosine_power;
    } else if (law == "cosine_ramp") {
        spot.law = pbr::SpotLaw::cosine_ramp;
    } else if (law == "smoothstep") {
        spot.law = pbr::SpotLaw::smoothstep;
    } else if (law != "hard") {
        light.refuse("spot_law", "hard, cosine_power, cosine_ramp, smoothstep");
    }
    spot.exponent = light.number({"spot_exponent"}, law == "cosine_ramp" ? 2 : law == "smoothstep" ? 1 : 0);
    return spot;
}

/// Members that describe a falloff, of a light or of an object in it.
constexpr std::array<std::string_view, 9> kFalloffMembers{
    "constant",  "constant_attenuation",  "exponent", "linear", "linear_attenuation",
    "quadratic", "quadratic_attenuation", "range",    "window"};
constexpr std::array<std::string_view, 17> kLightMembers{
    "attenuation",   "color",     "colour", "direction", "falloff",  "height",
    "inner_deg",     "intensity", "name",   "outer_deg", "position", "radius",
    "spot_exponent", "spot_law",  "type",   "unit",      "width"};

/// A misspelt member would change a light unseen.
void tell_unread(const JsonFields& fields, std::vector<Diagnostic>& diagnostics) {
    const auto tell = [&](const Json& members, std::span<const std::string_view> known,
                          const std::string& where) {
        for (const auto& [key, value] : members.items())
            if (std::ranges::find(known, key) == known.end() &&
                std::ranges::find(kFalloffMembers, key) == kFalloffMembers.end())
                diagnostics.push_back({Severity::warning, "unread", 0,
                                       "has " + parse::quoted(key) + where + ", which isn't read"});
    };
    constexpr std::array<std::string_view, 1> kKind{"kind"};
    tell(fields.json(), kLightMembers, "");
    for (const std::string key : {"falloff", "attenuation"})
        if (fields.has(key) && fields.json()[key].is_object())
            tell(fields.json()[key], kKind, " in its " + key);
}

LegacyLight read_light(const JsonFields& fields, LightUnit file_unit, ColourEncoding encoding,
                       std::size_t i) {
    LegacyLight light;
    light.name = fields.text({"name"}, "light " + std::to_string(i));
    if (!read_light_type(fields.text({"type"}, "point"), light.type)) fields.refuse("type", kLightTypeNames);
    light.unit = unit_for(light.type, file_unit);
    if (fields.has("unit")) {
        const auto unit = light_unit(fields.text({"unit"}, ""));
        if (!unit) fields.refuse("unit", kLightUnitNames);
        light.unit = *unit;
        if (unit_for(light.type, *unit) != *unit)
            fields.refuse("unit", "a unit that a light of its type can have");
    }
    light.intensity = fields.number({"intensity"}, 1);
    light.encoding = encoding;
    read_colour(fields, light);
    light.position = fields.vector({"position"}).value_or(light.position);
    light.direction = fields.vector({"direction"}).value_or(light.direction);
    light.radius = fields.number({"radius"}, 0);
    light.width = fields.number({"width"}, 0);
    light.height = fields.number({"height"}, 0);
    if (light.type != LightType::directional && light.type != LightType::ambient)
        light.falloff = read_falloff(fields, light.unit);
    if (light.type == LightType::spot) light.spot = read_spot(fields);
    tell_unread(fields, light.diagnostics);
    return light;
}

}  // namespace

LightFile parse_plain_lights(const Json& json, const std::string& file) {
    const JsonFields root(json, file);
    LightFile lights;
    lights.format = "plain JSON";
    const auto unit = light_unit(root.text({"unit"}, "relative"));
    if (!unit) root.refuse("unit", kLightUnitNames);
    lights.meaning = *unit == LightUnit::relative
                         ? "1 lights a white surface that faces the light, where nothing fades it, to white"
                         : "the file's unit is " + root.text({"unit"}, "relative");
    if (const auto length = root.number({"length_m"})) {
        if (!(*length > 0)) root.refuse("length_m", "metres of a length of 1, above 0");
        lights.unit_m = *length;
        lights.unit_is_stated = true;
    }
    const std::string encoding = root.text({"colours", "colors"}, "linear"), up = root.text({"up"}, "y");
    if (encoding != "linear" && encoding != "srgb") root.refuse("colours", "linear, srgb");
    if (up != "y" && up != "z") root.refuse("up", "y, z");
    lights.up = up == "z" ? UpAxis::z : UpAxis::y;
    const std::vector<JsonFields> list = root.objects("lights");
    if (list.size() > kMostLights)
        root.refuse("lights", "at most " + std::to_string(kMostLights) + " lights");
    for (std::size_t i = 0; i < list.size(); ++i)
        lights.lights.push_back(read_light(
            list[i], *unit, encoding == "srgb" ? ColourEncoding::srgb : ColourEncoding::linear, i));
    return lights;
}

}  // namespace pbrbake::parse
