#pragma once
// The DFG baker: tables of directional albedo. README.md has the maths.

#include "bakers/dfg/params.hpp"
#include "pbr/ibl/dfg.hpp"

namespace pbrbake::dfg {

inline constexpr int kAlgorithmVersion = 3;

/// How E and Fc are had, of settled parameters.
pbr::DfgMethod method_of(const DfgParams& params, const Accuracy& accuracy);

std::vector<Mistake> check(const DfgParams& params, const std::string& format);
std::vector<Read> reads(const DfgParams& params);
Product bake(const DfgParams& params, const Inputs& inputs, Context& context);
Certificate certify(const DfgParams& params, const Inputs& inputs, const Product& product, Context& context);

}  // namespace pbrbake::dfg
