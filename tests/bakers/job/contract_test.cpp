// Schema and code say the same: properties, enumerations, formats, colour spaces.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bakers/dfg/params.hpp"
#include "bakers/formats.hpp"
#include "bakers/ies/params.hpp"
#include "bakers/io/io.hpp"
#include "bakers/job/schema.hpp"
#include "bakers/light/params.hpp"
#include "bakers/probe/params.hpp"
#include "bakers/registry.hpp"
#include "bakers/texture/params.hpp"

namespace pbrbake {
namespace {

const Json& definition(std::string_view name) {
    return job::job_schema().root()["definitions"][std::string(name)];
}

std::vector<std::string> strings(const Json& array) { return array.get<std::vector<std::string>>(); }

TEST(JobSchema, HasJustThePropertiesThatParamsRead) {
    for (const Baker& baker : bakers()) {
        std::vector<std::string> expected{"kind", "name", "format", "pixel", "certify", "accuracy"};
        expected.insert(expected.end(), baker.fields.begin(), baker.fields.end());
        std::vector<std::string> found;
        for (const auto& [name, property] : definition(baker.kind)["properties"].items())
            found.push_back(name);
        EXPECT_THAT(found, testing::UnorderedElementsAreArray(expected)) << baker.kind;
    }
}

TEST(JobSchema, KnowsJustTheBakersThereAre) {
    std::vector<std::string> kinds;
    for (const Baker& baker : bakers()) kinds.emplace_back(baker.kind);
    const Json& item = job::job_schema().root()["properties"]["bakes"]["items"];
    EXPECT_EQ(strings(item["properties"]["kind"]["enum"]), kinds);
    EXPECT_EQ(item["allOf"].size(), kinds.size());
}

template <class T>
struct EnumOf {
    using type = T;
};
template <class T>
struct EnumOf<std::vector<T>> {
    using type = T;
};

template <class Params>
void expect_enums_agree(const std::string& kind) {
    int compared = 0;
    Params::fields([&]<class T>(const char* name, T Params::*) {
        using E = typename EnumOf<T>::type;
        if constexpr (std::is_enum_v<E>) {
            const Json& property = definition(kind)["properties"][name];
            const Json& names = property.contains("items") ? property["items"]["enum"] : property["enum"];
            EXPECT_THAT(strings(names), testing::ElementsAreArray(EnumNames<E>::names))
                << kind << " " << name;
            ++compared;
        }
    });
    EXPECT_GT(compared, 0);
}

TEST(JobSchema, NamesEnumerationsAsParamsDo) {
    expect_enums_agree<dfg::DfgParams>("dfg");
    expect_enums_agree<probe::ProbeParams>("probe");
    expect_enums_agree<ies::IesParams>("ies");
    expect_enums_agree<texture::TextureParams>("texture");
    expect_enums_agree<light::LightParams>("light");
}

TEST(JobSchema, ListsTheFormatsAndColourSpacesOfIo) {
    EXPECT_EQ(strings(definition("format")["enum"]), io::output_formats());
    EXPECT_EQ(strings(definition("probe")["properties"]["colour_space"]["enum"]), io::colour_spaces());
}

TEST(JobSchema, GivesDocumentsFormatsOfTheirOwnAndNoPixels) {
    EXPECT_EQ(strings(definition("light")["properties"]["format"]["enum"]),
              (std::vector<std::string>{"json", "gltf"}));
    for (const char* name : {"json", "gltf"}) {
        ASSERT_NE(find_format(name), nullptr);
        EXPECT_TRUE(find_format(name)->is_document());
        EXPECT_NO_THROW(settle_pixel(name, "auto"));
        EXPECT_THROW(settle_pixel(name, "half"), Error);
    }
}

TEST(JobSchema, NamesEveryPixelTypeOfAFormat) {
    std::vector<std::string> names{"auto"};
    for (const Format& format : formats())
        for (const PixelType pixel : format.pixels) names.emplace_back(pixel_name(pixel));
    EXPECT_THAT(strings(definition("pixel")["enum"]), testing::IsSubsetOf(names));
    for (const std::string& name : names)
        EXPECT_THAT(strings(definition("pixel")["enum"]), testing::Contains(name));
    EXPECT_EQ(settle_pixel("png", "auto"), PixelType::unorm16);
    EXPECT_THROW(settle_pixel("png", "half"), Error);
}

TEST(JobSchema, DescribesEveryProperty) {
    const job::Schema& schema = job::job_schema();
    for (const Baker& baker : bakers())
        for (const auto& [name, property] : definition(baker.kind)["properties"].items())
            if (name != "kind") {
                EXPECT_NE(schema.keyword(property, "description"), nullptr) << baker.kind << " " << name;
            }
}

TEST(JobSchema, GivesEveryOptionalPropertyAValidDefault) {
    const job::Schema& schema = job::job_schema();
    for (const Baker& baker : bakers()) {
        const std::vector<std::string> required = strings(definition(baker.kind)["required"]);
        for (const auto& [name, property] : definition(baker.kind)["properties"].items()) {
            if (std::find(required.begin(), required.end(), name) != required.end()) continue;
            if (name == "accuracy") continue;  // the job's own is its default
            const Json* fallback = schema.keyword(property, "default");
            ASSERT_NE(fallback, nullptr) << baker.kind << " " << name;
            EXPECT_TRUE(schema.accepts(*fallback, property)) << baker.kind << " " << name;
        }
    }
}

}  // namespace
}  // namespace pbrbake
