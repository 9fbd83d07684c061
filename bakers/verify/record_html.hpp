#pragma once
// What a run tells of its bakes, as parts of pages.

#include <string>
#include <vector>

#include "bakers/run/run.hpp"

namespace pbrbake::verify {

/// A JSON string as it may stand in an element.
std::string escaped_text(const Json& value);

/// What was tolerated or is doubtful, as a list; "" for nothing.
std::string warnings_html(const run::BakeReport& report);

/// Of a stage that a bake came to, else 0.
run::Seconds seconds_of(const run::BakeReport& report, run::Stage stage);

/// "0.0123 <small>estimate, 95 % in 0.01 to 0.02</small>"; `gap` stands before the small print.
std::string certified(const Json& figure, const char* gap = " ");

/// The figures of a record's certificate as a table, and the curves of those that have one, for a page that
/// holds plot_style().
std::string figures_html(const Json& certificate);

/// Wall and CPU seconds of each stage, a pair of columns a bake.
std::string stage_table(const std::vector<const run::BakeReport*>& bakes,
                        const std::vector<std::string>& titles);

}  // namespace pbrbake::verify
