#pragma once
// The probe baker: prefiltered cube map mip chains (the LD term of the split sum). README.md has the maths.

#include "bakers/probe/params.hpp"

namespace pbrbake::probe {

inline constexpr int kAlgorithmVersion = 3;

std::vector<Mistake> check(const ProbeParams& params, const std::string& format);
std::vector<Read> reads(const ProbeParams& params);
Product bake(const ProbeParams& params, const Inputs& inputs, Context& context);
Certificate certify(const ProbeParams& params, const Inputs& inputs, const Product& product,
                    Context& context);

/// A procedural environment by its name in "builtin:NAME"; throws unreadable_input naming those there are.
SourceImage builtin_environment(const std::string& name);

}  // namespace pbrbake::probe
