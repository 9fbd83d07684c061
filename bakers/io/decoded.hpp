#pragma once
// What the decoders hand to read_source: file numbers as floats, and what the file says of them.

#include <cstdint>
#include <string>
#include <vector>

#include "bakers/io/encoding.hpp"
#include "bakers/io/file_bytes.hpp"
#include "bakers/io/io.hpp"

namespace pbrbake::io {

struct Decoded {
    int width = 0;  ///< of a face
    int height = 0;
    int faces = 1;
    std::vector<float> rgb;    ///< faces, rows, texels, R G B
    std::vector<float> alpha;  ///< of each texel, or empty
    /// In place of both, where codes were asked for and the file has 8 bits: R G B, or R G B A.
    std::vector<std::uint8_t> codes;
    int code_channels = 3;
    int bits = 0;          ///< of an integer channel, 0 of a float
    bool is_half = false;  ///< of floats, whether they are 16-bit
    Encoding encoding;
    bool encoding_assumed = true;
    double to_units = 1;  ///< multiplies linear values
    std::string units = "relative";
    std::string icc_profile;  ///< what an embedded one calls itself that isn't followed; "": there is none
};

/// An OpenEXR file, read as it is decoded; alpha of a flat picture alone.
Decoded decode_exr(const File& file, const ReadLimits& limits, bool with_alpha = false);

/// A file in a format that OpenImageIO reads for us.
enum class ForeignFormat { hdr, png, tiff, targa, jpeg };
Decoded decode_foreign(ForeignFormat format, Bytes file, const std::string& where, const ReadLimits& limits,
                       bool with_alpha = false, bool as_codes = false);

/// Throws Error(unreadable_input) unless width x height texels of `bytes_per_texel` in memory are within the
/// limits.
void check_limits(std::int64_t width, std::int64_t height, double bytes_per_texel, const std::string& where,
                  const ReadLimits& limits);

/// Bytes of one RGB texel in memory.
inline constexpr double kRgbBytes = 3 * sizeof(float);

}  // namespace pbrbake::io
