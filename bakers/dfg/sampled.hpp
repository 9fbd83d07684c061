#pragma once
// What a shader's bilinear lookup is off by, between texels too.

#include <cstdint>

#include "bakers/baker.hpp"
#include "bakers/dfg/params.hpp"
#include "pbr/ibl/dfg.hpp"

namespace pbrbake::dfg {

struct SampledErrors {
    double interpolation = 0;  ///< of a table of exact texels
    double sampled = 0;        ///< of the table given; 0 without one
    int points = 0;
};

enum class Probing {
    some,      ///< rows chosen by hash, the smoothest first
    middles,   ///< the middles of all cells that a shader may read, their edges, and the ends of the range
    thorough,  ///< quarters along a row as well
};

/// The largest errors found over the range of the (settled) parameters, against `truth`. `table` may be null;
/// `rows` is how many rows of points are looked at, and `seed` which, where some are.
SampledErrors sampled_errors(const DfgParams& params, const Product* table, const pbr::DfgMethod& truth,
                             Probing probing, int rows, std::uint64_t seed, Context& context);

}  // namespace pbrbake::dfg
