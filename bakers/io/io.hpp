#pragma once
// Files to images and back: the only door to OpenImageIO, OpenEXR, OpenColorIO and the container formats.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/error.hpp"
#include "bakers/image.hpp"

namespace pbrbake::io {

/// What a file may claim before memory is taken for it.
struct ReadLimits {
    int max_side = 65536;
    std::uint64_t max_decoded_bytes = std::uint64_t{4} << 30;
};

struct ReadRequest {
    std::filesystem::path path = {};
    std::string colour_space = "auto";         ///< of the file; "auto": what the file tells, else by its type
    std::string working_space = "lin_rec709";  ///< of the result: lin_rec709 | acescg
    bool with_alpha = false;                   ///< keeps alpha, where a flat picture has it
    ReadLimits limits = {};
    bool as_codes = false;  ///< keeps the codes of 8-bit files whose gamut is the working space's
    Infinity infinity = Infinity::peak;
    /// The picture, where it is inside another file; `path` then is its name in messages. Not an EXR.
    std::optional<std::vector<std::byte>> bytes = {};
};

/// Reads an equirect (HDR, EXR, PNG, TIFF, TGA, JPEG) or a cube map (EXR with an envmap attribute), linear,
/// in the working space, repaired (see Repairs). Grey is spread to RGB, alpha is dropped, Exif orientation is
/// applied. An EXR's whiteLuminance makes the values cd/m^2; a scaled product of ours is unscaled.
/// Throws Error(unreadable_input) naming the file for: absent, unknown, truncated, lying or oversized files,
/// and Error(invalid_job) for colour spaces that don't exist.
SourceImage read_source(const ReadRequest& request);

/// Reads a file as its bytes: `bytes`, `name` and `hash` of what is returned. Throws Error(unreadable_input)
/// for what is absent, no regular file, or above kMaxTextBytes.
SourceImage read_text_source(const std::filesystem::path& path);
inline constexpr std::uint64_t kMaxTextBytes = std::uint64_t{512} << 20;  ///< glTF embeds pictures

/// Bytes of a file from `offset` on; of size 0 to its end. Throws Error(unreadable_input) for what is absent,
/// no regular file, or too short.
std::vector<std::byte> read_part(const std::filesystem::path& path, std::uint64_t offset, std::uint64_t size);

/// Colour spaces that `colour_space` may name, "auto" first.
const std::vector<std::string>& colour_spaces();

/// What goes into a container besides the texels.
struct FileInfo {
    PixelType pixel = PixelType::half;
    std::map<std::string, std::string> metadata;  ///< "pbrbake:scale" -> "0.5"; strings, sorted
    std::string name = {};                        ///< what a C header calls its array
};

/// A whole file in memory. `format` is one of formats() (bakers/formats.hpp), which says what each holds.
/// ktx2 and dds store 3 channels as 4, the last one 1; png and hdr store 2 as 3, the last one 0, and hdr 1 as
/// 3 that are equal. dds, png and hdr hold no metadata; h has it as comments. Levels halve, rounding down; an
/// EXR cube map's without remainder. "pbrbake:working_space" (lin_rec709 | acescg), "pbrbake:units" and
/// "pbrbake:scale" of the metadata also set what the containers have for primaries and luminance;
/// "pbrbake:levels" and "pbrbake:channels" are io's own. Throws Error(unwritable_output) for what a format
/// can't hold. Bytes depend on nothing but the arguments. Texels must already be representable in
/// `info.pixel` (see quantise).
std::vector<std::byte> encode(std::string_view format, const Image& image, const FileInfo& info);

/// Formats encode() writes.
const std::vector<std::string>& output_formats();

/// Rounds every texel to what `pixel` can store (half: to nearest even), after multiplying by one power of
/// two, the largest 2^-k, k >= 0, with which the peak of all images fits; returns it. Half and float keep
/// signs; the unorm types end at 1 and clip negatives to 0, as rgbe does, which
/// carries what rounding takes to the next texel, so that means are kept (a texel is off by less than .8 %).
/// NaN and Inf stay in half and float; the caller has a bug then. Codes stay as they are.
double quantise(std::vector<Image>& images, PixelType pixel);

/// A product read back: our own EXR, KTX2 and DDS files (all faces and levels), PNG, HDR, and plain 2D EXR.
struct ReadBack {
    Image image;
    FileInfo info;
    std::string format;
};
ReadBack read_product(const std::filesystem::path& path);

/// An 8-bit sRGB PNG in memory, for report pages. `rgb` holds width * height * 3 display-encoded bytes.
std::vector<std::byte> encode_png8(int width, int height, const std::vector<std::uint8_t>& rgb);

/// XXH3-128 of a file's bytes as 32 hex digits, and of a buffer. Throws unreadable_input.
std::string hash_file(const std::filesystem::path& path);
std::string hash_bytes(const std::byte* data, std::size_t size);

}  // namespace pbrbake::io
