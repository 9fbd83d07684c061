#pragma once
// The subcommands there are. A new one is a line in command.cpp's table and a file.

#include <functional>
#include <string>
#include <vector>

#include "bakers/error.hpp"

namespace pbrbake::cli {

/// What follows the command's own name on the command line.
using Arguments = std::vector<std::string>;

struct Command {
    std::string name;
    std::string summary;  ///< one line for `pbrbake --help`
    std::function<ExitCode(const Arguments&)> run;
};

/// In the order of the help text.
std::vector<Command> commands();

ExitCode bake_command(const Arguments& arguments);
ExitCode one_shot_command(const std::string& kind, const Arguments& arguments);
/// Of `pbrbake ies --convert`.
ExitCode convert_command(const Arguments& arguments);
ExitCode inspect_command(const Arguments& arguments);
ExitCode demo_command(const Arguments& arguments);
ExitCode study_command(const Arguments& arguments);

/// One line on stderr for each mistake: "pbrbake: error: …".
void print_error(const Error& error);

}  // namespace pbrbake::cli
