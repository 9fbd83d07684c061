// Lights of each format: what their numbers mean, and what malformed files are told.

#include "bakers/parse/lights.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "tests/bakers/parse/fixtures.hpp"

namespace pbrbake::parse::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
using testing::HasSubstr;

LightFile read(const std::string& text, const std::string& name, ThreeLights three = ThreeLights::automatic) {
    return parse_lights(bytes_of(text), name, {three, GltfUnits::standard});
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

std::string blender(const std::string& version, const std::string& light, const std::string& extra = "") {
    std::string text = collada(light, "",
                               "<contributor><authoring_tool>Blender " + version +
                                   " commit date:2015</authoring_tool></contributor>");
    text.insert(text.find("</light>"),
                "<extra><technique profile=\"blender\">" + extra + "</technique></extra>");
    return text;
}

TEST(ColladaLights, BlendersConeIsItsBlend) {
    const LegacyLight light = read(blender("2.74.0",
                                           "<spot><color>1 1 1</color><falloff_angle>60</falloff_angle>"
                                           "<falloff_exponent>0.25</falloff_exponent></spot>"),
                                   "a.dae")
                                  .lights.at(0);
    EXPECT_EQ(light.spot->law, pbr::SpotLaw::smoothstep);
    EXPECT_NEAR(light.spot->outer_rad, 30 * kDegree, 1e-12);
    const double outer = std::cos(30 * kDegree);
    EXPECT_NEAR(std::cos(light.spot->inner_rad), outer + .25 * (1 - outer), 1e-12);
    EXPECT_EQ(light.unit, LightUnit::relative);
}

TEST(ColladaLights, BlendersLightsAreWattsSince280) {
    const std::string point =
        "<point><color>100 100 100</color><constant_attenuation>1</constant_attenuation>"
        "<quadratic_attenuation>0.0006</quadratic_attenuation></point>";
    for (const char* version : {"2.80.75", "2.93.4", "3.6", "4.1.1"}) {
        const LegacyLight light = read(blender(version, point), "a.dae").lights.at(0);
        EXPECT_EQ(light.unit, LightUnit::watt) << version;
        EXPECT_NEAR(pbr::falloff_at(light.falloff, 3), 1. / 9, 1e-12);
        EXPECT_TRUE(has(light.diagnostics, "blender_watts"));
    }
    EXPECT_EQ(read(blender("2.79.0", point), "a.dae").lights.at(0).unit, LightUnit::relative);
    EXPECT_EQ(
        read(blender("2.80", "<directional><color>3 3 3</color></directional>"), "a.dae").lights.at(0).unit,
        LightUnit::watt_per_m2);
    EXPECT_TRUE(has(read(blender("2.80", point, "<type>4</type>"), "a.dae").lights.at(0).diagnostics,
                    "blender_area"));
}

TEST(ColladaLights, SayWhereTheyBreak) {
    EXPECT_THAT(refusal_of_lights("<COLLADA>\n<asset>", "a.dae"), HasSubstr("is no XML"));
    EXPECT_THAT(refusal_of_lights("<svg/>", "a.dae"), HasSubstr("found the element 'svg'; allowed: COLLADA"));
    EXPECT_THAT(refusal_of_lights(collada("<point><color>1 one 1</color></point>", ""), "a.dae"),
                HasSubstr("found 'one' in <color>"));
    EXPECT_THAT(refusal_of_lights(collada("<point/>", "<node><instance_light url=\"#M\"/></node>"), "a.dae"),
                HasSubstr("places the light 'M', which isn't there"));
    EXPECT_THAT(refusal_of_lights(collada("<laser/>", ""), "a.dae"), HasSubstr("allowed: point, spot"));
    EXPECT_THAT(refusal_of_lights(collada("<point/>", "", "<unit meter=\"0\"/>"), "a.dae"),
                HasSubstr("above 0"));
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
    EXPECT_EQ(pbr::falloff_at(file.lights[0].falloff, 10), 1);  // an inverse curve never rises above 1
}

/// By hand: a node's transformations multiply from left to right, angles are of the file's metric (here
/// degrees), and one of the object alone isn't handed down. (5, 0, 0) turned by 90 degrees about z is (0, 5,
/// 0).
TEST(OpenGexLights, StandWhereAllTransformationsOfTheirNodesPutThem) {
    const LightFile file = read(R"(Metric (key = "angle") {float {0.017453292519943295}}
LightObject $l (type = "spot") { Atten (kind = "cos_angle") { Param (attrib = "begin") {float {1}}
                                                              Param (attrib = "end") {float {0.5}} } }
LightNode { Name {string {"a"}} ObjectRef {ref {$l}}
  Translation {float[3] {{10, 20, 30}}} Rotation (kind = "z") {float {90}} Translation (kind = "x") {float {5}} }
LightNode { Name {string {"b"}} ObjectRef {ref {$l}} Rotation (kind = "x") {float {90}}
  Scale (kind = "y") {float {3}} Translation (kind = "y") {float {2}} }
Node { Transform (object = true) {float[16] {{1,0,0,0, 0,1,0,0, 0,0,1,0, 100,0,0,1}}}
  Rotation {float[4] {{-90, 0, 2, 0}}}
  LightNode { ObjectRef {ref {$l}} Transform (object = true) {float[16] {{1,0,0,0, 0,1,0,0, 0,0,1,0, 1,2,3,1}}}
    Rotation (kind = "quaternion") {float[4] {{0, 0, 2, 2}}} } })",
                                "a.ogex");
    ASSERT_EQ(file.lights.size(), 3u);
    const auto expect = [&](std::size_t i, const char* name, glm::dvec3 position, glm::dvec3 direction) {
        EXPECT_EQ(file.lights[i].name, name);
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(file.lights[i].position[k], position[k], 1e-12) << name << k;
            EXPECT_NEAR(file.lights[i].direction[k], direction[k], 1e-12) << name << k;
        }
    };
    expect(0, "a", {10, 25, 30}, {0, 0, -1});
    expect(1, "b", {0, 0, 6}, {0, 1, 0});
    // (1, 2, 3) by a quarter about z is (-2, 1, 3), by minus a quarter about y (x, z) -> (-z, x) is (-3, 1,
    // -2).
    expect(2, "l", {-3, 1, -2}, {1, 0, 0});
    for (const char* wrong : {"Translation (kind = \"w\") {float {1}}", "Rotation {float[3] {{1, 2, 3}}}",
                              "Transform {float[16] {{1}}}", "Scale (kind = \"x\") {float[3] {{1, 2, 3}}}"})
        EXPECT_THAT(refusal_of_lights(std::string("Node {\n") + wrong + "} LightObject (type = \"point\") {}",
                                      "a.ogex"),
                    HasSubstr("a.ogex:2: has a "))
            << wrong;
}

