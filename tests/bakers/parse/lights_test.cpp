// Lights of each format: what their numbers mean, and what malformed files are told.

#include "bakers/parse/lights.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/bakers/parse/fixtures.hpp"

namespace pbrbake::parse::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
using testing::HasSubstr;

LightFile read(const std::string& text, const std::string& name, ThreeLights three = ThreeLights::automatic) {
    return parse_lights(bytes_of(text), name, {three, GltfUnits::standard});
}

std::string refusal(const std::string& text, const std::string& name) {
    try {
        read(text, name);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::unreadable_input) << error.what();
        return error.what();
    }
    return "";
}

const char* const kQuake = R"(// a map
{
"classname" "worldspawn"
"_sunlight" "64"
"_sun_mangle" "0 -90 0"
{
( 0 0 0 ) ( 1 0 0 ) ( 0 1 0 ) brick 0 0 0 1 1 // a brush
}
}
{
"classname" "light"
"origin" "10 20 30"
}
{
"classname" "light_torch"
"light" "256"
"delay" "2"
"wait" "2"
"_color" "255 128 0"
}
{
"classname" "light"
"delay" "5"
"target" "floor"
"angle" "60"
"_softangle" "30"
}
{
"classname" "info_null"
"targetname" "floor"
"origin" "0 0 -64"
}
)";

TEST(QuakeLights, DefaultIsARampTo300Units) {
    const LightFile file = read(kQuake, "a.map");
    EXPECT_EQ(file.format, "Quake map");
    ASSERT_EQ(file.lights.size(), 4u);
    const LegacyLight& light = file.lights[1];
    EXPECT_EQ(light.intensity, 300. / 128);
    for (const double d : {0., 75., 299.})
        EXPECT_NEAR(light.intensity * pbr::falloff_at(light.falloff, d) * 128, 300 - d, 1e-9);
    EXPECT_EQ(pbr::falloff_at(light.falloff, 300), 0);
    EXPECT_EQ(light.position, glm::dvec3(10, 20, 30));
    EXPECT_EQ(light.line, 10);
}

TEST(QuakeLights, DelaysAreErics) {
    const LightFile file = read(kQuake, "a.map");
    // value = wait d; 2: light / (value/128)^2, 5: the same of value + 128.
    const LegacyLight &square = file.lights[2], &soft = file.lights[3];
    for (const double d : {1., 50., 700.}) {
        EXPECT_NEAR(pbr::falloff_at(square.falloff, d) * std::pow(2 * d / 128, 2), 1, 1e-12);
        EXPECT_NEAR(pbr::falloff_at(soft.falloff, d) * std::pow((d + 128) / 128, 2), 1, 1e-12);
    }
    EXPECT_NEAR(square.colour.y, 128 / 255., 1e-12);
    ASSERT_TRUE(soft.spot);
    EXPECT_NEAR(soft.spot->outer_rad, 30 * kDegree, 1e-12);
    EXPECT_NEAR(soft.spot->inner_rad, 15 * kDegree, 1e-12);
    EXPECT_EQ(soft.direction, glm::dvec3(0, 0, -64));
}

TEST(QuakeLights, SunIsAKeyOfTheWorld) {
    const LegacyLight sun = read(kQuake, "a.map").lights[0];
    EXPECT_EQ(sun.type, LightType::directional);
    EXPECT_EQ(sun.intensity, .5);
    EXPECT_NEAR(sun.direction.z, -1, 1e-12);
}

std::string vmf(const std::string& keys) {
    return "versioninfo\n{\n\"editorversion\" \"400\"\n}\nentity\n{\n\"id\" \"7\"\n" + keys +
           "\n\"origin\" \"1 2 3\"\neditor\n{\n\"color\" \"220 30 220\"\n}\n}\n";
}

