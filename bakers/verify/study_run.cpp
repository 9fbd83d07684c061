// Runs a study: every setting once for its error, then all of them again and again for their times.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "bakers/formats.hpp"
#include "bakers/run/bake_one.hpp"
#include "bakers/verify/study.hpp"
#include "bakers/verify/study_job.hpp"

namespace pbrbake::verify {
namespace fs = std::filesystem;
namespace {

/// Figures of certificates below which an error says more of them than of a method: of a reference, and of a
/// product.
constexpr const char* kReferenceFloor = "error_of_the_exact_sum";
constexpr const char* kStorageFloor = "quantisation_error";

double wall_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The largest figure of each metric, over levels.
std::map<std::string, double> figures_of(const Json& certificate) {
    std::map<std::string, double> figures;
    for (const Json& figure : certificate["figures"]) {
        const double value = figure["value"].get<double>();
        const auto [place, is_new] = figures.emplace(figure["metric"].get<std::string>(), value);
        if (!is_new && std::abs(value) > std::abs(place->second)) place->second = value;
    }
    return figures;
}

std::uint64_t sum_of(const std::map<std::string, std::uint64_t>& counts) {
    std::uint64_t sum = 0;
    for (const auto& [effect, count] : counts) sum += count;
    return sum;
}

/// By the paths that a bake reads.
using DecodedInputs = std::map<std::vector<std::string>, std::shared_ptr<const Inputs>>;

bool holds_pictures(const fs::path& file) {
    const Format* format = find_format(file.extension().string().substr(1));
    return format && !format->is_document();
}

/// A setting that is baked: what it takes to time it again.
struct Timed {
    job::Job job;
    std::shared_ptr<const Inputs> inputs;
    std::size_t studied = 0, point = 0;  ///< indices into the study
};

class StudyRun {
  public:
    StudyRun(std::vector<StudyCase> cases, const StudyOptions& options) : options_(options) {
        for (StudyCase& asked : cases) {
            StudiedCase studied;
            studied.asked = std::move(asked);
            study_.cases.push_back(std::move(studied));
        }
    }

    Study run() {
        const double start = wall_seconds();
        for (std::size_t i = 0; i < study_.cases.size(); ++i) bake_case(i);
        RepeatLimits limits = options_.limits;
        limits.budget_s -= wall_seconds() - start;
        time_all(limits);
        for (StudiedCase& studied : study_.cases) judge(studied);
        study_.wall_s = wall_seconds() - start;
        return std::move(study_);
    }

  private:
    void tell(const std::string& line) const {
        if (options_.tell) options_.tell(line);
    }

    run::Options run_options(int threads) const {
        run::Options options;
        options.threads = threads;
        options.cancel = options_.cancel;
        return options;
    }

    run::BakeReport baked(const job::Job& job) const {
        run::BakeReport report = run::run_bake(job, job.bakes.front(), run_options(options_.threads));
        if (report.status == run::Status::interrupted) throw Cancelled{};
        return report;
    }

    static void remove_files(const run::BakeReport& report) {
        std::error_code ignored;
        for (const fs::path& file : report.writes) fs::remove(file, ignored);
    }

    BakedImage bake_reference(StudiedCase& studied) const {
        Json bake = with_overrides(studied.asked.bake, *studied.asked.reference);
        bake["certify"] = "sampled";
        const job::Job job = single_bake_job(studied.asked.around, std::move(bake),
                                             studied.asked.name + "_reference", options_.folder);
        const run::BakeReport report = baked(job);
        if (report.status == run::Status::failed) throw Error(report.code, "", report.error);
        studied.reference_cpu_s = report.seconds.at(run::Stage::bake).cpu;
        const auto figures = figures_of(report.entry["certificate"]);
        if (const auto found = figures.find(kReferenceFloor); found != figures.end())
            studied.floor = found->second;
        studied.metric = "relative_rmse";
        studied.truth = "every stored texel against the case's reference, the worst level";
        BakedImage reference = read_baked(report);
        remove_files(report);
        return reference;
    }

