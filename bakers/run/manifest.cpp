#include "bakers/run/manifest.hpp"

#include <algorithm>

#include "bakers/io/io.hpp"
#include "bakers/job/json_text.hpp"
#include "bakers/run/atomic_file.hpp"

namespace pbrbake::run {
namespace fs = std::filesystem;
namespace {

/// The products of the manifest that is there, by name; none if it can't be read.
std::map<std::string, Json> older_entries(const fs::path& file) {
    std::map<std::string, Json> entries;
    try {
        const Json manifest = job::parse_json(job::read_text(file), file.string());
        for (const Json& entry : manifest.at("products"))
            entries[entry.at("name").get<std::string>()] = entry;
    } catch (const std::exception&) {  // absent, torn by another tool, of another version: what is listed is
                                       // unknown
        entries.clear();
    }
    return entries;
}

bool still_true(const job::Job& job, const job::Bake& bake, const Json& entry) {
    try {
        if (entry.at("kind") != bake.kind || entry.at("params") != bake.params ||
            entry.at("working_space") != job.working_space || entry.at("tool") != tool_version() ||
            entry.at("algorithm_version") != bake.baker->algorithm_version)
            return false;
        for (const Json& output : entry.at("outputs")) {
            const fs::path name = output.at("path").get<std::string>();
            const fs::path file = job.output / name;
            if (name != name.filename() || !fs::is_regular_file(file)) return false;  // not a record of ours
            if (io::hash_file(file) != output.at("xxh3")) return false;
        }
        return true;
    } catch (const std::exception&) {
        return false;
    }
}

}  // namespace

fs::path manifest_file(const job::Job& job) { return (job.output / "manifest.json").lexically_normal(); }

bool write_manifest(const job::Job& job, std::span<const BakeReport> reports) {
    const fs::path file = manifest_file(job);
    const std::map<std::string, Json> older = older_entries(file);
    Json products = Json::array();
    for (const job::Bake& bake : job.bakes) {
        const auto report = std::find_if(reports.begin(), reports.end(), [&](const BakeReport& candidate) {
            return candidate.bake == &bake;
        });
        if (report != reports.end() && report->status != Status::interrupted) {
            if (report->status != Status::failed) products.push_back(report->entry);
        } else if (const auto entry = older.find(bake.name); entry != older.end()) {
            if (still_true(job, bake, entry->second)) products.push_back(entry->second);
        }
    }
    if (products.empty() && !fs::exists(file)) return false;
    write_atomically(file, job::to_text({{"version", 1}, {"tool", tool_version()}, {"products", products}}));
    return true;
}

}  // namespace pbrbake::run
