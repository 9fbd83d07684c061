#pragma once
// The texture baker: legacy texture sets to PBR ones, with proof of what was kept. README.md has the maths.

#include "bakers/texture/params.hpp"

namespace pbrbake::texture {

inline constexpr int kAlgorithmVersion = 1;

/// One bake a material of `source`, filled in from it; the bake itself without a source. Throws
/// Error(unreadable_input) for a source that can't be read, and holds errors of single materials.
std::vector<Expansion> expand(const Json& bake, const FileQueries& files);
std::vector<Mistake> check(const TextureParams& params, const std::string& format);
std::vector<Read> reads(const TextureParams& params);
/// Names of the images besides the first, in order; with format gltf of all.
std::vector<std::string> images(const TextureParams& params, const std::string& format);
/// Suffixes of the documents that are written.
std::vector<std::string> documents(const std::string& format);
Product bake(const TextureParams& params, const Inputs& inputs, Context& context);
Certificate certify(const TextureParams& params, const Inputs& inputs, const Product& product,
                    Context& context);

}  // namespace pbrbake::texture
