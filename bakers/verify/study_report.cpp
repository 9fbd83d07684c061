#include "bakers/verify/study_report.hpp"

#include <algorithm>
#include <cmath>

#include "bakers/job/json_text.hpp"
#include "bakers/run/run.hpp"
#include "bakers/verify/machine.hpp"
#include "bakers/verify/page.hpp"
#include "bakers/verify/study_job.hpp"
#include "bakers/verify/study_plot.hpp"

namespace pbrbake::verify {
namespace {

constexpr std::string_view kStyle = R"css(
.legend{display:flex;flex-wrap:wrap;gap:4px 20px;list-style:none;padding:0;margin:8px 0 12px;font-size:13px}
.legend li{display:flex;align-items:center;gap:6px;cursor:default}
.legend small{color:var(--soft)}
.dim .series{opacity:.12}
.dim .series.lit{opacity:1}
#tip{position:fixed;z-index:9;pointer-events:none;display:none;background:var(--panel);color:var(--text);border:1px solid var(--soft);border-radius:6px;padding:6px 9px;font-size:12px;line-height:1.4;white-space:pre;box-shadow:0 3px 12px rgba(0,0,0,.25)}
h4{font-size:14px;margin:16px 0 4px;color:var(--soft)}
.steps{display:flex;flex-wrap:wrap;gap:10px 18px}
.step{font-size:12px;color:var(--soft);line-height:1.3}
.step b{color:var(--text)}
.tiles{display:flex;gap:6px;align-items:center;margin-bottom:3px}
.tiles img{image-rendering:pixelated;border-radius:3px}
details{margin:12px 0}
summary{cursor:pointer;color:var(--mark);font-size:14px}
)css";

/// Shows a point's data-tip beside the pointer, and dims the other series while one is pointed at.
constexpr std::string_view kScript = R"js(
(function(){
var tip=document.createElement('div');tip.id='tip';document.body.appendChild(tip);
function show(event){
  var point=event.target.closest?event.target.closest('[data-tip]'):null;
  if(!point){tip.style.display='none';return}
  tip.textContent=point.getAttribute('data-tip');tip.style.display='block';
  var x=event.clientX+14,y=event.clientY+14;
  if(x+tip.offsetWidth>innerWidth-8)x=event.clientX-14-tip.offsetWidth;
  if(y+tip.offsetHeight>innerHeight-8)y=event.clientY-14-tip.offsetHeight;
  tip.style.left=Math.max(4,x)+'px';tip.style.top=Math.max(4,y)+'px';
}
document.addEventListener('pointermove',show);
document.querySelectorAll('.legend li[data-series]').forEach(function(item){
  var section=item.closest('section');
  function light(on){
    section.querySelector('.plot').classList.toggle('dim',on);
    section.querySelectorAll('.series').forEach(function(s){
      s.classList.toggle('lit',on&&s.dataset.series===item.dataset.series)});
  }
  item.addEventListener('pointerenter',function(){light(true)});
  item.addEventListener('pointerleave',function(){light(false)});
});
})();
)js";

const std::string& series_name(const StudiedCase& studied, const StudyPoint& point) {
    return studied.asked.series[point.series].name;
}

std::string setting(const StudiedCase& studied, std::size_t index) {
    const StudyPoint& point = studied.points[index];
    return escaped(series_name(studied, point) + " " + point.step.label);
}

std::string milliseconds(double seconds) { return number(seconds * 1000) + " ms"; }

/// What a further digit costs at a law, in words.
std::string law_text(const PowerLaw& law) {
    return "error ~ (t − " + number(law.fixed) + ")<sup>−" + number(law.exponent) + "</sup>; a digit: × " +
           number(law.price_of_digit());
}

std::string legend(const StudiedCase& studied) {
    std::string html = "<ul class=legend>";
    for (std::size_t s = 0; s < studied.asked.series.size(); ++s) {
        const Series& series = studied.asked.series[s];
        html += "<li data-series=" + std::to_string(s) + ">" + plot_mark(s) + "<span>" + escaped(series.name);
        if (!series.dial.empty()) html += " <small>by " + escaped(series.dial) + "</small>";
        if (const auto& law = studied.laws[s]) html += " <small>" + law_text(*law) + "</small>";
        html += "</span></li>";
    }
    return html + "</ul>\n";
}

std::string digit_table(const StudiedCase& studied) {
    if (studied.digits.empty()) return "";
    Table table({"error at most", "cheapest setting", "time", "CPU here", "× the digit before"});
    table.set_text(1);
    double before = 0;
    for (const Digit& digit : studied.digits) {
        const Timing& timing = studied.points[digit.point].timing;
        table.add({number(digit.error), setting(studied, digit.point), number(timing.ratio.value),
                   milliseconds(timing.seconds.value),
                   before > 0 ? number(timing.ratio.value / before) : ""});
        before = timing.ratio.value;
    }
    return "<h3>The price of each further digit</h3>\n" + table.html();
}

