#pragma once
// pbrbake study --shading: what approximations of shading lose.

#include "cli/options.hpp"

namespace pbrbake::cli {

/// Bakes what spheres and a plane need, shades them both ways, and writes the page.
ExitCode study_shading(const Given& given);

}  // namespace pbrbake::cli
