// Lights of Quake and Source maps: what their numbers mean to the compilers and engines that read them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bakers/parse/lights.hpp"
#include "tests/bakers/parse/fixtures.hpp"

namespace pbrbake::parse::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
/// What "light" "1" is of white.
constexpr double kOne = .5 * 264 / 128 / 255;
using testing::HasSubstr;

LightFile read(const std::string& text, const std::string& name) {
    return parse_lights(bytes_of(text), name);
}

const char* const kQuake = R"(// a map
{
"classname" "worldspawn"
"_sunlight" "64"
"_sun_mangle" "0 -90 0"
"_sunlight_color" "255 128 0"
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
    // light.exe halves what it writes, GLQuake doubles it to 264/128: 255 is white.
    EXPECT_NEAR(light.intensity * 255, 300 * .5 * 264 / 128, 1e-12);
    for (const double d : {0., 75., 299.})
        EXPECT_NEAR(light.intensity * pbr::falloff_at(light.falloff, d) / kOne, 300 - d, 1e-9);
    EXPECT_EQ(pbr::falloff_at(light.falloff, 300), 0);
    EXPECT_EQ(light.position, glm::dvec3(10, 20, 30));
    EXPECT_EQ(light.line, 11);
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
    EXPECT_NEAR(sun.intensity, 64 * kOne, 1e-12);
    EXPECT_NEAR(sun.colour.y, .5, 1e-2);
    EXPECT_NEAR(sun.direction.z, -1, 1e-12);
}

std::string quake(const std::string& light, const std::string& world = "") {
    return "{\n\"classname\" \"worldspawn\"\n" + world + "}\n{\n\"classname\" \"light\"\n" + light + "}\n";
}

LegacyLight quake_light(const std::string& keys, const std::string& world = "") {
    return read(quake(keys, world), "a.map").lights.back();
}

TEST(QuakeLights, RangeOfTheWorldScalesAllOfIt) {
    EXPECT_NEAR(quake_light("", "\"_range\" \"1\"\n").intensity, 2 * 300 * kOne, 1e-12);
    EXPECT_NEAR(quake_light("").intensity, 300 * kOne, 1e-12);
}

TEST(QuakeLights, WaitOfNothingIsOneAndAnUnknownDelayIsDark) {
    for (const char* wait : {"0", "-2"})
        EXPECT_EQ(quake_light(std::string("\"wait\" \"") + wait + "\"\n").falloff.range, 300) << wait;
    for (const char* delay : {"6", "-1"}) {
        const LegacyLight light = quake_light(std::string("\"delay\" \"") + delay + "\"\n");
        EXPECT_EQ(light.intensity, 0) << delay;
        EXPECT_TRUE(has(light.diagnostics, "delay_unknown"));
    }
}

TEST(QuakeLights, ValueMayBringAColour) {
    const LegacyLight four = quake_light("\"light\" \"255 128 0 200\"\n");
    EXPECT_NEAR(four.intensity, 200 * kOne, 1e-12);
    EXPECT_NEAR(four.colour.y, 128 / 255., 1e-12);
    const LegacyLight three = quake_light("\"light\" \"0 1 0\"\n\"_color\" \"255 0 0\"\n");
    EXPECT_NEAR(three.intensity, 300 * kOne, 1e-12);
    EXPECT_EQ(three.colour, glm::dvec3(1, 0, 0));
}

TEST(QuakeLights, ConeIsAHalfAngleAndAngleAFullOne) {
    EXPECT_NEAR(quake_light("\"mangle\" \"0 -90 0\"\n\"_cone\" \"25\"\n").spot->outer_rad, 25 * kDegree,
                1e-12);
    EXPECT_NEAR(quake_light("\"mangle\" \"0 -90 0\"\n\"angle\" \"0\"\n").spot->outer_rad, 20 * kDegree,
                1e-12);
}

