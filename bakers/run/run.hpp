#pragma once
// Runs validated jobs: decode, bake, certify, encode and write, one bake after the other, each on all worker
// threads.
//
// A bake that fails stops no other. Outputs are old, new or absent, never torn. A job's manifest is written
// last, and lists what this run made, plus what its older self lists of bakes that this run did not try
// (`only`, or an interruption), as long as job and files still agree with it. A failed bake is in no
// manifest.

#include <array>
#include <atomic>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/job/job.hpp"
#include "bakers/run/stopwatch.hpp"

namespace pbrbake::run {

/// "pbrbake 0.1.0"
std::string_view tool_version();

enum class Stage { decode, bake, certify, encode, write };
inline constexpr std::array<std::string_view, 5> kStageNames{"decode", "bake", "certify", "encode", "write"};

enum class Status { planned, done, accuracy_missed, failed, interrupted };
inline constexpr std::array<std::string_view, 5> kStatusNames{"planned", "done", "accuracy_missed", "failed",
                                                              "interrupted"};

/// What became of one bake.
struct BakeReport {
    const job::Job* job = nullptr;
    const job::Bake* bake = nullptr;
    Status status = Status::planned;
    ExitCode code = ExitCode::done;
    std::string error;                  ///< why it isn't done, with the file's name; else ""
    std::vector<std::string> warnings;  ///< repaired texels, an assumed colour space, a scale
    std::map<Stage, Seconds> seconds;   ///< of the stages it came to
    std::map<std::string, std::uint64_t> bake_evaluations, certify_evaluations;
    std::uint64_t peak_memory_bytes = 0;        ///< of the process, when the bake ended
    std::vector<std::filesystem::path> reads;   ///< files; "builtin:NAME" isn't one
    std::vector<std::filesystem::path> writes;  ///< files, written if done, else to be written
    Json entry;                                 ///< as in manifest and sidecar, if done
};

struct RunReport {
    std::vector<BakeReport> bakes;                 ///< those that were tried
    std::vector<std::filesystem::path> manifests;  ///< written, or to be written
    std::vector<Error> errors;                     ///< of manifests
    int threads = 1;
    Seconds seconds;
    /// One kind of failure gives its own code, several give mixed_failures; an interruption comes before all.
    ExitCode code = ExitCode::done;
};

/// Is told how a run goes. `progress` comes from worker threads, one at a time.
class Observer {
  public:
    virtual ~Observer() = default;
    virtual void started(const job::Bake&) {}
    virtual void progress(Stage, double /*fraction*/) {}
    virtual void finished(const BakeReport&) {}
};

struct Options {
    int threads = 1;
    std::vector<std::string> only;              ///< names of bakes; empty for all
    bool dry_run = false;                       ///< report what would be read and written, and stop
    const std::atomic<bool>* cancel = nullptr;  ///< polled; true ends the run with code interrupted
    Observer* observer = nullptr;
};

/// Throws Error(usage) for a name in `only` that no job has, and Error(invalid_job) for two jobs with one
/// output folder: one's manifest would replace the other's. Everything later is in the report.
RunReport run(std::span<const job::Job> jobs, const Options& options);

/// The document of `--report` and `--json`; schemas/report.schema.json describes it.
Json report_json(const RunReport& report);

/// A dependency file in gcc's format: what was written depends on the jobs and sources read.
std::string depfile_text(const RunReport& report);

}  // namespace pbrbake::run
