// All nine formats: what comes out is valid glTF to Khronos's validator, and what is broken is told.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>

#include "bakers/job/json_text.hpp"
#include "bakers/parse/lights.hpp"
#include "tests/bakers/job/temporary_folder.hpp"
#include "tests/bakers/light/fixtures.hpp"

namespace pbrbake::light::test {
namespace {

using pbrbake::test::TemporaryFolder;

/// A light or more of each format, cones and hard cases among them.
struct Format {
    const char *name, *text;
};

constexpr std::array<Format, 10> kFormats{{
    {"a.dae", R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><unit meter="0.01"/><up_axis>Z_UP</up_axis></asset>
<library_lights><light id="L" name="Lamp"><technique_common><spot><color>1 .5 .25</color><constant_attenuation>1</constant_attenuation>
<quadratic_attenuation>0.04</quadratic_attenuation><falloff_angle>180</falloff_angle><falloff_exponent>1</falloff_exponent></spot></technique_common></light></library_lights>
<library_visual_scenes><visual_scene id="S"><node><rotate>1 0 0 90</rotate><translate>0 0 5</translate><instance_light url="#L"/></node></visual_scene></library_visual_scenes>
</COLLADA>
)"},
    {"a.gltf",
     R"({"asset": {"version": "2.0"}, "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "intensity": 40, "range": 12,
 "spot": {"innerConeAngle": 0.6, "outerConeAngle": 0.6}}, {"type": "directional", "intensity": 120000}, {"type": "point"}]}},
 "nodes": [{"translation": [1, 2, 3], "extensions": {"KHR_lights_punctual": {"light": 0}}}, {"scale": [0, 2, 2],
 "extensions": {"KHR_lights_punctual": {"light": 1}}}], "scenes": [{"nodes": [0, 1]}]})"},
    {"b.json",
     R"({"metadata": {"version": 4.6, "type": "Object"}, "object": {"type": "Scene", "children": [
 {"type": "PointLight", "color": 16711680, "intensity": 2, "distance": 10, "decay": 2, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 3,4,5,1]},
 {"type": "SpotLight", "angle": 1.5, "penumbra": 1}, {"type": "RectAreaLight", "width": 2}, {"type": "AmbientLight"}]}})"},
    {"c.json",
     R"({"lights": [{"type": "spot", "outer_deg": 90, "direction": [0, 0, 1], "attenuation": [1, 0.5, 0.25]}, {"type": "sun"},
 {"type": "sphere", "radius": 0.1, "unit": "lm", "intensity": 800}, {"intensity": -1}, {"colour": [0, 0, 0]}, {"falloff": "constant"}]})"},
    {"d.csv",
     "name,type,intensity,x,y,z,falloff,range,outer_deg\n\"a, "
     "b\",point,2,1,2,3,linear,10,\nc,spot,1,,,,,,0.5\n"},
    {"e.map",
     "{\n\"classname\" \"worldspawn\"\n\"_sunlight\" \"64\"\n\"light\" \"8\"\n}\n{\n\"classname\" "
     "\"light\"\n\"origin\" \"1 2 3\"\n}\n"
     "{\n\"classname\" \"light\"\n\"delay\" \"5\"\n\"mangle\" \"90 -45 0\"\n\"_softangle\" \"20\"\n}\n"},
    {"f.vmf",
     "entity\n{\n\"classname\" \"light_spot\"\n\"_light\" \"255 128 0 200\"\n\"_inner_cone\" "
     "\"45\"\n\"_cone\" \"90\"\n"
     "\"_quadratic_attn\" \"1\"\n\"pitch\" \"-90\"\n}\nentity\n{\n\"classname\" "
     "\"light_environment\"\n\"_light\" \"255 255 255 900\"\n}\n"},
    {"g.ogex",
     "Metric (key = \"distance\") {float {0.01}}\nLightObject $l (type = \"spot\") {Name {string {\"Lamp\"}} "
     "Color (attrib = \"light\") {float[3] "
     "{{1, 0.5, 0.25}}}\nAtten (curve = \"inverse_square\") {Param (attrib = \"scale\") {float {50}}}\nAtten "
     "(kind = \"cos_angle\", curve = "
     "\"smooth\") {Param (attrib = \"begin\") {float {0.9}} Param (attrib = \"end\") {float "
     "{0.1}}}}\nLightNode $n {ObjectRef {ref {$l}}}\n"},
    {"h.ac",
     "AC3Db\nMATERIAL \"\" rgb 1 1 1  amb 1 1 1  emis 0 0 0  spec 1 1 1  shi 10  trans 0\nOBJECT world\nkids "
     "1\nOBJECT light\nname \"lamp\"\nloc 1 2 3\nkids 0\n"},
    {"i.ent",
     "{\n\"classname\" \"light\"\n\"light\" \"-200\"\n\"delay\" \"2\"\n}\n{\n\"classname\" "
     "\"light\"\n\"_light\" \"1 0 0 300\"\n\"wait\" \"0.001\"\n}\n"},
}};

