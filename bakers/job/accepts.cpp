// The one translation unit that compiles valijson.

#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "bakers/job/schema.hpp"

namespace pbrbake::job {

bool Schema::accepts(const Json& value, const Json& node) const {
    // valijson knows nlohmann's unordered type alone, and resolves "#/definitions/…" within the document it
    // is given.
    nlohmann::json document{{"allOf", nlohmann::json::array({nlohmann::json(node)})}};
    if (root_.contains("definitions")) document["definitions"] = nlohmann::json(root_.at("definitions"));
    const nlohmann::json target(value);

    valijson::Schema schema;
    valijson::SchemaParser(valijson::SchemaParser::kDraft7)
        .populateSchema(valijson::adapters::NlohmannJsonAdapter(document), schema);
    valijson::Validator validator;
    return validator.validate(schema, valijson::adapters::NlohmannJsonAdapter(target), nullptr);
}

}  // namespace pbrbake::job
