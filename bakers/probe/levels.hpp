#pragma once
// Filling the levels of a probe.

#include <functional>
#include <span>

#include "bakers/baker.hpp"
#include "bakers/probe/environment.hpp"
#include "bakers/probe/method.hpp"
#include "bakers/probe/params.hpp"

namespace pbrbake::probe {

/// A black cube of `size`.
Level empty_level(int size);

/// The context's workers as libpbr takes them; each body is `work` for the progress bar.
pbr::ForEach each_on(Context& context, double work);

/// Fills image.levels. Returns what there is to say of each from 1 on: its samples, or the band limit and
/// what it leaves out.
Json fill_levels(const ProbeParams& params, const Method& method, const Environment& environment,
                 Context& context, Image& image);

}  // namespace pbrbake::probe
