#include <gtest/gtest.h>

#include "bakers/run/run.hpp"

namespace pbrbake::run {
namespace {

BakeReport baked(const job::Job& job, std::vector<std::filesystem::path> reads,
                 std::vector<std::filesystem::path> writes) {
    BakeReport report;
    report.job = &job;
    report.reads = std::move(reads);
    report.writes = std::move(writes);
    return report;
}

TEST(Depfile, ListsWhatWasWrittenAndRead) {
    job::Job job;
    job.file = "jobs/job.json";
    RunReport report;
    report.manifests = {"out/manifest.json"};
    report.bakes.push_back(baked(job, {"b.hdr", "a.hdr"}, {"out/x.exr"}));
    report.bakes.push_back(baked(job, {"a.hdr"}, {"out/y.exr"}));
    EXPECT_EQ(depfile_text(report),
              "out/manifest.json out/x.exr out/y.exr: \\\n  a.hdr \\\n  b.hdr \\\n  jobs/job.json\n");
}

TEST(Depfile, EscapesAsGccDoes) {
    const job::Job job;
    RunReport report;
    report.bakes.push_back(baked(job, {"a b#c$d\\ e\\f"}, {"x"}));
    EXPECT_EQ(depfile_text(report), "x: \\\n  a\\ b\\#c$$d\\\\\\ e\\f\n");
}

}  // namespace
}  // namespace pbrbake::run
