#pragma once
// Command-line flags of a one-shot command, made from the job schema at run time.

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/job/job.hpp"

namespace pbrbake::job {

/// A property of a bake (or of the job around it) as a flag.
struct Flag {
    std::string name;     ///< "roughness-axis"
    std::string pointer;  ///< of the property in a job: "/bakes/0/roughness_axis"
    std::string place;    ///< how messages name it: "--roughness-axis", or "SOURCE" if it is required
    std::string value;  ///< what stands for its value in a help text: "perceptual|alpha", "N", "N,N", "FILE"
    std::string help;   ///< the property's description, then what is allowed and the default
    bool is_switch = false;      ///< may be given without a value, which means true
    bool on_by_default = false;  ///< of a switch
    bool is_required = false;    ///< is given as a positional argument
};

/// The flags of a kind of bake: the kind's properties in the schema's order, then those of the job around it.
/// `name` and `kind` are no flags: the command is the kind, and the output file gives the name.
std::vector<Flag> flags_of(std::string_view kind);

/// One line on a kind of bake: its title in the schema.
std::string title_of(std::string_view kind);

/// The first of a kind's examples in the schema, as a command.
std::string example_of(std::string_view kind);

/// A flag as the user gave it.
struct FlagText {
    std::string name;
    std::string text;
};

/// The job of a one-shot command. The output's extension gives the format (`--format` must agree with it, if
/// given). Throws JobError(usage) naming the flags.
Job from_flags(std::string_view kind, std::span<const FlagText> flags, const std::filesystem::path& output);

}  // namespace pbrbake::job
