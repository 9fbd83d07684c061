// Rules by names: what they change, and how they are refused.

#include "bakers/texture/rules.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bakers/job/json_text.hpp"
#include "bakers/job/schema.hpp"
#include "bakers/texture/names.hpp"
#include "tests/bakers/texture/fixtures.hpp"

namespace pbrbake::texture::test {
namespace {

using testing::HasSubstr;

std::string rules(const std::string& list) { return R"({"version": 1, "rules": [)" + list + "]}"; }

RuledSet ruled(const std::string& list, const std::string& diffuse = "vega/Steel02_d.png") {
    TextureParams params = defaults();
    params.diffuse = diffuse;
    Inputs inputs;
    inputs["rules"] = text_source("my.json", rules(list));
    return apply_rules(params, inputs);
}

std::string refusal(const std::string& text) {
    Inputs inputs;
    inputs["rules"] = text_source("my.json", text);
    try {
        apply_rules(defaults(), inputs);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::unreadable_input);
        return error.what();
    }
    return "";
}

bool schema_allows(const std::string& text) {
    const std::filesystem::path file =
        std::filesystem::path(PBRBAKE_SOURCE_DIR) / "schemas/texture_rules.schema.json";
    const job::Schema schema(job::parse_json(job::read_text(file), file.string()));
    return schema.mistakes(job::parse_json(text, "my.json")).empty();
}

TEST(Names, PatternsMatchNamesOrPaths) {
    EXPECT_TRUE(matches("*concrete*", "maps/Concrete01_d.png"));
    EXPECT_TRUE(matches("CONCRETE??_d.*", "concrete01_d.png"));
    EXPECT_FALSE(matches("concrete?_d.*", "concrete01_d.png"));
    EXPECT_TRUE(matches("maps/*", "maps/a/b.png"));
    EXPECT_FALSE(matches("maps*", "maps/b.png"));  // without '/', of the file name alone
    EXPECT_TRUE(matches("*a*b*c", "aXbXbXc"));
    EXPECT_FALSE(matches("*a*b*c", "aXbXbX"));
    EXPECT_TRUE(matches("*", ""));
    EXPECT_FALSE(matches("?", ""));
}

TEST(Rules, LaterOnesOverrideEarlierOnesAndTheJob) {
    const RuledSet set = ruled(R"({"match": "*", "power": 20, "gloss_in": "none"},
                                  {"match": "vega/steel*", "surface": "metal", "f0": [0.6, 0.5, 0.4]},
                                  {"match": "*concrete*", "power": 3},
                                  {"match": "*02_d*", "power": 64})");
    EXPECT_EQ(set.params.power, 64);
    EXPECT_EQ(set.params.gloss_in, GlossIn::none);
    EXPECT_EQ(set.params.surface, SurfaceIs::metal);
    ASSERT_TRUE(set.f0);
    EXPECT_EQ(set.f0->y, .5f);
    EXPECT_THAT(set.matched, testing::ElementsAre("*", "vega/steel*", "*02_d*"));
    EXPECT_EQ(ruled("", "a.png").matched.size(), 0u);
}

TEST(Rules, AnF0CalibratesWhateverTheNameSays) {
    for (const bool is_metal : {false, true}) {
        TextureParams params = defaults();
        params.diffuse = "concrete_d.png";
        params.rules = "my.json";
        Inputs inputs;
        inputs["diffuse"] = source(8, 8, 3, 8, [](int, int) { return Rgba{.2f, .2f, .2f, 1}; });
        inputs["specular"] = source(8, 8, 3, 8, [](int x, int) {
            const float s = .1f + .02f * static_cast<float>(x);
            return Rgba{s, s, s, 1};
        });
        inputs["rules"] = text_source(
            "my.json", rules(is_metal ? R"({"match": "concrete*", "surface": "metal", "f0": [0.9, 0.6, 0.5]})"
                                      : R"({"match": "concrete*", "surface": "dielectric", "f0": 0.06})"));
        const Baked baked = bake_set(params, inputs, PixelType::float32);
        EXPECT_EQ(baked.set()["calibration"], is_metal ? "metal" : "dielectric");
        EXPECT_EQ(baked.set()["mean_metallic"], is_metal ? 1. : 0.);
        EXPECT_EQ(baked.set()["rules"], Json({"concrete*"}));
        double mean = 0;
        const Image& image = baked.image(is_metal ? "base_color" : "specular");
        for (int x = 0; x < 8; ++x) mean += static_cast<double>(image.texel(0, 0, 0, x)[0]) / 8;
        if (!is_metal) mean *= baked.set()["dielectric_f0_unit"].get<double>();
        EXPECT_NEAR(mean, is_metal ? .9 : .06, is_metal ? .03 : 1e-4);
    }
}

TEST(Rules, MistakesNameFileAndPlace) {
    const auto refused = [](const std::string& text, const std::string& place) {
        EXPECT_THAT(refusal(text), HasSubstr(place));
        const bool is_json = text.starts_with('{') && text.ends_with('}');
        EXPECT_FALSE(is_json && schema_allows(text)) << text;
    };
    refused("[]", "my.json: is no JSON object");
    refused("{", "my.json:1");
    refused(R"({"rules": []})", "my.json#/version: found nothing; allowed: 1");
    refused(R"({"version": 1})", "my.json#/rules: found nothing");
    refused(R"({"version": 1, "rules": [], "more": 1})", "my.json#/more");
    refused(rules(R"({"power": 3})"), "my.json#/rules/0/match: found nothing");
    refused(rules(R"({"match": "a"}, {"match": "b", "shine": 3})"), "my.json#/rules/1/shine: found");
    refused(rules(R"({"match": "b", "gloss_is": "shiny"})"),
            "allowed: auto, smoothness, perceptual_roughness");
    refused(rules(R"({"match": "b", "power_scale": 0})"), "my.json#/rules/0/power_scale: found '0'");
    refused(rules(R"({"match": "b", "f0": 0.04})"),
            "my.json#/rules/0/surface: found nothing; allowed: metal");
    refused(rules(R"({"match": "b", "surface": "metal", "f0": [1, 2, 3]})"), "my.json#/rules/0/f0");
    refused(rules(R"({"match": "b", "surface": "metal", "f0": "red"})"), "my.json#/rules/0/f0");
}

/// Words and ranges of the schemas, and those of the reader.
TEST(Rules, SchemaAgreesWithTheJobs) {
    const std::filesystem::path file =
        std::filesystem::path(PBRBAKE_SOURCE_DIR) / "schemas/texture_rules.schema.json";
    const Json schema = job::parse_json(job::read_text(file), file.string());
    const Json& job = job::job_schema().root()["definitions"]["texture"]["properties"];
    for (const auto& [name, rule] : schema["properties"]["rules"]["items"]["properties"].items()) {
        if (name == "match" || name == "f0") continue;
        for (const char* key : {"enum", "minimum", "maximum"})
            EXPECT_EQ(rule.value(key, Json()), job[name].value(key, Json())) << name << " " << key;
        const Json least = rule.contains("enum") ? rule["enum"].back() : rule["minimum"];
        EXPECT_EQ(refusal(rules(Json({{"match", "*"}, {name, least}}).dump())), "");
        if (rule.contains("enum")) continue;
        const double beyond = rule["maximum"].get<double>() * 1.01;
        EXPECT_NE(refusal(rules(Json({{"match", "*"}, {name, beyond}}).dump())), "");
    }
}

}  // namespace
}  // namespace pbrbake::texture::test