std::string interval_text(const Median& ratio, bool is_base) {
    if (is_base) return "is 1";
    return std::isfinite(ratio.high) ? number(ratio.low) + " to " + number(ratio.high) : "unknown";
}

std::string point_table(const StudiedCase& studied) {
    Table table({"method", "setting", "error", "time", "95 % interval", "spread", "CPU here", "repeats",
                 "evaluations", "bytes", ""});
    table.set_text(1);
    for (std::size_t i = 0; i < studied.points.size(); ++i) {
        const StudyPoint& point = studied.points[i];
        const std::string label =
            escaped(point.step.label + (point.step.note.empty() ? "" : ", " + point.step.note));
        if (!point.failure.empty()) {
            table.add({escaped(series_name(studied, point)), label, "failed: " + escaped(point.failure), "",
                       "", "", "", "", "", "", ""});
            continue;
        }
        const Median& ratio = point.timing.ratio;
        const bool on_front = std::ranges::find(studied.front, i) != studied.front.end();
        table.add({escaped(series_name(studied, point)), label, number(point.error), number(ratio.value),
                   interval_text(ratio, i == studied.base), percent(point.timing.seconds.spread),
                   milliseconds(point.timing.seconds.value), std::to_string(point.timing.seconds.count),
                   count(point.evaluations), count(point.bytes),
                   studied.knee == i ? "knee"
                   : on_front        ? "front"
                                     : ""});
    }
    return "<details><summary>All " + std::to_string(studied.points.size()) + " settings</summary>\n" +
           table.html() + "</details>\n";
}

std::string picture_words(const StudiedCase& studied, const PictureBook& pictures) {
    const std::string kind = studied.asked.bake["kind"].get<std::string>();
    if (kind == "light")
        return "Illuminance in stops over distance, both logarithmic: broad the source's law, blue the light "
               "that was fitted; below, red, their difference.";
    if (kind == "texture" && !studied.asked.reference)
        return "A sphere in the built-in room: the set as it was read, or calibrated where it was; as it was "
               "stored; their difference in luminance over the mean, from "
               "dark (0.1 % and less) to light (100 %), and the mean LDR-FLIP. Both sum over the same 64 × "
               "32 "
               "lights, so that lobes alone differ. Spheres go through " +
               std::string(pictures.display_name()) + "; FLIP is of the exposed values before that.";
    if (kind == "probe" && studied.asked.reference)
        return "Each step: a filtered level unfolded; its difference from the reference, over the mean, from "
               "dark (0.1 % and less) to light (100 %); an aluminium ball of perceptual roughness 1/3 by the "
               "split sum.";
    return "Channels as colours, each over its largest value; of large products every nth texel.";
}

std::string pictures_html(const StudiedCase& studied, const PictureBook& pictures) {
    const std::string html = pictures.html(studied);
    if (html.empty()) return "";
    return "<details open><summary>Pictures at each step of the dial</summary>\n<p class=soft>" +
           picture_words(studied, pictures) + "</p>\n" + html + "</details>\n";
}

std::string knee_text(const StudiedCase& studied) {
    if (!studied.knee) return "";
    const StudyPoint& point = studied.points[*studied.knee];
    return "<p>The knee is <b>" + setting(studied, *studied.knee) + "</b>: error " + number(point.error) +
           " for " + number(point.timing.ratio.value) + " of the time of " + setting(studied, studied.base) +
           ".</p>\n";
}

std::string reproduce(const StudiedCase& studied) {
    const std::size_t shown = studied.knee.value_or(studied.base);
    Json bake = without_folders(with_overrides(studied.asked.bake, studied.points[shown].step.overrides));
    bake["name"] = studied.asked.name;
    return "<details><summary>The bake of " + setting(studied, shown) + " as a job</summary><pre>" +
           escaped(job::to_text({{"version", 1}, {"bakes", Json::array({bake})}})) + "</pre></details>\n";
}

std::string case_html(const StudiedCase& studied, const PictureBook& pictures) {
    std::string html = "<section id=\"" + escaped(studied.asked.name) + "\"><h2>" +
                       escaped(studied.asked.title) + "</h2>\n<p>" + escaped(studied.asked.about) + "</p>\n" +
                       "<div class=wide>" + plot_svg(studied) + "</div>" + legend(studied);
    html +=
        "<p class=soft>Error: <code>" + escaped(studied.metric) + "</code>, " + escaped(studied.truth) + ". ";
    if (studied.reference_cpu_s > 0)
        html += "The reference took " + number(studied.reference_cpu_s) + " CPU seconds, " +
                number(studied.reference_cpu_s / studied.points[studied.base].timing.seconds.value) + " × " +
                setting(studied, studied.base) + ". ";
    if (studied.floor > 0)
        html += "Errors below " + number(3 * studied.floor) +
                " (shaded) say more of the reference or of storage than of the method: they count as equal. ";
    html +=
        "The broad line is the front: no other setting beats its points in both. Dashed: fitted laws.</p>\n";
    return html + knee_text(studied) + digit_table(studied) + pictures.proof(studied) +
           pictures_html(studied, pictures) + point_table(studied) + reproduce(studied) + "</section>\n";
}

