#include "bakers/verify/run_page.hpp"

#include "bakers/verify/page.hpp"
#include "bakers/verify/record_html.hpp"
#include "bakers/verify/study_plot.hpp"
#include "bakers/verify/texture_proof.hpp"

namespace pbrbake::verify {
namespace {

run::Seconds seconds_of(const run::BakeReport& report) {
    run::Seconds sum;
    for (const auto& [stage, seconds] : report.seconds) {
        sum.wall += seconds.wall;
        sum.cpu += seconds.cpu;
    }
    return sum;
}

std::string status_of(const run::BakeReport& report) {
    return std::string(run::kStatusNames[static_cast<std::size_t>(report.status)]);
}

std::string overview(const run::RunReport& report) {
    Table table({"bake", "kind", "status", "headline", "wall", "CPU"});
    for (const std::size_t words : {1, 2, 3}) table.set_text(words);
    for (const run::BakeReport& bake : report.bakes) {
        const Json headline =
            bake.entry.is_object() ? bake.entry["certificate"].value("headline", Json()) : Json();
        const run::Seconds seconds = seconds_of(bake);
        table.add({"<code>" + escaped(bake.bake->name) + "</code>", escaped(bake.bake->kind), status_of(bake),
                   headline.is_null() ? "–" : escaped_text(headline["metric"]) + " " + certified(headline),
                   number(seconds.wall) + " s", number(seconds.cpu) + " s"});
    }
    return table.html();
}

/// Pictures of a page's texture sets, a quarter of a megabyte each.
class Proofs {
  public:
    explicit Proofs(int threads) : threads_(threads) {}

    std::string operator()(const run::BakeReport& report) {
        if (!has_proof(report)) return "";
        return (shown_++ < kMost ? texture_proof_html(report, display_, threads_)
                                 : "<p class=soft>Pictures are of the first " + std::to_string(kMost) +
                                       " sets; --only shows others.</p>\n") +
               texture_reading_html(report);
    }

  private:
    static constexpr int kMost = 24;
    DisplayTransform display_;
    int threads_, shown_ = 0;
};

std::string bake_html(const run::BakeReport& report, Proofs& proofs) {
    std::string html = "<h2>" + escaped(report.bake->name) + "</h2>\n";
    if (!report.error.empty()) html += "<p><b>" + escaped(report.error) + "</b></p>\n";
    html += warnings_html(report);
    if (!report.entry.is_object()) return html;
    html += proofs(report);
    Table files({"file", "bytes"});
    for (const Json& output : report.entry["outputs"])
        files.add({escaped_text(output["path"]), count(output["bytes"].get<std::uint64_t>())});
    if (!report.entry["certificate"]["figures"].empty())
        html += "<h3>Certificate</h3>\n" + figures_html(report.entry["certificate"]);
    return html + "<h3>Files</h3>\n" + files.html() + stage_table({&report}, {"this bake"});
}

}  // namespace

std::string run_page(const run::RunReport& report) {
    std::string body = "<style>" + plot_style() + "</style>\n<h1>Bakes</h1>\n<p class=lead>" +
                       std::to_string(report.bakes.size()) + (report.bakes.size() == 1 ? " bake" : " bakes") +
                       " by " + escaped(std::string(run::tool_version())) + ", " +
                       number(report.seconds.wall) + " s on " + std::to_string(report.threads) +
                       (report.threads == 1 ? " thread" : " threads") + ".</p>\n" + overview(report);
    Proofs proofs(report.threads);
    for (const run::BakeReport& bake : report.bakes) body += bake_html(bake, proofs);
    return page("pbrbake report", body);
}

}  // namespace pbrbake::verify