TEST(SourceLights, BrightnessIsAtAHundredUnits) {
    const LightFile file = read(
        vmf("\"classname\" \"light\"\n\"_light\" \"255 255 255 200\"\n\"_quadratic_attn\" \"1\""), "a.vmf");
    EXPECT_EQ(file.format, "Source map");
    ASSERT_EQ(file.lights.size(), 1u);
    const LegacyLight& light = file.lights[0];
    EXPECT_NEAR(light.intensity * pbr::falloff_at(light.falloff, 100), 200. / 255, 1e-12);
    EXPECT_NEAR(light.intensity * pbr::falloff_at(light.falloff, 200), 50. / 255, 1e-12);
    EXPECT_EQ(light.encoding, ColourEncoding::gamma_2_2);
    EXPECT_EQ(light.position, glm::dvec3(1, 2, 3));
}

TEST(SourceLights, HalfDistanceHasHalfTheLight) {
    for (const char* zero : {"150", "400", "90"}) {  // 90 is before the half: twice that is taken
        const LightFile file =
            read(vmf(std::string("\"classname\" \"light\"\n\"_light\" \"255 255 255 255\"\n"
                                 "\"_fifty_percent_distance\" \"100\"\n\"_zero_percent_distance\" \"") +
                     zero + "\""),
                 "a.vmf");
        EXPECT_NEAR(pbr::falloff_at(file.lights[0].falloff, 100), .5, 1e-9) << zero;
        EXPECT_EQ(has(file.lights[0].diagnostics, "zero_percent_distance"), zero == std::string("90"));
    }
}

TEST(SourceLights, HardFalloffEndsAndSpotsHaveHalfAngles) {
    const LightFile file = read(vmf("\"classname\" \"light_spot\"\n\"_light\" \"255 255 255 "
                                    "255\"\n\"_fifty_percent_distance\" \"100\"\n"
                                    "\"_zero_percent_distance\" \"400\"\n\"_hardfalloff\" "
                                    "\"1\"\n\"_inner_cone\" \"20\"\n\"_cone\" \"45\"\n"
                                    "\"pitch\" \"-90\""),
                                "a.vmf");
    const LegacyLight& light = file.lights[0];
    EXPECT_GT(pbr::falloff_at(light.falloff, 324), 0);
    EXPECT_EQ(pbr::falloff_at(light.falloff, 400), 0);
    EXPECT_NEAR(light.spot->outer_rad, 45 * kDegree, 1e-12);
    EXPECT_NEAR(light.direction.z, -1, 1e-12);
}

TEST(MapEntities, SayWhereTheyBreak) {
    EXPECT_THAT(refusal("{\n\"classname\" \"light\"\n", "a.map"), HasSubstr("a.map:1: opens a brace"));
    EXPECT_THAT(refusal("{\n\"classname\" \"light\n}", "a.map"), HasSubstr("a.map:2: has a quote"));
    EXPECT_THAT(refusal("{\n\"classname\"\n}", "a.map"),
                HasSubstr("where the value of 'classname' should be"));
    EXPECT_THAT(refusal("}", "a.map"), HasSubstr("that none opened"));
    EXPECT_THAT(refusal("{\n\"classname\" \"light\"\n\"light\" \"bright\"\n}", "a.map"),
                HasSubstr("found 'bright' as 'light'"));
    EXPECT_THAT(refusal(std::string(100, '{'), "a.map"), HasSubstr("deeper than 64"));
}

std::string collada(const std::string& light, const std::string& nodes, const std::string& asset = "") {
    return "<?xml version=\"1.0\"?>\n<COLLADA "
           "xmlns=\"http://www.collada.org/2005/11/COLLADASchema\">\n<asset>" +
           asset + "</asset>\n<library_lights><light id=\"L\" name=\"Lamp\"><technique_common>" + light +
           "</technique_common></light></library_lights>\n<library_visual_scenes><visual_scene id=\"S\">" +
           nodes + "</visual_scene></library_visual_scenes>\n</COLLADA>\n";
}

