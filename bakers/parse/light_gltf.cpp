// Lights of a glTF scene: KHR_lights_punctual (Khronos, 2020). Intensities are candela and lux, lengths
// metres, colours linear; the range is a window of 1 - (d / range)^4, as the extension recommends.

#include "bakers/parse/json_fields.hpp"
#include "bakers/parse/light_formats.hpp"
#include "bakers/parse/scene_transform.hpp"

namespace pbrbake::parse {
namespace {

constexpr const char* kExtension = "KHR_lights_punctual";

void read_spot(const JsonFields& fields, LegacyLight& light) {
    pbr::SpotFalloff& spot = light.spot.emplace();
    spot.law = pbr::SpotLaw::cosine_ramp;
    spot.exponent = 2;
    const auto cone = fields.object({"spot"});
    if (!cone) fields.refuse("spot", "an object, which a spot needs");
    spot.inner_rad = cone->number({"innerConeAngle"}, 0);
    spot.outer_rad = cone->number({"outerConeAngle"}, 45 * kRadPerDegree);
}

LightUnit unit_of(GltfUnits units, bool is_directional) {
    if (is_directional) return units == GltfUnits::standard ? LightUnit::lux : LightUnit::watt_per_m2;
    return units == GltfUnits::standard   ? LightUnit::candela
           : units == GltfUnits::unitless ? LightUnit::watt_per_sr
                                          : LightUnit::watt;
}

LegacyLight read_light(const JsonFields& fields, GltfUnits units, std::size_t i) {
    LegacyLight light;
    const std::string type = fields.text({"type"}, "");
    light.name = fields.text({"name"}, "light " + std::to_string(i));
    light.intensity = fields.number({"intensity"}, 1);
    light.colour = fields.vector({"color"}).value_or(glm::dvec3(1));
    light.unit = unit_of(units, type == "directional");
    if (type == "directional") {
        light.type = LightType::directional;
        return light;
    }
    if (type != "point" && type != "spot") fields.refuse("type", "\"point\", \"spot\", \"directional\"");
    light.falloff = {0, 0, 1};
    if (const auto range = fields.number({"range"})) {
        if (*range > 0) {
            light.falloff.window = pbr::FalloffWindow::quartic;
            light.falloff.range = *range;
        } else {
            light.diagnostics.push_back({Severity::warning, "range_not_positive", 0,
                                         "has a range that isn't above 0, which glTF doesn't allow; read as "
                                         "unlimited, as viewers do"});
        }
    }
    if (type == "spot") {
        light.type = LightType::spot;
        read_spot(fields, light);
    }
    return light;
}

glm::dmat4 transform_of(const JsonFields& node) {
    if (const auto matrix = node.numbers({"matrix"}, 16)) return matrix_of(*matrix);
    return matrix_of(node.vector({"translation"}).value_or(glm::dvec3(0)),
                     node.numbers({"rotation"}, 4).value_or(std::vector<double>{0, 0, 0, 1}),
                     node.vector({"scale"}).value_or(glm::dvec3(1)));
}

/// Walks the scene's nodes; each is visited once, so that a cycle ends.
class Scene {
  public:
    Scene(const JsonFields& root, const std::vector<LegacyLight>& lights)
        : nodes_(root.objects("nodes")), visited_(nodes_.size()), used_(lights.size()), lights_(lights) {}

    void walk(std::size_t start, const glm::dmat4& above, std::vector<LegacyLight>& placed) {
        std::vector<std::pair<std::size_t, glm::dmat4>> waiting{{start, above}};
        while (!waiting.empty()) {
            const auto [index, parent] = waiting.back();
            waiting.pop_back();
            if (visited_[index])
                nodes_[index].refuse("children", "nodes that form a tree: this one is reached twice");
            visited_[index] = true;
            const JsonFields& node = nodes_[index];
            const glm::dmat4 world = parent * transform_of(node);
            if (const auto extensions = node.object({"extensions"}))
                if (const auto extension = extensions->object({kExtension}))
                    add(node, *extension, world, placed);
            const std::vector<std::size_t> children = node.indices("children", nodes_.size());
            for (auto child = children.rbegin(); child != children.rend(); ++child)
                waiting.emplace_back(*child, world);
        }
    }

    /// Roots of the default scene, or nodes that are nobody's children.
    std::vector<std::size_t> roots(const JsonFields& root) const {
        const std::vector<JsonFields> scenes = root.objects("scenes");
        if (!scenes.empty())
            return scenes[root.index("scene", scenes.size()).value_or(0)].indices("nodes", nodes_.size());
        std::vector<bool> is_child(nodes_.size());
        for (const JsonFields& node : nodes_)
            for (const std::size_t child : node.indices("children", nodes_.size())) is_child[child] = true;
        std::vector<std::size_t> list;
        for (std::size_t i = 0; i < nodes_.size(); ++i)
            if (!is_child[i]) list.push_back(i);
        return list;
    }

    bool is_used(std::size_t light) const { return used_[light]; }

  private:
    void add(const JsonFields& node, const JsonFields& extension, const glm::dmat4& world,
             std::vector<LegacyLight>& placed) {
        const auto index = extension.index("light", lights_.size());
        if (!index) return;  // an extension on a node may be there for its extras
        used_[*index] = true;
        LegacyLight light = lights_[*index];
        if (node.has("name")) light.name = node.text({"name"}, "");
        place(light, world);
        placed.push_back(std::move(light));
    }

    std::vector<JsonFields> nodes_;
    std::vector<bool> visited_, used_;
    const std::vector<LegacyLight>& lights_;
};

}  // namespace

LightFile parse_gltf_lights(const Json& json, const std::string& file, GltfUnits units) {
    const JsonFields root(json, file);
    LightFile result;
    result.format = "glTF KHR_lights_punctual";
    result.meaning =
        units == GltfUnits::standard
            ? "candela for point and spot, lux for directional lights, metres (KHR_lights_punctual)"
        : units == GltfUnits::unitless
            ? "watts a steradian and watts a square metre, as Blender's \"unitless\" mode exports"
            : "watts and watts a square metre, as Blender's \"raw\" mode exports";
    result.unit_is_stated = true;
    std::vector<LegacyLight> lights;
    if (const auto extensions = root.object({"extensions"}))
        if (const auto extension = extensions->object({kExtension})) {
            const std::vector<JsonFields> list = extension->objects("lights");
            if (list.size() > kMostLights) extension->refuse("lights", "at most 100000 lights");
            for (std::size_t i = 0; i < list.size(); ++i) lights.push_back(read_light(list[i], units, i));
        }
    Scene scene(root, lights);
    for (const std::size_t start : scene.roots(root)) scene.walk(start, glm::dmat4(1), result.lights);
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (!scene.is_used(i)) {
            lights[i].diagnostics.push_back(
                {Severity::note, "not_placed", 0, "is on no node of the scene; converted at the origin"});
            result.lights.push_back(lights[i]);
        }
    return result;
}

}  // namespace pbrbake::parse
