// Lights of a COLLADA document (1.4.1 specification, "Lighting"): attenuation 1 / (constant + linear d +
// quadratic d^2), a spot's cos^falloff_exponent inside falloff_angle, which exporters write as the cone's
// full angle (Blender, OpenCOLLADA). Colours hold the intensity; they have no unit. Blender
// (LightExporter.cpp) writes energy times colour, which are watts since 2.80, and the blend of its cone as
// the exponent.

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <pugixml.hpp>
#include <set>

#include "bakers/parse/collada_document.hpp"
#include "bakers/parse/light_formats.hpp"
#include "bakers/parse/scene_transform.hpp"
#include "bakers/parse/text.hpp"
#include "pbr/numerics/elementary.hpp"

namespace pbrbake::parse {
namespace {

constexpr int kDeepest = 128;

/// Of a version that begins "2.79.0" or "4.1".
bool is_since_280(std::string_view version) {
    const auto number = [&] {
        double value = 0;
        while (!version.empty() && version.front() >= '0' && version.front() <= '9') {
            value = 10 * value + (version.front() - '0');
            version.remove_prefix(1);
        }
        if (version.starts_with('.')) version.remove_prefix(1);
        return value;
    };
    const double major = number();
    return major > 2 || (major == 2 && number() >= 80);
}

class Collada : ColladaDocument {
  public:
    Collada(std::string_view text, const std::string& file) : ColladaDocument(text, file) {}

    LightFile read() {
        LightFile lights;
        lights.format = "COLLADA";
        lights.meaning =
            "a colour of 1 lights a white surface that faces the light, where nothing fades it, to "
            "white; COLLADA's lights have no unit";
        const pugi::xml_node asset = root_.child("asset");
        if (const pugi::xml_attribute meter = asset.child("unit").attribute("meter")) {
            const auto value = finite_number(trimmed(meter.value()));
            if (!value || !(*value > 0))
                throw malformed(file_, line_of(asset.child("unit")),
                                "found " + parse::quoted(meter.value()) +
                                    " as metres of a unit; allowed: a number above 0");
            lights.unit_m = *value;
            lights.unit_is_stated = true;
        }
        if (trimmed(asset.child_value("up_axis")) == "Z_UP") lights.up = UpAxis::z;
        const std::string_view tool = trimmed(asset.child("contributor").child_value("authoring_tool"));
        is_in_watts_ = tool.starts_with("Blender ") && is_since_280(tool.substr(8));
        for (const pugi::xml_node light : root_.child("library_lights").children("light"))
            if (light.attribute("id")) lights_.emplace(light.attribute("id").value(), light);
        for (const pugi::xml_node scene : root_.child("library_visual_scenes").children("visual_scene"))
            for (const pugi::xml_node node : scene.children("node")) walk(node, glm::dmat4(1), 0, lights);
        for (const auto& [id, node] : lights_)
            if (!used_.contains(id)) {
                LegacyLight light = read_light(node);
                light.diagnostics.push_back({Severity::note, "not_placed", light.line,
                                             "is on no node of the scene; converted at the origin"});
                lights.lights.push_back(std::move(light));
            }
        return lights;
    }

  private:
    std::vector<double> numbers(const pugi::xml_node& node, std::size_t least, std::size_t most) const {
        std::vector<double> list;
        std::string_view rest = node.child_value();
        for (;;) {
            const std::size_t begin = rest.find_first_not_of(" \t\r\n");
            if (begin == rest.npos) break;
            rest.remove_prefix(begin);
            const std::size_t end = std::min(rest.find_first_of(" \t\r\n"), rest.size());
            const auto value = finite_number(rest.substr(0, end));
            if (!value)
                throw malformed(file_, line_of(node),
                                "found " + parse::quoted(rest.substr(0, end)) + " in <" + node.name() +
                                    ">; allowed: finite numbers");
            list.push_back(*value);
            rest.remove_prefix(end);
        }
        if (list.size() < least || list.size() > most)
            throw malformed(file_, line_of(node),
                            "found " + std::to_string(list.size()) + " numbers in <" + node.name() +
                                ">; allowed: " + std::to_string(least));
        return list;
    }
    double number(const pugi::xml_node& parent, const char* name, double fallback) const {
        const pugi::xml_node node = parent.child(name);
        return node ? numbers(node, 1, 1).front() : fallback;
    }

