// pbrbake demo: everything on built-in inputs, with a page to look at.

#include "bakers/verify/demo.hpp"

#include <cstdio>
#include <filesystem>

#include "bakers/job/json_text.hpp"
#include "bakers/run/atomic_file.hpp"
#include "cli/execute.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress.hpp"

namespace pbrbake::cli {
namespace {

namespace fs = std::filesystem;

/// One short line a bake: the page has the rest.
class DemoProgress : public Progress {
  public:
    explicit DemoProgress(bool quiet) : Progress(quiet), quiet_(quiet) {}

    void finished(const run::BakeReport& report) override {
        if (!report.error.empty()) return Progress::finished(report);
        clear();
        if (quiet_) return;
        const Json& figure = report.entry["certificate"]["headline"];
        std::fprintf(stderr, "%-13s bake %6.2f s  certify %6.2f s  %s %.2g\n", report.bake->name.c_str(),
                     report.seconds.at(run::Stage::bake).wall, report.seconds.at(run::Stage::certify).wall,
                     figure["metric"].get<std::string>().c_str(), figure["value"].get<double>());
    }

  private:
    bool quiet_;
};

/// Writes the job, unless that would replace a job that no demo wrote.
fs::path write_job(const fs::path& folder, bool with_reference) {
    const fs::path file = folder / "job.json";
    const std::string text = job::to_text(verify::demo_job(with_reference));
    if (fs::exists(file) && !fs::exists(folder / "index.html") && job::read_text(file) != text)
        throw Error(ExitCode::unwritable_output, file.string(),
                    "is there already, and not from a demo; give another folder with -o");
    run::write_atomically(file, text);
    return file;
}

}  // namespace

ExitCode demo_command(const Arguments& arguments) {
    Options options(
        "demo", "[OPTIONS]",
        "Bakes a table and probes of two built-in environments, and writes a page that shows them with "
        "their cost and error. `pbrbake bake DIR/job.json` bakes the same bytes again.");
    options.add(
        {"output", {{"o,output", "DIR", "Folder for job, products and index.html. [default: demo]"}}});
    options.add({"what to bake",
                 {{"reference", "",
                   "Bakes the exact sum too, and measures every texel against it; takes a minute.", true}}});
    options.add({"running",
                 {{"threads", "N", "Worker threads. [default: all processors]"},
                  {"quiet", "", "Shows errors alone, and the path of the page.", true}}});
    const auto given = options.parse(arguments);
    if (!given) return ExitCode::done;

    const fs::path folder = given->find("output").value_or("demo");
    const job::Job job = job::load(write_job(folder, given->is_on("reference")));
    DemoProgress progress(given->is_on("quiet"));
    run::Options run_options;
    run_options.threads = threads_of(*given);
    run_options.cancel = &catch_interrupts();
    run_options.observer = &progress;
    const run::RunReport report = run::run(std::span(&job, 1), run_options);
    for (const Error& error : report.errors) print_error(error);
    if (report.code != ExitCode::done) return report.code;

    const fs::path page = folder / "index.html";
    run::write_atomically(page, verify::demo_page(report));
    std::printf("%s\n", page.c_str());
    return ExitCode::done;
}

}  // namespace pbrbake::cli
