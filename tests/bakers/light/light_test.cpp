#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "bakers/job/json_text.hpp"
#include "bakers/job/schema.hpp"
#include "bakers/light/convert.hpp"
#include "bakers/parse/text.hpp"
#include "tests/bakers/light/fixtures.hpp"

namespace pbrbake::light::test {
namespace {

constexpr double kPi = std::numbers::pi;

/// Illuminance of a written light on a surface that faces it, by the formulas of the README alone.
double written_lx(const Json& light, double d) {
    const double cd = light["intensity_cd"], r = light["source_radius_m"];
    double window = 1;
    if (!light["attenuation_radius_m"].is_null()) {
        const double share = d / light["attenuation_radius_m"].get<double>();
        window = std::max(1 - std::pow(share, 4), 0.);
        if (light["window"] == "quartic_squared") window *= window;
    }
    return cd / (d * d + r * r) * window;
}

TEST(Light, ConstantAndQuadraticIsADiskToOnePartInAMillion) {
    for (const auto& [c, q, unit] : {std::tuple{1., .04, 1.}, {.25, 300., 1.}, {2., .00111109, .01}}) {
        LightParams params = defaults();
        params.unit_m = unit;
        const Baked baked = bake_one("\"intensity\": 7, \"attenuation\": [" + std::to_string(c) + ", 0, " +
                                         parse::number_text(q) + "]",
                                     params);
        const Json& light = baked.light();
        EXPECT_NEAR(light["intensity_cd"].get<double>() / (7 / q * unit * unit), 1, 1e-6);
        EXPECT_NEAR(light["source_radius_m"].get<double>() / (std::sqrt(c / q) * unit), 1, 1e-6);
        EXPECT_TRUE(light["falloff"]["exact"].get<bool>());
        for (const double share : {.1, 1., 10.}) {
            const double d = share * std::sqrt(c / q);
            EXPECT_NEAR(written_lx(light, d * unit) * (c + q * d * d) / 7, 1, 1e-6);
        }
        EXPECT_LE(baked.figure("stops_max"), 1e-6);
    }
}

TEST(Light, QuakesRampIsWithinATenthOfAStop) {
    const Baked baked = bake_one(R"("intensity": 300, "falloff": {"kind": "linear", "range": 300})");
    const Json& light = baked.light();
    double squares = 0, sum_as_point = 0;
    constexpr int kCount = 1000;
    for (int i = 0; i < kCount; ++i) {
        const double d = 300 * (.05 + .85 * (i + .5) / kCount);
        squares += std::pow(std::log2(written_lx(light, d) / (300 - d)), 2);
        sum_as_point += 1;
    }
    EXPECT_LE(std::sqrt(squares / kCount), .15);
    EXPECT_LE(baked.certificate.headline->value, .15);
    EXPECT_GT(light["source_radius_m"].get<double>(), 0);
    EXPECT_GT(light["falloff"]["stops_as_point"]["rms"].get<double>(), 1);
    EXPECT_GT(baked.figure("gltf_stops_rms"), 1);
}

TEST(Light, CurveIsLawAndFitOverTheSpan) {
    const Baked baked =
        bake_one(R"("intensity": 2, "falloff": {"constant": 1, "linear": 0.7, "quadratic": 1.8})");
    const Json& falloff = baked.light()["falloff"];
    for (const Json& row : falloff["curve"]["rows"]) {
        const double d = row[0];
        EXPECT_NEAR(row[1].get<double>() * (1 + .7 * d + 1.8 * d * d) / 2, 1, 1e-8);
        EXPECT_NEAR(row[2].get<double>() / written_lx(baked.light(), d), 1, 1e-7);
        EXPECT_NEAR(row[3].get<double>(), std::log2(row[2].get<double>() / row[1].get<double>()), 1e-7);
    }
}

const Figure* figure_of(const Baked& baked, const std::string& metric) {
    for (const Figure& figure : baked.certificate.figures)
        if (figure.metric == metric) return &figure;
    return nullptr;
}

TEST(Light, CertificateCarriesTheCurveOfEachLawsWorstLight) {
    const Baked baked = bake_text(R"({"lights": [
        {"name": "near", "falloff": {"kind": "linear", "range": 3}}, {"falloff": "inverse"},
        {"name": "far", "falloff": {"kind": "linear", "range": 300}}]})");
    EXPECT_FALSE(figure_of(baked, "stops_rms.inverse")->curve.is_null());
    EXPECT_FALSE(figure_of(baked, "gltf_stops_rms")->curve.is_null());
    const Json& curve = figure_of(baked, "stops_rms.linear ramp")->curve;
    EXPECT_EQ(curve["columns"], Json({"distance_m", "legacy_lx", "written_lx", "stops"}));
    ASSERT_GE(curve["rows"].size(), 16u);
    double squares = 0;
    for (const Json& row : curve["rows"]) {
        const double stops = std::log2(row[2].get<double>() / row[1].get<double>());
        EXPECT_NEAR(row[3].get<double>(), stops, 1e-6);
        squares += stops * stops;
    }
    EXPECT_GT(squares, 0);
}