TEST(LightFormats, WriteWhatKhronosValidatorTakes) {
    const std::filesystem::path external = std::filesystem::path(PBRBAKE_SOURCE_DIR) / "tests" / "external";
    if (std::system("node --version >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "node (package nodejs) is not installed";
    if (!std::filesystem::exists(external / "node_modules" / "gltf-validator"))
        GTEST_SKIP() << "gltf-validator is not installed: npm ci --prefix tests/external";
    const TemporaryFolder folder;
    std::string command = "node '" + (external / "check_gltf.mjs").string() + "'";
    for (const Format& format : kFormats) {
        const Baked baked = bake_text(format.text, defaults(), format.name);
        command += " '" +
                   folder.write(std::string(format.name) + ".gltf", job::to_text(baked.gltf())).string() +
                   "'";
    }
    EXPECT_EQ(std::system((command + " >&2").c_str()), 0);
    // It does look at lights.
    const std::string wrong = folder.write("wrong.gltf", R"({"asset": {"version": "2.0"}, "extensionsUsed":
        ["KHR_lights_punctual"], "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot"}]}}})");
    EXPECT_NE(
        std::system(("node '" + (external / "check_gltf.mjs").string() + "' '" + wrong + "' >/dev/null 2>&1")
                        .c_str()),
        0);
}

/// The message of a refusal; empty where the file is read.
std::string refusal(const std::string& text, const std::string& name) {
    try {
        parse::parse_lights(parse::test::bytes_of(text), name);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::unreadable_input) << error.what();
        EXPECT_THAT(error.what(), testing::HasSubstr(name));
        return error.what();
    }
    return "";
}

TEST(LightFormats, CutAnywhereAreReadOrRefused) {
    for (const Format& format : kFormats) {
        const std::string text = format.text;
        std::size_t refused = 0;
        for (std::size_t size = 0; size < text.size(); ++size)
            refused += !refusal(text.substr(0, size), format.name).empty();
        EXPECT_GT(refused, 0u) << format.name;
    }
}

TEST(LightFormats, SayWhatIsNoNumber) {
    for (const char* number : {"NaN", "inf", "1e999", "-1e40", "0x10", "1,5"})
        for (const auto& [name, text, place] :
             {std::tuple{"a.dae",
                         "<COLLADA><library_lights><light id='L'><technique_common><point><color>@ 1 "
                         "1</color></point>"
                         "</technique_common></light></library_lights></COLLADA>",
                         "in <color>"},
              {"a.csv", "name,intensity\na,\"@\"\n", "as intensity"},
              {"a.map", "{\n\"classname\" \"light\"\n\"light\" \"@\"\n}\n", "as 'light'"},
              {"a.vmf",
               "entity\n{\n\"classname\" \"light\"\n\"_quadratic_attn\" \"@\"\n\"_light\" \"1 1 1 1\"\n}\n",
               "as '_quadratic_attn'"},
              {"a.ogex", "LightObject (type = \"point\") {Param (attrib = \"intensity\") {float {@}}}",
               "allowed: a finite number"},
              {"a.ac", "AC3Db\nOBJECT world\nkids 1\nOBJECT light\nloc @ 0 0\nkids 0\n", "a.ac:5"}}) {
            // A comma parts OpenGEX's and AC3D's numbers.
            if (std::string(number) == "1,5" &&
                (std::string(name) == "a.ogex" || std::string(name) == "a.ac"))
                continue;
            std::string file = text;
            file.replace(file.find('@'), 1, number);
            EXPECT_THAT(refusal(file, name), testing::HasSubstr(place)) << number << " in " << name;
        }
}

TEST(LightFormats, NestNoDeeperThanTheyNeed) {
    constexpr int kDepth = 100'000;
    const auto repeated = [](const std::string& text) {
        std::string all;
        for (int i = 0; i < kDepth; ++i) all += text;
        return all;
    };
    for (const auto& [name, text] :
         {std::pair{"a.dae", "<COLLADA><library_visual_scenes><visual_scene>" + repeated("<node>")},
          {"b.dae", "<COLLADA><library_visual_scenes><visual_scene>" + repeated("<node>") +
                        repeated("</node>") + "</visual_scene></library_visual_scenes></COLLADA>"},
          {"a.json", repeated("[")},
          {"b.json", repeated("{\"lights\":")},
          {"a.map", repeated("{\n")},
          {"a.ogex", repeated("Node {")},
          {"a.ac", "AC3Db\n" + repeated("OBJECT group\nkids 1\n")}})
        EXPECT_NE(refusal(text, name), "") << name;
    // Entities that hold entities are not expanded.
    EXPECT_NE(refusal("<!DOCTYPE a [<!ENTITY b \"bb\"><!ENTITY c \"&b;&b;&b;\">]><COLLADA>&c;", "c.dae"), "");
}

TEST(LightFormats, OtherEncodingsAreNamed) {
    for (const Format& format : kFormats) {
        std::string wide = "\xFF\xFE";
        for (const char* c = format.text; *c != 0; ++c) wide += {*c, '\0'};
        EXPECT_THAT(refusal(wide, format.name), testing::HasSubstr("UTF-16")) << format.name;
        EXPECT_EQ(refusal("\xEF\xBB\xBF" + std::string(format.text), format.name), "") << format.name;
        EXPECT_THAT(refusal("", format.name), testing::HasSubstr("is empty"));
    }
}

}  // namespace
}  // namespace pbrbake::light::test
