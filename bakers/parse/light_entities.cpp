// Lights of maps made of entities: tells Source's VMF from Quake's.

#include <algorithm>
#include <array>

#include "bakers/parse/entity_values.hpp"
#include "bakers/parse/light_formats.hpp"

namespace pbrbake::parse {
namespace {

bool is_source_light(const MapEntity& entity) {
    constexpr std::array<std::string_view, 5> kKeys{"_constant_attn", "_linear_attn", "_quadratic_attn",
                                                    "_fifty_percent_distance", "_lightHDR"};
    const std::string_view light = entity.value("_light");
    return is_light(entity) &&
           (std::any_of(kKeys.begin(), kKeys.end(), [&](std::string_view key) { return entity.has(key); }) ||
            std::count(light.begin(), light.end(), ' ') >= 2);
}

}  // namespace

LightFile parse_entity_lights(std::string_view text, const std::string& file) {
    const std::vector<MapEntity> entities = read_map_entities(text, file);
    const bool is_source = std::any_of(entities.begin(), entities.end(), is_source_light);
    return is_source ? parse_source_lights(entities, file) : parse_quake_lights(entities, file);
}

}  // namespace pbrbake::parse
