#include "cli/command.hpp"
namespace pbrbake::cli {
ExitCode inspect_command(const Arguments&) { return ExitCode::usage; }
}  // namespace pbrbake::cli
