#pragma once
// What all commands that bake share: how to run, what to tell, what to write besides products.

#include <span>

#include "bakers/job/job.hpp"
#include "cli/options.hpp"

namespace pbrbake::cli {

/// --threads, --dry-run, --report, --html, --depfile, --json, --quiet.
OptionGroup run_option_group();

/// Whether an option is one of those.
bool is_run_option(const std::string& name);

/// Of --threads; all processors if it isn't given. Throws Error(usage).
int threads_of(const Given& given);

/// Runs jobs as the options say, with progress on stderr and interruption by signals.
ExitCode execute(std::span<const job::Job> jobs, const Given& given, std::vector<std::string> only = {});

}  // namespace pbrbake::cli