LegacyLight opengex_light(const std::string& type, const std::string& curves) {
    return read("LightObject (type = \"" + type + "\") {" + curves + "}", "a.ogex").lights.at(0);
}

std::string atten(const std::string& properties, const std::vector<std::pair<const char*, double>>& params) {
    std::string text = "Atten (" + properties + ") {";
    for (const auto& [name, value] : params)
        text += std::string("Param (attrib = \"") + name + "\") {float {" + std::to_string(value) + "}}";
    return text + "}";
}

TEST(OpenGexLights, InverseCurvesAreAsTheirParameters) {
    const LegacyLight light = opengex_light(
        "point", atten(R"(curve = "inverse")", {{"scale", 10}, {"constant", .5}, {"linear", 2}}));
    for (const double d : {4., 30.})
        EXPECT_NEAR(pbr::falloff_at(light.falloff, d), 10 / (2 * d + .5 * 10), 1e-12);
    EXPECT_EQ(pbr::falloff_at(light.falloff, 1), 1);
}

TEST(OpenGexLights, CosineCurvesFadeBetweenCosines) {
    // As 3ds Max's exporter writes a hotspot of 60 degrees in a cone of 90.
    const LegacyLight light =
        opengex_light("spot", atten(R"(kind = "cos_angle", curve = "smooth")",
                                    {{"begin", std::cos(30 * kDegree)}, {"end", std::cos(45 * kDegree)}}));
    EXPECT_NEAR(light.spot->inner_rad, 30 * kDegree, 1e-6);
    EXPECT_NEAR(light.spot->outer_rad, 45 * kDegree, 1e-6);
    EXPECT_EQ(light.spot->law, pbr::SpotLaw::smoothstep);
    EXPECT_FALSE(has(light.diagnostics, "angle_curve"));
}

TEST(OpenGexLights, MayasDropOffIsAPowerOfTheCosine) {
    // Its exporter begins at 0, which would be dark on the axis.
    const LegacyLight light = opengex_light(
        "spot", atten(R"(kind = "cos_angle", curve = "linear")", {{"begin", 0}, {"end", .5}, {"power", 3}}));
    EXPECT_EQ(light.spot->law, pbr::SpotLaw::cosine_power);
    EXPECT_NEAR(light.spot->outer_rad, 60 * kDegree, 1e-12);
    EXPECT_EQ(light.spot->exponent, 3);
    EXPECT_TRUE(has(light.diagnostics, "axis_dark"));
}

