// The demo's page, section by section.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "bakers/io/io.hpp"
#include "bakers/job/json_text.hpp"
#include "bakers/verify/demo.hpp"
#include "bakers/verify/demo_pictures.hpp"
#include "bakers/verify/page.hpp"
#include "bakers/verify/picture.hpp"
#include "bakers/verify/record_html.hpp"

namespace pbrbake::verify {
namespace {

/// A setting, without the zeros that measured numbers end with.
std::string plain(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", value);
    return text.data();
}

std::string figure_html(const std::string& pictures, const std::string& caption, const char* kind = "") {
    return std::string("<figure") + kind + ">" + pictures + "<figcaption>" + caption +
           "</figcaption></figure>\n";
}

std::string image_html(const Picture& picture, const std::string& alt) {
    return "<img alt=\"" + escaped(alt) + "\" width=" + std::to_string(picture.width) +
           " height=" + std::to_string(picture.height) + " src=\"" + data_uri(picture) + "\">";
}

std::uint64_t evaluations(const run::BakeReport& report) {
    std::uint64_t sum = 0;
    for (const auto& [effect, count] : report.bake_evaluations) sum += count;
    return sum;
}

const Json& headline(const run::BakeReport& report) { return report.entry["certificate"]["headline"]; }

/// The figure of a metric at a level, or null.
const Json* figure_at(const run::BakeReport& report, const std::string& metric, int level) {
    for (const Json& figure : report.entry["certificate"]["figures"])
        if (figure["metric"] == metric && figure.value("level", -1) == level) return &figure;
    return nullptr;
}

/// One probe of the demo.
struct Probe {
    const run::BakeReport* report;
    BakedImage baked;
    std::string title;  ///< "32 samples"
};

struct Environment {
    EnvironmentLook look;
    std::string source;
    std::vector<Probe> probes;  ///< cheapest first

    const Probe& best() const { return probes.back(); }
    int levels() const { return static_cast<int>(best().baked.image.levels.size()); }
};

class DemoPage {
  public:
    explicit DemoPage(const run::RunReport& report) : report_(report) {
        for (const EnvironmentLook& look : environment_looks()) {
            Environment environment{look, "builtin:" + look.name, {}};
            for (const run::BakeReport& bake : report.bakes) {
                if (bake.bake->json.value("source", "") != environment.source) continue;
                const bool exact = bake.bake->json["integrator"] == "reference";
                const std::string samples = exact ? "" : count(bake.bake->json["samples"].get<unsigned>());
                environment.probes.push_back(
                    {&bake, read_baked(bake), exact ? "reference" : samples + " samples"});
            }
            environments_.push_back(std::move(environment));
        }
        for (const run::BakeReport& bake : report.bakes)
            if (bake.bake->kind == "dfg") table_ = &bake;
    }

    std::string html() const {
        std::string body = introduction() + cost();
        for (const Environment& environment : environments_) body += probe_section(environment);
        body += table_section() + reading();
        return page("pbrbake demo", body);
    }

  private:
    std::string introduction() const;
    std::string cost() const;
    std::string cost_table() const;
    std::string cost_sentence(const Environment& environment) const;
    std::string probe_section(const Environment& environment) const;
    std::string balls(const Environment& environment) const;
    std::string level_table(const Environment& environment) const;
    std::string facts(const run::BakeReport& report) const;
    std::string table_section() const;
    std::string reading() const;