TEST(ColladaLights, AttenuationIsOneOverTheSum) {
    const LightFile file = read(
        collada(
            "<point><color>1 .5 .25</color><constant_attenuation>1</constant_attenuation>"
            "<quadratic_attenuation>0.04</quadratic_attenuation></point>",
            "<node><translate>1 2 3</translate><node><rotate>1 0 0 90</rotate><translate>0 0 5</translate>"
            "<instance_light url=\"#L\"/></node></node>",
            "<unit meter=\"0.01\"/><up_axis>Z_UP</up_axis>"),
        "a.dae");
    EXPECT_EQ(file.unit_m, .01);
    EXPECT_EQ(file.up, UpAxis::z);
    ASSERT_EQ(file.lights.size(), 1u);
    EXPECT_NEAR(pbr::falloff_at(file.lights[0].falloff, 5), .5, 1e-12);
    EXPECT_NEAR(file.lights[0].position.y, 2 - 5, 1e-12);  // z turned to -y
    EXPECT_NEAR(file.lights[0].direction.y, 1, 1e-12);     // -z turned to y
    EXPECT_EQ(file.lights[0].name, "Lamp");
}

TEST(ColladaLights, SpotHasAFullAngleAndAnExponent) {
    const LightFile file = read(collada("<spot><color>1 1 1</color><falloff_angle>60</falloff_angle>"
                                        "<falloff_exponent>4</falloff_exponent></spot>",
                                        ""),
                                "a.dae");
    ASSERT_EQ(file.lights.size(), 1u);
    EXPECT_TRUE(has(file.lights[0].diagnostics, "not_placed"));
    const pbr::SpotFalloff& spot = *file.lights[0].spot;
    EXPECT_NEAR(spot.outer_rad, 30 * kDegree, 1e-12);
    EXPECT_NEAR(pbr::spot_falloff_at(spot, std::cos(.3)), std::pow(std::cos(.3), 4), 1e-12);
}

TEST(ColladaLights, SayWhereTheyBreak) {
    EXPECT_THAT(refusal("<COLLADA>\n<asset>", "a.dae"), HasSubstr("is no XML"));
    EXPECT_THAT(refusal("<svg/>", "a.dae"), HasSubstr("found the element 'svg'; allowed: COLLADA"));
    EXPECT_THAT(refusal(collada("<point><color>1 one 1</color></point>", ""), "a.dae"),
                HasSubstr("found 'one' in <color>"));
    EXPECT_THAT(refusal(collada("<point/>", "<node><instance_light url=\"#M\"/></node>"), "a.dae"),
                HasSubstr("places the light 'M', which isn't there"));
    EXPECT_THAT(refusal(collada("<laser/>", ""), "a.dae"), HasSubstr("allowed: point, spot"));
    EXPECT_THAT(refusal(collada("<point/>", "", "<unit meter=\"0\"/>"), "a.dae"), HasSubstr("above 0"));
}

TEST(ThreeLightsFile, LegacyAndPhysicalFadeApart) {
    const std::string scene =
        R"({"metadata": {"version": 4.5, "type": "Object"}, "object": {"type": "Scene", "children": [
        {"type": "PointLight", "name": "a", "color": 16711680, "intensity": 2, "distance": 10, "decay": 2,
         "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 3,4,5,1]},
        {"type": "SpotLight", "angle": 0.5, "penumbra": 0.25, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,9,0,1]},
        {"type": "Group", "children": [{"type": "HemisphereLight", "color": 0, "groundColor": 16777215}]}]}})";
    const LightFile old = read(scene, "a.json"), now = read(scene, "a.json", ThreeLights::physical);
    ASSERT_EQ(old.lights.size(), 3u);
    EXPECT_NEAR(pbr::falloff_at(old.lights[0].falloff, 4), .36, 1e-12);
    EXPECT_EQ(old.lights[0].unit, LightUnit::relative);
    EXPECT_NEAR(pbr::falloff_at(now.lights[0].falloff, 4), std::pow(1 - std::pow(.4, 4), 2) / 16, 1e-12);
    EXPECT_EQ(now.lights[0].unit, LightUnit::candela);
    EXPECT_EQ(old.lights[0].colour, glm::dvec3(1, 0, 0));
    EXPECT_EQ(old.lights[0].position, glm::dvec3(3, 4, 5));
    EXPECT_NEAR(old.lights[1].spot->inner_rad, .375, 1e-12);
    EXPECT_EQ(old.lights[1].direction, glm::dvec3(0, -9, 0));
    EXPECT_EQ(old.lights[2].colour, glm::dvec3(.5));
    EXPECT_TRUE(has(old.diagnostics, "three_lights"));
}

