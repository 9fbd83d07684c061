#include "bakers/job/schema.hpp"

#include <algorithm>
#include <sstream>

#include "bakers/job/json_text.hpp"
#include "bakers/job/words.hpp"

namespace pbrbake {
extern const std::string_view job_schema_text;
}

namespace pbrbake::job {
namespace {

std::string number_text(const Json& number) {
    constexpr std::int64_t kLargestExact = (std::int64_t{1} << 53) - 1;  // that every JSON library holds
    if (number == kLargestExact) return "2^53 - 1";
    std::ostringstream stream;
    stream.imbue(std::locale::classic());
    if (number.is_number_float())
        stream << number.get<double>();
    else
        stream << number.get<std::int64_t>();
    return stream.str();
}

std::vector<std::string> keys_of(const Json& object) {
    std::vector<std::string> keys;
    for (const auto& [key, unused] : object.items()) keys.push_back(key);
    return keys;
}

/// The names that a node allows, itself or in a branch.
std::vector<std::string> names_of(const Json& node) {
    std::vector<std::string> names;
    if (node.contains("enum"))
        for (const Json& name : node["enum"])
            if (name.is_string()) names.push_back(name.get<std::string>());
    if (node.contains("anyOf"))
        for (const Json& branch : node["anyOf"])
            for (std::string& name : names_of(branch)) names.push_back(std::move(name));
    return names;
}

bool has_type(const Json& node, const char* type) {
    const auto found = node.find("type");
    return found != node.end() && *found == type;
}

/// The branch of an anyOf that a structured value was meant for: the only one of its type.
const Json* branch_for(const Schema& schema, const Json& value, const Json& branches) {
    if (!value.is_structured()) return nullptr;
    const Json* found = nullptr;
    for (const Json& branch : branches) {
        if (!has_type(schema.resolve(branch), value.is_array() ? "array" : "object")) continue;
        if (found) return nullptr;
        found = &branch;
    }
    return found;
}

/// Whether a mistake is known at a pointer or inside it.
bool has_mistake(const std::vector<Mistake>& mistakes, const std::string& at) {
    return std::any_of(mistakes.begin(), mistakes.end(),
                       [&](const Mistake& mistake) { return (mistake.pointer + "/").starts_with(at + "/"); });
}

void add(std::vector<Mistake>& out, std::string pointer, std::string message) {
    for (const Mistake& mistake : out)
        if (mistake.pointer == pointer && mistake.message == message) return;
    out.push_back({std::move(pointer), std::move(message)});
}

}  // namespace

const Schema& job_schema() {
    static const Schema schema(parse_json(job_schema_text, "job.schema.json"));
    return schema;
}

std::string shown(const Json& value) {
    constexpr std::size_t kLongest = 60;
    std::string text = to_line(value);
    if (text.size() <= kLongest) return text;
    std::size_t cut = kLongest - 1;
    while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xC0) == 0x80)
        --cut;  // not inside a character
    return text.substr(0, cut) + "…";
}

std::string step(const std::string& pointer, std::string_view token) {
    return (Json::json_pointer(pointer) / std::string(token)).to_string();
}

const Json& Schema::resolve(const Json& node) const {
    if (const auto ref = node.find("$ref"); ref != node.end())
        return resolve(root_.at(Json::json_pointer(ref->get_ref<const std::string&>().substr(1))));
    if (const auto all = node.find("allOf");
        all != node.end() && all->size() == 1 && all->front().contains("$ref"))
        return resolve(all->front());
    return node;
}

const Json* Schema::keyword(const Json& node, const char* name) const {
    for (const Json* place : {&node, &resolve(node)})
        if (const auto found = place->find(name); found != place->end()) return &*found;
    return nullptr;
}

// --- words
// ---------------------------------------------------------------------------------------------------------

std::string Schema::describe_range(const Json& node, const char* type) const {
    std::string text = type;
    const bool above = node.contains("exclusiveMinimum"), from = node.contains("minimum"),
               to = node.contains("maximum");
    if (from && to) return text + " " + number_text(node["minimum"]) + " to " + number_text(node["maximum"]);
    if (above) text += " above " + number_text(node["exclusiveMinimum"]);
    if (from) text += ", at least " + number_text(node["minimum"]);
    if (to) text += ", at most " + number_text(node["maximum"]);
    return text;
}

std::string Schema::describe_array(const Json& node) const {
    const std::size_t least = node.value("minItems", std::size_t{0});
    const std::size_t most = node.value("maxItems", std::size_t{0});
    std::string text = "an array of ";
    if (least == most && least > 0)
        text += std::to_string(least) + " of ";
    else if (most > 0)
        text += std::to_string(least) + " to " + std::to_string(most) + " of ";
    else if (least > 0)
        text += std::to_string(least) + " or more of ";
    text += node.contains("items") ? describe(node["items"]) : "anything";
    return text + (node.value("uniqueItems", false) ? ", no two alike" : "");
}

