#pragma once
// What a run baked, as a page.

#include <string>

#include "bakers/run/run.hpp"

namespace pbrbake::verify {

/// An HTML page: each bake's warnings, files, the figures of its certificate with their curves, and times.
std::string run_page(const run::RunReport& report);

}  // namespace pbrbake::verify