TEST(QuakeLights, DomesAreLeftOutAloud) {
    EXPECT_TRUE(has(read(quake("", "\"_sunlight2\" \"100\"\n"), "a.map").diagnostics, "sky_dome"));
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

LegacyLight source_light(const std::string& keys) { return read(vmf(keys), "a.vmf").lights.front(); }

TEST(SourceLights, NegativeNumbersAreNone) {
    const char* const kLight = "\"classname\" \"light\"\n\"_quadratic_attn\" \"1\"\n";
    EXPECT_NEAR(
        source_light(std::string(kLight) + "\"_light\" \"255 255 255 102\"\n\"_lightHDR\" \"-1 -1 -1 1\"")
            .colour.x,
        1, 1e-12);
    const LegacyLight dark = source_light(std::string(kLight) + "\"_light\" \"255 255 255 -200\"");
    EXPECT_EQ(dark.intensity, 0);
    EXPECT_TRUE(has(dark.diagnostics, "light_illegal"));
    const LegacyLight cut = source_light(std::string(kLight) + "\"_light\" \"255 255\"");
    EXPECT_EQ(cut.intensity, 0);
    EXPECT_TRUE(has(cut.diagnostics, "light_illegal"));
}

TEST(SourceLights, HdrNumbersGoFirst) {
    // Light and its HDR twin may share a key; the HDR scale is of either.
    const LegacyLight light = source_light(
        "\"classname\" \"light\"\n\"_constant_attn\" \"1\"\n\"_light\" \"255 0 0 10 0 255 0 "
        "51\"\n\"_lightscaleHDR\" \"2\"");
    EXPECT_EQ(light.colour, glm::dvec3(0, 1, 0));
    EXPECT_NEAR(light.intensity, 2 * 51 / 255., 1e-12);
}

TEST(SourceLights, SpotsAreWeighedByTheCosineOffTheirAxis) {
    const LegacyLight light = source_light(
        "\"classname\" \"light_spot\"\n\"_light\" \"255 255 255 255\"\n\"_quadratic_attn\" \"1\"\n"
        "\"_inner_cone\" \"30\"\n\"_cone\" \"120\"\n\"_exponent\" \"2\"\n\"pitch\" \"0\"\n\"angles\" \"-90 0 "
        "0\"");
    EXPECT_NEAR(light.spot->outer_rad, 90 * kDegree, 1e-12);  // as far as vrad goes
    const double ramp = .5 / std::cos(30 * kDegree);
    EXPECT_NEAR(pbr::spot_falloff_at(*light.spot, .5), .5 * ramp * ramp, 1e-12);
    EXPECT_NEAR(light.direction.z, -1, 1e-12);  // a pitch of 0 is none
}

TEST(SourceLights, SkyWithoutAnAmbientHasHalfOfItsSun) {
    const LightFile file = read(
        vmf("\"classname\" \"light_environment\"\n\"_light\" \"255 255 255 200\"\n\"angles\" \"-45 90 0\""),
        "a.vmf");
    ASSERT_EQ(file.lights.size(), 2u);
    EXPECT_NEAR(file.lights[0].direction.y, std::cos(45 * kDegree), 1e-12);
    EXPECT_EQ(file.lights[1].type, LightType::ambient);
    EXPECT_NEAR(file.lights[1].intensity, 100 / 255., 1e-12);
}

TEST(MapEntities, SayWhereTheyBreak) {
    EXPECT_THAT(refusal_of_lights("{\n\"classname\" \"light\"\n", "a.map"),
                HasSubstr("a.map:1: opens a brace"));
    EXPECT_THAT(refusal_of_lights("{\n\"classname\" \"light\n}", "a.map"), HasSubstr("a.map:2: has a quote"));
    EXPECT_THAT(refusal_of_lights("{\n\"classname\"\n}", "a.map"),
                HasSubstr("where the value of 'classname' should be"));
    EXPECT_THAT(refusal_of_lights("}", "a.map"), HasSubstr("that none opened"));
    EXPECT_THAT(refusal_of_lights("{\n\"classname\" \"light\"\n\"light\" \"bright\"\n}", "a.map"),
                HasSubstr("found 'bright' as 'light'"));
    EXPECT_THAT(
        refusal_of_lights("{\n\"classname\" \"light\"\n\"origin\" \"1 2\"\n}", "a.map"),
        HasSubstr("a.map:1: found '1 2' as 'origin' of the entity that begins here; allowed: three numbers"));
    EXPECT_THAT(refusal_of_lights(std::string(100, '{'), "a.map"), HasSubstr("deeper than 64"));
}

}  // namespace
}  // namespace pbrbake::parse::test