TEST(OpenGexLights, CurvesMultiply) {
    const LightFile file = read(R"(Metric (key = "distance") {float {0.0254}}
Metric (key = "up") {string {"z"}}
LightNode $node1 { Name {string {"Lamp"}} ObjectRef {ref {$light1}}
  Transform { float[16] { {1,0,0,0, 0,1,0,0, 0,0,1,0, 7,8,9,1} } } }
/* a comment
*/ LightObject $light1 (type = "point") {
  Color (attrib = "light") {float[3] {{0.5, 1.0, 0.25}}}
  Param (attrib = "intensity") {float {3}}
  Atten (curve = "inverse_square") { Param (attrib = "scale") {float {50}} }
  Atten (curve = "smooth") { Param (attrib = "begin") {float {10}} Param (attrib = "end") {float {110}} }
})",
                                "a.ogex");
    EXPECT_EQ(file.unit_m, .0254);
    ASSERT_EQ(file.lights.size(), 1u);
    EXPECT_EQ(file.lights[0].position, glm::dvec3(7, 8, 9));
    EXPECT_EQ(file.lights[0].intensity, 3);
    EXPECT_NEAR(pbr::falloff_at(file.lights[0].falloff, 60), 2500. / 3600 * .5, 1e-12);
}

TEST(OpenGexLights, SayWhereTheyBreak) {
    EXPECT_THAT(refusal("LightObject (type = \"point\") {\n", "a.ogex"), HasSubstr("a.ogex:2: ends where"));
    EXPECT_THAT(refusal("LightObject (type = \"laser\") {}", "a.ogex"),
                HasSubstr("allowed: infinite, point, spot"));
    EXPECT_THAT(
        refusal("LightObject (type = \"point\") {Param (attrib = \"intensity\") {float {x}}}", "a.ogex"),
        HasSubstr("found 'x'"));
}

TEST(Ac3dLights, StandInTheTreeOfObjects) {
    const LightFile file = read(
        "AC3Db\nOBJECT world\nkids 2\nOBJECT group\nloc 1 2 3\nkids 1\nOBJECT light\nname \"lamp\"\nloc 10 0 "
        "0\nkids "
        "0\nOBJECT poly\ndata 13\nOBJECT light\n\nnumvert 1\n0 0 0\nkids 0\n",
        "a.ac");
    ASSERT_EQ(file.lights.size(), 1u);
    EXPECT_EQ(file.lights[0].name, "lamp");
    EXPECT_EQ(file.lights[0].position, glm::dvec3(11, 2, 3));
    EXPECT_THAT(refusal("AC3Db\nOBJECT world\nkids 2\nOBJECT light\nkids 0\n", "a.ac"),
                HasSubstr("truncated"));
}

TEST(CsvLights, AreRowsOfNamedColumns) {
    const LightFile file = read(
        "# lamps\nname,type,intensity,x,y,z,falloff,range\n\"a, b\",point,2,1,2,3,linear,10\nc,spot,,,,,,\n",
        "a.csv");
    ASSERT_EQ(file.lights.size(), 2u);
    EXPECT_EQ(file.lights[0].name, "a, b");
    EXPECT_NEAR(pbr::falloff_at(file.lights[0].falloff, 5), .5, 1e-12);
    EXPECT_NEAR(file.lights[1].spot->outer_rad, 45 * kDegree, 1e-12);
    EXPECT_THAT(refusal("name,colr\na,b\n", "a.csv"),
                HasSubstr("a.csv:1: found the column 'colr'; allowed: name"));
    EXPECT_THAT(refusal("name,type\na\n", "a.csv"), HasSubstr("a.csv:2: found 1 cells; allowed: 2"));
    EXPECT_THAT(refusal("name,range\na,wide\n", "a.csv"), HasSubstr("found 'wide' as range"));
}

