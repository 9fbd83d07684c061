#pragma once
// A product read back with what is recorded of it.

#include <filesystem>
#include <string>

#include "bakers/baker.hpp"
#include "bakers/io/io.hpp"

namespace pbrbake::verify {

struct ProductFile {
    std::string format;
    io::FileInfo info;
    Image image;
    double scale = 1;                ///< stored value = scale x value
    std::string units = "relative";  ///< "" where the container holds no metadata and no record tells
    std::string kind;                ///< "dfg"; "" where nothing tells
    Json record;  ///< its entry in X.ext.json or manifest.json beside it; null if neither lists it
};

/// Reads a product and its record, or takes the record that the caller has. Throws Error(unreadable_input).
ProductFile read_product_file(const std::filesystem::path& file);
ProductFile read_product_file(const std::filesystem::path& file, Json record);

/// The entry of X.ext.json or manifest.json beside a file that lists it; null if neither does.
Json record_of(const std::filesystem::path& file);

}  // namespace pbrbake::verify
