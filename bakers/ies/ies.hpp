#pragma once
// The ies baker: photometric files to textures whose flux and peak are certified. README.md has the maths.

#include "bakers/ies/params.hpp"

namespace pbrbake::ies {

inline constexpr int kAlgorithmVersion = 1;

std::vector<Mistake> check(const IesParams& params, const std::string& format);
std::vector<Read> reads(const IesParams& params);
/// The file of a TILT=FILE.
std::vector<Read> follow(const Inputs& inputs);
/// Suffixes of the documents that are written.
std::vector<std::string> documents(const IesParams& params);
Product bake(const IesParams& params, const Inputs& inputs, Context& context);
Certificate certify(const IesParams& params, const Inputs& inputs, const Product& product, Context& context);

}  // namespace pbrbake::ies
