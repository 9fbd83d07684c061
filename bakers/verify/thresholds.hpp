#pragma once
// What compare lets pass. schemas/thresholds.schema.json is the source of names, ranges, defaults and help.

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/baker.hpp"

namespace pbrbake::verify {

struct Thresholds {
    std::uint64_t max_ulp;
    double max_relative_rms, max_relative_p99, max_relative, max_energy_change, max_flip, max_document_change,
        max_certificate_change;
    bool any_format;
    std::optional<std::pair<double, double>> flip_exposures;
};

/// A threshold as a flag.
struct ThresholdFlag {
    std::string name;   ///< "max-ulp"
    std::string value;  ///< "N", "X", "X,X"; empty for a switch
    std::string help;   ///< with range and default
    bool is_switch = false;
};
std::vector<ThresholdFlag> threshold_flags();

/// The defaults, then what a file says, then flags (name and text). Throws Error(unreadable_input) for a file
/// that isn't there, Error(invalid_job) for one that breaks the schema, naming file and pointer, and
/// Error(usage) naming the flag.
Thresholds read_thresholds(const std::optional<std::filesystem::path>& file,
                           const std::vector<std::pair<std::string, std::string>>& flags);

/// As in a thresholds file.
Json thresholds_json(const Thresholds& thresholds);

}  // namespace pbrbake::verify
