#include "bakers/ies/pictures.hpp"

#include <algorithm>
#include <cmath>

#include "bakers/ies/light.hpp"
#include "bakers/parse/text.hpp"
#include "pbr/numerics/elementary.hpp"

namespace pbrbake::ies {
namespace {

std::string fixed2(double value) { return parse::number_text(std::round(value * 100) / 100); }

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else
            out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    return out;
}

/// A round number of candela at or above a quarter of the peak: 1, 2 or 5 times a power of ten.
double ring_step(double peak) {
    double step = 1e-6;
    while (true)
        for (const double factor : {2., 2.5, 2.}) {
            if (step * 4 >= peak) return step;
            step *= factor;
        }
}

constexpr double kCenter = 200, kRadius = 170;

std::string point_at(double deg, double radius) {
    const pbr::SinCos at = pbr::sin_cos_pi(deg / 180);
    return fixed2(kCenter + radius * at.sin) + "," + fixed2(kCenter + radius * at.cos);  // nadir below
}

std::string curve(const Profile& profile, double azimuth, double full_cd, const char* style) {
    std::string path = "<path fill=\"none\" ";
    path.append(style).append(" d=\"");
    for (int deg = -180; deg <= 180; ++deg) {
        const double cd = profile.sample_cd(std::abs(deg), deg < 0 ? azimuth + 180 : azimuth);
        path.append(deg == -180 ? "M" : "L").append(point_at(deg, kRadius * cd / full_cd));
    }
    return path + "\"/>\n";
}

std::string svg_open(int width, int height) {
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + std::to_string(width) + "\" height=\"" +
           std::to_string(height) + "\" viewBox=\"0 0 " + std::to_string(width) + " " +
           std::to_string(height) + "\" font-family=\"sans-serif\" font-size=\"11\">\n";
}

/// One hemisphere by Lambert's azimuthal equal-area projection: radius sqrt(2) sin(polar / 2).
std::string hemisphere(const Profile& profile, double center_x, bool lower, double peak) {
    constexpr int kRings = 18, kSectors = 48;
    std::string out;
    for (int ring = 0; ring < kRings; ++ring)
        for (int sector = 0; sector < kSectors; ++sector) {
            const double a0 = 90. * ring / kRings, a1 = 90. * (ring + 1) / kRings;
            const double b0 = 360. * sector / kSectors, b1 = 360. * (sector + 1) / kSectors;
            const double from_axis = (a0 + a1) / 2;
            const double cd = profile.sample_cd(lower ? from_axis : 180 - from_axis, (b0 + b1) / 2);
            const int grey =
                peak > 0 ? static_cast<int>(std::lround(255 * std::sqrt(std::max(0., cd / peak)))) : 0;
            const auto corner = [&](double from, double azimuth) {
                const double radius = 160 * std::sqrt(2.) * pbr::sin_cos_pi(from / 360).sin;
                const pbr::SinCos at = pbr::sin_cos_pi(azimuth / 180);
                return fixed2(center_x + radius * at.cos) + "," + fixed2(180 - radius * at.sin);
            };
            const std::string level = std::to_string(grey);
            out.append("<path fill=\"rgb(")
                .append(level)
                .append(",")
                .append(level)
                .append(",")
                .append(level)
                .append(")\" d=\"M");
            out.append(corner(a0, b0))
                .append("L")
                .append(corner(a1, b0))
                .append("L")
                .append(corner(a1, b1))
                .append("L")
                .append(corner(a0, b1))
                .append("z\"/>\n");
        }
    return out;
}

std::string row(const std::string& name, const std::string& value) {
    return "<tr><th>" + escaped(name) + "</th><td>" + escaped(value) + "</td></tr>\n";
}

}  // namespace

