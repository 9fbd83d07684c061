#include "bakers/job/schema.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bakers/job/json_text.hpp"
#include "bakers/job/words.hpp"

namespace pbrbake::job {
namespace {

Schema schema(const char* text) { return Schema(parse_json(text, "schema")); }

std::vector<std::string> lines(const Schema& judge, const char* text) {
    const Json value = parse_json(text, "value");
    std::vector<std::string> list;
    for (const Mistake& mistake : judge.mistakes(value))
        list.push_back(mistake.pointer + ": " + mistake.message);
    EXPECT_EQ(list.empty(), judge.accepts(value, judge.root())) << text;
    return list;
}

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Schema, SaysWhatItFoundAndWhatIsAllowed) {
    const Schema sizes = schema(R"({"properties": {"size": {"anyOf": [
        {"type": "integer", "minimum": 1, "maximum": 4096},
        {"type": "array", "minItems": 2, "maxItems": 2, "items": {"type": "integer", "minimum": 1, "maximum": 4096}}
    ]}}, "type": "object"})");
    EXPECT_THAT(lines(sizes, R"({"size": 7})"), IsEmpty());
    EXPECT_THAT(lines(sizes, R"({"size": [7, 8]})"), IsEmpty());
    EXPECT_THAT(lines(sizes, R"({"size": "big"})"),
                ElementsAre(R"(/size: found "big"; allowed: integer 1 to 4096, or an array of 2 of those)"));
    EXPECT_THAT(lines(sizes, R"({"size": [7, 0]})"),
                ElementsAre("/size/1: found 0; allowed: integer 1 to 4096"));
    EXPECT_THAT(lines(sizes, R"({"size": [7]})"),
                ElementsAre("/size: found [7]; allowed: an array of 2 of integer 1 to 4096"));
}

TEST(Schema, FindsEveryMistakeOfAnObject) {
    const Schema object =
        schema(R"({"type": "object", "additionalProperties": false, "required": ["a"], "properties": {
        "a": {"type": "boolean"}, "axis": {"enum": ["nov", "sqrt_nov"]}}})");
    EXPECT_THAT(
        lines(object, R"({"axis": "sqrt-nov", "ax/is": 1})"),
        ElementsAre(R"(/axis: found "sqrt-nov"; allowed: "nov", "sqrt_nov"; did you mean "sqrt_nov"?)",
                    "/a: missing; allowed: true, false",
                    R"(/ax~1is: unknown key; allowed: a, axis; did you mean "axis"?)"));
    EXPECT_THAT(lines(object, "7"), ElementsAre(R"(: found 7; allowed: an object with "a")"));
}

TEST(Schema, DescribesRangesAndArrays) {
    const auto described = [](const char* text) {
        const Schema node = schema(text);
        return node.describe(node.root());
    };
    EXPECT_EQ(described(R"({"type": "number", "exclusiveMinimum": 0})"), "number above 0");
    EXPECT_EQ(described(R"({"type": "number", "minimum": 0, "maximum": 1})"), "number 0 to 1");
    EXPECT_EQ(described(R"({"type": "integer", "minimum": 3})"), "integer, at least 3");
    EXPECT_EQ(
        described(R"({"type": "array", "minItems": 1, "uniqueItems": true, "items": {"enum": ["a", "b"]}})"),
        "an array of 1 or more of \"a\", \"b\", no two alike");
    EXPECT_EQ(described(R"({"const": 1})"), "1");
}

TEST(Schema, FollowsTheBranchWhoseConditionHolds) {
    const Schema either = schema(R"({"type": "object", "allOf": [
        {"if": {"properties": {"kind": {"const": "a"}}}, "then": {"type": "object", "properties": {"x": {"type": "integer"}}}},
        {"if": {"properties": {"kind": {"const": "b"}}}, "then": {"type": "object", "properties": {"x": {"type": "boolean"}}}}
    ]})");
    EXPECT_THAT(lines(either, R"({"kind": "a", "x": 1})"), IsEmpty());
    EXPECT_THAT(lines(either, R"({"kind": "b", "x": 1})"), ElementsAre("/x: found 1; allowed: true, false"));
}

TEST(Schema, FillsInDefaultsInItsOwnOrder) {
    const Schema nested = schema(R"({"type": "object", "properties": {
        "b": {"$ref": "#/definitions/five"}, "a": {"type": "object", "default": {}, "properties": {"c": {"default": 6}}}
    }, "definitions": {"five": {"default": 5}}})");
    Json value = Json::object();
    nested.complete(value);
    EXPECT_EQ(to_line(value), R"({"b":5,"a":{"c":6}})");
    value = parse_json(R"({"a": {"c": 1}, "b": 2})", "value");
    nested.complete(value);
    EXPECT_EQ(to_line(value), R"({"b":2,"a":{"c":1}})");
}

TEST(Shown, CutsLongValuesBetweenCharacters) {
    std::string long_text;
    for (int i = 0; i < 100; ++i) long_text += "é";
    const std::string text = shown(Json(long_text));
    EXPECT_LE(text.size(), 64u);
    EXPECT_NO_THROW(Json::parse("\"" + text.substr(1) + "\""));
}

TEST(Nearest, KnowsSwappedAndMissingLetters) {
    EXPECT_EQ(nearest("sgrb", {"raw", "srgb"}), "srgb");
    EXPECT_EQ(nearest("sampels", {"samples", "size"}), "samples");
    EXPECT_EQ(nearest("colour", {"samples", "size"}), "");
    EXPECT_EQ(nearest("", {"size"}), "");
    EXPECT_EQ(nearest(std::string(100000, 'x'), {"size"}), "");
}

}  // namespace
}  // namespace pbrbake::job