TEST(Light, CertificateMeasuresTheDocumentsItIsGiven) {
    // A product whose numbers were doubled after the bake is a stop off, and its cone no longer the law's.
    const std::string text = R"({"lights": [{"type": "spot", "unit": "cd", "intensity": 5, "outer_deg": 30,
        "falloff": "inverse_square"}]})";
    const LightParams params = defaults();
    const Inputs inputs = inputs_of(text, "lights.json");
    Context context(1, {});
    Product product = bake(params, inputs, context);
    product.documents[0].json["lights"][0]["intensity_cd"] = 10;
    product.documents[0].json["lights"][0]["spot"]["inner_half_angle_deg"] = 0;
    Json& told = product.documents[1].json["extensions"]["KHR_lights_punctual"]["lights"][0];
    told["intensity"] = told["intensity"].get<double>() / 4;
    const Baked baked{product, certify(params, inputs, product, context)};
    EXPECT_NEAR(baked.certificate.headline->value, 1, 1e-6);
    EXPECT_NEAR(baked.figure("gltf_stops_rms"), 2, 1e-6);
    EXPECT_GT(baked.figure("cone_rms"), .2);
}

TEST(Light, GltfAloneIsCertifiedAsGltf) {
    LightParams params = defaults();
    params.documents = {DocumentKind::gltf};
    const Baked baked = bake_one(R"("falloff": {"kind": "linear", "range": 300})", params);
    EXPECT_GT(baked.certificate.headline->value, 1);
    EXPECT_EQ(baked.certificate.headline->value, baked.figure("gltf_stops_rms"));
}

TEST(Light, EachWarningIsGivenOnceAFile) {
    std::string lights;
    for (int i = 0; i < 40; ++i)
        lights += std::string(i ? "," : "") + R"({"name": "l)" + std::to_string(i) +
                  R"(", "unit": "cd", "intensity": 1e6})";
    const Baked baked =
        bake_text("{\"lights\": [" + lights + R"(, {"name": "hum", "falloff": "constant"}]})");
    EXPECT_THAT(
        baked.product.warnings,
        testing::ElementsAre(testing::AllOf(testing::HasSubstr("\"l0\" "), testing::HasSubstr("65504"),
                                            testing::HasSubstr("(39 other lights likewise)")),
                             testing::HasSubstr("\"hum\" doesn't fade")));
}