TEST(PlainLights, SayWhereTheyBreak) {
    EXPECT_THAT(refusal("{\"lights\": [{\"intensity\": \"much\"}]}", "a.json"),
                HasSubstr("a.json#/lights/0/intensity: found '\"much\"'; allowed: a finite number"));
    EXPECT_THAT(refusal("{\"lights\": [{\"falloff\": \"cubic\"}]}", "a.json"),
                HasSubstr("allowed: constant, linear"));
    EXPECT_THAT(refusal("{\"lights\": [{\"falloff\": \"linear\"}]}", "a.json"),
                HasSubstr("the ramp is dark"));
    EXPECT_THAT(refusal("{\"lights\": 3}", "a.json"), HasSubstr("a.json#/lights: found '3'"));
    EXPECT_THAT(refusal("{\"lights\": [,]}", "a.json"), HasSubstr("a.json:1:"));
    EXPECT_THAT(refusal("{\"lamps\": []}", "a.json"), HasSubstr("without \"asset\""));
    EXPECT_THAT(refusal("{\"unit\": \"furlong\", \"lights\": []}", "a.json"),
                HasSubstr("allowed: relative, cd"));
    EXPECT_THAT(refusal("[1]", "a.json"), HasSubstr("no object"));
}

TEST(GltfLights, SayWhereTheyBreak) {
    const std::string head =
        R"({"asset": {"version": "2.0"}, "extensions": {"KHR_lights_punctual": {"lights": [)";
    EXPECT_THAT(refusal(head + R"({"type": "laser"}]}}})", "a.gltf"),
                HasSubstr("/lights/0/type: found '\"laser\"'"));
    EXPECT_THAT(refusal(head + R"({"type": "spot"}]}}})", "a.gltf"), HasSubstr("which a spot needs"));
    EXPECT_THAT(refusal(head + R"(]}}, "nodes": [{"children": [0]}], "scenes": [{"nodes": [0]}]})", "a.gltf"),
                HasSubstr("reached twice"));
    EXPECT_THAT(
        refusal(head + R"(]}}, "nodes": [{"extensions": {"KHR_lights_punctual": {"light": 3}}}]})", "a.gltf"),
        HasSubstr("below 0"));
    using namespace std::string_literals;
    EXPECT_THAT(refusal("glTF\2\0\0\0\x20\0\0\0\x40\0\0\0JSON{}"s, "a.glb"), HasSubstr("claims 64 bytes"));
}

TEST(Lights, RefuseWhatIsNoFormatKnown) {
    EXPECT_THAT(refusal("hello\n", "a.txt"), HasSubstr("as no format known does"));
    EXPECT_THAT(refusal("", "a.txt"), HasSubstr("is empty"));
    EXPECT_THAT(refusal("  \n", "a.txt"), HasSubstr("nothing but blanks"));
    EXPECT_THAT(refusal("Kaydara FBX Binary", "a.fbx"), HasSubstr("FBX"));
}

TEST(Lights, ReadTheRealFiles) {
    const std::filesystem::path ies = real_files();
    const std::filesystem::path folder = ies.empty() ? ies : ies.parent_path() / "legacy";
    if (folder.empty() || !std::filesystem::is_directory(folder))
        GTEST_SKIP() << "the real assets are absent";
    const std::pair<const char*, std::size_t> files[] = {
        {"assimp/lights.dae", 5},
        {"assimp/light_issue1262.ogex", 3},
        {"assimp/SphereWithLight.ac", 1},
        {"lights/khr_lights_example.gltf", 3},
        {"lights/blenderio_24_animation_pointer.gltf", 4},
        {"lights/source_vmf_lights_excerpt.vmf", 1},
        {"lights/three_editor_arkanoid_lights_excerpt.json", 2}};
    for (const auto& [name, count] : files) {
        if (!std::filesystem::exists(folder / name)) continue;
        EXPECT_EQ(read(read_text(folder / name), name).lights.size(), count) << name;
    }
}

}  // namespace
}  // namespace pbrbake::parse::test
