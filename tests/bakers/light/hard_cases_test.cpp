// What other converters get wrong: each case with its right answer.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/bakers/light/fixtures.hpp"

namespace pbrbake::light::test {
namespace {

std::size_t punctual_count(const Baked& baked) {
    const Json& gltf = baked.gltf();
    return gltf.contains("extensions") ? gltf["extensions"]["KHR_lights_punctual"]["lights"].size() : 0;
}

TEST(HardLight, ZeroIsDarkAndNotWritten) {
    for (const char* fields : {R"("intensity": 0)", R"("intensity": 5, "colour": [0, 0, 0])",
                               R"("type": "directional", "intensity": 0)"}) {
        const Baked baked = bake_one(fields);
        EXPECT_TRUE(has_flag(baked.light(), "dark")) << fields;
        EXPECT_EQ(baked.light()["illuminance_lx"], 0.0);
        EXPECT_EQ(punctual_count(baked), 0u);
        EXPECT_EQ(baked.product.properties["lights"]["dark"], 1);
    }
}

TEST(HardLight, NegativeIsAFillOfItsMagnitude) {
    for (const char* fields :
         {R"("intensity": -4, "falloff": "inverse_square")", R"("intensity": 4, "colour": [-1, -1, -1])"}) {
        const Baked baked = bake_one(fields);
        EXPECT_TRUE(has_flag(baked.light(), "negative"));
        EXPECT_TRUE(baked.light()["fill"].get<bool>());
        EXPECT_TRUE(baked.light()["negative"].get<bool>());
        EXPECT_NEAR(baked.light()["intensity_cd"].get<double>(), 4, 1e-7);
        EXPECT_EQ(punctual_count(baked), 0u);
        EXPECT_EQ(baked.gltf()["scenes"][0]["extras"]["left_out"][0], "light 0");
    }
    const Baked twice = bake_one(R"("intensity": -4, "colour": [-1, -1, -1])");
    EXPECT_FALSE(twice.light()["negative"].get<bool>());
}

TEST(HardLight, AMillionKeepsItsValueAndIsFlagged) {
    const Baked baked = bake_one(R"("unit": "cd", "intensity": 1e6)");
    EXPECT_NEAR(baked.light()["intensity_cd"].get<double>(), 1e6, 1e-3);
    EXPECT_TRUE(has_flag(baked.light(), "half_overflow"));
    EXPECT_LT(baked.light()["headroom_stops"].get<double>(), 0);
    EXPECT_FALSE(has_flag(bake_one(R"("unit": "cd", "intensity": 1000)").light(), "half_overflow"));
}

TEST(HardLight, SunOf120000LuxOverflowsHalf) {
    const Baked baked = bake_one(R"("type": "directional", "unit": "lx", "intensity": 120000)");
    EXPECT_TRUE(has_flag(baked.light(), "half_overflow"));
    EXPECT_NEAR(baked.light()["headroom_stops"].get<double>(), std::log2(65504. / 120000), 1e-8);
}

TEST(HardLight, RangeOfZeroLightsNothing) {
    for (const char* fields :
         {R"("falloff": {"kind": "linear", "range": 0})", R"("falloff": "inverse_square", "range": 0)",
          R"("falloff": {"kind": "linear", "range": -5})"}) {
        const Baked baked = bake_one(fields);
        EXPECT_TRUE(has_flag(baked.light(), "range_zero")) << fields;
        EXPECT_EQ(punctual_count(baked), 0u);
        EXPECT_EQ(baked.certificate.headline->value, 0);
    }
}

TEST(HardLight, RangeOfFloatMaxIsNone) {
    const Baked baked = bake_one(
        R"("unit": "cd", "intensity": 100, "falloff": "inverse_square", "range": 3.4028234663852886e38)");
    EXPECT_TRUE(has_flag(baked.light(), "range_unlimited"));
    EXPECT_TRUE(baked.light()["attenuation_radius_m"].is_null());
    EXPECT_NEAR(baked.light()["intensity_cd"].get<double>(), 100, 1e-6);
    EXPECT_FALSE(baked.gltf()["extensions"]["KHR_lights_punctual"]["lights"][0].contains("range"));
}

TEST(HardLight, AllAttenuationsZeroAreTheConstantOne) {
    const Baked baked = bake_one(R"("intensity": 3, "attenuation": [0, 0, 0])");
    EXPECT_TRUE(has_flag(baked.light(), "attenuations_zero"));
    EXPECT_TRUE(has_flag(baked.light(), "constant_fill"));
    EXPECT_NEAR(baked.light()["illuminance_lx"].get<double>(), 3, 1e-8);
}

TEST(HardLight, ConstantIsAFill) {
    for (const char* fields : {R"("falloff": "constant")", R"("attenuation": [2, 0, 0])"}) {
        const Baked baked = bake_one(fields);
        EXPECT_TRUE(has_flag(baked.light(), "constant_fill"));
        EXPECT_TRUE(baked.light()["fill"].get<bool>());
        EXPECT_EQ(punctual_count(baked), 0u);
    }
}

TEST(HardLight, NegativeAttenuationsBecomeZero) {
    const Baked baked = bake_one(R"("attenuation": [1, -0.5, 0.25])");
    EXPECT_TRUE(has_flag(baked.light(), "attenuation_negative"));
    EXPECT_NEAR(baked.light()["source_radius_m"].get<double>(), 2, 1e-7);
}

TEST(HardLight, ConeOfZeroLightsNothing) {
    const Baked baked = bake_one(R"("type": "spot", "outer_deg": 0)");
    EXPECT_TRUE(has_flag(baked.light(), "cone_zero"));
    EXPECT_EQ(punctual_count(baked), 0u);
}

TEST(HardLight, ConeOf180IsAPointLight) {
    const Baked baked = bake_one(R"("type": "spot", "outer_deg": 180, "unit": "cd", "intensity": 5)");
    EXPECT_TRUE(has_flag(baked.light(), "cone_open"));
    EXPECT_EQ(baked.light()["type"], "point");
    EXPECT_FALSE(baked.light().contains("spot"));
    EXPECT_EQ(baked.gltf()["extensions"]["KHR_lights_punctual"]["lights"][0]["type"], "point");
    const Baked wide = bake_one(R"("type": "spot", "outer_deg": 120)");
    EXPECT_TRUE(has_flag(wide.light(), "cone_wide"));
    EXPECT_LE(wide.light()["spot"]["outer_half_angle_deg"].get<double>(), 90 + 1e-6);
}

TEST(HardLight, InnerBeyondOuterIsAHardEdgeAtTheOuter) {
    const Baked baked = bake_one(R"("type": "spot", "inner_deg": 50, "outer_deg": 30)");
    EXPECT_TRUE(has_flag(baked.light(), "inner_beyond_outer"));
    EXPECT_NEAR(baked.light()["spot"]["outer_half_angle_deg"].get<double>(), 30, 1e-6);
    EXPECT_NEAR(baked.light()["spot"]["inner_half_angle_deg"].get<double>(), 30, 1e-6);
    const Json& cone = baked.gltf()["extensions"]["KHR_lights_punctual"]["lights"][0]["spot"];
    EXPECT_LT(cone["innerConeAngle"].get<double>(),
              cone["outerConeAngle"].get<double>());  // as glTF wants it
}

TEST(HardLight, ConesOf90DegreesStayInGltfsBounds) {
    for (const char* fields :
         {R"("type": "spot", "outer_deg": 90)", R"("type": "spot", "outer_deg": 90, "spot_exponent": 2)",
          R"("type": "spot", "outer_deg": 170, "inner_deg": 160)"}) {
        const Baked baked = bake_one(fields);
        const Json& cone = baked.gltf()["extensions"]["KHR_lights_punctual"]["lights"][0]["spot"];
        EXPECT_LE(cone["outerConeAngle"].get<double>(), std::acos(0.)) << fields;
        EXPECT_GE(cone["innerConeAngle"].get<double>(), 0);
        EXPECT_LT(cone["innerConeAngle"].get<double>(), cone["outerConeAngle"].get<double>());
    }
}

TEST(HardLight, NarrowConeIsFlagged) {
    EXPECT_TRUE(has_flag(bake_one(R"("type": "spot", "outer_deg": 1)").light(), "cone_narrow"));
    EXPECT_FALSE(has_flag(bake_one(R"("type": "spot", "outer_deg": 3)").light(), "cone_narrow"));
}

TEST(HardLight, DirectionOfNothingLooksDown) {
    const Baked baked = bake_one(R"("type": "directional", "direction": [0, 0, 0])");
    EXPECT_TRUE(has_flag(baked.light(), "no_direction"));
    EXPECT_EQ(baked.light()["direction"], Json({0.0, -1.0, 0.0}));
}

TEST(HardLight, AbsurdNumbersStayFinite) {
    for (const char* fields :
         {R"("intensity": 1e38, "attenuation": [0, 0, 1e-38])", R"("intensity": 1e-38)",
          R"("falloff": {"kind": "linear", "range": 1e-38})",
          R"("falloff": {"kind": "linear", "range": 1e38})",
          R"("falloff": {"kind": "power", "exponent": 1e9})", R"("attenuation": [1e38, 1e38, 1e38])",
          R"("type": "spot", "spot_exponent": 1e30, "outer_deg": 1e-12)", R"("colour": [1e38, 1e-38, 0])",
          R"("position": [1e38, -1e38, 1e300], "direction": [1e300, 1e300, 0], "type": "spot")"}) {
        const Baked baked = bake_one(fields);
        for (const char* key : {"intensity_cd", "illuminance_lx", "flux_lm", "source_radius_m"})
            if (baked.light().contains(key)) {
                EXPECT_TRUE(std::isfinite(baked.light()[key].get<double>())) << fields << key;
            }
        EXPECT_TRUE(std::isfinite(baked.certificate.headline->value)) << fields;
    }
}

TEST(HardLight, NoLightsAreNoError) {
    const Baked baked = bake_text("{\"lights\": []}");
    EXPECT_THAT(baked.product.warnings, testing::ElementsAre(testing::HasSubstr("holds no lights")));
    EXPECT_FALSE(baked.gltf().contains("extensionsUsed"));
}

}  // namespace
}  // namespace pbrbake::light::test
