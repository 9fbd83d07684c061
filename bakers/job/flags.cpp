#include "bakers/job/flags.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

#include "bakers/job/json_text.hpp"
#include "bakers/job/schema.hpp"
#include "bakers/job/words.hpp"

namespace pbrbake::job {
namespace {

constexpr std::string_view kBakePointer = "/bakes/0/";

const Json& definition(std::string_view kind) {
    return job_schema().root()["definitions"][std::string(kind)];
}

const Json& property_at(std::string_view kind, const std::string& pointer) {
    if (pointer.starts_with(kBakePointer))
        return definition(kind)["properties"][pointer.substr(kBakePointer.size())];
    if (pointer.starts_with("/limits/"))
        return job_schema().root()["properties"]["limits"]["properties"][pointer.substr(8)];
    return job_schema().root()["properties"][pointer.substr(1)];
}

bool is_type(const Json& node, const char* type) { return node.contains("type") && node["type"] == type; }

// --- schema to help
// ------------------------------------------------------------------------------------------------

/// "exr|ktx2", "N", "N|N,N": what stands for a value.
std::string placeholder(const Json& reference) {
    constexpr std::size_t kLongest = 28;
    const Json& node = job_schema().resolve(reference);
    std::vector<std::string> choices;
    if (node.contains("enum")) {
        for (const Json& value : node["enum"]) choices.push_back(value.get<std::string>());
        const std::string text = joined(choices, "|");
        return text.size() <= kLongest ? text : "NAME";
    }
    if (node.contains("anyOf")) {
        for (const Json& branch : node["anyOf"]) choices.push_back(placeholder(branch));
        return joined(choices, "|");
    }
    if (is_type(node, "array")) {
        const std::string item = placeholder(node["items"]);
        const int least = node.value("minItems", 0);
        if (least == 0 || least != node.value("maxItems", 0)) return item + ",...";
        return joined(std::vector(static_cast<std::size_t>(least), item), ",");
    }
    if (is_type(node, "object")) return placeholder(node["properties"].front());
    return is_type(node, "integer")   ? "N"
           : is_type(node, "number")  ? "X"
           : is_type(node, "boolean") ? ""
                                      : "FILE";
}

/// A default as a user would type it.
std::string flag_text(const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (!value.is_array()) return to_line(value);
    std::vector<std::string> elements;
    for (const Json& element : value) elements.push_back(flag_text(element));
    return joined(elements, ",");
}

/// What a flag may be and is by default. Lists are typed without quotes or brackets.
std::string facts_of(const Flag& flag, const Json& property, const Json* fallback) {
    const bool shown_by_value =
        flag.value.find('|') != std::string::npos && flag.value.find('N') == std::string::npos;
    std::string facts =
        shown_by_value || flag.is_switch || flag.value == "FILE" ? "" : job_schema().describe(property);
    std::erase(facts, '"');
    for (const std::string_view words : {"an array of ", ", no two alike"})
        if (const auto at = facts.find(words); at != std::string::npos) facts.erase(at, words.size());
    const bool off = flag.is_switch && fallback && !fallback->get<bool>();
    const std::string text = fallback && !off ? flag_text(*fallback) : "";
    if (!text.empty()) facts += (facts.empty() ? "default: " : "; default: ") + text;
    return facts;
}

std::string upper_case(std::string text) {
    for (char& letter : text) letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
    return text;
}

Flag make_flag(const std::string& property_name, const Json& property, std::string pointer) {
    const Schema& schema = job_schema();
    Flag flag;
    flag.name = property_name;
    std::replace(flag.name.begin(), flag.name.end(), '_', '-');
    flag.place = "--" + flag.name;
    flag.pointer = std::move(pointer);
    flag.value = placeholder(property);
    flag.is_switch = is_type(schema.resolve(property), "boolean");

    const Json* description = schema.keyword(property, "description");
    flag.help = description ? description->get<std::string>() : "";
    const Json* fallback = schema.keyword(property, "default");
    const Json& around = schema.root()["properties"];
    if (!fallback && around.contains(property_name))
        fallback = schema.keyword(around[property_name], "default");
    flag.on_by_default = flag.is_switch && fallback && fallback->get<bool>();
    const std::string facts = facts_of(flag, property, fallback);
    if (!facts.empty()) flag.help += " [" + facts + "]";
    return flag;
}

// --- texts to JSON
// -------------------------------------------------------------------------------------------------

template <class Number>
std::optional<Json> parse_number(std::string_view text) {
    Number number{};
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    if (!std::isfinite(static_cast<double>(number))) return std::nullopt;  // JSON has no NaN
    return Json(number);
}

std::optional<Json> convert(const std::string& text, const Json& reference);

/// "a,b,c"; numbers may be written 128x64 as well, but 0x80 is none.
std::optional<Json> convert_array(const std::string& text, const Json& node) {
    const bool numbers = !job_schema().resolve(node["items"]).contains("enum");
    if (numbers && (text.starts_with("0x") || text.starts_with("0X"))) return std::nullopt;
    Json array = Json::array();
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find_first_of(numbers ? ",x" : ",", begin), text.size());
        const std::string part = text.substr(begin, end - begin);
        array.push_back(convert(part, node["items"]).value_or(Json(part)));
        begin = end + 1;
    }
    const bool is_number = array.front().is_number();
    if (numbers && !is_number) return std::nullopt;  // "big" is no list of numbers
    return array;
}

