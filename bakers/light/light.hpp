#pragma once
// The light baker: lights of older formats to photometric ones. README.md has the maths and the formats.

#include "bakers/light/params.hpp"

namespace pbrbake::light {

inline constexpr int kAlgorithmVersion = 1;

std::vector<Mistake> check(const LightParams& params, const std::string& format);
std::vector<Read> reads(const LightParams& params);
/// Suffixes of the documents that are written, the product itself among them.
std::vector<std::string> documents(const LightParams& params);
Product bake(const LightParams& params, const Inputs& inputs, Context& context);
Certificate certify(const LightParams& params, const Inputs& inputs, const Product& product,
                    Context& context);

}  // namespace pbrbake::light
