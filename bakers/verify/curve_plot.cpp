#include "bakers/verify/curve_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>

#include "bakers/verify/page.hpp"

namespace pbrbake::verify {
namespace {

constexpr double kWidth = 260, kHigh = 110, kLow = 40, kGap = 14, kLeft = 4;
constexpr double kMiddle = kHigh + kGap + kLow / 2;  ///< where the difference is 0
constexpr double kMostStops = 16;                    ///< below the brightest there is no light to speak of
constexpr std::array kColours{"var(--c8)", "var(--c0)", "var(--c1)"};

std::string text(const char* format, double value) {
    std::array<char, 64> buffer{};
    std::snprintf(buffer.data(), buffer.size(), format, value);
    return buffer.data();
}

std::string label(double x, double y, const char* anchor, const std::string& words) {
    return "<text font-size=10 fill=\"var(--soft)\" text-anchor=" + std::string(anchor) +
           " x=" + text("%.0f", x) + " y=" + text("%.0f", y) + ">" + words + "</text>";
}

/// A curve's rows in the picture.
class Chart {
  public:
    explicit Chart(const Json& rows)
        : rows_(rows), near_(rows.front()[0].get<double>()), far_(rows.back()[0].get<double>()) {
        for (const Json& row : rows) {
            if (row[3].is_null()) continue;
            for (const int column : {1, 2}) {
                most_ = std::max(most_, stops(row[column]));
                least_ = std::min(least_, stops(row[column]));
            }
            worst_ = std::max(worst_, std::abs(row[3].get<double>()));
        }
        least_ = std::max(least_, most_ - kMostStops);
    }

    std::string svg() const {
        const auto high = [this](int column) {
            return [this, column](const Json& row) {
                const double share = (stops(row[column]) - least_) / std::max(most_ - least_, 1e-9);
                return kHigh * (1 - std::clamp(share, 0., 1.));
            };
        };
        std::string svg = "<svg viewBox=\"0 -4 " + text("%.0f", kWidth + 4) + " " +
                          text("%.0f", kHigh + kGap + kLow + 22) +
                          "\" width=260 height=182 role=img aria-label=\"stops over distance\">";
        svg += "<line x1=4 x2=260 y1=" + text("%.1f", kMiddle) + " y2=" + text("%.1f", kMiddle) +
               " stroke=\"var(--line)\"/>";
        svg += lines(kColours[0], 5, .35, high(1)) + lines(kColours[1], 1.6, 1, high(2)) +
               lines(kColours[2], 1.6, 1,
                     [this](const Json& row) { return kMiddle - kLow / 2 * row[3].get<double>() / worst_; });
        svg += label(kWidth, 8, "end", text("%.1f stops", most_ > least_ ? most_ - least_ : 0)) +
               label(kWidth, kMiddle - kLow / 2 + 4, "end", text("± %.2f stops", worst_)) +
               label(kLeft, kHigh + kGap + kLow + 14, "start", text("%.3g m", near_)) +
               label(kWidth, kHigh + kGap + kLow + 14, "end", text("%.3g m", far_));
        return svg + "</svg>";
    }

  private:
    static double stops(const Json& value) { return std::log2(std::max(value.get<double>(), 1e-9)); }

    /// A line for each run of rows without a gap.
    std::string lines(const char* colour, double width, double opacity,
                      const std::function<double(const Json& row)>& y_of) const {
        std::string svg, points;
        const auto end_line = [&] {
            if (!points.empty())
                svg += "<polyline fill=none stroke=\"" + std::string(colour) +
                       "\" stroke-width=" + text("%g", width) + " stroke-opacity=" + text("%g", opacity) +
                       " points=\"" + points + "\"/>";
            points.clear();
        };
        for (const Json& row : rows_) {
            if (row[3].is_null())
                end_line();
            else
                points += text("%.1f,", kLeft + (kWidth - kLeft) * std::log(row[0].get<double>() / near_) /
                                                    std::log(far_ / near_)) +
                          text("%.1f ", y_of(row));
        }
        end_line();
        return svg;
    }

    const Json& rows_;
    double near_, far_;
    double most_ = -std::numeric_limits<double>::infinity(), least_ = std::numeric_limits<double>::infinity();
    double worst_ = 0.1;  ///< differences below fill less than the height
};

}  // namespace

std::string curve_html(const Json& curve) {
    if (!curve.is_object() || curve["columns"].size() != 4 || curve["columns"][3] != "stops" ||
        curve["rows"].size() < 2)
        return "";
    std::string names;
    for (std::size_t i = 0; i < kColours.size(); ++i)
        names += std::string(i > 0 ? " " : "") + "<span style=\"color:" + kColours[i] + "\">&#9632;</span> " +
                 escaped(curve["columns"][i + 1].get<std::string>());
    return "<div class=curve>" + Chart(curve["rows"]).svg() + "<br><small>" + names + "</small></div>";
}

}  // namespace pbrbake::verify
