#include "bakers/verify/thresholds.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "bakers/job/json_text.hpp"
#include "bakers/job/schema.hpp"

namespace pbrbake {
extern const std::string_view thresholds_schema_text;
}

namespace pbrbake::verify {
namespace {

const job::Schema& schema() {
    static const job::Schema instance(job::parse_json(thresholds_schema_text, "thresholds.schema.json"));
    return instance;
}

std::string type_of(const Json& property) { return property["type"].get<std::string>(); }

std::optional<double> number_of(std::string_view text) {
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(number)) return {};
    return number;
}

/// The JSON that a flag's text stands for; the text itself where it stands for none, for the schema to
/// refuse.
Json value_of(const std::string& text, const Json& property) {
    const std::string type = type_of(property);
    if (type == "boolean") return text == "true" || text == "false" ? Json(text == "true") : Json(text);
    if (type == "array") {
        const std::size_t comma = std::min(text.find(','), text.size() - 1);
        const auto first = number_of(std::string_view(text).substr(0, comma)),
                   second = number_of(std::string_view(text).substr(comma + 1));
        return first && second ? Json{*first, *second} : Json(text);
    }
    const auto number = number_of(text);
    if (!number) return text;
    return type == "integer" && *number == std::trunc(*number) ? Json(static_cast<std::int64_t>(*number))
                                                               : Json(*number);
}

std::string flag_of(const std::string& property) {
    std::string flag = property;
    std::ranges::replace(flag, '_', '-');
    return flag;
}

std::string property_of(const std::string& flag) {
    std::string property = flag;
    std::ranges::replace(property, '-', '_');
    return property;
}

Thresholds from_json(const Json& json) {
    Thresholds thresholds{json["max_ulp"].get<std::uint64_t>(),
                          json["max_relative_rms"].get<double>(),
                          json["max_relative_p99"].get<double>(),
                          json["max_relative"].get<double>(),
                          json["max_energy_change"].get<double>(),
                          json["max_flip"].get<double>(),
                          json["max_document_change"].get<double>(),
                          json["max_certificate_change"].get<double>(),
                          json["any_format"].get<bool>(),
                          {}};
    if (json.contains("flip_exposures"))
        thresholds.flip_exposures = {json["flip_exposures"][0].get<double>(),
                                     json["flip_exposures"][1].get<double>()};
    return thresholds;
}

}  // namespace

std::vector<ThresholdFlag> threshold_flags() {
    std::vector<ThresholdFlag> flags;
    for (const auto& [name, property] : schema().root()["properties"].items()) {
        const std::string type = type_of(property);
        ThresholdFlag flag{flag_of(name),
                           type == "integer"  ? "N"
                           : type == "number" ? "X"
                           : type == "array"  ? "X,X"
                                              : "",
                           property["description"].get<std::string>(), type == "boolean"};
        if (!flag.is_switch) {
            flag.help += " [" + schema().describe(property);
            if (property.contains("default")) flag.help += "; default: " + job::to_line(property["default"]);
            flag.help += "]";
        }
        flags.push_back(std::move(flag));
    }
    return flags;
}

Thresholds read_thresholds(const std::optional<std::filesystem::path>& file,
                           const std::vector<std::pair<std::string, std::string>>& flags) {
    Json json = Json::object();
    if (file) {
        json = job::parse_json(job::read_text(*file), file->string());
        if (const auto mistakes = schema().mistakes(json); !mistakes.empty())
            throw Error(ExitCode::invalid_job, file->string() + "#" + mistakes.front().pointer,
                        mistakes.front().message);
    }
    for (const auto& [flag, text] : flags) {
        const std::string name = property_of(flag);
        json[name] = value_of(text, schema().root()["properties"][name]);
        if (const auto mistakes = schema().mistakes(json); !mistakes.empty())
            throw Error(ExitCode::usage, "--" + flag, mistakes.front().message);
    }
    schema().complete(json);
    return from_json(json);
}

Json thresholds_json(const Thresholds& thresholds) {
    Json json{{"max_ulp", thresholds.max_ulp},
              {"max_relative_rms", thresholds.max_relative_rms},
              {"max_relative_p99", thresholds.max_relative_p99},
              {"max_relative", thresholds.max_relative},
              {"max_energy_change", thresholds.max_energy_change},
              {"max_flip", thresholds.max_flip},
              {"max_document_change", thresholds.max_document_change},
              {"max_certificate_change", thresholds.max_certificate_change},
              {"any_format", thresholds.any_format}};
    if (thresholds.flip_exposures)
        json["flip_exposures"] = {thresholds.flip_exposures->first, thresholds.flip_exposures->second};
    return json;
}

}  // namespace pbrbake::verify
