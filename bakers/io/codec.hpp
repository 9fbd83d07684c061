#pragma once
// The containers that products are written to and read from, one codec a format.

#include <string>
#include <vector>

#include "bakers/io/file_bytes.hpp"
#include "bakers/io/io.hpp"

namespace pbrbake::io {

/// See encode(). The image's shape has been checked.
std::vector<std::byte> encode_exr(const Image& image, const FileInfo& info);
std::vector<std::byte> encode_ktx2(const Image& image, const FileInfo& info);
std::vector<std::byte> encode_dds(const Image& image, const FileInfo& info);
std::vector<std::byte> encode_c_header(const Image& image, const FileInfo& info);
std::vector<std::byte> encode_png16(const Image& image);
std::vector<std::byte> encode_png8(const Image& image);
std::vector<std::byte> encode_hdr(const Image& image, const FileInfo& info);

/// See read_product().
ReadBack read_exr_product(Bytes file, const std::string& where);
ReadBack read_ktx2_product(Bytes file, const std::string& where);
ReadBack read_dds_product(Bytes file, const std::string& where);
/// A PNG or HDR, linear as its product was, through the OpenImageIO module: one channel or three, and a PNG's
/// alpha.
ReadBack read_flat_product(const char* format, PixelType pixel, Bytes file, const std::string& where);

inline Error unwritable(std::string message) {
    return Error(ExitCode::unwritable_output, "", std::move(message));
}

}  // namespace pbrbake::io
