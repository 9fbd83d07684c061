#pragma once
// The smallest table that is near enough everywhere a shader reads it.

#include "bakers/baker.hpp"
#include "bakers/dfg/params.hpp"

namespace pbrbake::dfg {

struct Choice {
    DfgParams params;  ///< settled, with a size and axes
    PixelType pixel;
};

/// The smallest size (square, 1,024 at most; just the one that the job states) and a pixel type with which the
/// sampled error is at most context.accuracy().max_error. Axes that the job leaves open, to no target either,
/// are the defaults, or where that makes the table smaller cbrt_nov and sqrt_perceptual. Where nothing reaches
/// it: throws Error(accuracy_missed), as a rule from a few points of the largest.
Choice choose(const DfgParams& asked, Context& context);

}  // namespace pbrbake::dfg
