#include "bakers/parse/rules.hpp"

#include "bakers/parse/text.hpp"

namespace pbrbake::parse {
std::vector<Rule> parse_rules(std::span<const std::byte> bytes, const std::string& file) {
    std::vector<Diagnostic> diagnostics;
    const Json json = parse_json_source(decode_text(bytes, file, diagnostics), file);
    const JsonFields root(json, file);
    if (!json.is_object())
        throw malformed(file, 0, "is no JSON object; allowed: {\"version\": 1, \"rules\": […]}");
    for (const auto& [key, value] : json.items())
        if (key != "version" && key != "rules") root.refuse(key, "version, rules");
    if (root.number({"version"}, 0) != 1) root.refuse("version", "1");
    if (!root.has("rules")) root.refuse("rules", "an array of objects");
    std::vector<Rule> rules;
    for (const JsonFields& fields : root.objects("rules")) {
        Rule rule{fields.text({"match"}, ""), fields.json(), fields.place()};
        if (rule.match.empty()) fields.refuse("match", "a pattern of names, as in \"*concrete*\"");
        rules.push_back(std::move(rule));
    }
    return rules;
}

}  // namespace pbrbake::parse