    void bake_case(std::size_t index) {
        StudiedCase& studied = study_.cases[index];
        const double start = wall_seconds();
        std::optional<BakedImage> reference;
        if (studied.asked.reference) reference = bake_reference(studied);
        DecodedInputs inputs;
        for (std::size_t s = 0; s < studied.asked.series.size(); ++s)
            for (std::size_t k = 0; k < studied.asked.series[s].steps.size(); ++k) {
                if (s == studied.asked.base_series && k == studied.asked.base_step)
                    studied.base = studied.points.size();
                StudyPoint point;
                point.series = s;
                point.step = studied.asked.series[s].steps[k];
                studied.points.push_back(std::move(point));
                bake_point(index, studied.points.size() - 1, reference, inputs);
            }
        if (!studied.points[studied.base].failure.empty())
            throw Error(ExitCode::mixed_failures, studied.asked.title,
                        "what ratios are to can't be baked: " + studied.points[studied.base].failure);
        const std::string of = std::to_string(index + 1) + " of " + std::to_string(study_.cases.size()) +
                               ", " + studied.asked.name;
        tell(of + ": " + std::to_string(studied.points.size()) + " settings baked in " +
             std::to_string(std::lround(wall_seconds() - start)) + " s");
    }

    void bake_point(std::size_t index, std::size_t number, const std::optional<BakedImage>& reference,
                    DecodedInputs& inputs) {
        StudiedCase& studied = study_.cases[index];
        StudyPoint& point = studied.points[number];
        try {
            Json bake = with_overrides(studied.asked.bake, point.step.overrides);
            const bool states_error = bake.contains("accuracy") && bake["accuracy"].is_object();
            bake["certify"] = !reference ? "full" : states_error ? "sampled" : "none";
            Timed timed{single_bake_job(studied.asked.around, std::move(bake),
                                        studied.asked.name + "_" + std::to_string(number), options_.folder),
                        nullptr, index, number};
            const run::BakeReport report = baked(timed.job);
            if (report.status == run::Status::failed) throw Error(report.code, "", report.error);
            measure(studied, point, report, reference);
            remove_files(report);
            timed.inputs = decoded(timed.job, inputs);
            timed_.push_back(std::move(timed));
        } catch (const Error& error) {
            point.failure = error.what();
        }
    }

    /// What a bake reads; settings of a case that read the same share it.
    std::shared_ptr<const Inputs> decoded(const job::Job& job, DecodedInputs& inputs) const {
        std::vector<std::string> read;
        for (const job::Source& source : job.bakes.front().sources) read.push_back(source.read.path);
        std::shared_ptr<const Inputs>& found = inputs[read];
        if (!found)
            found = std::make_shared<const Inputs>(
                run::decoded_inputs(job, job.bakes.front(), run_options(options_.threads)));
        return found;
    }

    void measure(StudiedCase& studied, StudyPoint& point, const run::BakeReport& report,
                 const std::optional<BakedImage>& reference) const {
        const Json& certificate = report.entry["certificate"];
        point.figures = figures_of(certificate);
        point.evaluations = sum_of(report.bake_evaluations);
        for (const Json& output : report.entry["outputs"])
            point.bytes += output["bytes"].get<std::uint64_t>();
        const BakedImage product = holds_pictures(report.writes.front()) ? read_baked(report) : BakedImage{};
        if (reference) {
            const WorstLevel worst = worst_level(at_size_of(*reference, product), *reference);
            point.error = worst.relative_rmse;
            point.level = worst.level;
        } else {
            take_headline(studied, point, certificate);
        }
        if (const auto free = point.figures.find(studied.asked.free_figure); free != point.figures.end())
            studied.free_error = free->second;
        if (options_.inspect)
            options_.inspect(studied, point, product, reference ? &*reference : nullptr, report);
    }

    /// Flat pictures of another size are held against the reference as a shader would magnify them.
    static BakedImage at_size_of(const BakedImage& reference, const BakedImage& product) {
        const Level &like = reference.image.levels[0], &level = product.image.levels[0];
        const bool is_same = like.width == level.width && like.height == level.height;
        return is_same || reference.image.faces > 1 ? product : resampled(product, like.width, like.height);
    }

    static void take_headline(StudiedCase& studied, StudyPoint& point, const Json& certificate) {
        const Json& headline = certificate["headline"];
        studied.metric =
            studied.asked.metric.empty() ? headline["metric"].get<std::string>() : studied.asked.metric;
        const auto found = point.figures.find(studied.metric);
        if (found == point.figures.end())
            throw Error(ExitCode::invalid_job, "", "its certificate has no " + studied.metric);
        point.error = std::abs(found->second);
        studied.truth = "full certificate of each product";
        for (const Json& figure : certificate["figures"])
            if (figure["metric"] == studied.metric) studied.truth = figure["method"].get<std::string>();
        const auto floor = point.figures.find(kStorageFloor);
        if (floor != point.figures.end() && (studied.floor == 0 || floor->second < studied.floor))
            studied.floor = floor->second;
    }

