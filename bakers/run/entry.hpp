#pragma once
// What is recorded of a product: its manifest entry (a sidecar is just that) and the metadata in its
// container. No times, hosts, thread counts or absolute paths: the same job gives the same bytes.

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "bakers/job/job.hpp"

namespace pbrbake::run {

/// A file that a bake makes.
struct Output {
    std::filesystem::path file;  ///< in the output folder
    std::string hash;
    std::size_t bytes = 0;
};

/// schemas/sidecar.schema.json describes it. `sources` are the bake's own and
/// those that they name; `work` is what the bake counted.
Json entry(const job::Job& job, const job::Bake& bake, std::span<const job::Source> sources,
           const Inputs& inputs, const Product& product, const Certificate& certificate,
           const std::map<std::string, std::uint64_t>& work, const std::vector<Output>& outputs);

/// What goes into each container of a product.
std::map<std::string, std::string> metadata(const job::Job& job, const job::Bake& bake,
                                            const Product& product);

/// "out/X.ext.json"
std::filesystem::path sidecar_file(const job::Job& job, const job::Bake& bake);

/// A figure of a certificate.
Json figure_json(const Figure& figure);

}  // namespace pbrbake::run
