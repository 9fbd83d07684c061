#pragma once
// The smallest table that is near enough everywhere a shader reads it.

#include "bakers/baker.hpp"
#include "bakers/dfg/params.hpp"

namespace pbrbake::dfg {

struct Choice {
    DfgParams params;  ///< settled, with a size
    PixelType pixel;
};

/// A size (square; width and height of 1,024 at most) and pixel type with which the sampled error is at most
/// context.accuracy().max_error. `params` are settled but for their size. Where none reaches it: the largest.
Choice choose(DfgParams params, Context& context);

}  // namespace pbrbake::dfg
