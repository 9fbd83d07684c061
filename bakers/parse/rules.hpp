#pragma once
// A file of rules: which names, and what is known of what is called so.
//
//     {"version": 1, "rules": [{"match": "*concrete*", "f0": 0.04}, …]}

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "bakers/parse/json_fields.hpp"

namespace pbrbake::parse {

/// One rule: the names it is for, and what else it holds, for the baker to read.
struct Rule {
    std::string match;  ///< a pattern, not empty
    Json fields;
    std::string place;  ///< "rules.json#/rules/0"
    JsonFields read() const { return {fields, place}; }
};

/// Throws Error(unreadable_input) naming file and pointer for what is no JSON, another version, or no rules.
std::vector<Rule> parse_rules(std::span<const std::byte> bytes, const std::string& file);

}  // namespace pbrbake::parse
