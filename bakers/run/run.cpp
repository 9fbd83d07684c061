#include "bakers/run/run.hpp"

#include <algorithm>
#include <set>

#include "bakers/job/words.hpp"
#include "bakers/run/bake_one.hpp"
#include "bakers/run/manifest.hpp"

namespace pbrbake::run {
namespace fs = std::filesystem;
namespace {

void check_only(std::span<const job::Job> jobs, const std::vector<std::string>& only) {
    std::vector<std::string> names;
    for (const job::Job& job : jobs)
        for (const job::Bake& bake : job.bakes) names.push_back(bake.name);
    for (const std::string& name : only)
        if (std::find(names.begin(), names.end(), name) == names.end())
            throw Error(
                ExitCode::usage, "--only",
                "found \"" + name + "\"; allowed: " + job::joined(names) + job::did_you_mean(name, names));
}

void check_folders(std::span<const job::Job> jobs) {
    std::map<fs::path, const job::Job*> owners;
    for (const job::Job& job : jobs) {
        if (job.record != job::Record::manifest) continue;
        std::error_code error;
        const fs::path manifest = fs::weakly_canonical(fs::absolute(manifest_file(job)), error);
        const auto [owner, is_new] = owners.emplace(manifest, &job);
        if (!is_new)
            throw Error(ExitCode::invalid_job, job.file.string() + "#/output",
                        "is the output folder of " + owner->second->file.string() +
                            " too, and one manifest would replace the other; give each job its own");
    }
}

ExitCode combined_code(const RunReport& report) {
    std::set<ExitCode> codes;
    for (const BakeReport& bake : report.bakes) codes.insert(bake.code);
    for (const Error& error : report.errors) codes.insert(error.code());
    codes.erase(ExitCode::done);
    if (codes.contains(ExitCode::interrupted)) return ExitCode::interrupted;
    return codes.empty() ? ExitCode::done : codes.size() == 1 ? *codes.begin() : ExitCode::mixed_failures;
}

/// A bake of the run that failed and that another one joins, or null.
const BakeReport* failed_part(const job::Bake& bake, std::span<const BakeReport> reports) {
    for (const BakeReport& report : reports)
        if (report.status == Status::failed &&
            std::ranges::find(bake.parts, report.bake->name) != bake.parts.end())
            return &report;
    return nullptr;
}

/// What joins a failed bake fails with it: what that wrote earlier is out of date.
BakeReport left_out(const job::Job& job, const job::Bake& bake, const BakeReport& part) {
    BakeReport report = outline_bake(job, bake);
    report.status = Status::failed;
    report.code = part.code;
    report.error = bake.file + ": isn't written, because \"" + part.bake->name + "\" failed";
    return report;
}

/// Runs the bakes of one job into the report; false if the run was interrupted.
bool run_job(const job::Job& job, const Options& options, RunReport& report) {
    const std::size_t first = report.bakes.size();
    bool interrupted = false;
    for (const job::Bake& bake : job.bakes) {
        const bool wanted = options.only.empty() || std::find(options.only.begin(), options.only.end(),
                                                              bake.name) != options.only.end();
        if (!wanted || interrupted) continue;
        if (options.dry_run && !bake.error) {
            report.bakes.push_back(plan_bake(job, bake, options));
            if (options.observer && report.bakes.back().status == Status::failed)
                options.observer->finished(report.bakes.back());
            continue;
        }
        if (options.observer) options.observer->started(bake);
        const BakeReport* part = failed_part(bake, std::span(report.bakes).subspan(first));
        report.bakes.push_back(part ? left_out(job, bake, *part) : run_bake(job, bake, options));
        if (options.observer) options.observer->finished(report.bakes.back());
        interrupted = report.bakes.back().status == Status::interrupted;
    }
    if (job.record != job::Record::manifest || report.bakes.size() == first) return !interrupted;
    try {
        if (options.dry_run || write_manifest(job, std::span(report.bakes).subspan(first)))
            report.manifests.push_back(manifest_file(job));
    } catch (const Error& error) {
        report.errors.push_back(error);
    }
    return !interrupted;
}

}  // namespace

std::string_view tool_version() { return "pbrbake " PBRBAKE_VERSION; }

RunReport run(std::span<const job::Job> jobs, const Options& options) {
    check_only(jobs, options.only);
    check_folders(jobs);
    const Stopwatch watch;
    RunReport report;
    report.threads = options.threads;
    for (const job::Job& job : jobs)
        if (!run_job(job, options, report)) break;
    report.seconds = watch.elapsed();
    report.code = combined_code(report);
    return report;
}

}  // namespace pbrbake::run
