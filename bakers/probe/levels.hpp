#pragma once
// Filling the levels of a probe.

#include <functional>
#include <span>

#include "bakers/baker.hpp"
#include "bakers/probe/environment.hpp"
#include "bakers/probe/method.hpp"
#include "bakers/probe/params.hpp"

namespace pbrbake::probe {

/// A cube of `size`, each row by row(face, y, RGB of the row) on the workers.
Level filled_by_rows(Context& context, int size,
                     const std::function<void(int face, int y, std::span<float> rgb)>& row);

/// Levels from 1 on into image.levels, whose level 0 is there. Returns what there is to say of each: its
/// samples, or the band limit and what it leaves out.
Json filter_levels(const ProbeParams& params, const Method& method, const Environment& environment,
                   Context& context, Image& image);

}  // namespace pbrbake::probe
