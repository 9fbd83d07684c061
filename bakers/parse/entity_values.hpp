#pragma once
// What the lights of Quake and Source maps have in common: numbers in keys, angles, targets.

#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/parse/lights.hpp"
#include "bakers/parse/map_entities.hpp"

namespace pbrbake::parse {

/// An entity's numbers, with errors that name its line.
class EntityValues {
  public:
    EntityValues(const MapEntity& entity, const std::string& file) : entity_(entity), file_(file) {}

    /// All numbers of a value; none where the key is absent or empty.
    std::vector<double> numbers(std::string_view key) const;
    /// The first of them.
    double number(std::string_view key, double fallback) const;
    /// A vector of three; the fallback where the key is absent or empty.
    glm::dvec3 vector(std::string_view key, const glm::dvec3& fallback) const;

    const MapEntity& entity() const { return entity_; }
    /// A light of its own name, line and place; `count` names those without a name. Throws past kMostLights.
    LegacyLight light(std::size_t count) const;

  private:
    [[noreturn]] void refuse(std::string_view key, const char* allowed) const;

    const MapEntity& entity_;
    const std::string& file_;
};

/// Origins of a map's entities by targetname, the first of a name.
class Targets {
  public:
    Targets(const std::vector<MapEntity>& entities, const std::string& file);

    /// From a place to an entity's target; nothing where it has none, or one that isn't there.
    std::optional<glm::dvec3> towards(const MapEntity& entity, const glm::dvec3& from) const;

  private:
    const std::string& file_;
    std::map<std::string_view, const MapEntity*> entities_;
};

/// Whether a compiler takes the entity for a light.
bool is_light(const MapEntity& entity);

/// Direction of yaw and pitch in degrees, pitch upwards; x is east, z is up.
glm::dvec3 direction_of(double yaw_deg, double pitch_deg);

/// The lights of a whole map, by the engine it was made for.
LightFile parse_quake_lights(const std::vector<MapEntity>& entities, const std::string& file);
LightFile parse_source_lights(const std::vector<MapEntity>& entities, const std::string& file);

}  // namespace pbrbake::parse