TEST(Light, AnchorIsTheExposureUnderWhichOneIsWhite) {
    // Pixel value of white: exposure times E / pi, with exposure 1 / (1.2 2^EV).
    for (const double ev : {0., 8., 15.})
        EXPECT_NEAR(reference_illuminance_lx(ev) / kPi / (1.2 * std::exp2(ev)), 1, 1e-13);
    EXPECT_NEAR(ev100_of_reference(reference_illuminance_lx(11.5)), 11.5, 1e-12);
    LightParams params = defaults();
    params.reference_illuminance_lx = 0;
    params.ev100 = 15;
    const Baked sun = bake_one(R"("type": "directional")", params);
    EXPECT_NEAR(sun.light()["illuminance_lx"].get<double>(), 1.2 * kPi * 32768, .1);
    params.unit_cd = 40;
    params.unit_m = .5;
    const Baked lamp = bake_one(R"("falloff": "inverse_square")", params);
    EXPECT_NEAR(lamp.light()["intensity_cd"].get<double>(), 40, 1e-6);
}

TEST(Light, LumensAreOverWhatTheLightFills) {
    const auto candela = [](const std::string& fields) {
        return bake_one("\"intensity\": 800, " + fields).light()["intensity_cd"].get<double>();
    };
    EXPECT_NEAR(candela(R"("unit": "lm")"), 63.662, 1e-3);
    EXPECT_NEAR(candela(R"("type": "spot", "unit": "lm_over_pi")"), 254.648, 1e-3);
    EXPECT_NEAR(candela(R"("type": "spot", "unit": "lm", "outer_deg": 22.5)"), 1672.7, .1);
    EXPECT_NEAR(candela(R"("type": "spot", "unit": "lm_over_4pi")"), 63.662, 1e-3);
}

TEST(Light, WattsAreBlenders) {
    const Baked point = bake_one(R"("unit": "W", "intensity": 100)");
    EXPECT_NEAR(point.light()["intensity_cd"].get<double>(), 100 * 683 / (4 * kPi), 1e-3);
    const Baked sun = bake_one(R"("type": "sun", "unit": "W/m2", "intensity": 3)");
    EXPECT_NEAR(sun.light()["illuminance_lx"].get<double>(), 3 * 683, 1e-6);
    const Baked area = bake_one(R"("type": "area", "unit": "W", "intensity": 10, "width": 2, "height": 0.5)");
    EXPECT_NEAR(area.light()["luminance_cd_m2"].get<double>(), 10 * 683 / kPi, 1e-3);
}

TEST(Light, BlendersThreeModesOfGltfAreOneLamp) {
    // A lamp of 100 W and a sun of 3 W/m^2, as its exporter writes them in each mode.
    const auto scene = [](double point, double sun) {
        return R"({"asset": {"version": "2.0"}, "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": )" +
               parse::number_text(point) + R"(}, {"type": "directional", "intensity": )" +
               parse::number_text(sun) + "}]}}}";
    };
    const std::array<std::pair<GltfUnits, std::string>, 3> files{
        {{GltfUnits::standard, scene(100 * 683 / (4 * kPi), 3 * 683)},
         {GltfUnits::unitless, scene(100 / (4 * kPi), 3)},
         {GltfUnits::raw, scene(100, 3)}}};
    for (const auto& [units, text] : files) {
        LightParams params = defaults();
        params.gltf_units = units;
        const Baked baked = bake_text(text, params, "scene.gltf");
        EXPECT_NEAR(baked.light(0)["intensity_cd"].get<double>(), 5435.142, 1e-2);
        EXPECT_NEAR(baked.light(1)["illuminance_lx"].get<double>(), 2049, 1e-5);
    }
}

