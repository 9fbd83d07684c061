#include "bakers/verify/record_html.hpp"

#include <algorithm>

#include "bakers/verify/curve_plot.hpp"
#include "bakers/verify/page.hpp"

namespace pbrbake::verify {

std::string escaped_text(const Json& value) { return escaped(value.get<std::string>()); }

std::string warnings_html(const run::BakeReport& report) {
    std::string list;
    for (const std::string& warning : report.warnings) list += "<li>" + escaped(warning) + "</li>";
    return list.empty() ? "" : "<ul>" + list + "</ul>\n";
}

run::Seconds seconds_of(const run::BakeReport& report, run::Stage stage) {
    const auto found = report.seconds.find(stage);
    return found == report.seconds.end() ? run::Seconds{} : found->second;
}

std::string certified(const Json& figure, const char* gap) {
    std::string html =
        number(figure["value"].get<double>()) + gap + "<small>" + escaped_text(figure["evidence"]);
    if (figure.contains("interval"))
        html += ", 95 % in " + number(figure["interval"][0].get<double>()) + " to " +
                number(figure["interval"][1].get<double>());
    return html + "</small>";
}

std::string figures_html(const Json& certificate) {
    const Json& figures = certificate["figures"];
    const bool has_levels =
        std::ranges::any_of(figures, [](const Json& figure) { return figure.contains("level"); });
    std::vector<std::string> heads{"metric", "value", "method"};
    if (has_levels) heads.insert(heads.begin() + 1, "level");
    Table table(heads);
    table.set_text(heads.size() - 1);
    std::string curves;
    for (const Json& figure : figures) {
        const std::string metric = "<code>" + escaped_text(figure["metric"]) + "</code>";
        std::vector<std::string> cells{metric, certified(figure), escaped_text(figure["method"])};
        if (has_levels)
            cells.insert(cells.begin() + 1,
                         figure.contains("level") ? std::to_string(figure["level"].get<int>()) : "");
        table.add(cells);
        if (const std::string curve = curve_html(figure.value("curve", Json())); !curve.empty())
            curves += "<figure>" + curve + "<figcaption>" + metric + " " +
                      number(figure["value"].get<double>()) + "</figcaption></figure>\n";
    }
    return table.html() + (curves.empty() ? "" : "<div class=charts>\n" + curves + "</div>\n");
}

std::string stage_table(const std::vector<const run::BakeReport*>& bakes,
                        const std::vector<std::string>& titles) {
    std::vector<std::string> heads{"stage"};
    for (const std::string& title : titles) {
        heads.push_back(title + ", wall");
        heads.push_back("CPU");
    }
    Table table(heads);
    for (std::size_t stage = 0; stage < run::kStageNames.size(); ++stage) {
        std::vector<std::string> cells{std::string(run::kStageNames[stage])};
        for (const run::BakeReport* bake : bakes) {
            const run::Seconds seconds = seconds_of(*bake, static_cast<run::Stage>(stage));
            cells.push_back(number(seconds.wall) + " s");
            cells.push_back(number(seconds.cpu) + " s");
        }
        table.add(cells);
    }
    return "<h3>Time a stage</h3>\n" + table.html();
}

}  // namespace pbrbake::verify
