#pragma once
// Lights of older formats as their files state them: one model for all, nothing converted yet.
//
// A light's illuminance on a surface that faces it is
//     intensity * colour * falloff(distance in the file's lengths) * spot(angle) * what 1 is worth in lux,
// and what 1 is worth is known where `unit` is physical.

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/parse/diagnostic.hpp"
#include "pbr/legacy/falloff.hpp"

namespace pbrbake::parse {

enum class LightType { point, spot, directional, ambient, sphere, rectangle };

/// What the intensity is a number of. relative: 1 lights a white surface to white.
enum class LightUnit {
    relative,
    candela,
    lumen,            ///< over the solid angle that the light really fills
    lumen_over_pi,    ///< a spot's candela are its lumens over pi, as in Frostbite
    lumen_over_4_pi,  ///< over the whole sphere, also for spots
    lux,              ///< of a directional light
    nit,              ///< luminance of an area light
    watt,             ///< radiant, over the sphere (spots too) or a Lambertian area: Blender's
    watt_per_sr,      ///< radiant intensity: Blender's glTF in its "unitless" mode
    watt_per_m2,      ///< irradiance of a directional light: Blender's sun
};

/// How a file's colours are encoded.
enum class ColourEncoding { linear, srgb, gamma_2_2 };

/// One light. Numbers are as in the file: negative, zero and absurd ones are for the baker to judge.
struct LegacyLight {
    std::string name;
    int line = 0;  ///< counted from 1; 0: unknown
    LightType type = LightType::point;
    LightUnit unit = LightUnit::relative;
    double intensity = 1;
    glm::dvec3 colour{1};
    ColourEncoding encoding = ColourEncoding::linear;
    pbr::Falloff falloff;  ///< directional and ambient lights have the constant one
    std::optional<pbr::SpotFalloff> spot;
    double radius = 0;             ///< of the source
    double width = 0, height = 0;  ///< of a rectangle
    glm::dvec3 position{0};
    glm::dvec3 direction{0, 0, -1};       ///< in which it shines; any length
    std::vector<Diagnostic> diagnostics;  ///< of this light alone
};

enum class UpAxis { y, z };

/// All lights of a file. Positions and directions are in its own right-handed axes.
struct LightFile {
    std::string format;   ///< "Quake map"
    std::string meaning;  ///< what an intensity of 1 meant, and what that was taken from
    double unit_m = 1;    ///< metres that a length of 1 is
    bool unit_is_stated = false;
    UpAxis up = UpAxis::y;
    std::vector<LegacyLight> lights;
    std::vector<Diagnostic> diagnostics;
};

/// three.js changed its lights in r155 and files hardly tell which they were made for.
enum class ThreeLights { automatic, legacy, physical };

/// What Blender's glTF exporter wrote: candela and lux, as glTF has it; W/sr and W/m^2, its "unitless" mode;
/// or its own W and W/m^2, its "raw" mode.
enum class GltfUnits { standard, unitless, raw };

/// What files don't tell of themselves.
struct LightConventions {
    ThreeLights three = ThreeLights::automatic;
    GltfUnits gltf = GltfUnits::standard;
};

/// Reads a file of any format known, told by its content: glTF, three.js, plain JSON, COLLADA, Quake map,
/// Source VMF, OpenGEX, AC3D, CSV. `file` is for messages. Throws Error(unreadable_input).
LightFile parse_lights(std::span<const std::byte> bytes, std::string_view file,
                       const LightConventions& conventions = {});

}  // namespace pbrbake::parse
