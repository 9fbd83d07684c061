#pragma once
// What a run baked, as a page.

#include <string>

#include "bakers/run/run.hpp"

namespace pbrbake::verify {

/// An HTML page: each bake's warnings, what a texture bake kept of its set, the figures of its certificate
/// with their curves, files and times. Reads texture sets and what they became again.
std::string run_page(const run::RunReport& report);

}  // namespace pbrbake::verify
