#pragma once
// Parameters of a conversion of lights; schemas/job.schema.json, definitions/light, says what each means.

#include <array>
#include <string>
#include <vector>

#include "bakers/params.hpp"

namespace pbrbake {
namespace light {

enum class Shape { automatic, point, disk, rectangle };
enum class Colours { automatic, linear, srgb };
enum class ThreeLights { automatic, legacy, physical };
enum class GltfUnits { standard, unitless, raw };
enum class DocumentKind { json, gltf };

struct LightParams {
    std::string source;
    double ev100;
    double reference_illuminance_lx;  ///< 0: from ev100
    double unit_cd;                   ///< 0: not stated
    double unit_m;                    ///< 0: as the format has it
    Colours colours;
    double efficacy_lm_per_w;
    Shape shape;
    double near_m;  ///< 0: a twentieth of the reach
    double far_m;   ///< 0: nine tenths of it
    ThreeLights three_lights;
    GltfUnits gltf_units;
    std::vector<DocumentKind> documents;

    template <class Visit>
    static void fields(Visit&& visit) {
        visit("source", &LightParams::source);
        visit("ev100", &LightParams::ev100);
        visit("reference_illuminance_lx", &LightParams::reference_illuminance_lx);
        visit("unit_cd", &LightParams::unit_cd);
        visit("unit_m", &LightParams::unit_m);
        visit("colours", &LightParams::colours);
        visit("efficacy_lm_per_w", &LightParams::efficacy_lm_per_w);
        visit("shape", &LightParams::shape);
        visit("near_m", &LightParams::near_m);
        visit("far_m", &LightParams::far_m);
        visit("three_lights", &LightParams::three_lights);
        visit("gltf_units", &LightParams::gltf_units);
        visit("documents", &LightParams::documents);
    }
};

}  // namespace light

template <>
struct EnumNames<light::Shape> {
    static constexpr std::array<std::string_view, 4> names{"auto", "point", "disk", "rectangle"};
};
template <>
struct EnumNames<light::Colours> {
    static constexpr std::array<std::string_view, 3> names{"auto", "linear", "srgb"};
};
template <>
struct EnumNames<light::ThreeLights> {
    static constexpr std::array<std::string_view, 3> names{"auto", "legacy", "physical"};
};
template <>
struct EnumNames<light::GltfUnits> {
    static constexpr std::array<std::string_view, 3> names{"standard", "unitless", "raw"};
};
template <>
struct EnumNames<light::DocumentKind> {
    static constexpr std::array<std::string_view, 2> names{"json", "gltf"};
};

}  // namespace pbrbake
