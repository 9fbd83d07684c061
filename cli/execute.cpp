#include "cli/execute.hpp"

#include <algorithm>
#include <cstdio>
#include <thread>

#include "bakers/job/json_text.hpp"
#include "bakers/run/atomic_file.hpp"
#include "bakers/run/run.hpp"
#include "bakers/verify/run_page.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress.hpp"

namespace pbrbake::cli {
namespace {

constexpr int kMostThreads = 1024;

const std::vector<Option>& run_options() {
    static const std::vector<Option> list{
        {"threads", "N", "Worker threads; the bytes are the same at any number. [default: all processors]"},
        {"dry-run", "", "Shows what would be read and written, and stops.", true},
        {"report", "FILE", "Writes times, memory, evaluations and warnings as JSON."},
        {"html", "FILE", "Writes a page of figures, pictures, curves, times and warnings."},
        {"depfile", "FILE", "Writes a dependency file in gcc's format."},
        {"json", "", "Prints the report on stdout.", true},
        {"quiet", "", "Shows errors alone.", true},
    };
    return list;
}

void print_plan(const run::RunReport& report) {
    for (const run::BakeReport& bake : report.bakes) {
        std::printf("%s (%s)\n", bake.bake->name.c_str(), bake.bake->kind.c_str());
        for (const job::Source& source : bake.bake->sources)
            if (source.file.empty()) std::printf("  reads   %s\n", source.read.path.c_str());
        for (const auto& file : bake.reads) std::printf("  reads   %s\n", file.c_str());
        for (const auto& file : bake.writes) std::printf("  writes  %s\n", file.c_str());
    }
    for (const auto& file : report.manifests) std::printf("writes  %s\n", file.c_str());
}

/// Writes what was asked for besides products; an error there adds to the run's exit code.
ExitCode write_extras(const run::RunReport& report, const Given& given) {
    try {
        if (const auto file = given.find("report"))
            run::write_atomically(*file, job::to_text(run::report_json(report)));
        if (const auto file = given.find("html")) run::write_atomically(*file, verify::run_page(report));
        if (const auto file = given.find("depfile")) run::write_atomically(*file, run::depfile_text(report));
        return report.code;
    } catch (const Error& error) {
        print_error(error);
        const bool first = report.code == ExitCode::done || report.code == error.code();
        return first                                  ? error.code()
               : report.code == ExitCode::interrupted ? report.code
                                                      : ExitCode::mixed_failures;
    }
}

}  // namespace

int threads_of(const Given& given) {
    if (const auto text = given.find("threads")) return integer_option("threads", *text, 1, kMostThreads);
    return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMostThreads);
}

OptionGroup run_option_group() { return {"running", run_options()}; }

bool is_run_option(const std::string& name) {
    return std::any_of(run_options().begin(), run_options().end(),
                       [&](const Option& option) { return option.name == name; });
}

ExitCode execute(std::span<const job::Job> jobs, const Given& given, std::vector<std::string> only) {
    run::Options options;
    options.threads = threads_of(given);
    options.only = std::move(only);
    options.dry_run = given.is_on("dry-run");
    options.cancel = &catch_interrupts();
    Progress progress(given.is_on("quiet"));
    options.observer = &progress;
    const bool as_json = given.is_on("json");

    const run::RunReport report = run::run(jobs, options);
    for (const Error& error : report.errors) print_error(error);
    if (as_json)
        std::printf("%s", job::to_text(run::report_json(report)).c_str());
    else if (options.dry_run)
        print_plan(report);
    return write_extras(report, given);
}

}  // namespace pbrbake::cli
