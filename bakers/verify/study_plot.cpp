#include "bakers/verify/study_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "bakers/verify/page.hpp"

namespace pbrbake::verify {
namespace {

constexpr double kWidth = 760, kHeight = 430, kLeft = 66, kRight = 18, kTop = 14, kBottom = 48;
constexpr double kLegendRow = 20;

constexpr std::string_view kStyle = R"css(
:root,svg{--c0:#0b62a8;--c1:#c2410c;--c2:#15803d;--c3:#7e22ce;--c4:#b45309;--c5:#0e7490;--c6:#be185d;--c7:#4d7c0f;--c8:#475569}
@media(prefers-color-scheme:dark){:root,svg{--c0:#7cbcf4;--c1:#fb923c;--c2:#4ade80;--c3:#c084fc;--c4:#facc15;--c5:#22d3ee;--c6:#f472b6;--c7:#a3e635;--c8:#cbd5e1}}
.plot{width:100%;min-width:560px;height:auto;font:12px system-ui,-apple-system,"Segoe UI",Roboto,"Liberation Sans",sans-serif}
.plot text{fill:var(--soft)}
.plot .grid{stroke:var(--line);stroke-width:1}
.plot .one{stroke:var(--soft);stroke-width:1;stroke-dasharray:2 3}
.plot .floor{fill:var(--soft);opacity:.12}
.plot .front{fill:none;stroke:var(--soft);stroke-width:9;stroke-linejoin:round;stroke-linecap:round;opacity:.22}
.plot .law{fill:none;stroke-width:1;stroke-dasharray:5 4;opacity:.75}
.plot .line{fill:none;stroke-width:1.6}
.plot .free{stroke:var(--soft);stroke-width:1.2;stroke-dasharray:8 4}
.plot .knee{fill:none;stroke:var(--text);stroke-width:1.4}
.plot .point{cursor:default}
.plot .hit{fill:transparent;stroke:none}
)css";

std::string coordinate(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.1f", value);
    return text.data();
}

/// A logarithmic axis between two powers, or parts, of ten.
struct LogAxis {
    double low, high;    ///< values at its ends
    double start, span;  ///< pixels; span is negative for an axis that rises

    double at(double value) const {
        const double share = std::log(std::max(value, low) / low) / std::log(high / low);
        return start + span * std::min(share, 1.0);
    }
};

/// 1, 2 and 5 times powers of ten within the axis; powers alone where those are many.
std::vector<double> ticks(const LogAxis& axis) {
    const double decades = std::log10(axis.high / axis.low);
    std::vector<double> list;
    for (int power = static_cast<int>(std::floor(std::log10(axis.low))); power <= 12; ++power)
        for (const double digit : {1., 2., 5.}) {
            const double value = digit * std::pow(10.0, power);
            const bool inside = value >= axis.low * .999 && value <= axis.high * 1.001;
            const int every = static_cast<int>(std::ceil(decades / 9));
            if (inside && (digit == 1 ? power % every == 0 : decades < 2.5)) list.push_back(value);
        }
    return list;
}

/// "0.01", "1e-5"
std::string tick_text(double value) {
    std::array<char, 32> text{};
    const bool plain = value >= .999e-3 && value < 1e5;
    std::snprintf(text.data(), text.size(), plain ? "%.3g" : "%.0e", value);
    std::string label = text.data();
    if (const auto zero = label.find("e-0"); zero != std::string::npos) label.erase(zero + 2, 1);
    return label;
}

class Plot {
  public:
    explicit Plot(const StudiedCase& studied) : studied_(studied) {
        double least_time = std::numeric_limits<double>::infinity(), most_time = 0;
        double least = least_time, most = 0;
        const auto take = [&](double error) {
            if (!(error > 0)) return;
            least = std::min(least, error);
            most = std::max(most, error);
        };
        for (const StudyPoint& point : studied.points) {
            if (!point.failure.empty()) continue;
            take(point.error);
            least_time = std::min(least_time, point.timing.ratio.value);
            most_time = std::max(most_time, point.timing.ratio.value);
        }
        if (studied.free_error) take(*studied.free_error);
        if (most == 0) least = most = 1;
        x_ = {least_time / 1.25, most_time * 1.25, kLeft, kWidth - kLeft - kRight};
        y_ = {std::pow(10, std::floor(std::log10(least) - .05)),
              std::pow(10, std::ceil(std::log10(most) + .02)), kHeight - kBottom,
              -(kHeight - kTop - kBottom)};
    }

    std::string parts() const {
        std::string svg = grid() + floor() + front();
        if (studied_.free_error) svg += free_line();
        for (std::size_t s = 0; s < studied_.asked.series.size(); ++s) svg += law(s);
        for (std::size_t s = 0; s < studied_.asked.series.size(); ++s) svg += line(s);
        return svg + knee();
    }

  private:
    double right() const { return kWidth - kRight; }
    double bottom() const { return kHeight - kBottom; }

    static std::string text(double x, double y, const char* anchor, const std::string& words) {
        return "<text x=\"" + coordinate(x) + "\" y=\"" + coordinate(y) + "\" text-anchor=\"" + anchor +
               "\">" + words + "</text>";
    }

    static std::string segment(const char* kind, double x1, double y1, double x2, double y2) {
        return "<line class=\"" + std::string(kind) + "\" x1=\"" + coordinate(x1) + "\" y1=\"" +
               coordinate(y1) + "\" x2=\"" + coordinate(x2) + "\" y2=\"" + coordinate(y2) + "\"/>";
    }

    std::string grid() const {
        std::string svg;
        for (const double value : ticks(x_)) {
            svg += segment("grid", x_.at(value), kTop, x_.at(value), bottom());
            svg += text(x_.at(value), bottom() + 17, "middle", tick_text(value));
        }
        for (const double value : ticks(y_)) {
            svg += segment("grid", kLeft, y_.at(value), right(), y_.at(value));
            svg += text(kLeft - 8, y_.at(value) + 4, "end", tick_text(value));
        }
        const StudyPoint& base = studied_.points[studied_.base];
        svg += segment("one", x_.at(1), kTop, x_.at(1), bottom());
        svg += text((kLeft + right()) / 2, kHeight - 8, "middle",
                    "CPU time of the bake; 1 is " +
                        escaped(studied_.asked.series[base.series].name + " " + base.step.label) + ", " +
                        number(base.timing.seconds.value * 1000) + " ms here");
        return svg + "<text transform=\"translate(14," + coordinate((kTop + bottom()) / 2) +
               ") rotate(-90)\" text-anchor=\"middle\">" + escaped(studied_.metric) + "</text>\n";
    }

    /// Where errors say more of the reference than of the method.
    std::string floor() const {
        const double top = y_.at(3 * studied_.floor);
        if (!(3 * studied_.floor > y_.low)) return "";
        return "<rect class=\"floor\" x=\"" + coordinate(kLeft) + "\" y=\"" + coordinate(top) +
               "\" width=\"" + coordinate(right() - kLeft) + "\" height=\"" + coordinate(bottom() - top) +
               "\"/>\n";
    }

    std::string polyline(const char* kind, const std::vector<std::array<double, 2>>& points,
                         const std::string& more) const {
        std::string svg = "<polyline class=\"" + std::string(kind) + "\"" + more + " points=\"";
        for (const auto& [time, error] : points)
            svg += coordinate(x_.at(time)) + "," + coordinate(y_.at(error)) + " ";
        return svg + "\"/>\n";
    }

    std::string front() const {
        std::vector<std::array<double, 2>> points;
        for (const std::size_t i : studied_.front)
            points.push_back({studied_.points[i].timing.ratio.value, studied_.points[i].error});
        return points.size() > 1 ? polyline("front", points, "") : "";
    }

    std::string free_line() const {
        const double y = y_.at(*studied_.free_error);
        return segment("free", kLeft, y, right(), y) +
               text(right() - 6, y - 6, "end",
                    escaped(studied_.asked.free_title) + ": " + number(*studied_.free_error));
    }

    static std::string stroke(std::size_t series) {
        return " style=\"stroke:var(--c" + std::to_string(series % kPlotColours) + ")\"";
    }

    std::string law(std::size_t series) const {
        const auto& law = studied_.laws[series];
        if (!law) return "";
        double least = std::numeric_limits<double>::infinity(), most = 0;
        for (const StudyPoint& point : studied_.points)
            if (point.series == series && point.failure.empty()) {
                least = std::min(least, point.timing.ratio.value);
                most = std::max(most, point.timing.ratio.value);
            }
        std::vector<std::array<double, 2>> points;
        constexpr int kSteps = 48;
        for (int i = 0; i <= kSteps; ++i) {
            const double time = least * std::pow(most / least, static_cast<double>(i) / kSteps);
            const double error = time > law->fixed ? law->error_at(time) : 0;
            if (error >= y_.low && error <= y_.high) points.push_back({time, error});
        }
        return polyline("law", points, stroke(series));
    }

    std::string line(std::size_t series) const {
        std::vector<std::array<double, 2>> points;
        std::string marks;
        for (const StudyPoint& point : studied_.points) {
            if (point.series != series || !point.failure.empty()) continue;
            points.push_back({point.timing.ratio.value, point.error});
            marks += mark(point);
        }
        return "<g class=\"series\" data-series=\"" + std::to_string(series) + "\">" +
               (points.size() > 1 ? polyline("line", points, stroke(series)) : "") + marks + "</g>\n";
    }

    std::string mark(const StudyPoint& point) const {
        const Series& series = studied_.asked.series[point.series];
        std::string tip = series.name + (series.dial.empty() ? "" : ", " + series.dial + " ") +
                          point.step.label + (point.step.note.empty() ? "" : " (" + point.step.note + ")");
        tip += "\nerror " + number(point.error) +
               (point.level >= 0 ? ", worst at level " + std::to_string(point.level) : "");
        tip += "\ntime " + number(point.timing.ratio.value) + " ± " + known_percent(point.timing.ratio) +
               " %, " + number(point.timing.seconds.value * 1000) + " ms CPU";
        tip += "\n" + count(point.evaluations) + " evaluations, " + count(point.bytes) + " bytes";
        const double x = x_.at(point.timing.ratio.value), y = y_.at(point.error);
        return "<g class=\"point\" data-tip=\"" + escaped(tip) + "\" transform=\"translate(" + coordinate(x) +
               "," + coordinate(y) + ")\">" + shape(point.series) + "<circle class=\"hit\" r=\"11\"/></g>";
    }

    std::string knee() const {
        if (!studied_.knee) return "";
        const StudyPoint& point = studied_.points[*studied_.knee];
        const double x = x_.at(point.timing.ratio.value), y = y_.at(point.error);
        return "<circle class=\"knee\" cx=\"" + coordinate(x) + "\" cy=\"" + coordinate(y) + "\" r=\"9\"/>" +
               text(x + 12, y + 16, "start", "knee");
    }

  public:
    /// A mark of about 8 pixels around the origin.
    static std::string shape(std::size_t series) {
        static constexpr std::array<std::string_view, 4> kShapes{
            R"(<circle r="4")", R"(<rect x="-3.6" y="-3.6" width="7.2" height="7.2")",
            R"(<path d="M0-5L5 0L0 5L-5 0Z")", R"(<path d="M0-5L4.6 3.6L-4.6 3.6Z")"};
        return std::string(kShapes[series % kShapes.size()]) + " style=\"fill:var(--c" +
               std::to_string(series % kPlotColours) + ")\"/>";
    }

  private:
    const StudiedCase& studied_;
    LogAxis x_{}, y_{};
};

std::string opening(double height, const std::string& more) {
    return "<svg class=\"plot\" viewBox=\"0 0 " + coordinate(kWidth) + " " + coordinate(height) + "\"" +
           more + ">\n";
}

}  // namespace

std::string plot_style() { return std::string(kStyle); }

std::string plot_svg(const StudiedCase& studied) {
    return opening(kHeight,
                   " role=\"img\" aria-label=\"" + escaped(studied.asked.title) + ": error against time\"") +
           Plot(studied).parts() + "</svg>\n";
}

std::string plot_mark(std::size_t series) {
    return "<svg class=\"mark\" width=\"14\" height=\"14\" viewBox=\"-7 -7 14 14\">" + Plot::shape(series) +
           "</svg>";
}

std::string plot_file(const StudiedCase& studied) {
    const double height =
        kHeight + kLegendRow * (1 + static_cast<double>((studied.asked.series.size() + 3) / 4));
    std::string svg = opening(height, " xmlns=\"http://www.w3.org/2000/svg\" width=\"" + coordinate(kWidth) +
                                          "\" height=\"" + coordinate(height) + "\"");
    svg +=
        "<style>svg{--ground:#fff;--text:#1c1d1f;--soft:#5d6167;--line:#e3e3df;background:var(--ground)}"
        "@media(prefers-color-scheme:dark){svg{--ground:#131416;--text:#e9e9e6;--soft:#9ba0a8;--line:#303338}"
        "}" +
        plot_style() + "</style>\n" + Plot(studied).parts();
    for (std::size_t s = 0; s < studied.asked.series.size(); ++s) {
        const double x = kLeft + 8 + static_cast<double>(s % 4) * 168;
        const double y = kHeight + kLegendRow * (.6 + static_cast<double>(s / 4));
        svg += "<g transform=\"translate(" + coordinate(x) + "," + coordinate(y) + ")\">" + Plot::shape(s) +
               "<text x=\"12\" y=\"4\">" +
               escaped(studied.asked.series[s].name +
                       (studied.asked.series[s].dial.empty() ? "" : ", by " + studied.asked.series[s].dial)) +
               "</text></g>\n";
    }
    return svg + "</svg>\n";
}

}  // namespace pbrbake::verify
