// The README's tables of residuals, row by row.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "tests/bakers/light/fixtures.hpp"

namespace pbrbake::light::test {
namespace {

std::string readme() {
    return parse::test::read_text(std::string(PBRBAKE_SOURCE_DIR) + "/bakers/light/README.md");
}

/// A law of distance in metres, as a table of formulas has it: none of the library's is used.
using Law = std::function<double(double)>;

double illuminance_of(const Json& cd, const Json& radius, const Json& end, bool is_squared, double d) {
    const double r = radius.get<double>(), share = end.is_null() ? 0 : d / end.get<double>();
    const double window = std::max(1 - std::pow(share, 4), 0.);
    return cd.get<double>() / (d * d + r * r) * (is_squared ? window * window : window);
}

Law told_by_json(const Json& light) {
    return [&light](double d) {
        return illuminance_of(light["intensity_cd"], light["source_radius_m"], light["attenuation_radius_m"],
                              light["window"] == "quartic_squared", d);
    };
}

/// White lights: the intensity is that of every component.
Law told_by_gltf(const Json& light) {
    return [&light](double d) {
        return illuminance_of(light["intensity"], 0, light.value("range", Json()), false, d);
    };
}

constexpr double kDigits = 1e-7;

struct Stops {
    double rms = 0, max = 0;
};

/// Stops between two laws: at 20,000 distances spread evenly, and for the largest at as many spread by
/// ratios, the ends of the span among them.
Stops stops_between(const Law& law, const Law& told, double near, double far) {
    constexpr int kCount = 20'000;
    Stops result;
    const auto at = [&](double d) {
        const double stops = std::abs(std::log2(told(d) / law(d)));
        result.max = std::max(result.max, stops);
        return stops;
    };
    double squares = 0;
    for (int i = 0; i < kCount; ++i) squares += std::pow(at(near + (far - near) * (i + .5) / kCount), 2);
    for (int i = 0; i < kCount; ++i) at(near * std::pow(far / near, static_cast<double>(i) / kCount));
    at(far);
    result.rms = std::sqrt(squares / kCount);
    return result;
}

/// What a document says of its own error: the root mean square by 256 distances, the largest never too small
/// but for the documents' nine digits.
void expect_stops(const Json& said, const Stops& found, const std::string& what) {
    EXPECT_NEAR(said["rms"].get<double>(), found.rms, 1e-3) << what;
    EXPECT_GE(said["max"].get<double>(), found.max - kDigits) << what;
    EXPECT_NEAR(said["max"].get<double>(), found.max, 1e-4) << what;
}

std::string cell(const Stops& stops) {
    std::array<char, 64> text;
    std::snprintf(text.data(), text.size(), "%.2f (%.2f)", stops.rms, stops.max);
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
    return "{\n\"classname\" \"light\"\n\"light\" \"247.27272727\"\n" + keys + "}\n";
}

std::string three(const std::string& fields, bool is_physical) {
    return std::string("{\"metadata\": {\"version\": ") + (is_physical ? "4.6" : "4.5") +
           "}, \"lights\": [{\"type\": \"PointLight\", " + fields + "}]}";
}

std::string plain(const std::string& fields) { return "{\"lights\": [{" + fields + "}]}"; }

struct Row {
    const char *law, *from, *file;
    std::string text;
    Law formula;
};

double squared(double x) { return x * x; }

/// vrad's law for _fifty_percent_distance 100, _zero_percent_distance 400: a parabola through (0, 1), (100,
/// y), (400, 256), y moved from 2 towards the straight line by steps of a twentieth until it rises at 1,
/// which the fifth does (y = 17.6875, slope .01, curvature .00156875), and scaled so that y is 2. A unit is
/// .01905 m.
double vrads_half(double d) {
    const double units = d / .01905;
    return 17.6875 / 2 / (1 + units * (.01 + units * .00156875));
}

/// 6 t^5 - 15 t^4 + 10 t^3 from 325 to 400 units.
double vrads_hard(double d) {
    const double t = std::clamp((400 - d / .01905) / 75, 0., 1.);
    return vrads_half(d) * t * t * t * (t * (6 * t - 15) + 10);
}

std::vector<Row> table_rows() {
    const auto ramp = [](double d) { return 1 - d / 300; };
    return {
        {"1 / d²", "glTF, Quake `delay` 2, three.js", "a.json", plain(R"("falloff": "inverse_square")"),
         [](double d) { return 1 / (d * d); }},
        {"1 / (1 + .04 d²)", "COLLADA, Source, plain", "a.json", plain(R"("attenuation": [1, 0, 0.04])"),
         [](double d) { return 1 / (1 + .04 * d * d); }},
        {"1 / d", "Quake `delay` 1, COLLADA, Source", "a.json", plain(R"("falloff": "inverse")"),
         [](double d) { return 1 / d; }},
        {"1 / (1 + .1 d)", "COLLADA, Source, OpenGEX", "a.json", plain(R"("attenuation": [1, 0.1, 0])"),
         [](double d) { return 1 / (1 + .1 * d); }},
        {"1 / (d + d²)", "COLLADA, Source, OpenGEX", "a.json", plain(R"("attenuation": [0, 1, 1])"),
         [](double d) { return 1 / (d + d * d); }},
        {"1 / (1 + .7 d + 1.8 d²)", "COLLADA, Source, OpenGEX", "a.json",
         plain(R"("attenuation": [1, 0.7, 1.8])"), [](double d) { return 1 / (1 + .7 * d + 1.8 * d * d); }},
        {"1 / (1 + d / 128)²", "Quake `delay` 5", "a.map", map("\"delay\" \"5\"\n"),
         [](double d) { return 1 / squared(1 + d * 32 / 128); }},
        {"1 / (1 + .04 d²), cut at 10", "Source `_distance`, plain `range`", "a.json",
         plain(R"("attenuation": [1, 0, 0.04], "range": 10)"),
         [](double d) { return 1 / (1 + .04 * d * d); }},
        {"through 1/2 at 100, 1/256 at 400", "Source `_fifty_percent_distance`", "a.vmf", vmf("0"),
         vrads_half},
        {"the same, smootherstep from 325 to 400", "Source `_hardfalloff`", "a.vmf", vmf("1"), vrads_hard},
        {"1 / max(d^1.5, .01)", "three.js from r155", "a.json", three(R"("decay": 1.5)", true),
         [](double d) { return 1 / std::max(std::pow(d, 1.5), .01); }},
        {"1 / max(d², .01), (1 − (d / 10)⁴)²", "three.js from r155", "a.json",
         three(R"("distance": 10)", true),
         [](double d) { return squared(1 - std::pow(d / 10, 4)) / std::max(d * d, .01); }},
        {"1 / d², 1 − (d / 10)⁴", "glTF `range`", "a.json",
         plain(R"("falloff": {"kind": "inverse_square", "range": 10, "window": "quartic"})"),
         [](double d) { return (1 - std::pow(d / 10, 4)) / (d * d); }},
        {"1 − d / 300", "Quake, old three.js with decay 1, OpenGEX", "a.json",
         plain(R"("falloff": {"kind": "linear", "range": 300})"), ramp},
        {"(1 − d / 300)²", "old three.js with decay 2", "a.json",
         three(R"("distance": 300, "decay": 2)", false), [=](double d) { return squared(ramp(d)); }},
        {"smoothstep of 1 − d / 300", "OpenGEX `smooth`", "a.json",
         plain(R"("falloff": {"kind": "smoothstep", "range": 300})"),
         [=](double d) { return squared(ramp(d)) * (3 - 2 * ramp(d)); }},
        {"1 − (d − 100) / 200 from 100 on", "OpenGEX `linear`", "a.ogex",
         opengex(
             "Atten () {Param (attrib = \"begin\") {float {100}} Param (attrib = \"end\") {float {300}}}"),
         [](double d) { return std::min(1 - (d - 100) / 200, 1.); }},
        {"50² / d², at most 1", "OpenGEX `inverse_square`, 3ds Max", "a.ogex",
         opengex("Atten (curve = \"inverse_square\") {Param (attrib = \"scale\") {float {50}}}"),
         [](double d) { return std::min(2500 / (d * d), 1.); }},
        {"50 / d, at most 1", "OpenGEX `inverse`, 3ds Max", "a.ogex",
         opengex("Atten (curve = \"inverse\") {Param (attrib = \"scale\") {float {50}}}"),
         [](double d) { return std::min(50 / d, 1.); }},
        {"50² / d², at most 1, times 1 − d / 300", "OpenGEX, two curves", "a.ogex",
         opengex("Atten (curve = \"inverse_square\") {Param (attrib = \"scale\") {float {50}}} Atten () "
                 "{Param (attrib = "
                 "\"end\") {float {300}}}"),
         [=](double d) { return std::min(2500 / (d * d), 1.) * ramp(d); }},
        {"1, cut at 10", "plain `constant` with `range`", "a.json",
         plain(R"("falloff": "constant", "range": 10)"), [](double) { return 1.; }},
    };
}

/// The table's figures come from the formulas and the numbers of the documents alone; what the documents say
/// of themselves, their curves and the certificate has to agree.
TEST(LightTable, HoldsTheResidualOfEveryLaw) {
    const std::string document = readme();
    for (const Row& row : table_rows()) {
        LightParams params = defaults();
        params.shape = Shape::point;
        const Baked point = bake_text(row.text, params, row.file);
        params.shape = Shape::disk;
        const Baked disk = bake_text(row.text, params, row.file);
        ASSERT_EQ(disk.json()["lights"].size(), 1u) << row.law;
        ASSERT_TRUE(disk.light().contains("falloff")) << row.law;
        const Json& falloff = disk.light()["falloff"];
        const double near = falloff["near_m"], far = falloff["far_m"], reach = far / .9;
        EXPECT_NEAR(near / reach, .05, 1e-8) << row.law;
        const auto stops = [&](const Law& told) { return stops_between(row.formula, told, near, far); };
        const Stops of_disk = stops(told_by_json(disk.light())),
                    of_point = stops(told_by_json(point.light())),
                    of_gltf =
                        stops(told_by_gltf(disk.gltf()["extensions"]["KHR_lights_punctual"]["lights"][0]));
        expect_stops(falloff["stops"], of_disk, row.law);
        expect_stops(falloff["stops_as_point"], of_point, row.law);
        expect_stops(falloff["stops_in_gltf"], of_gltf, row.law);
        for (const Json& point_of_curve : falloff["curve"]["rows"])
            EXPECT_LE(std::abs(point_of_curve[3].get<double>()),
                      falloff["stops"]["max"].get<double>() + kDigits)
                << row.law;
        EXPECT_NEAR(disk.figure("stops_max"), of_disk.max, 1e-4) << row.law;
        EXPECT_GE(disk.figure("stops_max"), of_disk.max - kDigits) << row.law;
        const std::string line = std::string("| ") + row.law + " | " + row.from + " | " + cell(of_disk) +
                                 " | " + cell(of_point) + " | " + cell(of_gltf) + " |\n";
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