TEST(Light, AreaSourcesKeepTheirSizeAndLuminance) {
    const Baked baked =
        bake_one(R"("type": "rectangle", "unit": "nit", "intensity": 500, "width": 2, "height": 3)");
    EXPECT_EQ(baked.light()["shape"], "rectangle");
    EXPECT_NEAR(baked.light()["intensity_cd"].get<double>(), 3000, 1e-6);
    EXPECT_NEAR(baked.light()["flux_lm"].get<double>(), 3000 * kPi, 1e-4);
    EXPECT_NEAR(baked.light()["luminance_cd_m2"].get<double>(), 500, 1e-6);
    const Baked sphere = bake_one(R"("type": "sphere", "unit": "cd", "intensity": 50, "radius": 0.1)");
    EXPECT_EQ(sphere.light()["shape"], "sphere");
    EXPECT_NEAR(sphere.light()["luminance_cd_m2"].get<double>(), 50 / (kPi * .01), 1e-4);
}

/// Until r154 WebGLLights multiplies every light but the rectangle by pi, and the BRDF divides by it: a white
/// wall under a directional light of 1, 965.1 lx at EV 8, has a radiance of 1, and so has a rectangle of
/// intensity 1: 965.1 / pi = 307.2 nit, whatever its size and the files' length.
TEST(Light, LegacyRectanglesOfThreeAreAsBrightAsAWhiteWall) {
    LightParams params = defaults();
    params.reference_illuminance_lx = 0;
    const auto scene = [](const char* version) {
        return std::string("{\"metadata\": {\"version\": ") + version +
               R"(}, "lights": [{"type": "DirectionalLight"},
            {"type": "RectAreaLight", "width": 2, "height": 0.5, "intensity": 1},
            {"type": "RectAreaLight", "width": 4, "height": 3, "intensity": 2}]})";
    };
    for (const double unit_m : {0., .01}) {
        params.unit_m = unit_m;
        const double metres = unit_m > 0 ? unit_m : 1;
        const Baked old = bake_text(scene("4.5"), params);
        EXPECT_NEAR(old.light(0)["illuminance_lx"].get<double>(), 965.0973, 1e-3);
        EXPECT_NEAR(old.light(1)["luminance_cd_m2"].get<double>(), 307.2, 1e-4);
        EXPECT_NEAR(old.light(2)["luminance_cd_m2"].get<double>(), 614.4, 1e-4);
        EXPECT_NEAR(old.light(2)["intensity_cd"].get<double>(), 614.4 * 12 * metres * metres, 1e-3);
        const Baked now = bake_text(scene("4.6"), params);
        EXPECT_NEAR(now.light(0)["illuminance_lx"].get<double>(), 1, 1e-9);
        EXPECT_NEAR(now.light(2)["luminance_cd_m2"].get<double>(), 2, 1e-8);
    }
}

