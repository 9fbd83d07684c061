#include "bakers/run/run.hpp"

namespace pbrbake::run {
namespace {

Json seconds_json(const Seconds& seconds) { return {{"wall_s", seconds.wall}, {"cpu_s", seconds.cpu}}; }

Json paths_json(const std::vector<std::filesystem::path>& paths) {
    Json list = Json::array();
    for (const auto& path : paths) list.push_back(path.generic_string());
    return list;
}

Json bake_json(const BakeReport& report) {
    Json json{{"job", report.job->file.generic_string()},
              {"kind", report.bake->kind},
              {"name", report.bake->name},
              {"status", kStatusNames[static_cast<std::size_t>(report.status)]},
              {"exit_code", static_cast<int>(report.code)},
              {"reads", paths_json(report.reads)},
              {"writes", paths_json(report.writes)},
              {"warnings", report.warnings}};
    if (!report.error.empty()) json["error"] = report.error;
    if (report.status == Status::planned) return json;
    json["stages"] = Json::object();
    for (const auto& [stage, seconds] : report.seconds)
        json["stages"][std::string(kStageNames[static_cast<std::size_t>(stage)])] = seconds_json(seconds);
    json["evaluations"] = {{"bake", report.bake_evaluations}, {"certify", report.certify_evaluations}};
    json["peak_memory_bytes"] = report.peak_memory_bytes;
    if (report.entry.contains("certificate") && report.entry["certificate"].contains("headline"))
        json["headline"] = report.entry["certificate"]["headline"];
    return json;
}

}  // namespace

Json report_json(const RunReport& report) {
    Json bakes = Json::array(), errors = Json::array();
    for (const BakeReport& bake : report.bakes) bakes.push_back(bake_json(bake));
    for (const Error& error : report.errors) errors.push_back(error.what());
    return {{"version", 1},
            {"tool", tool_version()},
            {"exit_code", static_cast<int>(report.code)},
            {"threads", report.threads},
            {"seconds", seconds_json(report.seconds)},
            {"peak_memory_bytes", peak_memory_bytes()},
            {"bakes", std::move(bakes)},
            {"manifests", paths_json(report.manifests)},
            {"errors", std::move(errors)}};
}

}  // namespace pbrbake::run
