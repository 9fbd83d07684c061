// pbrbake bake JOB…: job files.

#include <set>

#include "cli/execute.hpp"

namespace pbrbake::cli {
namespace {

/// All jobs, or all mistakes of all files: nothing is baked before every job is known to be sound.
std::vector<job::Job> load_all(const std::vector<std::string>& files,
                               const std::vector<std::filesystem::path>& roots) {
    std::vector<job::Job> jobs;
    std::vector<Mistake> mistakes;
    std::set<ExitCode> codes;
    for (const std::string& file : files) try {
            jobs.push_back(job::load(file, roots));
        } catch (const job::JobError& error) {
            mistakes.insert(mistakes.end(), error.mistakes().begin(), error.mistakes().end());
            codes.insert(error.code());
        } catch (const Error& error) {
            mistakes.push_back({error.where(), error.message()});
            codes.insert(error.code());
        }
    if (mistakes.empty()) return jobs;
    throw job::JobError(codes.size() == 1 ? *codes.begin() : ExitCode::mixed_failures, std::move(mistakes));
}

}  // namespace

ExitCode bake_command(const Arguments& arguments) {
    Options options("bake", "[OPTIONS] JOB...",
                    "Runs job files. All are validated before the first bake starts.");
    options.add_positional(
        {{"job", "JOB...", "Job files; schemas/job.schema.json describes them.", false, true}});
    options.add({"what to bake",
                 {{"only", "NAME", "Runs the bake of this name alone; may be given again.", false, true},
                  {"root", "DIR", "Lets the paths of jobs lead into this folder too; may be given again.",
                   false, true}}});
    options.add(run_option_group());
    const auto given = options.parse(arguments);
    if (!given) return ExitCode::done;

    const std::vector<std::string> files = given->all("job");
    if (files.empty())
        throw Error(ExitCode::usage, "pbrbake bake", "no job file given; usage: pbrbake bake JOB...");
    std::vector<std::filesystem::path> roots;
    for (const std::string& root : given->all("root")) roots.emplace_back(root);
    return execute(load_all(files, roots), *given, given->all("only"));
}

}  // namespace pbrbake::cli
