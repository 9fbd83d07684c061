// pbrbake study: what accuracy costs in time.

#include "bakers/verify/study.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "bakers/job/json_text.hpp"
#include "bakers/run/atomic_file.hpp"
#include "cli/execute.hpp"
#include "cli/interrupt.hpp"

namespace pbrbake::cli {
namespace {

namespace fs = std::filesystem;

/// A folder of its own for what a study bakes, gone when the study is.
class ScratchFolder {
  public:
    ScratchFolder() {
        std::string name = (fs::temp_directory_path() / "pbrbake-study-XXXXXX").string();
        if (!::mkdtemp(name.data()))
            throw Error(ExitCode::unwritable_output, name, "cannot be made; set TMPDIR to a writable folder");
        path_ = name;
    }
    ~ScratchFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

verify::Depth depth_of(const Given& given) {
    const std::string suite = given.find("suite").value_or("quick");
    if (suite != "quick" && suite != "full")
        throw Error(ExitCode::usage, "--suite", "found \"" + suite + "\"; allowed: quick, full");
    return suite == "full" ? verify::Depth::full : verify::Depth::quick;
}

verify::RepeatLimits limits_of(const Given& given, verify::Depth depth) {
    constexpr int kQuick_s = 90, kFull_s = 1500, kMost_s = 86'400;
    verify::RepeatLimits limits;
    limits.budget_s = depth == verify::Depth::quick ? kQuick_s : kFull_s;
    if (const auto text = given.find("budget-s"))
        limits.budget_s = integer_option("budget-s", *text, 1, kMost_s);
    return limits;
}

void write_results(const verify::Study& study, const fs::path& folder) {
    run::write_atomically(folder / "study.csv", verify::study_csv(study));
    run::write_atomically(folder / "study.json", job::to_text(verify::study_json(study)));
}

}  // namespace

ExitCode study_command(const Arguments& arguments) {
    Options options("study", "[OPTIONS] [JOB]",
                    "Shows what accuracy costs in time: every method at every setting, its error against the "
                    "reference, its CPU time measured until the median is known to 5 %.");
    options.add_positional(
        {{"job", "JOB", "Job file whose bakes are studied, instead of the built-in suite."}});
    options.add({"what to study",
                 {{"suite", "quick|full",
                   "Size of the built-in suite, or of the dials tried on a job. "
                   "[default: quick]"}}});
    options.add({"output", {{"o,output", "DIR", "Folder for study.json and study.csv. [default: study]"}}});
    options.add({"running",
                 {{"threads", "N",
                   "Worker threads of references and certificates; times are of one. "
                   "[default: all processors]"},
                  {"budget-s", "N",
                   "Wall seconds after which times are not repeated further. "
                   "[default: 90, full: 1500]"},
                  {"json", "", "Prints the study as JSON instead of the table.", true},
                  {"quiet", "", "Shows errors alone.", true}}});
    const auto given = options.parse(arguments);
    if (!given) return ExitCode::done;

    const ScratchFolder scratch;
    const verify::Depth depth = depth_of(*given);
    const auto job = given->find("job");
    verify::StudyOptions study_options;
    study_options.folder = scratch.path();
    study_options.threads = threads_of(*given);
    study_options.limits = limits_of(*given, depth);
    study_options.cancel = &catch_interrupts();
    if (!given->is_on("quiet"))
        study_options.tell = [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); };
    try {
        const verify::Study study = verify::run_study(
            job ? verify::job_cases(*job, depth) : verify::suite_cases(depth, scratch.path()), study_options);
        write_results(study, given->find("output").value_or("study"));
        std::printf("%s", given->is_on("json") ? job::to_text(verify::study_json(study)).c_str()
                                               : verify::study_table(study).c_str());
    } catch (const Cancelled&) {
        return ExitCode::interrupted;
    }
    return ExitCode::done;
}

}  // namespace pbrbake::cli