TEST(Light, ColourIsTemperatureTintAndLuminance) {
    const Baked white = bake_one(R"("unit": "cd", "intensity": 10)");
    EXPECT_NEAR(white.light()["colour"]["temperature_k"].get<double>(), 6504, 1);
    // Its colour's luminance goes into the intensity, and comes back in glTF.
    const Baked green = bake_one(R"("unit": "cd", "intensity": 10, "colour": [0, 0.5, 0])");
    const double y = 10 * .5 * .7152;
    EXPECT_NEAR(green.light()["intensity_cd"].get<double>(), y, 1e-3);
    EXPECT_FALSE(green.light()["colour"]["temperature_is_meaningful"].get<bool>());
    const Json& written = green.gltf()["extensions"]["KHR_lights_punctual"]["lights"][0];
    EXPECT_NEAR(written["color"][1].get<double>(), 1, 1e-9);
    EXPECT_NEAR(written["intensity"].get<double>(), 5, 1e-6);
    // sRGB 188 is half of linear light.
    const Baked grey = bake_one(R"("unit": "cd", "intensity": 10, "colour": "#bcbcbc")");
    EXPECT_NEAR(grey.light()["intensity_cd"].get<double>(), 5.03, .01);
}

struct CorrelatedPair {
    double kelvin, duv;
};

/// Isotemperature lines (Robertson 1968; Wyszecki & Stiles, table 1(3.11), 325 as corrected): reciprocal
/// megakelvin, u, v and slope. The temperature is interpolated between the two lines on whose sides a colour
/// lies.
CorrelatedPair robertson(double u, double v) {
    constexpr double kLines[][4] = {
        {50, .18388, .27709, -.32675},  {60, .18494, .28021, -.35156},  {70, .18611, .28342, -.37915},
        {80, .18740, .28668, -.40955},  {90, .18880, .28997, -.44278},  {100, .19032, .29326, -.47888},
        {125, .19462, .30141, -.58204}, {150, .19962, .30921, -.70471}, {175, .20525, .31647, -.84901},
        {200, .21142, .32312, -1.0182}, {225, .21807, .32909, -1.2168}, {250, .22511, .33439, -1.4512},
        {275, .23247, .33904, -1.7298}, {300, .24010, .34308, -2.0637}, {325, .24792, .34655, -2.4681},
        {350, .25591, .34951, -2.9641}, {375, .26400, .35200, -3.5814}, {400, .27218, .35407, -4.3633},
        {425, .28039, .35577, -5.3762}, {450, .28863, .35714, -6.7262}};
    const auto beside = [&](const double* line) {
        return ((v - line[2]) - line[3] * (u - line[1])) / std::hypot(1, line[3]);
    };
    const double* last = kLines[0];
    for (const auto& line : kLines) {
        if (beside(line) <= 0) {
            const double part = beside(last) / (beside(last) - beside(line));
            const auto between = [&](int i) { return last[i] + (line[i] - last[i]) * part; };
            const double above = v - between(2);
            return {1e6 / between(0), std::copysign(std::hypot(u - between(1), above), above)};
        }
        last = line;
    }
    return {0, 0};
}

/// White, warm, cold, green and pink lights, by the chromaticities of Rec. 709's primaries and Robertson's
/// lines: a tenth of a mired and 2e-4 are what a table of five digits tells.
TEST(Light, TemperatureAndTintAreRobertsons) {
    constexpr double kColours[][3] = {{1, 1, 1},   {1, .8, .5},  {1, .6, .3},   {.7, .8, 1}, {1, .9, 1},
                                      {.9, 1, .9}, {1, .5, .15}, {1, .35, .08}, {.5, .7, 1}, {.6, 1, .4}};
    for (const auto& [r, g, b] : kColours) {
        const double x = .4123908 * r + .3575843 * g + .1804808 * b,
                     y = .2126390 * r + .7151687 * g + .0721923 * b,
                     z = .0193308 * r + .1191948 * g + .9505322 * b, n = x + 15 * y + 3 * z;
        const CorrelatedPair expected = robertson(4 * x / n, 6 * y / n);
        const Baked baked = bake_one("\"unit\": \"cd\", \"colour\": [" + parse::number_text(r) + ", " +
                                     parse::number_text(g) + ", " + parse::number_text(b) + "]");
        const Json& colour = baked.light()["colour"];
        EXPECT_NEAR(1e6 / colour["temperature_k"].get<double>(), 1e6 / expected.kelvin, .1) << r << g << b;
        EXPECT_NEAR(colour["tint_duv"].get<double>(), expected.duv, 2e-4) << r << g << b;
        EXPECT_NEAR(baked.light()["intensity_cd"].get<double>() / y, 1, 1e-6) << r << g << b;
    }
}

TEST(Light, GltfComesBackAsItWent) {
    const std::string source =
        R"({"asset": {"version": "2.0"}, "extensions": {"KHR_lights_punctual": {"lights": [
        {"type": "spot", "intensity": 40, "range": 12, "color": [1, 0.5, 0.25], "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.6}},
        {"type": "directional", "intensity": 1000}, {"type": "point", "intensity": 3}]}},
        "nodes": [{"translation": [1, 2, 3], "rotation": [0.7071067811865476, 0, 0, 0.7071067811865476], "extensions": {"KHR_lights_punctual": {"light": 0}}},
                  {"children": [2], "scale": [2, 2, 2]}, {"translation": [0, 1, 0], "extensions": {"KHR_lights_punctual": {"light": 2}}},
                  {"extensions": {"KHR_lights_punctual": {"light": 1}}}],
        "scenes": [{"nodes": [0, 1, 3]}]})";
    const Baked once = bake_text(source, defaults(), "scene.gltf");
    EXPECT_LE(once.figure("gltf_stops_rms"), 1e-8);
    const Json& lights = once.gltf()["extensions"]["KHR_lights_punctual"]["lights"];
    ASSERT_EQ(lights.size(), 3u);
    EXPECT_NEAR(lights[0]["intensity"].get<double>(), 40, 1e-6);
    EXPECT_NEAR(lights[0]["range"].get<double>(), 12, 1e-6);
    EXPECT_NEAR(lights[0]["spot"]["innerConeAngle"].get<double>(), .2, 1e-6);
    EXPECT_NEAR(lights[0]["color"][2].get<double>(), .25, 1e-8);
    EXPECT_EQ(once.gltf()["nodes"][1]["translation"], Json({0.0, 2.0, 0.0}));
    // Through its own product again: the same numbers.
    const Baked twice = bake_text(job::to_text(once.gltf()), defaults(), "scene.gltf");
    EXPECT_EQ(twice.gltf()["extensions"], once.gltf()["extensions"]);
    EXPECT_NEAR(twice.light(0)["direction"][1].get<double>(), 1, 1e-8);
}

