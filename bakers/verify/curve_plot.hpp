#pragma once
// What a figure of a certificate sums up, as a chart.

#include <string>

#include "bakers/baker.hpp"

namespace pbrbake::verify {

/// A curve of four columns (Figure::curve), the last of which is "stops": over the first, a length on a
/// logarithmic scale, the next two in stops, and their difference below; with a line that names them. Rows
/// whose last value is null leave a gap. For a page that holds plot_style(); "" for other curves, and for
/// fewer than two rows.
std::string curve_html(const Json& curve);

}  // namespace pbrbake::verify