    LegacyLight read_light(const pugi::xml_node& node) const {
        LegacyLight light;
        light.line = line_of(node);
        light.name = node.attribute("name") ? node.attribute("name").value() : node.attribute("id").value();
        const pugi::xml_node common = node.child("technique_common"), kind = common.first_child();
        const std::string name = kind.name();
        if (name == "point" || name == "spot") {
            light.falloff = {number(kind, "constant_attenuation", 1), number(kind, "linear_attenuation", 0),
                             number(kind, "quadratic_attenuation", 0)};
        } else if (name == "directional") {
            light.type = LightType::directional;
        } else if (name == "ambient") {
            light.type = LightType::ambient;
        } else {
            throw malformed(file_, light.line,
                            "found a light of kind " + parse::quoted(name) +
                                "; allowed: point, spot, directional, ambient");
        }
        if (const pugi::xml_node colour = kind.child("color")) {
            const std::vector<double> rgb = numbers(colour, 3, 4);
            light.colour = {rgb[0], rgb[1], rgb[2]};
        }
        if (name == "spot") {
            light.type = LightType::spot;
            light.spot = {pbr::SpotLaw::cosine_power, 0,
                          number(kind, "falloff_angle", 180) / 2 * kRadPerDegree,
                          number(kind, "falloff_exponent", 0)};
        }
        read_extras(node, light);
        return light;
    }

    /// FCollada's multiplier, and what Blender means by its numbers.
    void read_extras(const pugi::xml_node& node, LegacyLight& light) const {
        for (const pugi::xml_node extra : node.children("extra"))
            for (const pugi::xml_node technique : extra.children("technique")) {
                const std::string_view profile = technique.attribute("profile").value();
                if (profile == "FCOLLADA") light.intensity *= number(technique, "intensity", 1);
                if (profile == "blender") read_blender(technique, light);
            }
        if (!is_in_watts_ || light.type == LightType::ambient) return;
        const bool is_sun = light.type == LightType::directional;
        light.unit = is_sun ? LightUnit::watt_per_m2 : LightUnit::watt;
        if (!is_sun) light.falloff = {0, 0, 1};
        light.diagnostics.push_back(
            {Severity::note, "blender_watts", light.line,
             "is Blender's of 2.80 or later: watts, whatever attenuation is written"});
    }

    /// Blender writes the blend of its cone as the exponent: what share of the cone's cosine a smoothstep
    /// takes.
    void read_blender(const pugi::xml_node& technique, LegacyLight& light) const {
        constexpr int kArea = 4;
        if (number(technique, "type", 0) == kArea)
            light.diagnostics.push_back({Severity::warning, "blender_area", light.line,
                                         "was an area light, which Blender writes as a point light"});
        if (!light.spot) return;
        pbr::SpotFalloff& spot = *light.spot;
        const double outer = pbr::sin_cos_pi(spot.outer_rad / std::numbers::pi).cos,
                     inner = outer + std::clamp(spot.exponent, 0., 1.) * (1 - outer);
        spot.law = pbr::SpotLaw::smoothstep;
        spot.inner_rad = pbr::atan2_exact(std::sqrt((1 - inner) * (1 + inner)), inner);
        spot.exponent = 1;
    }

    glm::dmat4 transform_of(const pugi::xml_node& node) const {
        glm::dmat4 product(1);
        for (const pugi::xml_node step : node.children()) {
            const std::string_view name = step.name();
            if (name == "matrix") {
                product = product * matrix_of(numbers(step, 16, 16), true);
            } else if (name == "translate") {
                const auto v = numbers(step, 3, 3);
                product = product * matrix_of({v[0], v[1], v[2]}, {0, 0, 0, 1}, glm::dvec3(1));
            } else if (name == "scale") {
                const auto v = numbers(step, 3, 3);
                product = product * matrix_of(glm::dvec3(0), {0, 0, 0, 1}, {v[0], v[1], v[2]});
            } else if (name == "rotate") {
                const auto v = numbers(step, 4, 4);
                product = product * turn_about({v[0], v[1], v[2]}, v[3] / 180);
            }
        }
        return product;
    }

    void walk(const pugi::xml_node& node, const glm::dmat4& above, int depth, LightFile& lights) {
        if (depth == kDeepest)
            throw malformed(file_, line_of(node),
                            "nests nodes deeper than " + std::to_string(kDeepest) + " levels");
        const glm::dmat4 world = above * transform_of(node);
        for (const pugi::xml_node instance : node.children("instance_light")) {
            std::string id = instance.attribute("url").value();
            if (id.starts_with('#')) id.erase(0, 1);
            const auto found = lights_.find(id);
            if (found == lights_.end())
                throw malformed(file_, line_of(instance),
                                "places the light " + parse::quoted(id) + ", which isn't there");
            if (lights.lights.size() == kMostLights)
                throw malformed(file_, line_of(instance), "is past 100000 lights");
            LegacyLight light = read_light(found->second);
            place(light, world);
            used_.insert(id);
            lights.lights.push_back(std::move(light));
        }
        for (const pugi::xml_node child : node.children("node")) walk(child, world, depth + 1, lights);
    }

    std::map<std::string, pugi::xml_node> lights_;
    std::set<std::string> used_;
    bool is_in_watts_ = false;
};

}  // namespace

LightFile parse_collada_lights(std::string_view text, const std::string& file) {
    return Collada(text, file).read();
}

}  // namespace pbrbake::parse
