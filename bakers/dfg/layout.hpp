#pragma once
// Where a table's texels lie.

#include "bakers/baker.hpp"
#include "bakers/dfg/params.hpp"

namespace pbrbake::dfg {

/// The parameters with nothing left automatic: a target's values where the job states none, else the defaults
/// (128 x 128, ggx, sqrt_nov, ends, scale_bias). flip_rows turns a target's own rows over.
DfgParams settled(DfgParams params);

/// What column x and row y stand for: NoV and perceptual roughness, or NoL and curvature of a subsurface
/// table. This and what follows take settled parameters.
double value_of_column(const DfgParams& params, int x);
double value_of_row(const DfgParams& params, int y);

/// The stretch that slice z of a volume stands for: width across the view over that along it, from 10 to
/// 1/10; 1 of any other table.
double value_of_slice(const DfgParams& params, int z);
double slice_of_value(const DfgParams& params, double stretch);
/// The highest perceptual roughness along a view in a volume: width sqrt(10), which Burley's convention
/// reaches.
inline constexpr double kRoughestAlong = 1.7782794100389228;

/// Continuous texel coordinates (0 at the middle of the first texel) at which a shader finds such values.
double column_of_value(const DfgParams& params, double across);
double row_of_value(const DfgParams& params, double down);

/// The values that a shader may ask for: NoV or NoL, and perceptual roughness from min_perceptual_roughness,
/// or curvature.
struct Range {
    double lowest, highest;
};
Range across(const DfgParams& params);
Range down(const DfgParams& params);
Range deep(const DfgParams& params);

/// How a shader finds its texel, for the record: what a target or an accuracy chose is said as well.
Json layout_json(const DfgParams& params);

/// The settled parameters of a product, whose size and axes an accuracy as sampled may have chosen.
DfgParams as_baked(const DfgParams& asked, const Product& product);

/// The largest quadrature error that an accuracy allows: draft 1e-3, production 1e-6, reference 1e-8; a
/// hundredth of one that is stated as sampled, 1e-6 at most.
double quadrature_error(const Accuracy& accuracy);

}  // namespace pbrbake::dfg