TEST(OpenGexLights, PowersAreOfAnglesAndAnglesOfTheMetric) {
    const std::string cone = atten(R"(kind = "angle")", {{"begin", 10}, {"end", 40}, {"power", 2}});
    const LegacyLight spot =
        read("Metric (key = \"angle\") {float {0.017453292519943295}} LightObject (type = \"spot\") {" +
                 cone + "}",
             "a.ogex")
            .lights.at(0);
    EXPECT_NEAR(spot.spot->outer_rad, 40 * kDegree, 1e-12);
    EXPECT_EQ(spot.spot->exponent, 2);
    EXPECT_TRUE(has(spot.diagnostics, "angle_curve"));
    const LegacyLight point = opengex_light("point", atten("", {{"end", 10}, {"power", 2}}));
    EXPECT_NEAR(pbr::falloff_at(point.falloff, 5), .5, 1e-12);
}

TEST(OpenGexLights, WhatRisesWithDistanceIsLeftOut) {
    // 3ds Max's near attenuation ends before it begins.
    const LegacyLight light =
        opengex_light("point", atten(R"(curve = "smooth")", {{"begin", 10}, {"end", 90}}) +
                                   atten(R"(curve = "smooth")", {{"begin", 5}, {"end", 1}}));
    EXPECT_TRUE(has(light.diagnostics, "rises"));
    EXPECT_NEAR(pbr::falloff_at(light.falloff, 50), .5, 1e-12);
    EXPECT_EQ(pbr::falloff_at(light.falloff, 3), 1);
}

TEST(OpenGexLights, OnlyRampsFadeByAngle) {
    const LegacyLight light = opengex_light("spot", atten(R"(kind = "angle", curve = "inverse")", {}));
    EXPECT_TRUE(has(light.diagnostics, "angle_curve_unknown"));
    EXPECT_TRUE(has(light.diagnostics, "no_cone"));
}

