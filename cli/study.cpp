// pbrbake study: what accuracy costs in time.

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "bakers/job/json_text.hpp"
#include "bakers/job/words.hpp"
#include "bakers/run/atomic_file.hpp"
#include "bakers/verify/study_against.hpp"
#include "bakers/verify/study_effects.hpp"
#include "bakers/verify/study_plot.hpp"
#include "bakers/verify/study_report.hpp"
#include "cli/execute.hpp"
#include "cli/interrupt.hpp"
#include "cli/study_shading.hpp"

namespace pbrbake::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kAgreement = .1;                     // of ratios of time in two studies
constexpr std::size_t kMostPictureBytes = 3'500'000;  // leaves the page below 5 MB

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
    constexpr int kQuick_s = 150, kFull_s = 1800, kMost_s = 86'400;
    verify::RepeatLimits limits;
    limits.budget_s = depth == verify::Depth::quick ? kQuick_s : kFull_s;
    if (const auto text = given.find("budget-s"))
        limits.budget_s = integer_option("budget-s", *text, 1, kMost_s);
    return limits;
}

struct Results {
    verify::Study study;
    std::vector<verify::EffectGroup> effects;

    Json json() const {
        Json document = verify::study_json(study);
        if (!effects.empty()) document["effects"] = verify::effects_json(effects);
        return document;
    }
};

/// Files that the suite made for the cases studied go beside the study, for who repeats a bake.
void keep_sources(const verify::Study& study, const fs::path& scratch, const fs::path& folder) {
    const auto keep = [&](const Json& bake) {
        for (const Json& value : bake) {
            if (!value.is_string()) continue;
            const fs::path file(value.get<std::string>());
            if (file.is_absolute() && file.parent_path() == fs::absolute(scratch))
                run::write_atomically(folder / file.filename(), job::read_text(file));
        }
    };
    for (const verify::StudiedCase& studied : study.cases) {
        keep(studied.asked.bake);
        for (const verify::StudyPoint& point : studied.points) keep(point.step.overrides);
    }
}

/// The page comes last: where it is, the rest is.
void write_results(const Results& results, const verify::PictureBook& pictures, const std::string& command,
                   const fs::path& folder) {
    run::write_atomically(folder / "study.csv", verify::study_csv(results.study));
    run::write_atomically(folder / "study.json", job::to_text(results.json()));
    if (!results.study.cases.empty())
        run::write_atomically(folder / "study.svg", verify::plot_file(results.study.cases.front()));
    const std::string effects = results.effects.empty() ? "" : verify::effects_html(results.effects);
    run::write_atomically(folder / "study.html",
                          verify::study_page(results.study, pictures, command, effects));
}

/// The cases asked for, all of them by default.
std::vector<verify::StudyCase> chosen(std::vector<verify::StudyCase> cases,
                                      const std::vector<std::string>& only) {
    std::vector<std::string> names;
    for (const verify::StudyCase& asked : cases) names.push_back(asked.name);
    for (const std::string& name : only)
        if (std::ranges::find(names, name) == names.end())
            throw Error(
                ExitCode::usage, "--only",
                "found \"" + name + "\"; allowed: " + job::joined(names) + job::did_you_mean(name, names));
    if (!only.empty())
        std::erase_if(cases, [&](const verify::StudyCase& asked) {
            return std::ranges::find(only, asked.name) == only.end();
        });
    return cases;
}

std::string command_line(const Arguments& arguments) {
    std::string line = "pbrbake study";
    for (const std::string& argument : arguments) line.append(" ").append(argument);
    return line;
}

/// Flags of one study mean nothing to the other.
void check_together(const Given& given) {
    const bool shading = given.is_on("shading");
    const std::vector<const char*> others =
        shading ? std::vector<const char*>{"job", "suite", "only", "effects", "budget-s", "against", "json"}
                : std::vector<const char*>{"environment", "size"};
    for (const std::string other : others)
        if (given.has(other))
            throw Error(ExitCode::usage, other == "job" ? "JOB" : "--" + other,
                        shading ? "found with --shading, which doesn't take it" : "is for --shading");
}