std::string polar_svg(const Profile& profile) {
    const double peak = profile.web().max_cd(), step = peak > 0 ? ring_step(peak) : 1, full = 4 * step;
    std::string svg = svg_open(400, 420);
    svg += "<rect width=\"400\" height=\"420\" fill=\"white\"/>\n<g fill=\"none\" stroke=\"#ccc\">\n";
    for (int i = 1; i <= 4; ++i)
        svg += "<circle cx=\"200\" cy=\"200\" r=\"" + fixed2(kRadius * i / 4) + "\"/>\n";
    for (int deg = 0; deg < 180; deg += 30)
        svg += "<path d=\"M" + point_at(deg, kRadius) + "L" + point_at(deg + 180, kRadius) + "\"/>\n";
    svg += "</g>\n<g fill=\"#666\">\n";
    for (int i = 1; i <= 4; ++i)
        svg += "<text x=\"202\" y=\"" + fixed2(kCenter + kRadius * i / 4 - 2) + "\">" +
               parse::number_text(step * i) + "</text>\n";
    svg += "</g>\n";
    svg += curve(profile, 90, full, "stroke=\"#2166ac\" stroke-width=\"1.5\" stroke-dasharray=\"5 3\"");
    svg += curve(profile, 0, full, "stroke=\"#b2182b\" stroke-width=\"1.5\"");
    svg +=
        "<text x=\"10\" y=\"410\" fill=\"#b2182b\">C180 - C0</text><text x=\"90\" y=\"410\" "
        "fill=\"#2166ac\">C270 - C90 (dashed)</text><text x=\"375\" y=\"410\">cd</text>\n";
    return svg + "</svg>\n";
}

std::string sphere_svg(const Profile& profile) {
    const double peak = profile.web().max_cd();
    std::string svg = svg_open(720, 370) + "<rect width=\"720\" height=\"370\" fill=\"white\"/>\n";
    svg += hemisphere(profile, 180, true, peak) + hemisphere(profile, 540, false, peak);
    svg += "<text x=\"180\" y=\"362\" text-anchor=\"middle\">below: from the nadir to the horizon</text>\n";
    svg +=
        "<text x=\"540\" y=\"362\" text-anchor=\"middle\">above</text>\n<text x=\"345\" "
        "y=\"184\">C0</text>\n<text x=\"172\" y=\"14\">C90</text>\n";
    return svg + "</svg>\n";
}

std::string page_html(const IesParams& params, const Luminaire& luminaire, const std::string& source) {
    const Json light = light_json(params, luminaire, source);
    std::string html = "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" +
                       escaped(source) +
                       "</"
                       "title>\n<style>body{font-family:sans-serif;margin:2em;max-width:60em}th{text-align:"
                       "left;padding-right:1em;font-weight:normal;color:#555}</style></head><body>\n<h1>" +
                       escaped(source) + "</h1>\n<table>\n";
    const auto number = [&](const char* key) { return fixed2(light[key].get<double>()); };
    html += row("format", light["format"].get<std::string>() + ", type " +
                              light["photometry"].get<std::string>() + ", symmetry " +
                              light["symmetry"].get<std::string>());
    html += row("flux, exact rule", number("flux_lm") + " lm");
    html += row("flux, zonal rule", number("flux_zonal_lm") + " lm");
    html += row("largest intensity", number("max_cd") + " cd");
    for (const char* key : {"beam_angle_deg", "field_angle_deg"})
        html += row(
            key == std::string_view("beam_angle_deg") ? "beam angle, C0 and C90" : "field angle, C0 and C90",
            fixed2(light[key][0].get<double>()) + "°, " + fixed2(light[key][1].get<double>()) + "°");
    if (light["power"].contains("efficacy_lm_per_w"))
        html += row("efficacy", fixed2(light["power"]["efficacy_lm_per_w"].get<double>()) + " lm/W");
    for (const Json& keyword : light["keywords"])
        html += row(keyword[0].get<std::string>(), keyword[1].get<std::string>());
    html += "</table>\n<h2>Diagnostics</h2>\n<ul>\n";
    for (const parse::Diagnostic& diagnostic : luminaire.diagnostics)
        html += "<li><code>" + escaped(diagnostic.code) + "</code>" +
                (diagnostic.line > 0 ? " (line " + std::to_string(diagnostic.line) + ")" : std::string()) +
                ": " + escaped(diagnostic.message) + "</li>\n";
    html += std::string(luminaire.diagnostics.empty() ? "<li>none</li>\n" : "") + "</ul>\n";
    return html + polar_svg(luminaire.profile) + sphere_svg(luminaire.profile) + "</body></html>\n";
}

}  // namespace pbrbake::ies
