// pbrbake study --shading: what approximations of shading lose.

#include "cli/study_shading.hpp"

#include <cstdio>
#include <filesystem>

#include "bakers/io/io.hpp"
#include "bakers/job/json_text.hpp"
#include "bakers/run/atomic_file.hpp"
#include "bakers/verify/shading_study.hpp"
#include "cli/execute.hpp"
#include "cli/interrupt.hpp"

namespace pbrbake::cli {
namespace {

namespace fs = std::filesystem;

/// Writes the job, unless that would replace a job that no study wrote.
fs::path write_job(const fs::path& folder, const Json& document) {
    const fs::path file = folder / "job.json";
    const std::string text = job::to_text(document);
    if (fs::exists(file) && !fs::exists(folder / "figures.json") && job::read_text(file) != text)
        throw Error(ExitCode::unwritable_output, file.string(),
                    "is there already, and not from a study; give another folder with -o");
    run::write_atomically(file, text);
    return file;
}

ExitCode bake_and_shade(const fs::path& folder, const verify::ShadingStudy& study) {
    const Image environment = verify::study_environment(study.environment);
    const fs::path job_file = write_job(folder, verify::shading_job(study));
    run::write_atomically(folder / verify::study_environment_file(study),
                          io::encode("exr", environment, {PixelType::float32, {}}));
    const job::Job job = job::load(job_file);
    run::Options options;
    options.threads = study.threads;
    options.cancel = &catch_interrupts();
    const run::RunReport report = run::run(std::span(&job, 1), options);
    for (const run::BakeReport& bake : report.bakes)
        if (!bake.error.empty()) print_error(Error(bake.code, bake.bake->name, bake.error));
    if (report.code != ExitCode::done) return report.code;

    Json figures;
    const std::string page = verify::shading_page(study, environment, report, figures);
    run::write_atomically(folder / "figures.json", job::to_text(figures));
    run::write_atomically(folder / "index.html", page);
    std::printf("%s\n", (folder / "index.html").c_str());
    return ExitCode::done;
}

}  // namespace

ExitCode study_shading(const Given& given) {
    verify::ShadingStudy study{given.find("environment").value_or("indoor"), 48, threads_of(given)};
    if (const auto size = given.find("size")) study.size = integer_option("size", *size, 8, 512);
    if (study.environment != "indoor" && study.environment != "outdoor")
        throw Error(ExitCode::usage, "--environment",
                    "found \"" + study.environment + "\"; allowed: indoor, outdoor");
    return bake_and_shade(given.find("output").value_or("study"), study);
}

}  // namespace pbrbake::cli