Options study_command_options() {
    Options options("study", "[OPTIONS] [JOB]",
                    "Shows what accuracy costs in time: every method at every setting, its error against the "
                    "reference, its CPU time as a ratio that is measured until its median is known to 5 %.");
    options.add_positional(
        {{"job", "JOB", "Job file whose bakes are studied, instead of the built-in suite."}});
    options.add(
        {"what to study",
         {{"suite", "quick|full",
           "Size of the built-in suite, or of the dials tried on a job. [default: quick]"},
          {"only", "NAME", "Studies the case of this name alone; may be given again.", false, true},
          {"effects", "",
           "Measures what each effect costs, on and off; alone unless a suite or job is given too.", true}}});
    options.add({"shading",
                 {{"shading", "",
                   "Instead shades spheres and a plane by the exact integral, and by the split sum with "
                   "baked products, "
                   "with Frostbite's dominant direction and without; writes index.html and figures.json.",
                   true},
                  {"environment", "NAME", "Built-in environment: indoor or outdoor. [default: indoor]"},
                  {"size", "N", "Pixels across a sphere. [integer 8 to 512; default: 48]"}}});
    options.add({"output",
                 {{"o,output", "DIR",
                   "Folder for study.html, study.json, study.csv and study.svg. [default: study]"}}});
    options.add(
        {"running",
         {{"threads", "N",
           "Worker threads of references and certificates; times are of one. "
           "[default: all processors]"},
          {"budget-s", "N",
           "Wall seconds from the start after which times are not repeated further. [default: 150, full: "
           "1800]"},
          {"against", "FILE",
           "The study.json of an earlier study: tells how many ratios of time agree within 10 %, and which "
           "is furthest off."},
          {"json", "", "Prints the study as JSON instead of the table.", true},
          {"quiet", "", "Shows errors alone, and the result.", true}}});
    return options;
}

/// The study that --against names, null without one; read before hours are spent.
Json earlier_study(const Given& given) {
    const auto file = given.find("against");
    if (!file) return nullptr;
    Json study = job::parse_json(job::read_text(*file), *file);
    try {
        verify::ratio_agreement(study, study, kAgreement);
    } catch (const Json::exception&) {
        throw Error(ExitCode::unreadable_input, *file, "is no study.json");
    }
    return study;
}

Results run_all(const Given& given, const verify::StudyOptions& options) {
    const verify::Depth depth = depth_of(given);
    const auto job = given.find("job");
    const bool effects = given.is_on("effects");
    Results results;
    if (!effects || job || given.has("suite") || given.has("only"))
        results.study = verify::run_study(
            chosen(job ? verify::job_cases(*job, depth) : verify::suite_cases(depth, options.folder),
                   given.all("only")),
            options);
    if (effects) results.effects = verify::study_effects(options);
    return results;
}

void print_results(const Results& results, bool as_json) {
    if (as_json) {
        std::printf("%s", job::to_text(results.json()).c_str());
        return;
    }
    if (!results.study.cases.empty()) std::printf("%s", verify::study_table(results.study).c_str());
    std::printf("%s", verify::effects_table(results.effects).c_str());
}

}  // namespace

ExitCode study_command(const Arguments& arguments) {
    const auto given = study_command_options().parse(arguments);
    if (!given) return ExitCode::done;
    check_together(*given);
    if (given->is_on("shading")) return study_shading(*given);
    const ScratchFolder scratch;
    verify::PictureBook pictures(kMostPictureBytes);
    verify::StudyOptions options;
    options.folder = scratch.path();
    options.threads = threads_of(*given);
    options.limits = limits_of(*given, depth_of(*given));
    options.cancel = &catch_interrupts();
    options.inspect = [&pictures](auto&&... seen) { pictures.take(seen...); };
    if (!given->is_on("quiet"))
        options.tell = [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); };
    try {
        const Json before = earlier_study(*given);
        const Results results = run_all(*given, options);
        const fs::path folder = given->find("output").value_or("study");
        keep_sources(results.study, scratch.path(), folder);
        write_results(results, pictures, command_line(arguments), folder);
        print_results(results, given->is_on("json"));
        if (!before.is_null())
            std::fprintf(stderr, "%s\n", verify::ratio_agreement(results.json(), before, kAgreement).c_str());
    } catch (const Cancelled&) {
        return ExitCode::interrupted;
    }
    return ExitCode::done;
}

}  // namespace pbrbake::cli
