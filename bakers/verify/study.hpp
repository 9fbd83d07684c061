#pragma once
// The study: what accuracy costs in time.
//
// A study is a set of cases; a case is a bake without its dials, and series of settings of those dials. Each
// setting goes down the same way as every bake, job to run, once: its error is then found on the stored
// values as they decode, against the case's reference or by the product's own full certificate. After that
// the bake stages of all settings are timed again and again, in turn, on one thread.

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bakers/baker.hpp"
#include "bakers/verify/baked_image.hpp"
#include "bakers/verify/pareto.hpp"
#include "bakers/verify/repeat.hpp"

namespace pbrbake::verify {

/// One setting of a dial: properties that take the place of the case's own.
struct Step {
    std::string label;                ///< "32", "1e-3", "64, half"
    Json overrides = Json::object();  ///< null: the schema's default
    std::string note;                 ///< "as in Frostbite's notes"
};

/// A method, and its dial from cheap to dear.
struct Series {
    std::string name;  ///< "fis", "quadrature", "sqrt_nov ends, half"
    std::string dial;  ///< "samples", "accuracy", "size"
    std::vector<Step> steps;
};

/// A bake and what is tried on it.
struct StudyCase {
    std::string name;   ///< stem of the products: "probe_indoor"
    std::string title;  ///< "Probe, indoor room"
    std::string about;  ///< a sentence: what is hard here
    Json around;        ///< of a job, besides its bakes: working_space, limits
    Json bake;          ///< of a job, without name; paths absolute
    /// Overrides that make the reference; without them errors are those of the full certificate.
    std::optional<Json> reference;
    std::string metric;       ///< the certificate's figure taken as the error; "" for its headline
    std::string free_figure;  ///< a figure that is the error of a method without a bake (an analytic fit)
    std::string free_title;
    std::vector<Series> series;
    std::size_t base_series = 0, base_step = 0;  ///< what ratios of time are to
};

/// The size of a study.
enum class Depth { quick, full };

/// The built-in suite. Files that it needs, photometric ones and legacy sets, are written into `folder`,
/// which must exist.
std::vector<StudyCase> suite_cases(Depth depth, const std::filesystem::path& folder);

/// A case for every bake of a job file, its dials found in the schema. Throws what job::load throws.
std::vector<StudyCase> job_cases(const std::filesystem::path& job_file, Depth depth);

/// A setting, measured.
struct StudyPoint {
    std::size_t series = 0;
    Step step;
    double error = 0;
    int level = -1;                         ///< the worst, of products that have levels
    std::map<std::string, double> figures;  ///< of the certificate, the worst level's
    std::uint64_t evaluations = 0, bytes = 0;
    Timing timing;        ///< of the bake stage, CPU, one thread
    std::string failure;  ///< why it could not be baked; then nothing else holds
};

struct StudiedCase {
    StudyCase asked;
    std::string metric;  ///< of `error`
    std::string truth;   ///< what the error is against, in words
    double floor = 0;    ///< the reference's own error: smaller ones are not known
    double reference_cpu_s = 0;
    std::optional<double> free_error;  ///< of the method without a bake
    std::vector<StudyPoint> points;
    std::size_t base = 0;                       ///< index of the point that ratios are to
    std::vector<std::size_t> front;             ///< indices of points, in order of time
    std::optional<std::size_t> knee;            ///< index of a point
    std::vector<Digit> digits;                  ///< the cheapest point at or below each power of ten
    std::vector<std::optional<PowerLaw>> laws;  ///< of each series; time is the ratio to the base
};

struct Study {
    std::vector<StudiedCase> cases;
    int rounds = 0;
    std::size_t points = 0, known = 0;  ///< timed, and known as the limits ask
    double known_to = 0;                ///< what they ask
    double wall_s = 0;
};

/// Is given every setting's product, as stored, with the reference's where there is one. The image of a
/// product without pictures is empty; the files that `report` names are there until the inspector returns.
using StudyInspector =
    std::function<void(const StudiedCase& so_far, const StudyPoint& point, const BakedImage& product,
                       const BakedImage* reference, const run::BakeReport& report)>;

struct StudyOptions {
    std::filesystem::path folder;  ///< for products and sources while the study runs
    int threads = 1;               ///< of references and errors; times are of one thread
    RepeatLimits limits;
    const std::atomic<bool>* cancel = nullptr;
    StudyInspector inspect;
    std::function<void(const std::string&)> tell;  ///< a line for people
};

/// Runs it. A setting that can't be baked is kept as a failure; a case whose reference can't be baked throws
/// Error. Throws Cancelled.
Study run_study(std::vector<StudyCase> cases, const StudyOptions& options);

/// schemas/study.schema.json describes it.
Json study_json(const Study& study);

/// How well a median is known, in per cent: "4.20"; "?" of fewer than six values.
std::string known_percent(const Median& median);

/// "5 %"
std::string whole_percent(double share);

/// Settings whose ratio of time is known less well than the limits asked, the least known first:
/// "probe_noise, is 8: ± 9.10 %".
std::vector<std::string> unknown_ratios(const Study& study);

/// A median of a study's document: value, interval, spread, count.
Json median_json(const Median& median);

/// One line a point, with a heading.
std::string study_csv(const Study& study);

/// For a terminal, at most 80 columns wide.
std::string study_table(const Study& study);

}  // namespace pbrbake::verify
