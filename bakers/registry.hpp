#pragma once
// The bakers there are.

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/baker.hpp"

namespace pbrbake {

/// One baker behind a face that knows no Params type. `bake` (the first argument of each) is a validated JSON
/// bake with its defaults filled in.
struct Baker {
    std::string_view kind;
    int algorithm_version;  ///< raised when the same job would give other bytes; part of the manifest
    std::vector<std::string> fields;  ///< schema properties its Params reads, besides the common ones
    std::function<std::vector<Mistake>(const Json& bake)> check;
    std::function<std::vector<Read>(const Json& bake)> reads;
    std::function<Product(const Json& bake, const Inputs&, Context&)> run;
    std::function<Certificate(const Json& bake, const Inputs&, const Product&, Context&)> certify;
    std::function<SourceImage(const std::string& name)> builtin =
        {};  ///< a source of the baker's own, "builtin:NAME"
    /// Files that a source names, relative to its folder: read if they are there. A file leads only into its
    /// own folder's tree.
    std::function<std::vector<Read>(const Inputs&)> follow = {};
    /// The bakes that one stands for which names a source of several, each with its own name and what the
    /// source says filled in; asked of bakes as the user wrote them, once the schema found them sound. Throws
    /// Error for a source that can't be read.
    std::function<std::vector<Expansion>(const Json& bake, const FileQueries&)> expand = {};
    /// Names of the images that a bake will write besides its first.
    std::function<std::vector<std::string>(const Json& bake)> images = {};
    /// Suffixes of the documents that a bake will write, as far as they are known of it and of those of its
    /// sources that are given.
    std::function<std::vector<std::string>(const Json& bake, const Inputs&)> documents = {};
    /// What makes one product of a source as a whole, once its expansions are baked. Its inputs are "source"
    /// and, of the i-th expansion, the document "part.i".
    const Baker* joiner = nullptr;
    std::function<bool(const Json& bake)> is_joined = {};  ///< whether a bake's expansions are
    std::string_view part_document = {};                   ///< suffix of the document "part.i"
};

/// All bakers, in the order of their help texts.
std::span<const Baker> bakers();

/// The baker of a kind, or null.
const Baker* find_baker(std::string_view kind);

}  // namespace pbrbake
