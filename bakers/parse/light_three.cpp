// Lights of a three.js scene ("JSON Object Scene format"). Until r154 an intensity of 1 lit a white surface
// to white, and point lights faded as (1 - d / distance)^decay; from r155 on they are candela, lux and nit,
// and fade as 1 / max(d^decay, .01) times a window (three.js lights_pars_begin.glsl.js before and after; the
// migration note "Updates to lighting in three.js r155"). Files tell their format's version only: 4.6, which
// came with r153, is read as physical, older ones as legacy.

#include <cmath>
#include <numbers>

#include "bakers/parse/json_fields.hpp"
#include "bakers/parse/light_formats.hpp"
#include "bakers/parse/scene_transform.hpp"
#include "bakers/parse/text.hpp"

namespace pbrbake::parse {
namespace {

glm::dvec3 colour_of(const JsonFields& fields, const char* key) {
    const double code = fields.number({key}, 0xFFFFFF);
    if (code < 0 || code > 0xFFFFFF || code != static_cast<double>(static_cast<int>(code)))
        fields.refuse(key, "a colour as a whole number from 0 to 16777215");
    const int rgb = static_cast<int>(code);
    return glm::dvec3(rgb >> 16 & 255, rgb >> 8 & 255, rgb & 255) / 255.;
}

pbr::Falloff falloff_of(const JsonFields& fields, bool is_physical) {
    pbr::Falloff law;
    const double distance = fields.number({"distance"}, 0);
    const double decay = fields.number({"decay"}, is_physical ? 2 : 1);
    if (!is_physical) {
        if (distance > 0 && decay > 0) {
            law.window = pbr::FalloffWindow::ramp;
            law.range = distance;
            law.exponent = decay;
        }
        return law;
    }
    if (decay > 0) law.power = decay, law.floor = .01;
    if (distance > 0) law.window = pbr::FalloffWindow::quartic_squared, law.range = distance;
    return law;
}

class Reader {
  public:
    Reader(bool is_physical, LightFile& file) : is_physical_(is_physical), file_(file) {}

    /// Adds an object's light, if it is one.
    void read(const JsonFields& fields, const glm::dmat4& world) {
        const std::string type = fields.text({"type"}, "");
        LegacyLight light;
        light.name = fields.text({"name"}, "");
        if (light.name.empty()) light.name = type + " " + std::to_string(file_.lights.size());
        light.encoding = ColourEncoding::srgb;
        place(light, world);
        if (type == "PointLight") {
            light.falloff = falloff_of(fields, is_physical_);
        } else if (type == "SpotLight") {
            light.type = LightType::spot;
            light.falloff = falloff_of(fields, is_physical_);
            pbr::SpotFalloff& spot = light.spot.emplace();
            spot.law = pbr::SpotLaw::smoothstep;
            spot.outer_rad = fields.number({"angle"}, 60 * kRadPerDegree);
            spot.inner_rad = spot.outer_rad * (1 - fields.number({"penumbra"}, 0));
            light.direction = -light.position;  // targets stand at the origin unless a scene moves them
        } else if (type == "DirectionalLight") {
            light.type = LightType::directional;
            light.direction = -light.position;
        } else if (type == "AmbientLight" || type == "HemisphereLight") {
            light.type = LightType::ambient;
        } else if (type == "RectAreaLight") {
            light.type = LightType::rectangle;
            light.width = fields.number({"width"}, 10);
            light.height = fields.number({"height"}, 10);
            light.falloff = {0, 0, 1};
        } else {
            if (type.ends_with("Light") || type == "LightProbe")
                file_.diagnostics.push_back(
                    {Severity::warning, "light_unread", 0,
                     parse::quoted(light.name) + " is a " + parse::quoted(type) + ", which isn't read"});
            return;
        }
        light.intensity = fields.number({"intensity"}, 1);
        light.colour = colour_of(fields, "color");
        if (type == "HemisphereLight") light.colour = (light.colour + colour_of(fields, "groundColor")) / 2.;
        set_unit(light);
        if (fields.has("target"))
            light.diagnostics.push_back(
                {Severity::note, "target", 0, "has a target of its own; taken to be at the origin"});
        if (file_.lights.size() == kMostLights) fields.refuse("type", "at most 100000 lights a file");
        file_.lights.push_back(std::move(light));
    }

    void walk(const JsonFields& root) {
        std::vector<std::pair<JsonFields, glm::dmat4>> waiting{{root, glm::dmat4(1)}};
        while (!waiting.empty()) {
            const auto [fields, parent] = waiting.back();
            waiting.pop_back();
            glm::dmat4 local(1);
            if (const auto matrix = fields.numbers({"matrix"}, 16))
                local = matrix_of(*matrix);
            else if (const auto position = fields.vector({"position"}))
                local[3] = glm::dvec4(*position, 1);
            const glm::dmat4 world = parent * local;
            read(fields, world);
            std::vector<JsonFields> children = fields.objects("children");
            for (auto child = children.rbegin(); child != children.rend(); ++child)
                waiting.emplace_back(*child, world);
        }
    }

  private:
    /// A legacy rectangle alone is not scaled by pi (WebGLLights: "intensity is the brightness of the
    /// light"): one of 1 looks as bright as a white wall lit by 1, so that the luminance is 1 / pi of that
    /// illuminance.
    void set_unit(LegacyLight& light) const {
        const bool is_rectangle = light.type == LightType::rectangle;
        const bool is_far = light.type == LightType::directional || light.type == LightType::ambient;
        if (is_physical_)
            light.unit = is_rectangle ? LightUnit::nit : is_far ? LightUnit::lux : LightUnit::candela;
        else if (is_rectangle)
            light.intensity *= std::abs(light.width * light.height) / std::numbers::pi;
    }

    bool is_physical_;
    LightFile& file_;
};

}  // namespace

LightFile parse_three_lights(const Json& json, const std::string& file, ThreeLights three) {
    const JsonFields root(json, file);
    const auto metadata = root.object({"metadata"});
    const double version = metadata ? metadata->number({"version"}, 0) : 0;
    const bool is_physical =
        three == ThreeLights::physical || (three == ThreeLights::automatic && version >= 4.6);
    LightFile result;
    result.format = "three.js scene";
    result.meaning = is_physical
                         ? "candela, lux and nit, a length of 1 is a metre (three.js r155 and later)"
                         : "1 lights a white surface that faces the light, where nothing fades it, to white "
                           "(three.js with useLegacyLights, until r154)";
    if (three == ThreeLights::automatic)
        result.diagnostics.push_back(
            {Severity::note, "three_lights", 0,
             std::string("does not tell whether its lights are legacy or physical; read "
                         "as ") +
                 (is_physical ? "physical" : "legacy") +
                 " by its format's version (three_lights states it)"});
    Reader reader(is_physical, result);
    if (const auto scene = root.object({"object", "scene"})) reader.walk(*scene);
    for (const JsonFields& light : root.objects("lights")) reader.walk(light);
    return result;
}

}  // namespace pbrbake::parse
