#pragma once
// The DFG baker: directional albedo tables for the split sum and the Disney diffuse term. README.md has the
// maths.

#include "bakers/dfg/params.hpp"

namespace pbrbake::dfg {

inline constexpr int kAlgorithmVersion = 1;

std::vector<Mistake> check(const DfgParams& params, const std::string& format);
std::vector<Read> reads(const DfgParams& params);
Product bake(const DfgParams& params, const Inputs& inputs, Context& context);
Certificate certify(const DfgParams& params, const Inputs& inputs, const Product& product, Context& context);

}  // namespace pbrbake::dfg