/// Which setting is the cheapest for each error, case by case.
std::string summary(const Study& study) {
    std::vector<std::string> heads{"case", "1 is"};
    const std::vector<int> powers{-1, -2, -3, -4};
    for (const int power : powers) heads.push_back("1e" + std::to_string(power));
    Table table(heads);
    for (std::size_t column = 1; column < heads.size(); ++column) table.set_text(column);
    for (const StudiedCase& studied : study.cases) {
        std::vector<std::string> row{
            "<a href=\"#" + escaped(studied.asked.name) + "\">" + escaped(studied.asked.title) + "</a>",
            setting(studied, studied.base)};
        for (const int power : powers) {
            const auto reached = std::ranges::find_if(studied.digits, [&](const Digit& digit) {
                return digit.error <= std::pow(10.0, power) * 1.001;
            });
            if (reached == studied.digits.end()) {
                row.push_back("–");
                continue;
            }
            row.push_back("<b>" + number(studied.points[reached->point].timing.ratio.value) +
                          "</b><br><small>" + setting(studied, reached->point) + "</small>");
        }
        table.add(std::move(row));
    }
    return "<h2>The cheapest way to an error</h2>\n<p>Time as a ratio to the setting named first, and the "
           "method and setting that take it. Where the first digits are free, the cheapest setting of all "
           "has "
           "them already.</p>\n" +
           table.html();
}

/// What the time did not suffice for.
std::string unknown_html(const Study& study) {
    const std::vector<std::string> unknown = unknown_ratios(study);
    if (unknown.empty()) return "";
    std::string html = "<details><summary>" + std::to_string(unknown.size()) + " ratios are not known to " +
                       whole_percent(study.known_to) + "</summary>\n<p class=soft>";
    for (const std::string& line : unknown) html += escaped(line) + "<br>";
    return html + "</p></details>\n";
}

std::string fact(const std::string& value, const std::string& name) {
    return "<li><b>" + value + "</b>" + name + "</li>";
}

std::string method_text(const std::string& command) {
    return "<h2>How this was measured</h2>\n<p>Each setting was baked once the ordinary way, job to file, "
           "and its "
           "error taken from the stored values as they decode. Then the bake stages of all settings were "
           "timed "
           "in turn, on one thread, in CPU time: a warm-up, then rounds in alternating order until the "
           "ratio "
           "of each was known to 5 % (95 % intervals by order statistics), or the time was up. A ratio is "
           "the median of those to the base right before and after, so that a machine that drifts changes "
           "both. "
           "Ratios carry over to other machines; milliseconds are of the one named above.</p>\n"
           "<p>A law is fitted to a method's points above the floor: error = c (t − t₀)<sup>−p</sup>, t₀ "
           "being "
           "what is paid whatever the setting; a digit then costs 10<sup>1/p</sup> × the part above t₀. The "
           "knee "
           "is the point of the front farthest below the line between its ends, "
           "log-log.</p>\n<p>Again:</p><pre>" +
           escaped(command) +
           "</pre>\n<p>The same figures are in study.json and study.csv beside this page.</p>\n";
}

}  // namespace

std::string study_page(const Study& study, const PictureBook& pictures, const std::string& command,
                       const std::string& more) {
    const Machine machine = this_machine();
    std::string body =
        "<style>" + plot_style() + std::string(kStyle) +
        "</style>\n<h1>What accuracy costs</h1>\n<p class=lead>Error against CPU time of every "
        "method at every setting, each against a reference that is better than all of them.</p>\n";
    body += "<ul class=facts>" + fact(std::to_string(study.cases.size()), "cases") +
            fact(std::to_string(study.points),
                 std::to_string(study.known) + " of their times known to " + whole_percent(study.known_to)) +
            fact(std::to_string(study.rounds), "rounds of times") +
            fact(number(study.wall_s / 60) + " min", "in all") +
            fact(std::to_string(machine.threads) + " × ",
                 escaped(machine.processor) + ", " + escaped(machine.compiler)) +
            fact(escaped(std::string(run::tool_version()).substr(8)), "version of pbrbake") + "</ul>\n" +
            unknown_html(study);
    if (!study.cases.empty()) body += summary(study);
    for (const StudiedCase& studied : study.cases) body += case_html(studied, pictures);
    body += more + method_text(command) + "<script>" + std::string(kScript) + "</script>\n";
    return page("pbrbake study", body);
}

}  // namespace pbrbake::verify
