#pragma once
// The readers behind parse_lights, one a format. Each takes a whole text; README.md says where each format's
// meaning is defined.

#include <optional>
#include <string>
#include <string_view>

#include "bakers/baker.hpp"
#include "bakers/parse/lights.hpp"

namespace pbrbake::parse {

LightFile parse_plain_lights(const Json& json, const std::string& file);
LightFile parse_gltf_lights(const Json& json, const std::string& file, GltfUnits units);
LightFile parse_three_lights(const Json& json, const std::string& file, ThreeLights three);
LightFile parse_csv_lights(std::string_view text, const std::string& file);
LightFile parse_collada_lights(std::string_view text, const std::string& file);
LightFile parse_entity_lights(std::string_view text, const std::string& file);
LightFile parse_opengex_lights(std::string_view text, const std::string& file);
LightFile parse_ac3d_lights(std::string_view text, const std::string& file);

/// A name's own unit: "cd", "lm", "lm_over_pi", "lm_over_4pi", "lx", "nit", "W", "W/m2", "relative".
std::optional<LightUnit> light_unit(std::string_view name);

/// The number a word is; FLT_MAX is one. Nothing for NaN, infinities, and what is no number.
std::optional<double> finite_number(std::string_view word);

/// Largest count of lights that a file may hold.
inline constexpr std::size_t kMostLights = 100'000;

/// For a spot whose file gives an inner angle: one beyond the outer is kept, and told.
inline constexpr double kRadPerDegree = 0.017453292519943295;

}  // namespace pbrbake::parse
