#pragma once
// Error against time, both logarithmic, as SVG.

#include <string>

#include "bakers/verify/study.hpp"

namespace pbrbake::verify {

/// Series have this many colours and marks; the next one starts again.
inline constexpr int kPlotColours = 9;

/// The colours as CSS custom properties --c0 … of light and of dark pages, and the classes of a plot's parts.
std::string plot_style();

/// The plot of a case, for a page that holds plot_style(). Every point has a data-tip for a script to show,
/// and a title for a page without one.
std::string plot_svg(const StudiedCase& studied);

/// The same as a file of its own, with its legend and style.
std::string plot_file(const StudiedCase& studied);

/// The mark of a series, for legends: an SVG of 14 x 14.
std::string plot_mark(std::size_t series);

}  // namespace pbrbake::verify
