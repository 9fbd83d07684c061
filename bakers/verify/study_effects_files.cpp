// Effects as JSON, as a table for a terminal, and as a section of the page.

#include <array>
#include <cmath>
#include <cstdio>

#include "bakers/verify/page.hpp"
#include "bakers/verify/study_effects.hpp"

namespace pbrbake::verify {
namespace {

/// "f 1, albedo look-ups 2"
std::string counts_text(const EffectCost& row) {
    std::string text;
    for (const auto& [what, times] : row.evaluations) {
        if (!text.empty()) text += ", ";
        text.append(what).append(" ").append(count(times));
    }
    return text;
}

/// "12.3 ns", "4.56 ms"
std::string seconds_text(double seconds) {
    if (seconds < 1e-6) return number(seconds * 1e9) + " ns";
    return seconds < 1e-3 ? number(seconds * 1e6) + " us" : number(seconds * 1e3) + " ms";
}

}  // namespace

Json effects_json(const std::vector<EffectGroup>& groups) {
    Json list = Json::array();
    for (const EffectGroup& group : groups) {
        Json rows = Json::array();
        for (const EffectCost& row : group.rows)
            rows.push_back({{"name", row.name},
                            {"cpu_s", median_json(row.timing.seconds)},
                            {"time_ratio", median_json(row.timing.ratio)},
                            {"evaluations", row.evaluations},
                            {"bytes", row.bytes},
                            {"rest_unchanged", row.rest_unchanged}});
        list.push_back({{"title", group.title}, {"unit", group.unit}, {"rows", std::move(rows)}});
    }
    return list;
}

std::string effects_table(const std::vector<EffectGroup>& groups) {
    std::string text;
    for (const EffectGroup& group : groups) {
        text.append(group.title).append("\n\n");
        for (const EffectCost& row : group.rows) {
            std::array<char, 128> line{};
            std::snprintf(line.data(), line.size(), "%-28s %8s %7s %10s  ", row.name.c_str(),
                          number(row.timing.ratio.value).c_str(),
                          &row == group.rows.data() ? "" : (known_percent(row.timing.ratio) + " %").c_str(),
                          seconds_text(row.timing.seconds.value).c_str());
            text += line.data();
            std::string counts = counts_text(row);
            if (row.evaluations.size() > 1 && group.unit == "bake") {  // those of the effect itself
                const auto own = row.evaluations.find(row.name);
                if (own != row.evaluations.end()) counts = "+ " + count(own->second);
            }
            text += counts.substr(0, 23);
            text += row.rest_unchanged ? "\n" : " CHANGES THE REST\n";
        }
        text += "\n";
    }
    return text;
}

std::string effects_html(const std::vector<EffectGroup>& groups) {
    std::string html =
        "<section id=effects><h2>What effects cost</h2>\n<p>Each effect on, against the same without it. An "
        "effect "
        "that is off is not evaluated, which the counters show, and leaves the rest of a product as it was, "
        "bit "
        "for bit.</p>\n";
    for (const EffectGroup& group : groups) {
        Table table({"effect", "time", "95 % interval", "an " + group.unit + " here", "counted", "bytes"});
        if (group.unit == "bake")
            table = Table({"effect", "time", "95 % interval", "a bake here", "counted", "bytes"});
        table.set_text(4);
        for (const EffectCost& row : group.rows) {
            const Median& ratio = row.timing.ratio;
            const bool is_base = &row == group.rows.data();
            table.add({escaped(row.name) + (row.rest_unchanged ? "" : " <b>changes the rest</b>"),
                       number(ratio.value),
                       is_base ? "is 1" : number(ratio.low) + " to " + number(ratio.high),
                       seconds_text(row.timing.seconds.value), escaped(counts_text(row)),
                       row.bytes ? count(row.bytes) : ""});
        }
        html += "<h3>" + escaped(group.title) + "</h3>\n" + table.html();
    }
    return html + "</section>\n";
}

}  // namespace pbrbake::verify
