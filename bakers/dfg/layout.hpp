#pragma once
// Where a table's texels lie, and what its columns hold.

#include "bakers/dfg/params.hpp"
#include "pbr/ibl/dfg.hpp"

namespace pbrbake::dfg {

/// NoV of column x, and perceptual roughness of row y.
double nov_of_column(const DfgParams& params, int x);
double perceptual_roughness_of_row(const DfgParams& params, int y);

/// Continuous texel coordinates (0 at the middle of the first texel) at which a shader finds a view and
/// roughness.
double column_of_nov(const DfgParams& params, double NoV);
double row_of_perceptual_roughness(const DfgParams& params, double perceptual_roughness);

/// Channels a texel has: two for ggx, one for disney_diffuse.
int column_count(const DfgParams& params);

/// Writes a texel's channels from its albedos, in the order of `terms`.
void write_texel(const DfgParams& params, const pbr::DirectionalAlbedo& ggx, double disney, float* out);

/// Albedo of the diffuse term that `params.disney` names.
double disney_albedo(const DfgParams& params, double NoV, double perceptual_roughness);

bool has_term(const DfgParams& params, Term term);

/// The largest quadrature error that an accuracy allows: draft 1e-3, production 1e-6, reference 1e-8.
double quadrature_error(const Accuracy& accuracy);

}  // namespace pbrbake::dfg