/// The JSON that a text stands for, or nothing if the node's type can't be written that way. Ranges and names
/// are for the schema to judge. An object of one required property is written as that property's value, and
/// the other's, a word, after a colon: `--accuracy 0.001`, `--accuracy 0.001:sampled`.
std::optional<Json> convert(const std::string& text, const Json& reference) {
    const Json& node = job_schema().resolve(reference);
    if (node.contains("enum")) {
        const Json value(text);
        return std::find(node["enum"].begin(), node["enum"].end(), value) == node["enum"].end()
                   ? std::nullopt
                   : std::optional(value);
    }
    if (node.contains("anyOf")) {
        for (const Json& branch : node["anyOf"])
            if (auto value = convert(text, branch)) return value;
        return std::nullopt;
    }
    if (is_type(node, "integer")) return parse_number<std::int64_t>(text);
    if (is_type(node, "number")) return parse_number<double>(text);
    if (is_type(node, "boolean"))
        return text == "true" || text.empty() ? std::optional<Json>(true)
               : text == "false"              ? std::optional<Json>(false)
                                              : std::nullopt;
    if (is_type(node, "array")) return convert_array(text, node);
    if (is_type(node, "object") && node.contains("required") && node["required"].size() == 1) {
        const auto& member = node["required"][0].get_ref<const std::string&>();
        const std::size_t colon = text.find(':');
        const auto value = convert(text.substr(0, colon), node["properties"][member]);
        if (!value) return std::nullopt;
        if (colon == std::string::npos) return Json{{member, *value}};
        for (const auto& [name, property] : node["properties"].items())
            if (name != member) return Json{{member, *value}, {name, text.substr(colon + 1)}};
        return std::nullopt;
    }
    return Json(text);
}

/// A product's name from its file: what a name can't hold becomes "_".
std::string name_from(const std::filesystem::path& output) {
    std::string name = output.stem().string().substr(0, 100);
    for (char& letter : name) {
        const bool plain = (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
                           (letter >= '0' && letter <= '9') || letter == '.' || letter == '-';
        if (!plain) letter = '_';
    }
    if (name.starts_with('.') || name.starts_with('-')) name.front() = '_';
    return name;
}

/// Puts the format that the output's extension says into the bake, if none was given; refuses what disagrees.
void settle_format(Json& bake, const std::filesystem::path& output) {
    const Json& formats =
        job_schema().resolve(definition(bake["kind"].get_ref<const std::string&>())["properties"]["format"]);
    const std::string extension = output.extension().string();
    const std::string format = extension.empty() ? "" : extension.substr(1);
    if (output.filename().empty() || output.stem().empty() || !convert(format, formats))
        throw JobError(ExitCode::usage,
                       {{"-o", "found \"" + output.string() + "\"; allowed: a file name that ends " +
                                   "in \".\" and one of " + job_schema().describe(formats)}});
    if (bake.contains("format") && bake["format"].is_string() && convert(bake["format"], formats) &&
        bake["format"] != format)
        throw JobError(ExitCode::usage,
                       {{"--format", "found " + shown(bake["format"]) + ", but -o ends in \"" + extension +
                                         "\"; leave --format out or make them agree"}});
    if (!bake.contains("format")) bake["format"] = format;
}

}  // namespace

std::vector<Flag> flags_of(std::string_view kind) {
    const Json& around = job_schema().root()["properties"];
    const Json& bake = definition(kind);
    std::vector<Flag> flags;
    for (const auto& [name, property] : bake["properties"].items()) {
        if (name == "kind" || name == "name") continue;
        Flag flag = make_flag(name, property, std::string(kBakePointer) + name);
        flag.is_required =
            std::find(bake["required"].begin(), bake["required"].end(), name) != bake["required"].end();
        if (flag.is_required) flag.place = upper_case(flag.name);
        flags.push_back(std::move(flag));
    }
    flags.push_back(make_flag("working_space", around["working_space"], "/working_space"));
    for (const auto& [name, property] : around["limits"]["properties"].items())
        flags.push_back(make_flag(name, property, "/limits/" + name));
    return flags;
}

std::string example_of(std::string_view kind) {
    const Json& example = definition(kind)["examples"].front();
    std::string sources, flags;
    for (const Flag& flag : flags_of(kind)) {
        const std::string property = flag.pointer.substr(flag.pointer.rfind('/') + 1);
        if (property == "format" || !example.contains(property)) continue;
        const std::string text = flag_text(example[property]);
        if (flag.is_required)
            sources += " " + text;
        else
            flags += " --" + flag.name + (flag.is_switch ? "" : " " + text);
    }
    const auto format =
        example.value("format", *job_schema().keyword(definition(kind)["properties"]["format"], "default"));
    return "pbrbake " + std::string(kind) + sources + flags + " -o " + example["name"].get<std::string>() +
           "." + format.get<std::string>();
}

std::string title_of(std::string_view kind) { return definition(kind)["title"].get<std::string>(); }

Job from_flags(std::string_view kind, std::span<const FlagText> texts, const std::filesystem::path& output) {
    const std::vector<Flag> flags = flags_of(kind);
    Json document{{"version", 1},
                  {"bakes", Json::array({Json{{"kind", kind}, {"name", name_from(output)}}})}};
    for (const FlagText& given : texts) {
        const auto flag = std::find_if(flags.begin(), flags.end(),
                                       [&](const Flag& candidate) { return candidate.name == given.name; });
        if (flag == flags.end()) throw JobError(ExitCode::usage, {{"--" + given.name, "unknown flag"}});
        document[Json::json_pointer(flag->pointer)] =
            convert(given.text, property_at(kind, flag->pointer)).value_or(Json(given.text));
    }
    settle_format(document["bakes"][0], output);

    OneShot command{output, {{"/bakes/0/name", "-o"}, {"/limits", "--max-side"}}};
    for (const Flag& flag : flags) command.places.emplace_back(flag.pointer, flag.place);
    return from_document(std::move(document), command);
}

}  // namespace pbrbake::job
