#include "bakers/parse/entity_values.hpp"

#include <algorithm>
#include <cmath>

#include "bakers/parse/light_formats.hpp"
#include "bakers/parse/text.hpp"
#include "pbr/numerics/elementary.hpp"

namespace pbrbake::parse {

void EntityValues::refuse(std::string_view key, const char* allowed) const {
    throw malformed(file_, entity_.line,
                    "found " + parse::quoted(entity_.value(key)) + " as " + parse::quoted(key) +
                        " of the entity that begins here; allowed: " + allowed);
}

std::vector<double> EntityValues::numbers(std::string_view key) const {
    std::vector<double> list;
    std::string_view rest = trimmed(entity_.value(key));
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find_first_of(" \t"), rest.size());
        const auto value = finite_number(rest.substr(0, end));
        if (!value) refuse(key, "finite numbers");
        list.push_back(*value);
        rest = trimmed(rest.substr(end));
    }
    return list;
}

double EntityValues::number(std::string_view key, double fallback) const {
    const std::vector<double> list = numbers(key);
    return list.empty() ? fallback : list.front();
}

glm::dvec3 EntityValues::vector(std::string_view key, const glm::dvec3& fallback) const {
    const std::vector<double> list = numbers(key);
    if (list.empty()) return fallback;
    if (list.size() != 3) refuse(key, "three numbers");
    return {list[0], list[1], list[2]};
}

LegacyLight EntityValues::light(std::size_t count) const {
    if (count >= kMostLights) throw malformed(file_, entity_.line, "is past 100000 lights");
    LegacyLight light;
    light.line = entity_.line;
    light.name = entity_.value("targetname");
    if (light.name.empty())
        light.name = std::string(entity_.value("classname")) + " " + std::to_string(count);
    light.position = vector("origin", glm::dvec3(0));
    return light;
}

Targets::Targets(const std::vector<MapEntity>& entities, const std::string& file) : file_(file) {
    for (const MapEntity& entity : entities)
        if (!entity.value("targetname").empty()) entities_.emplace(entity.value("targetname"), &entity);
}

std::optional<glm::dvec3> Targets::towards(const MapEntity& entity, const glm::dvec3& from) const {
    const auto found = entities_.find(entity.value("target"));
    if (found == entities_.end()) return {};
    return EntityValues(*found->second, file_).vector("origin", glm::dvec3(0)) - from;
}

bool is_light(const MapEntity& entity) {
    return entity.value("classname").starts_with("light") && entity.value("classname") != "light_dynamic";
}

glm::dvec3 direction_of(double yaw_deg, double pitch_deg) {
    const auto bounded = [](double degrees) { return std::fmod(degrees, 360.) / 180; };
    const pbr::SinCos yaw = pbr::sin_cos_pi(bounded(yaw_deg)), pitch = pbr::sin_cos_pi(bounded(pitch_deg));
    return {yaw.cos * pitch.cos, yaw.sin * pitch.cos, pitch.sin};
}

}  // namespace pbrbake::parse
