// A study as JSON, as CSV, and as a table for a terminal.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <utility>

#include "bakers/job/json_text.hpp"
#include "bakers/run/run.hpp"
#include "bakers/verify/machine.hpp"
#include "bakers/verify/page.hpp"
#include "bakers/verify/study.hpp"
#include "bakers/verify/study_job.hpp"

namespace pbrbake::verify {
namespace {

constexpr std::size_t kWidth = 80;
constexpr std::size_t kMostUnknown = 8;  // named below the table

/// JSON has no infinity.
Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json law_json(const std::optional<PowerLaw>& law) {
    if (!law) return nullptr;
    return {{"exponent", law->exponent}, {"coefficient", law->coefficient},
            {"fixed", law->fixed},       {"scatter", law->scatter},
            {"points", law->points},     {"price_of_digit", law->price_of_digit()}};
}

bool is_on_front(const StudiedCase& studied, std::size_t point) {
    return std::ranges::find(studied.front, point) != studied.front.end();
}

Json point_json(const StudiedCase& studied, std::size_t index) {
    const StudyPoint& point = studied.points[index];
    Json json{{"series", studied.asked.series[point.series].name},
              {"step", point.step.label},
              {"overrides", without_folders(point.step.overrides)}};
    if (!point.step.note.empty()) json["note"] = point.step.note;
    if (!point.failure.empty()) {
        json["failure"] = point.failure;
        return json;
    }
    json["error"] = point.error;
    if (point.level >= 0) json["worst_level"] = point.level;
    json["time_ratio"] = median_json(point.timing.ratio);
    json["cpu_s"] = median_json(point.timing.seconds);
    json["evaluations"] = point.evaluations;
    json["bytes"] = point.bytes;
    json["on_front"] = is_on_front(studied, index);
    if (!point.figures.empty()) json["figures"] = point.figures;
    return json;
}

Json case_json(const StudiedCase& studied) {
    Json points = Json::array(), series = Json::array(), front = Json::array(), digits = Json::array();
    for (std::size_t i = 0; i < studied.points.size(); ++i) points.push_back(point_json(studied, i));
    for (std::size_t s = 0; s < studied.asked.series.size(); ++s)
        series.push_back({{"name", studied.asked.series[s].name},
                          {"dial", studied.asked.series[s].dial},
                          {"law", law_json(studied.laws[s])}});
    for (const std::size_t i : studied.front) front.push_back(i);
    for (const Digit& digit : studied.digits)
        digits.push_back({{"error", digit.error},
                          {"point", digit.point},
                          {"time_ratio", studied.points[digit.point].timing.ratio.value}});
    Json json{{"name", studied.asked.name},   {"title", studied.asked.title},
              {"about", studied.asked.about}, {"bake", without_folders(studied.asked.bake)},
              {"metric", studied.metric},     {"truth", studied.truth},
              {"floor", studied.floor},       {"base", studied.base},
              {"series", std::move(series)},  {"points", std::move(points)},
              {"front", std::move(front)},    {"knee", studied.knee ? Json(*studied.knee) : Json(nullptr)},
              {"digits", std::move(digits)}};
    if (studied.asked.reference) json["reference_overrides"] = *studied.asked.reference;
    if (studied.free_error)
        json["free"] = {{"title", studied.asked.free_title}, {"error", *studied.free_error}};
    return json;
}

std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

std::string exact(double value) { return std::isfinite(value) ? job::to_line(Json(value)) : ""; }

/// Columns that a terminal counts: bytes that don't continue a character of UTF-8.
std::size_t columns(const std::string& text) {
    return static_cast<std::size_t>(
        std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string padded(const std::string& text, std::size_t width, bool right) {
    const std::size_t used = columns(text);
    if (used >= width) return text;
    return right ? std::string(width - used, ' ') + text : text + std::string(width - used, ' ');
}

std::string short_seconds(double seconds) {
    if (seconds <= 0) return "0";
    return seconds >= 1 ? number(seconds) + " s" : number(seconds * 1000) + " ms";
}

/// One setting on 80 columns: method, dial, error, time as a ratio, its spread, seconds, marks.
std::string table_row(const std::array<std::string, 7>& cells) {
    constexpr std::array<std::size_t, 7> kColumns{22, 11, 10, 9, 7, 10, 6};
    std::string row;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (i) row += ' ';
        row += padded(cells[i], kColumns[i] - (i ? 1 : 0), i >= 2 && i < 6);
    }
    while (row.ends_with(' ')) row.pop_back();
    return row + "\n";
}

/// The price of each further digit, as measured: the cheapest setting of any method.
std::string digits_text(const StudiedCase& studied) {
    std::string text;
    double before = 0;
    for (const Digit& digit : studied.digits) {
        const StudyPoint& point = studied.points[digit.point];
        const double time = point.timing.ratio.value;
        text += "  " + padded("error <= " + number(digit.error), 20, false) + padded(number(time), 9, true) +
                (before > 0 ? padded("x " + number(time / before), 10, true) : std::string(10, ' ')) + "  " +
                studied.asked.series[point.series].name + " " + point.step.label + "\n";
        before = time;
    }
    return text;
}

std::string table_of(const StudiedCase& studied) {
    const StudyPoint& base = studied.points[studied.base];
    std::string text = studied.asked.title + "\n";
    text += "  error: " + studied.metric + "; time 1.00 = " + studied.asked.series[base.series].name + " " +
            base.step.label + "\n\n";
    text += table_row({"method", "dial", "error", "time", "±%", "CPU", ""});
    for (std::size_t i = 0; i < studied.points.size(); ++i) {
        const StudyPoint& point = studied.points[i];
        const std::string& name = studied.asked.series[point.series].name;
        if (!point.failure.empty()) {
            text += table_row({name, point.step.label, "failed", "", "", "", ""});
            continue;
        }
        const bool is_knee = studied.knee == i;
        text += table_row({name, point.step.label, number(point.error), number(point.timing.ratio.value),
                           studied.base == i ? "" : known_percent(point.timing.ratio),
                           short_seconds(point.timing.seconds.value),
                           is_knee                   ? "knee"
                           : is_on_front(studied, i) ? "front"
                                                     : ""});
    }
    if (studied.free_error)
        text += table_row(
            {studied.asked.free_title.substr(0, 21), "", number(*studied.free_error), "0", "", "0", ""});
    text += "\n";
    text += digits_text(studied);
    for (std::size_t s = 0; s < studied.laws.size(); ++s)
        if (const auto& law = studied.laws[s])
            text += "  " + studied.asked.series[s].name + ": error ~ (time - " + number(law->fixed) + ")^-" +
                    number(law->exponent) + ", a digit for " + number(law->price_of_digit()) + " x\n";
    if (studied.floor > 0)
        text += "  errors below " + number(3 * studied.floor) + " say more of the truth or the storage\n";
    return text + "\n";
}

}  // namespace

std::string known_percent(const Median& median) {
    const double known = 100 * median.known_to();
    return std::isfinite(known) ? number(known) : "?";
}

std::string whole_percent(double share) { return std::to_string(std::lround(100 * share)) + " %"; }

std::vector<std::string> unknown_ratios(const Study& study) {
    std::vector<std::pair<double, std::string>> unknown;
    for (const StudiedCase& studied : study.cases)
        for (const StudyPoint& point : studied.points) {
            const Median& ratio = point.timing.ratio;
            if (!point.failure.empty() || ratio.known_to() <= study.known_to) continue;
            unknown.emplace_back(ratio.known_to(),
                                 studied.asked.name + ", " + studied.asked.series[point.series].name + " " +
                                     point.step.label + ": ± " + known_percent(ratio) + " %");
        }
    std::ranges::stable_sort(unknown, std::greater<>(), &std::pair<double, std::string>::first);
    std::vector<std::string> lines;
    for (auto& [known_to, line] : unknown) lines.push_back(std::move(line));
    return lines;
}

Json median_json(const Median& median) {
    return {{"median", median.value},
            {"interval", {median.low, finite(median.high)}},
            {"spread", median.spread},
            {"count", median.count}};
}

Json study_json(const Study& study) {
    const Machine machine = this_machine();
    Json cases = Json::array();
    for (const StudiedCase& studied : study.cases) cases.push_back(case_json(studied));
    return {
        {"version", 1},
        {"tool", run::tool_version()},
        {"machine",
         {{"processor", machine.processor}, {"threads", machine.threads}, {"compiler", machine.compiler}}},
        {"timing",
         {{"of", "bake stage, CPU seconds, one thread"},
          {"rounds", study.rounds},
          {"settings", study.points},
          {"known", study.known},
          {"wall_s", study.wall_s}}},
        {"cases", std::move(cases)}};
}

std::string study_csv(const Study& study) {
    std::string text =
        "case,series,dial,step,error,metric,worst_level,time_ratio,ratio_low,ratio_high,ratio_spread,cpu_s,"
        "cpu_low_s,cpu_high_s,cpu_spread,repeats,evaluations,bytes,on_front,knee,failure\n";
    for (const StudiedCase& studied : study.cases)
        for (std::size_t i = 0; i < studied.points.size(); ++i) {
            const StudyPoint& point = studied.points[i];
            const Series& series = studied.asked.series[point.series];
            const Median &ratio = point.timing.ratio, &cpu = point.timing.seconds;
            const std::array<std::string, 21> fields{csv_field(studied.asked.name),
                                                     csv_field(series.name),
                                                     series.dial,
                                                     csv_field(point.step.label),
                                                     exact(point.error),
                                                     studied.metric,
                                                     point.level >= 0 ? std::to_string(point.level) : "",
                                                     exact(ratio.value),
                                                     exact(ratio.low),
                                                     exact(ratio.high),
                                                     exact(ratio.spread),
                                                     exact(cpu.value),
                                                     exact(cpu.low),
                                                     exact(cpu.high),
                                                     exact(cpu.spread),
                                                     std::to_string(cpu.count),
                                                     std::to_string(point.evaluations),
                                                     std::to_string(point.bytes),
                                                     is_on_front(studied, i) ? "1" : "0",
                                                     studied.knee == i ? "1" : "0",
                                                     csv_field(point.failure)};
            for (std::size_t k = 0; k < fields.size(); ++k) {
                if (k) text += ',';
                text += fields[k];
            }
            text += "\n";
        }
    return text;
}

std::string study_table(const Study& study) {
    const Machine machine = this_machine();
    std::string text = "What accuracy costs. " + machine.processor.substr(0, kWidth - 30) + "\n" +
                       "time: CPU of the bake on one thread, as a ratio; ±%: how well that is known\n\n";
    for (const StudiedCase& studied : study.cases) text += table_of(studied);
    text += std::to_string(study.known) + " of " + std::to_string(study.points) + " ratios known to " +
            whole_percent(study.known_to) + " after " + std::to_string(study.rounds) + " rounds, " +
            number(study.wall_s) + " s\n";
    const std::vector<std::string> unknown = unknown_ratios(study);
    const std::size_t shown = std::min(unknown.size(), kMostUnknown);
    for (std::size_t i = 0; i < shown; ++i) text += (i ? "  " : "not known so well:\n  ") + unknown[i] + "\n";
    if (shown < unknown.size())
        text += "  and " + std::to_string(unknown.size() - shown) + " more: ±% above\n";
    return text;
}

}  // namespace pbrbake::verify