    void time_all(const RepeatLimits& limits) {
        std::vector<std::size_t> base_task(study_.cases.size());
        for (std::size_t i = 0; i < timed_.size(); ++i)
            if (timed_[i].point == study_.cases[timed_[i].studied].base) base_task[timed_[i].studied] = i;
        const run::Options options = run_options(1);
        std::vector<RepeatTask> tasks;
        for (const Timed& timed : timed_)
            tasks.push_back(
                {[&timed, &options](int times) {
                     double cpu = 0;
                     for (int i = 0; i < times; ++i)
                         cpu += run::time_bake_stage(timed.job.bakes.front(), *timed.inputs, options).cpu;
                     return cpu / times;
                 },
                 base_task[timed.studied]});
        const std::vector<Timing> timings =
            repeat_until_known(tasks, limits, wall_seconds, [&](int round, std::size_t known, double wall_s) {
                study_.rounds = round;
                study_.known = known;
                tell("round " + std::to_string(round) + ": " + std::to_string(known) + " of " +
                     std::to_string(tasks.size()) + " times known, " + std::to_string(std::lround(wall_s)) +
                     " s; " + time_left(limits, round, wall_s));
            });
        study_.points = tasks.size();
        study_.known_to = limits.known_to;
        for (std::size_t i = 0; i < timed_.size(); ++i)
            study_.cases[timed_[i].studied].points[timed_[i].point].timing = timings[i];
    }

    /// Of the rounds of times: how much longer they may take.
    static std::string time_left(const RepeatLimits& limits, int round, double wall_s) {
        const double fewest = wall_s * limits.fewest / round;
        const double last = std::max(limits.budget_s, fewest) + wall_s / round;
        return "at most " + std::to_string(std::lround(std::max(0.0, last - wall_s))) + " s more";
    }

    /// Errors below the floor count as the floor: which of them is smaller is not known.
    static void judge(StudiedCase& studied) {
        const double floor = kAboveFloor * studied.floor;
        std::vector<std::size_t> whole;  // points that were baked
        std::vector<Cost> costs;
        for (std::size_t i = 0; i < studied.points.size(); ++i) {
            if (!studied.points[i].failure.empty()) continue;
            whole.push_back(i);
            costs.push_back({studied.points[i].timing.ratio.value, std::max(floor, studied.points[i].error)});
        }
        std::vector<Cost> front;
        for (const std::size_t i : front_apart(studied, whole, costs)) {
            studied.front.push_back(whole[i]);
            front.push_back(costs[i]);
        }
        if (const auto best = knee(front)) studied.knee = studied.front[*best];
        for (const Digit& digit : digits_reached(costs))
            studied.digits.push_back({digit.error, whole[digit.point]});
        for (std::size_t s = 0; s < studied.asked.series.size(); ++s) {
            std::vector<Cost> of_series;
            for (std::size_t i = 0; i < whole.size(); ++i)
                if (studied.points[whole[i]].series == s) of_series.push_back(costs[i]);
            studied.laws.push_back(fit_power_law(of_series, floor));
        }
    }

    /// The front without points that aren't known to be cheaper than a better one: their times' intervals
    /// overlap.
    static std::vector<std::size_t> front_apart(const StudiedCase& studied,
                                                const std::vector<std::size_t>& whole,
                                                const std::vector<Cost>& costs) {
        std::vector<std::size_t> front = pareto_front(costs), apart;
        std::ranges::reverse(front);  // the best first
        const auto ratio = [&](std::size_t i) { return studied.points[whole[i]].timing.ratio; };
        for (const std::size_t i : front)
            if (apart.empty() || !std::isfinite(ratio(i).high) || ratio(i).high < ratio(apart.back()).low)
                apart.push_back(i);
        std::ranges::reverse(apart);
        return apart;
    }

    /// Errors nearer to the reference's own say more of it than of the method.
    static constexpr double kAboveFloor = 3;

    const StudyOptions& options_;
    Study study_;
    std::vector<Timed> timed_;
};

}  // namespace

Study run_study(std::vector<StudyCase> cases, const StudyOptions& options) {
    return StudyRun(std::move(cases), options).run();
}

}  // namespace pbrbake::verify