std::string Schema::describe(const Json& reference) const {
    const Json& node = resolve(reference);
    if (node.contains("const")) return to_line(node["const"]);
    if (node.contains("enum")) {
        std::vector<std::string> values;
        for (const Json& value : node["enum"]) values.push_back(to_line(value));
        return joined(values);
    }
    if (node.contains("anyOf")) {
        std::vector<std::string> branches;
        std::string before;
        for (const Json& branch : node["anyOf"]) {
            std::string words = describe(branch);
            if (!before.empty() && words.ends_with(before))
                words.replace(words.size() - before.size(), before.size(), "those");
            before = words;
            branches.push_back(std::move(words));
        }
        return joined(branches, ", or ");
    }
    if (has_type(node, "integer")) return describe_range(node, "integer");
    if (has_type(node, "number")) return describe_range(node, "number");
    if (has_type(node, "boolean")) return "true, false";
    if (has_type(node, "array")) return describe_array(node);
    if (has_type(node, "string")) {
        const Json* description = keyword(reference, "description");
        return description ? "a string (" + description->get<std::string>() + ")" : "a string, not empty";
    }
    if (has_type(node, "object")) {
        std::vector<std::string> required;
        if (node.contains("required"))
            for (const Json& key : node["required"]) required.push_back(to_line(key));
        return required.empty() ? "an object" : "an object with " + joined(required);
    }
    return "see the schema";
}

std::string Schema::refusal(const Json& value, const Json& node) const {
    const std::string hint =
        value.is_string() ? did_you_mean(value.get_ref<const std::string&>(), names_of(resolve(node))) : "";
    return "found " + shown(value) + "; allowed: " + describe(node) + hint;
}

// --- mistakes
// ------------------------------------------------------------------------------------------------------

std::vector<Mistake> Schema::mistakes(const Json& value) const {
    std::vector<Mistake> out;
    explain(value, root_, "", out);
    return out;
}

void Schema::explain(const Json& value, const Json& reference, const std::string& at,
                     std::vector<Mistake>& out) const {
    if (accepts(value, reference)) return;
    const Json& node = resolve(reference);
    if ((has_type(node, "object") && !value.is_object()) || (has_type(node, "array") && !value.is_array())) {
        add(out, at, refusal(value, node));
        return;
    }
    if (node.contains("anyOf")) {
        if (const Json* branch = branch_for(*this, value, node["anyOf"])) explain(value, *branch, at, out);
    } else if (has_type(node, "object")) {
        explain_object(value, node, at, out);
    } else if (has_type(node, "array") && node.contains("items")) {
        for (std::size_t i = 0; i < value.size(); ++i)
            explain(value[i], node["items"], step(at, std::to_string(i)), out);
    }
    explain_conditions(value, node, at, out);
    if (!has_mistake(out, at)) add(out, at, refusal(value, node));
}

void Schema::explain_object(const Json& value, const Json& node, const std::string& at,
                            std::vector<Mistake>& out) const {
    static const Json none = Json::object();
    const Json& properties = node.contains("properties") ? node["properties"] : none;
    for (const auto& [key, property] : properties.items())
        if (value.contains(key)) explain(value[key], property, step(at, key), out);
    if (node.contains("required"))
        for (const Json& key : node["required"])
            if (!value.contains(key.get<std::string>()))
                add(out, step(at, key.get<std::string>()),
                    "missing; allowed: " + describe(properties.value(key.get<std::string>(), none)));
    if (node.value("additionalProperties", true)) return;
    for (const auto& [key, unused] : value.items())
        if (!properties.contains(key))
            add(out, step(at, key),
                "unknown key; allowed: " + joined(keys_of(properties)) +
                    did_you_mean(key, keys_of(properties)));
}

void Schema::explain_conditions(const Json& value, const Json& node, const std::string& at,
                                std::vector<Mistake>& out) const {
    if (!node.contains("allOf")) return;
    for (const Json& part : node["allOf"])
        if (!part.contains("if"))
            explain(value, part, at, out);
        else if (accepts(value, part["if"]))
            explain(value, part["then"], at, out);
}

// --- defaults
// ------------------------------------------------------------------------------------------------------

void Schema::complete(Json& value, const Json& reference) const {
    const Json& node = resolve(reference);
    if (value.is_array() && node.contains("items"))
        for (Json& element : value) complete(element, node["items"]);
    if (value.is_object() && node.contains("properties")) {
        Json ordered = Json::object();
        for (const auto& [key, property] : node["properties"].items()) {
            if (value.contains(key))
                ordered[key] = std::move(value[key]);
            else if (const Json* fallback = keyword(property, "default"))
                ordered[key] = *fallback;
            else
                continue;
            value.erase(key);
            complete(ordered[key], property);
        }
        ordered.update(value);  // what this node does not know
        value = std::move(ordered);
    }
    if (value.is_object() && node.contains("allOf"))
        for (const Json& part : node["allOf"])
            if (part.contains("if") && accepts(value, part["if"])) complete(value, part["then"]);
}

}  // namespace pbrbake::job