TEST(OpenGexLights, SayWhereTheyBreak) {
    EXPECT_THAT(refusal_of_lights("LightObject (type = \"point\") {\n", "a.ogex"),
                HasSubstr("a.ogex:2: ends where"));
    EXPECT_THAT(refusal_of_lights("LightObject (type = \"laser\") {}", "a.ogex"),
                HasSubstr("allowed: infinite, point, spot"));
    EXPECT_THAT(refusal_of_lights(
                    "LightObject (type = \"point\") {Param (attrib = \"intensity\") {float {x}}}", "a.ogex"),
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
    EXPECT_THAT(refusal_of_lights("AC3Db\nOBJECT world\nkids 2\nOBJECT light\nkids 0\n", "a.ac"),
                HasSubstr("truncated"));
}

/// rot is a matrix by rows, for columns: (1, 2, 3) becomes (3, 2, -1), and stands at (10, 0, 0) from there.
TEST(Ac3dLights, TurnWithTheirGroups) {
    const LightFile file = read(
        "AC3Db\nOBJECT world\nkids 1\nOBJECT group\nrot 0 0 1 0 1 0 -1 0 0\nloc 10 0 0\nkids 1\n"
        "OBJECT light\nloc 1 2 3\nkids 0\n",
        "a.ac");
    ASSERT_EQ(file.lights.size(), 1u);
    EXPECT_EQ(file.lights[0].position, glm::dvec3(13, 2, -1));
}

TEST(CsvLights, AreRowsOfNamedColumns) {
    const LightFile file = read(
        "# lamps\nname,type,intensity,x,y,z,falloff,range\n\"a, b\",point,2,1,2,3,linear,10\nc,spot,3,,,,,\n",
        "a.csv");
    ASSERT_EQ(file.lights.size(), 2u);
    EXPECT_EQ(file.lights[0].name, "a, b");
    EXPECT_NEAR(pbr::falloff_at(file.lights[0].falloff, 5), .5, 1e-12);
    EXPECT_NEAR(file.lights[1].spot->outer_rad, 45 * kDegree, 1e-12);
    EXPECT_THAT(refusal_of_lights("name,colr\na,b\n", "a.csv"),
                HasSubstr("a.csv:1: found the column 'colr'; allowed: name"));
    EXPECT_THAT(refusal_of_lights("name,type\na\n", "a.csv"),
                HasSubstr("a.csv:2: found 1 cells; allowed: 2"));
    EXPECT_THAT(refusal_of_lights("name,range\na,wide\n", "a.csv"), HasSubstr("found 'wide' as range"));
}

TEST(CsvLights, RefuseWhatIsEmptyOrOfNoUse) {
    EXPECT_THAT(
        refusal_of_lights("name,intensity\na,2\nb,\n", "a.csv"),
        HasSubstr("a.csv:3: found '' as intensity; allowed: a finite number; without the column it is 1"));
    EXPECT_EQ(read("name,x\na,\n", "a.csv").lights[0].intensity, 1);
    EXPECT_THAT(
        refusal_of_lights("falloff,linear\npolynomial,\n", "a.csv"),
        HasSubstr("a.csv:2: found 'polynomial' as falloff; allowed: polynomial where its coefficients"));
    // Cells of 0 and empty ones fill a table: they say nothing of a law that has no such number.
    const LightFile filled = read("falloff,linear,exponent\ninverse,0,0\npolynomial,2,\n", "a.csv");
    EXPECT_NEAR(pbr::falloff_at(filled.lights[0].falloff, 4), 1. / 4, 1e-15);
    EXPECT_NEAR(pbr::falloff_at(filled.lights[1].falloff, 4), 1. / 8, 1e-15);
}

TEST(PlainLights, SayWhereTheyBreak) {
    EXPECT_THAT(refusal_of_lights("{\"lights\": [{\"intensity\": \"much\"}]}", "a.json"),
                HasSubstr("a.json#/lights/0/intensity: found '\"much\"'; allowed: a finite number"));
    EXPECT_THAT(refusal_of_lights("{\"lights\": [{\"falloff\": \"cubic\"}]}", "a.json"),
                HasSubstr("allowed: constant, linear"));
    EXPECT_THAT(refusal_of_lights("{\"lights\": [{\"falloff\": \"linear\"}]}", "a.json"),
                HasSubstr("a.json#/lights/0/range: found nothing; allowed: the distance at which"));
    EXPECT_THAT(refusal_of_lights("{\"lights\": 3}", "a.json"), HasSubstr("a.json#/lights: found '3'"));
    EXPECT_THAT(refusal_of_lights("{\"lights\": [,]}", "a.json"), HasSubstr("a.json:1:"));
    EXPECT_THAT(refusal_of_lights("{\"lamps\": []}", "a.json"), HasSubstr("without \"asset\""));
    EXPECT_THAT(refusal_of_lights("{\"unit\": \"furlong\", \"lights\": []}", "a.json"),
                HasSubstr("allowed: relative, cd"));
    EXPECT_THAT(refusal_of_lights("[1]", "a.json"), HasSubstr("no object"));
}

TEST(ThreeLightsFile, TellsOfLightsThatAreNotRead) {
    const LightFile file = read(
        R"({"metadata": {"version": 4.5, "type": "Object"}, "object": {"type": "LightProbe", "name": "sky"}})",
        "a.json");
    EXPECT_TRUE(file.lights.empty());
    EXPECT_TRUE(has(file.diagnostics, "light_unread"));
}

/// The README: a polynomial's numbers are its three coefficients or `attenuation`, beside the name or in the
/// object.
TEST(PlainLights, PolynomialsAreTheSameInAllTheirForms) {
    for (const char* fields :
         {R"("falloff": {"kind": "polynomial", "attenuation": [1, 0.1, 0.5]})",
          R"("falloff": {"attenuation": [1, 0.1, 0.5]})",
          R"("falloff": {"kind": "polynomial", "constant": 1, "linear": 0.1, "quadratic": 0.5})",
          R"("falloff": "polynomial", "attenuation": [1, 0.1, 0.5])", R"("attenuation": [1, 0.1, 0.5])",
          R"("constant": 1, "linear": 0.1, "quadratic": 0.5)"}) {
        const LightFile file = read(std::string("{\"lights\": [{") + fields + "}]}", "a.json");
        for (const double d : {0., 1., 7.})
            EXPECT_NEAR(pbr::falloff_at(file.lights[0].falloff, d) * (1 + .1 * d + .5 * d * d), 1, 1e-14)
                << fields;
    }
    const LightFile power = read(R"({"lights": [{"falloff": "power", "exponent": 1.5}]})", "a.json");
    EXPECT_NEAR(pbr::falloff_at(power.lights[0].falloff, 4), 1. / 8, 1e-14);
}

TEST(PlainLights, RefuseWhatHasNoMeaning) {
    const auto of_light = [](const std::string& fields) {
        return refusal_of_lights("{\"lights\": [{}, {" + fields + "}]}", "a.json");
    };
    EXPECT_THAT(refusal_of_lights(R"({"lights": [], "length": 1})", "a.json"),
                HasSubstr("a.json#/length: unknown key; allowed: unit, length_m, up"));
    EXPECT_THAT(of_light(R"("bogus": 3)"),
                HasSubstr("a.json#/lights/1/bogus: unknown key; allowed: name, type, unit"));
    EXPECT_THAT(of_light(R"("outer_degrees": 3)"), HasSubstr("did you mean \"outer_deg\"?"));
    EXPECT_THAT(of_light(R"("type": "sphere", "radius": -2)"),
                HasSubstr("a.json#/lights/1/radius: found '-2'; allowed: a number from 0 on"));
    EXPECT_THAT(of_light(R"("type": "spot", "outer_deg": -10)"), HasSubstr("/outer_deg: found '-10'"));
    EXPECT_THAT(of_light(R"("falloff": {"kind": "inverse", "radius": 3})"),
                HasSubstr("a.json#/lights/1/falloff/radius: unknown key; allowed: kind, constant"));
    EXPECT_THAT(of_light(R"("falloff": {"kind": "inverse"}, "range": 3)"),
                HasSubstr("a.json#/lights/1/range: found '3'; allowed: nothing here"));
    EXPECT_THAT(
        of_light(R"("falloff": {"kind": "polynomial"})"),
        HasSubstr("/falloff/kind: found '\"polynomial\"'; allowed: polynomial where its coefficients"));
    EXPECT_THAT(of_light(R"("falloff": "inverse", "quadratic": 2)"),
                HasSubstr("/falloff: found '\"inverse\"'"));
    EXPECT_THAT(of_light(R"("attenuation": [1, 0, 0], "linear": 2)"), HasSubstr("/linear: found '2'"));
    EXPECT_THAT(of_light(R"("falloff": {"kind": "linear", "range": 3, "exponent": -1})"),
                HasSubstr("/falloff/exponent: found '-1'; allowed: a number above 0"));
    EXPECT_THAT(of_light(R"("falloff": "inverse", "exponent": 3)"), HasSubstr("/exponent: found '3'"));
    EXPECT_THAT(of_light(R"("falloff": "smoothstep")"), HasSubstr("/range: found nothing"));
    EXPECT_THAT(of_light(R"("falloff": "inverse", "window": "soft", "range": 2)"),
                HasSubstr("/window: found '\"soft\"'; allowed: none, cut"));
    EXPECT_THAT(of_light(R"("falloff": "cubic")"),
                HasSubstr("/falloff: found '\"cubic\"'; allowed: constant"));
}

TEST(GltfLights, SayWhereTheyBreak) {
    const std::string head =
        R"({"asset": {"version": "2.0"}, "extensions": {"KHR_lights_punctual": {"lights": [)";
    EXPECT_THAT(refusal_of_lights(head + R"({"type": "laser"}]}}})", "a.gltf"),
                HasSubstr("/lights/0/type: found '\"laser\"'"));
    EXPECT_THAT(refusal_of_lights(head + R"({"type": "spot"}]}}})", "a.gltf"),
                HasSubstr("which a spot needs"));
    EXPECT_THAT(refusal_of_lights(head + R"(]}}, "nodes": [{"children": [0]}], "scenes": [{"nodes": [0]}]})",
                                  "a.gltf"),
                HasSubstr("reached twice"));
    EXPECT_THAT(
        refusal_of_lights(head + R"(]}}, "nodes": [{"extensions": {"KHR_lights_punctual": {"light": 3}}}]})",
                          "a.gltf"),
        HasSubstr("none to refer to"));
    using namespace std::string_literals;
    EXPECT_THAT(refusal_of_lights("glTF\2\0\0\0\x20\0\0\0\x40\0\0\0JSON{}"s, "a.glb"),
                HasSubstr("claims 32 bytes in all, but has 22"));
}

TEST(Lights, RefuseWhatIsNoFormatKnown) {
    EXPECT_THAT(refusal_of_lights("hello\n", "a.txt"), HasSubstr("as no format known does"));
    EXPECT_THAT(refusal_of_lights("", "a.txt"), HasSubstr("is empty"));
    EXPECT_THAT(refusal_of_lights("  \n", "a.txt"), HasSubstr("nothing but blanks"));
    for (const char* head : {"Kaydara FBX Binary", "; FBX 7.7.0 project file"})
        EXPECT_THAT(refusal_of_lights(head, "a.fbx"), HasSubstr("is FBX, which isn't read"));
    EXPECT_THAT(refusal_of_lights(std::string("MM\0\0", 4), "a.3ds"), HasSubstr("is 3D Studio's 3DS"));
    EXPECT_THAT(refusal_of_lights(std::string("FORM\0\0LWO2", 10), "a.lwo"),
                HasSubstr("is a LightWave object"));
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