TEST(Light, NodesLookAlongTheirLight) {
    for (const char* direction : {"[0, -1, 0]", "[0, 0, 1]", "[0, 0, -1]", "[1, 2, -3]", "[1e-9, 0, 1]"}) {
        const Baked baked = bake_one(std::string(R"("type": "directional", "direction": )") + direction);
        const Json& q = baked.gltf()["nodes"][0]["rotation"];
        const double x = q[0], y = q[1], z = q[2], w = q[3];
        const Json& to = baked.light()["direction"];
        EXPECT_NEAR(-2 * (x * z + w * y), to[0].get<double>(), 1e-7)
            << direction;  // the third column, turned round
        EXPECT_NEAR(-2 * (y * z - w * x), to[1].get<double>(), 1e-7);
        EXPECT_NEAR(-(1 - 2 * (x * x + y * y)), to[2].get<double>(), 1e-7);
    }
}

TEST(Light, ShapeCanBeAskedFor) {
    LightParams params = defaults();
    const std::string ramp = R"("falloff": {"kind": "linear", "range": 10})";
    params.shape = Shape::point;
    EXPECT_EQ(bake_one(ramp, params).light()["source_radius_m"], 0.0);
    params.shape = Shape::rectangle;
    EXPECT_EQ(bake_one(ramp, params).light()["shape"], "rectangle");
    EXPECT_LE(bake_one(ramp, params).certificate.headline->value, .15);
}

TEST(Light, DocumentsAreValid) {
    const std::string file = std::string(PBRBAKE_SOURCE_DIR) + "/schemas/lights.schema.json";
    const job::Schema schema(job::parse_json(job::read_text(file), file));
    for (const char* fields :
         {R"("falloff": {"kind": "linear", "range": 10})", R"("falloff": "constant")",
          R"("type": "spot", "unit": "lm", "outer_deg": 30, "spot_exponent": 8)",
          R"("type": "directional", "unit": "lx")",
          R"("type": "rectangle", "unit": "nit", "width": 1, "height": 2)", R"("intensity": 0)",
          R"("intensity": -3)", R"("type": "ambient")", R"("colour": [0, 0, 0])"})
        for (const Mistake& mistake : schema.mistakes(bake_one(fields).json()))
            ADD_FAILURE() << fields << mistake.pointer << ": " << mistake.message;
}

}  // namespace
}  // namespace pbrbake::light::test
