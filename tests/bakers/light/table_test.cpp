// The README's tables of residuals, row by row.

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <string>

#include "tests/bakers/light/fixtures.hpp"

namespace pbrbake::light::test {
namespace {

std::string readme() {
    return parse::test::read_text(std::string(PBRBAKE_SOURCE_DIR) + "/bakers/light/README.md");
}

std::string cell(const Json& stops) {
    std::array<char, 64> text;
    std::snprintf(text.data(), text.size(), "%.2f (%.2f)", stops["rms"].get<double>(),
                  stops["max"].get<double>());
    return text.data();
}

std::string opengex(const std::string& curves) { return "LightObject (type = \"point\") {" + curves + "}"; }

std::string vmf(const std::string& hard) {
    return "entity\n{\n\"classname\" \"light\"\n\"_light\" \"255 255 255 255\"\n\"_fifty_percent_distance\" "
           "\"100\"\n"
           "\"_zero_percent_distance\" \"400\"\n\"_hardfalloff\" \"" +
           hard + "\"\n}\n";
}

std::string map(const std::string& keys) {
    return "{\n\"classname\" \"light\"\n\"light\" \"247.2727\"\n" + keys + "}\n";
}

std::string three(const std::string& fields, bool is_physical) {
    return std::string("{\"metadata\": {\"version\": ") + (is_physical ? "4.6" : "4.5") +
           "}, \"lights\": [{\"type\": \"PointLight\", " + fields + "}]}";
}

std::string plain(const std::string& fields) { return "{\"lights\": [{" + fields + "}]}"; }

struct Row {
    const char *law, *from, *file;
    std::string text;
};

TEST(LightTable, HoldsTheResidualOfEveryLaw) {
    const std::string document = readme();
    const std::array<Row, 21> rows{{
        {"1 / d²", "glTF, Quake `delay` 2, three.js", "a.json", plain(R"("falloff": "inverse_square")")},
        {"1 / (1 + .04 d²)", "COLLADA, Source, plain", "a.json", plain(R"("attenuation": [1, 0, 0.04])")},
        {"1 / d", "Quake `delay` 1, COLLADA, Source", "a.json", plain(R"("falloff": "inverse")")},
        {"1 / (1 + .1 d)", "COLLADA, Source, OpenGEX", "a.json", plain(R"("attenuation": [1, 0.1, 0])")},
        {"1 / (d + d²)", "COLLADA, Source, OpenGEX", "a.json", plain(R"("attenuation": [0, 1, 1])")},
        {"1 / (1 + .7 d + 1.8 d²)", "COLLADA, Source, OpenGEX", "a.json",
         plain(R"("attenuation": [1, 0.7, 1.8])")},
        {"1 / (1 + d / 128)²", "Quake `delay` 5", "a.map", map("\"delay\" \"5\"\n")},
        {"1 / (1 + .04 d²), cut at 10", "Source `_distance`, plain `range`", "a.json",
         plain(
             R"("attenuation": [1, 0, 0.04], "falloff": {"kind": "polynomial", "constant": 1, "quadratic": 0.04, "range": 10})")},
        {"through 1/2 at 100, 1/256 at 400", "Source `_fifty_percent_distance`", "a.vmf", vmf("0")},
        {"the same, smootherstep from 325 to 400", "Source `_hardfalloff`", "a.vmf", vmf("1")},
        {"1 / max(d^1.5, .01)", "three.js from r155", "a.json", three(R"("decay": 1.5)", true)},
        {"1 / max(d², .01), (1 − (d / 10)⁴)²", "three.js from r155", "a.json",
         three(R"("distance": 10)", true)},
        {"1 / d², 1 − (d / 10)⁴", "glTF `range`", "a.json",
         plain(R"("falloff": {"kind": "inverse_square", "range": 10, "window": "quartic"})")},
        {"1 − d / 300", "Quake, old three.js with decay 1, OpenGEX", "a.json",
         plain(R"("falloff": {"kind": "linear", "range": 300})")},
        {"(1 − d / 300)²", "old three.js with decay 2", "a.json",
         three(R"("distance": 300, "decay": 2)", false)},
        {"smoothstep of 1 − d / 300", "OpenGEX `smooth`", "a.json",
         plain(R"("falloff": {"kind": "smoothstep", "range": 300})")},
        {"1 − (d − 100) / 200 from 100 on", "OpenGEX `linear`", "a.ogex",
         opengex(
             "Atten () {Param (attrib = \"begin\") {float {100}} Param (attrib = \"end\") {float {300}}}")},
        {"50² / d², at most 1", "OpenGEX `inverse_square`, 3ds Max", "a.ogex",
         opengex("Atten (curve = \"inverse_square\") {Param (attrib = \"scale\") {float {50}}}")},
        {"50 / d, at most 1", "OpenGEX `inverse`, 3ds Max", "a.ogex",
         opengex("Atten (curve = \"inverse\") {Param (attrib = \"scale\") {float {50}}}")},
        {"50² / d², at most 1, times 1 − d / 300", "OpenGEX, two curves", "a.ogex",
         opengex("Atten (curve = \"inverse_square\") {Param (attrib = \"scale\") {float {50}}} Atten () "
                 "{Param (attrib = "
                 "\"end\") {float {300}}}")},
        {"1, cut at 10", "plain `constant` with `range`", "a.json",
         plain(R"("falloff": "constant", "range": 10)")},
    }};
    for (const Row& row : rows) {
        LightParams params = defaults();
        params.shape = Shape::disk;
        const Baked baked = bake_text(row.text, params, row.file);
        ASSERT_EQ(baked.json()["lights"].size(), 1u) << row.law;
        ASSERT_TRUE(baked.light().contains("falloff")) << row.law;
        const Json& falloff = baked.light()["falloff"];
        const std::string line = std::string("| ") + row.law + " | " + row.from + " | " +
                                 cell(falloff["stops"]) + " | " + cell(falloff["stops_as_point"]) + " | " +
                                 cell(falloff["stops_in_gltf"]) + " |\n";
        EXPECT_NE(document.find(line), std::string::npos) << "the row should be\n" << line;
    }
}

TEST(LightTable, HoldsTheResidualOfEveryCone) {
    const std::string document = readme();
    const std::array<std::pair<const char*, const char*>, 8> rows{{
        {"hard; square ramp of the cosine (glTF, Frostbite)", R"("inner_deg": 20)"},
        {"linear ramp of the cosine, 20° to 40° (Quake, OpenGEX)",
         R"("inner_deg": 20, "spot_law": "cosine_ramp", "spot_exponent": 1)"},
        {"smoothstep of it (three.js, Blender, OpenGEX)", R"("inner_deg": 20, "spot_law": "smoothstep")"},
        {"cos, in 90°", R"("outer_deg": 90, "spot_exponent": 1)"},
        {"cos⁸, in 90°", R"("outer_deg": 90, "spot_exponent": 8)"},
        {"cos¹²⁸, in 90°", R"("outer_deg": 90, "spot_exponent": 128)"},
        {"cos⁸, cut at 40°", R"("spot_exponent": 8)"},
        {"cos³², cut at 40°", R"("spot_exponent": 32)"},
    }};
    const auto expect_row = [&](const std::string& law, const Baked& baked) {
        std::array<char, 32> share;
        std::snprintf(share.data(), share.size(), "%.1f %%",
                      100 * baked.light()["spot"]["rms_share_of_axis"].get<double>());
        const std::string line = "| " + law + " | " + share.data() + " |\n";
        EXPECT_NE(document.find(line), std::string::npos) << "the row should be\n" << line;
    };
    for (const auto& [law, fields] : rows) {
        const bool has_outer = std::string(fields).find("outer_deg") != std::string::npos;
        expect_row(law, bake_one(std::string("\"type\": \"spot\", ") +
                                 (has_outer ? "" : "\"outer_deg\": 40, ") + fields));
    }
    expect_row("the same times the cosine (Source)",
               bake_text("entity\n{\n\"classname\" \"light_spot\"\n\"_light\" \"255 255 255 "
                         "255\"\n\"_quadratic_attn\" \"1\"\n"
                         "\"_inner_cone\" \"20\"\n\"_cone\" \"40\"\n\"pitch\" \"-90\"\n}\n",
                         defaults(), "a.vmf"));
}

}  // namespace
}  // namespace pbrbake::light::test
