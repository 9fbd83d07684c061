#include "bakers/parse/json_fields.hpp"

#include <algorithm>
#include <cmath>

#include "bakers/job/json_text.hpp"
#include "bakers/job/words.hpp"
#include "bakers/parse/text.hpp"

namespace pbrbake::parse {
namespace {

std::string shown(const Json& value) {
    if (value.is_object()) return "an object";
    if (value.is_array()) return "an array of " + std::to_string(value.size());
    return parse::quoted(job::to_line(value));
}

bool is_finite(const Json& value) { return value.is_number() && std::isfinite(value.get<double>()); }

std::string joined(const std::string& place, std::string_view key) {
    return place + (place.find('#') == std::string::npos ? "#/" : "/") + std::string(key);
}

constexpr int kDeepest = 512;  ///< deeper than scenes are, and bounded

}  // namespace

Json parse_json_source(std::string_view text, const std::string& file) {
    try {
        return job::parse_json(text, file, kDeepest);
    } catch (const Error& error) {
        throw Error(ExitCode::unreadable_input, error.where(), error.message());
    }
}

bool JsonFields::has(std::string_view key) const {
    return json_->is_object() && json_->contains(std::string(key)) && !(*json_)[std::string(key)].is_null();
}

const Json* JsonFields::find(std::initializer_list<std::string_view> keys, std::string_view& found) const {
    for (const std::string_view key : keys)
        if (has(key)) {
            found = key;
            return &(*json_)[std::string(key)];
        }
    return nullptr;
}

void JsonFields::refuse(std::string_view key, std::string_view allowed) const {
    const std::string name(key);
    const std::string what = json_->is_object() && json_->contains(name) ? shown((*json_)[name]) : "nothing";
    throw Error(ExitCode::unreadable_input, joined(place_, key),
                "found " + what + "; allowed: " + std::string(allowed));
}

void JsonFields::allow(const std::vector<std::string>& keys) const {
    for (const auto& [key, value] : json_->items())
        if (std::ranges::find(keys, key) == keys.end())
            throw Error(ExitCode::unreadable_input, joined(place_, key),
                        "unknown key; allowed: " + job::joined(keys) + job::did_you_mean(key, keys));
}

std::optional<double> JsonFields::number(std::initializer_list<std::string_view> keys) const {
    std::string_view key;
    const Json* value = find(keys, key);
    if (!value) return {};
    if (!is_finite(*value)) refuse(key, "a finite number");
    return value->get<double>();
}

double JsonFields::number(std::initializer_list<std::string_view> keys, double fallback) const {
    return number(keys).value_or(fallback);
}

std::string JsonFields::text(std::initializer_list<std::string_view> keys, std::string fallback) const {
    std::string_view key;
    const Json* value = find(keys, key);
    if (!value) return fallback;
    if (!value->is_string()) refuse(key, "a text");
    return value->get<std::string>();
}

bool JsonFields::boolean(std::string_view key, bool fallback) const {
    if (!has(key)) return fallback;
    const Json& value = (*json_)[std::string(key)];
    if (!value.is_boolean()) refuse(key, "true or false");
    return value.get<bool>();
}

std::optional<std::vector<double>> JsonFields::numbers(std::initializer_list<std::string_view> keys,
                                                       std::size_t count) const {
    std::string_view key;
    const Json* value = find(keys, key);
    if (!value) return {};
    const std::string allowed = "an array of " + std::to_string(count) + " finite numbers";
    if (!value->is_array() || value->size() != count) refuse(key, allowed);
    std::vector<double> list;
    for (const Json& element : *value) {
        if (!is_finite(element)) refuse(key, allowed);
        list.push_back(element.get<double>());
    }
    return list;
}

std::optional<glm::dvec3> JsonFields::vector(std::initializer_list<std::string_view> keys) const {
    const auto list = numbers(keys, 3);
    if (!list) return {};
    return glm::dvec3((*list)[0], (*list)[1], (*list)[2]);
}

std::optional<JsonFields> JsonFields::object(std::initializer_list<std::string_view> keys) const {
    std::string_view key;
    const Json* value = find(keys, key);
    if (!value) return {};
    if (!value->is_object()) refuse(key, "an object");
    return JsonFields(*value, joined(place_, key));
}

std::vector<JsonFields> JsonFields::objects(std::string_view key) const {
    std::vector<JsonFields> list;
    if (!has(key)) return list;
    const Json& array = (*json_)[std::string(key)];
    if (!array.is_array()) refuse(key, "an array of objects");
    for (std::size_t i = 0; i < array.size(); ++i) {
        list.emplace_back(array[i], joined(joined(place_, key), std::to_string(i)));
        if (!array[i].is_object())
            throw Error(ExitCode::unreadable_input, list.back().place(),
                        "found " + shown(array[i]) + "; allowed: an object");
    }
    return list;
}

std::optional<std::size_t> JsonFields::index(std::string_view key, std::size_t count) const {
    if (!has(key)) return {};
    const Json& value = (*json_)[std::string(key)];
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= count)
        refuse(key, count == 0 ? "nothing, as there is none to refer to"
                               : "a whole number below " + std::to_string(count));
    return value.get<std::size_t>();
}

std::vector<std::size_t> JsonFields::indices(std::string_view key, std::size_t count) const {
    std::vector<std::size_t> list;
    if (!has(key)) return list;
    const Json& array = (*json_)[std::string(key)];
    const std::string allowed = "an array of whole numbers below " + std::to_string(count);
    if (!array.is_array()) refuse(key, allowed);
    for (const Json& element : array) {
        if (!element.is_number_unsigned() || element.get<std::uint64_t>() >= count) refuse(key, allowed);
        list.push_back(element.get<std::size_t>());
    }
    return list;
}

}  // namespace pbrbake::parse