    const run::RunReport& report_;
    const run::BakeReport* table_ = nullptr;
    std::vector<Environment> environments_;
};

std::string DemoPage::introduction() const {
    std::uint64_t bytes = 0;
    for (const run::BakeReport& bake : report_.bakes)
        for (const Json& output : bake.entry["outputs"]) bytes += output["bytes"].get<std::uint64_t>();
    const BakedImage table = read_baked(*table_);
    std::string strips;
    for (const Environment& environment : environments_)
        strips += image_html(hero_picture(environment.look, environment.best().baked, table),
                             "Metal balls of perceptual roughness 0 to 1, " + environment.look.name);
    const auto fact = [](const std::string& value, const std::string& name) {
        return "<li><b>" + value + "</b>" + name + "</li>";
    };
    return "<h1>pbrbake demo</h1>\n<p class=lead>Look-up tables and prefiltered probes for image-based "
           "lighting, baked "
           "from two procedural environments, with what each cost and how far it is from the truth.</p>\n"
           "<ul class=facts>" +
           fact(std::to_string(report_.bakes.size()), "products") +
           fact(number(report_.seconds.wall) + " s", "wall, all stages, certifying included") +
           fact(number(report_.seconds.cpu) + " s",
                "CPU on " + std::to_string(report_.threads) + " threads") +
           fact(number(static_cast<double>(bytes) / 1e6) + " MB", "written") +
           fact(escaped(std::string(run::tool_version()).substr(8)), "version of pbrbake") + "</ul>\n" +
           figure_html(
               strips,
               "The products in use. Metal balls of perceptual roughness 0, 0.2 … 1, shaded by the split "
               "sum: "
               "probe(reflected direction, perceptual roughness) × (f0 · scale + bias), the table giving "
               "scale and "
               "bias. "
               "Above: aluminium, f0 = (0.91, 0.92, 0.92), outdoors at EV100 15. Below: gold, f0 = (1, 0.77, "
               "0.34), indoors at EV100 8. No diffuse light, no shadows, no multiple scattering.",
               " class=hero");
}

std::string DemoPage::cost_table() const {
    Table table({"probe", "samples a texel", "bake, wall", "bake, CPU", "evaluations", "certify, wall",
                 "relative RMSE, worst level", "level"});
    for (const Environment& environment : environments_)
        for (const Probe& probe : environment.probes) {
            const run::Seconds bake = seconds_of(*probe.report, run::Stage::bake);
            const Json& figure = headline(*probe.report);
            const bool exact = probe.title == "reference";
            table.add(
                {"<code>" + escaped(probe.report->bake->name) + "</code>",
                 exact ? "all source texels" : count(probe.report->bake->json["samples"].get<unsigned>()),
                 number(bake.wall) + " s", number(bake.cpu) + " s", count(evaluations(*probe.report)),
                 number(seconds_of(*probe.report, run::Stage::certify).wall) + " s", certified(figure),
                 std::to_string(figure["level"].get<int>())});
        }
    return table.html();
}

std::string DemoPage::cost_sentence(const Environment& environment) const {
    const Probe &cheap = environment.probes[0], &dear = environment.probes[1];
    const double cheap_s = seconds_of(*cheap.report, run::Stage::bake).cpu;
    const double dear_s = seconds_of(*dear.report, run::Stage::bake).cpu;
    std::string html = "<p><b>" + environment.look.title + ".</b> " + dear.title + " instead of " +
                       cheap.title + ": " + number(dear_s / cheap_s) + " × the CPU time of the bake (" +
                       number(dear_s) + " s against " + number(cheap_s) + " s). ";
    if (environment.probes.size() < 3) {
        double worst = 0;
        for (int level = 1; level < environment.levels(); ++level)
            worst = std::max(worst, relative_rmse(cheap.baked, dear.baked, level));
        const double cheap_error = headline(*cheap.report)["value"],
                     dear_error = headline(*dear.report)["value"];
        return html + "The certified error of the worst level falls from " + number(cheap_error) + " to " +
               number(dear_error) + ": by " + number(cheap_error / dear_error) +
               " ×. Measured at every texel, the two differ by a relative RMS of " + percent(worst) +
               " at the worst level.</p>\n";
    }
    double cheap_error = 0, dear_error = 0;
    for (int level = 1; level < environment.levels(); ++level) {
        cheap_error = std::max(cheap_error, relative_rmse(cheap.baked, environment.best().baked, level));
        dear_error = std::max(dear_error, relative_rmse(dear.baked, environment.best().baked, level));
    }
    return html + "The error of the worst level, measured at every texel against the reference, falls from " +
           percent(cheap_error) + " to " + percent(dear_error) + ": by " + number(cheap_error / dear_error) +
           " ×. The reference takes " +
           number(seconds_of(*environment.best().report, run::Stage::bake).cpu / dear_s) +
           " × the CPU time of " + dear.title + ".</p>\n";
}

std::string DemoPage::cost() const {
    std::string html =
        "<h2>What accuracy costs</h2>\n<p>The same 256² probe by filtered importance sampling: with 32 "
        "samples a texel, as in Frostbite's notes, and with 1,024.</p>\n" +
        cost_table();
    for (const Environment& environment : environments_) html += cost_sentence(environment);
    return html +
           "<p class=soft>Wall time is what one waits; CPU time is summed over threads. Every bake first "
           "resamples the "
           "source to level 0 and to the pyramid that samples read: the same work whatever the sample count. "
           "The errors in the table are "
           "certificates: part of each product's record, the same on every machine. An estimate compares "
           "tiles of "
           "texels chosen by hash with the exact sum over all source texels; its interval "
           "takes the tiles' errors for normally distributed, so with few tiles and one small sun it can "
           "miss. Level 0 is the mirror: its error is what storing it changed.</p>\n";
}

std::string DemoPage::balls(const Environment& environment) const {
    const int levels = environment.levels();
    std::string html = "<div class=wide><div class=balls style=\"grid-template-columns:108px repeat(" +
                       std::to_string(levels) + ",1fr)\"><span></span>";
    for (int level = 0; level < levels; ++level) {
        const Json& facts = environment.best().report->entry["levels"][static_cast<std::size_t>(level)];
        html += "<span class=head>level " + std::to_string(level) + "<br>perceptual roughness " +
                plain(facts["perceptual_roughness"].get<double>()) + "</span>";
    }
    for (const Probe& probe : environment.probes) {
        html += "<span class=row><b>" + probe.title + "</b>" +
                number(seconds_of(*probe.report, run::Stage::bake).cpu) + " s CPU</span>";
        for (int level = 0; level < levels; ++level)
            html +=
                image_html(level_ball(environment.look, probe.baked, level),
                           environment.look.name + ", " + probe.title + ", level " + std::to_string(level));
    }
    for (std::size_t i = 0; i + 1 < environment.probes.size(); ++i) {
        const Probe& probe = environment.probes[i];
        html += "<span class=row><b>difference</b>" + probe.title + "<br>from " + environment.best().title +
                "</span><span></span>";
        for (int level = 1; level < levels; ++level)
            html +=
                image_html(difference_ball(environment.look, probe.baked, environment.best().baked, level),
                           "Difference, level " + std::to_string(level));
    }
    return html + "</div></div>\n" +
           false_colour_scale(plain(100 * kLeastDifferenceShown) + " % or less",
                              plain(100 * kMostDifferenceShown) + " % or more");
}

std::string DemoPage::level_table(const Environment& environment) const {
    std::vector<std::string> heads{"level", "size", "perceptual roughness", "alpha"};
    for (const Probe& probe : environment.probes) heads.push_back("certificate, " + probe.title);
    for (std::size_t i = 0; i + 1 < environment.probes.size(); ++i)
        heads.push_back(environment.probes[i].title + " from " + environment.best().title + ", all texels");
    heads.push_back("energy against the source");
    Table table(heads);
    for (int level = 0; level < environment.levels(); ++level) {
        const Json& facts = environment.best().report->entry["levels"][static_cast<std::size_t>(level)];
        const std::string size = std::to_string(facts["size"].get<int>());
        std::vector<std::string> cells{std::to_string(level), size + " × " + size,
                                       plain(facts["perceptual_roughness"].get<double>()),
                                       plain(facts["alpha"].get<double>())};
        for (const Probe& probe : environment.probes) {
            const Json* figure = figure_at(*probe.report, "relative_rmse", level);
            cells.push_back(figure ? certified(*figure, "<br>") : "–");
        }
        for (std::size_t i = 0; i + 1 < environment.probes.size(); ++i)
            cells.push_back(level == 0 ? "–"
                                       : number(relative_rmse(environment.probes[i].baked,
                                                              environment.best().baked, level)) +
                                             "<br><small>measured</small>");
        const Json* energy = figure_at(*environment.best().report, "energy_error", level);
        cells.push_back(energy ? percent((*energy)["value"].get<double>()) : "–");
        table.add(cells);
    }
    return "<h3>Error a level</h3>\n<p class=soft>Relative root mean square error: of stored texels, over "
           "their mean. "
           "Energy: what texels of the " +
           environment.best().title + " probe hold more than exact ones, over the source's.</p>\n" +
           table.html();
}

std::string DemoPage::facts(const run::BakeReport& report) const {
    const Json& entry = report.entry;
    std::string outputs;
    for (const Json& output : entry["outputs"])
        outputs += (outputs.empty() ? "" : ", ") + ("<a href=\"" + escaped_text(output["path"]) + "\">") +
                   escaped_text(output["path"]) + "</a>, " + count(output["bytes"].get<std::uint64_t>()) +
                   " bytes, XXH3 <code>" + escaped_text(output["xxh3"]) + "</code>";
    return "<dl><dt>file</dt><dd>" + outputs + "</dd><dt>pixel, units, scale</dt><dd>" +
           escaped_text(entry["pixel"]) + ", " + escaped_text(entry["units"]) + ", " +
           scale_text(entry["scale"].get<double>()) + "</dd><dt>certificate</dt><dd>" +
           escaped_text(headline(report)["metric"]) + " " + certified(headline(report)) + "<br>" +
           escaped_text(headline(report)["method"]) + "</dd></dl>\n";
}

std::string DemoPage::probe_section(const Environment& environment) const {
    std::vector<const run::BakeReport*> bakes;
    std::vector<std::string> titles;
    std::string records;
    for (const Probe& probe : environment.probes) {
        bakes.push_back(probe.report);
        titles.push_back(probe.title);
        records += facts(*probe.report);
    }
    const Picture cross = level_0_cross(environment.look, environment.best().baked);
    return "<h2>" + environment.look.title + " probe</h2>\n<p>" + environment.look.description +
           " Shown at EV100 " + plain(environment.look.ev100) + ": " +
           number(1 / exposure_of_ev100(environment.look.ev100)) + " cd/m² is white.</p>\n" +
           figure_html(
               balls(environment),
               "Each level as a mirror ball seen from afar: the radiance stored for the direction that each "
               "point reflects into. Difference: |a − b| in luminance over the level's mean luminance, on a "
               "logarithmic scale.") +
           level_table(environment) + stage_table(bakes, titles) + "<h3>Records</h3>\n" + records +
           "<h3>Level 0</h3>\n" +
           figure_html(
               image_html(cross, "Level 0 as an unfolded cube"),
               "Level 0 unfolded. Middle row: −X, +Z, +X, −Z; +Y above and −Y below +Z. Faces are stored in "
               "the "
               "order +X −X +Y −Y +Z −Z, right-handed, y up, each as OpenGL samples it. Shown at half size.",
               " class=cross");
}

std::string DemoPage::table_section() const {
    const BakedImage table = read_baked(*table_);
    const auto chart = [](const Picture& picture, const std::string& title, const std::string& note) {
        return "<figure><div class=chart><div class=y><span>0</span><span>perceptual roughness &rarr;</span>"
               "<span>1</span></div>" +
               image_html(picture, title) +
               "<div class=x><span>0</span><span>NoV &rarr;</span><span>1</span></div></div>"
               "<figcaption><b>" +
               title + "</b><br>" + note + "</figcaption></figure>";
    };
    std::string charts;
    const Json& columns = table_->entry["columns"];
    const std::array<std::string, 3> notes{"R: what f0 is multiplied with", "G: what f90 is multiplied with",
                                           "B: albedo of a white surface, 1/π inside"};
    for (int c = 0; c < static_cast<int>(columns.size()); ++c) {
        double highest = 0;
        const Picture picture = channel_picture(table, c, highest);
        charts += chart(picture, columns[static_cast<std::size_t>(c)].get<std::string>(),
                        notes[static_cast<std::size_t>(c)] + "; 0 to " + number(highest));
    }
    charts +=
        chart(rgb_picture(table), "RGB", "the three channels as they lie in the file, clipped to 0 to 1");
    std::string work;
    for (const auto& [effect, evaluated] : table_->bake_evaluations)
        work += (work.empty() ? "" : ", ") + escaped(effect) + " " + count(evaluated);
    return "<h2>Table: the DFG term</h2>\n<p>Directional albedo of the GGX lobe and of Disney diffuse, 128 × "
           "128. Row 0 is "
           "the lowest perceptual roughness; texel centers lie at (i + ½) / 128. A material's specular "
           "albedo is f0 · "
           "scale + f90 · "
           "bias.</p>\n<div class=charts>" +
           charts + "</div>\n" + false_colour_scale("0", "highest") + "<h3>Certificate</h3>\n" +
           figures_html(table_->entry["certificate"]) + "<p class=soft>Evaluations: " + work + ".</p>\n" +
           stage_table({table_}, {"bake dfg"}) + "<h3>Record</h3>\n" + facts(*table_);
}

std::string DemoPage::reading() const {
    return "<h2>How to read this page</h2>\n<dl><dt>display</dt><dd>Values are multiplied by the exposure, 1 "
           "/ (1.2 · "
           "2<sup>EV100</sup>) for luminance in cd/m², clipped to [0, 1], and encoded by sRGB's curve. No "
           "other tone "
           "mapping.</dd><dt>scale</dt><dd>Half floats end at 65,504. A probe whose peak lies above is "
           "stored times a power "
           "of two; divide by it. Pictures and errors here are of divided values.</dd><dt>times</dt><dd>Of "
           "this one run, on "
           "this machine, other processes included. They are on this page alone: products, records and "
           "manifest "
           "are the same bytes in every run.</dd><dt>repeat</dt><dd><code>pbrbake bake job.json</code> in "
           "this "
           "folder bakes the same bytes again; <code>pbrbake inspect FILE</code> shows what a product "
           "holds.</dd></dl>\n<h3>The job</h3>\n<pre>" +
           escaped(job::to_text(demo_job(environments_[0].probes.size() > 2))) + "</pre>\n";
}

}  // namespace

std::string demo_page(const run::RunReport& report) { return DemoPage(report).html(); }

}  // namespace pbrbake::verify
