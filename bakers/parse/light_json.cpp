// The plain JSON format: {"unit": "relative", "length_m": 1, "lights": [{"type": "point", …}]}. README.md of
// bakers/light describes it.

#include <string>
#include <vector>

#include "bakers/parse/json_fields.hpp"
#include "bakers/parse/light_formats.hpp"
#include "bakers/parse/light_plain.hpp"
#include "bakers/parse/text.hpp"

namespace pbrbake::parse {
namespace {

using Keys = std::vector<std::string>;

const Keys kFileKeys{"unit", "length_m", "up", "colours", "colors", "lights"};
const Keys kLawKeys{"constant", "linear", "quadratic", "attenuation", "exponent", "range", "window"};
const Keys kLightKeys{"name",      "type",      "unit",          "intensity", "colour", "color",
                      "position",  "direction", "radius",        "width",     "height", "inner_deg",
                      "outer_deg", "spot_law",  "spot_exponent", "falloff"};

Keys both(Keys keys, const Keys& others) {
    keys.insert(keys.end(), others.begin(), others.end());
    return keys;
}

bool is_falloff_object(const JsonFields& light) {
    return light.has("falloff") && light.json()["falloff"].is_object();
}

/// Refuses what is no field of a light or of its falloff. A falloff that is an object holds all of its law.
void check_keys(const JsonFields& light) {
    static const Keys light_keys = both(kLightKeys, kLawKeys), falloff_keys = both({"kind"}, kLawKeys);
    light.allow(light_keys);
    if (!is_falloff_object(light)) return;
    light.object({"falloff"})->allow(falloff_keys);
    for (const std::string& key : kLawKeys)
        if (light.has(key)) light.refuse(key, "nothing here beside a falloff that is an object, but in it");
}

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

/// The numbers of a law, beside its name.
PlainFalloff read_law(const JsonFields& fields) {
    PlainFalloff plain;
    const auto list = fields.vector({"attenuation"});
    if (list) plain.constant = list->x, plain.linear = list->y, plain.quadratic = list->z;
    plain.states_coefficients = list.has_value();
    const auto read = [&](const char* key, double& coefficient) {
        const auto value = fields.number({key});
        if (!value) return;
        if (list) fields.refuse(key, "none beside attenuation, which holds it");
        coefficient = *value;
        plain.states_coefficients = true;
    };
    read("constant", plain.constant);
    read("linear", plain.linear);
    read("quadratic", plain.quadratic);
    plain.exponent = fields.number({"exponent"});
    plain.range = fields.number({"range"});
    plain.window = fields.text({"window"}, "");
    return plain;
}

/// `falloff` is an object that holds all of its law, or a name (or nothing) beside the law's numbers.
pbr::Falloff read_falloff(const JsonFields& light, LightUnit unit) {
    const bool is_object = is_falloff_object(light);
    const JsonFields fields = is_object ? *light.object({"falloff"}) : light;
    const char* const name = is_object ? "kind" : "falloff";
    PlainFalloff plain = read_law(fields);
    plain.kind = fields.text({name}, "");
    pbr::Falloff law;
    if (const auto mistake = make_falloff(plain, unit, law))
        fields.refuse(mistake->field == "falloff" ? name : mistake->field, mistake->allowed);
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

LegacyLight read_light(const JsonFields& fields, LightUnit file_unit, ColourEncoding encoding,
                       std::size_t i) {
    check_keys(fields);
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
    if (const auto mistake = mistake_of_sizes(light)) fields.refuse(mistake->field, mistake->allowed);
    return light;
}

}  // namespace

LightFile parse_plain_lights(const Json& json, const std::string& file) {
    const JsonFields root(json, file);
    LightFile lights;
    lights.format = "plain JSON";
    root.allow(kFileKeys);
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
