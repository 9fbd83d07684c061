#pragma once
// What the run-time loaded modules offer: OpenImageIO's and OpenColorIO's share of io, behind a face that
// names neither. Nothing throws across it; a failure is `false` (or null) and a message.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bakers/io/encoding.hpp"

namespace pbrbake::io {

/// Raised when anything in this header changes; a module of another number is refused.
inline constexpr int kModuleAbi = 5;

/// What a file says of its picture before a pixel is decoded.
struct PictureSpec {
    int width = 0;
    int height = 0;
    int channels = 0;
    int bytes_per_channel = 0;
    bool is_float = false;
    int orientation = 1;  ///< as Exif counts: 1 upright, 2 mirrored, 3 turned by 180°, …
    double gamma = 0;     ///< of a power curve the file states, 0 when none
    bool exif_srgb = false;
    std::string icc_profile;           ///< what an embedded one calls itself, "unnamed"; "": there is none
    std::vector<std::byte> icc_bytes;  ///< the profile
    std::string compression;
};

/// One open picture. Rows are read in order, top of the file first.
class PictureReader {
  public:
    virtual ~PictureReader() = default;
    virtual const PictureSpec& spec() const noexcept = 0;
    /// Rows that a call to read_rows had best be a multiple of (a tile's height, else 1).
    virtual int row_quantum() const noexcept = 0;
    /// Channels that read_rows returns: 3 of a colour picture, 1 of a grey one, and one more where alpha was
    /// asked for and is there; colour is never multiplied by it.
    virtual int decoded_channels() const noexcept = 0;
    /// Decodes rows [begin, end), integers as [0, 1], into (end - begin) * width * decoded_channels() floats.
    virtual bool read_rows(int begin, int end, float* texels, std::string& error) noexcept = 0;
};

struct OiioModule {
    int abi;
    /// `format` is OpenImageIO's name ("hdr", "png", "tiff", "targa", "jpeg"); `file` must outlive the
    /// reader.
    std::unique_ptr<PictureReader> (*open)(const char* format, std::span<const std::byte> file,
                                           bool with_alpha, std::string& error);
    /// Linear texels of 16 bits, 1, 3 or 4 channels, in native byte order.
    bool (*write_png16)(int width, int height, int channels, const std::uint16_t* texels,
                        std::vector<std::byte>& file, std::string& error);
    /// Texels of 8 bits, 1, 3 or 4 channels, linear or sRGB.
    bool (*write_png8)(int width, int height, int channels, bool is_srgb, const std::uint8_t* texels,
                       std::vector<std::byte>& file, std::string& error);
};

struct OcioModule {
    int abi;
    /// From `from` to linear light in `working`, in place, over `texels` RGB triples.
    bool (*convert)(const Encoding& from, Gamut working, float* rgb, std::size_t texels, std::string& error);
    /// From linear light in `working`, 1 what saturates the sensor, to sRGB's codes over 255, in place: ACES
    /// 1's output transform for SDR video.
    bool (*display)(Gamut working, float* rgb, std::size_t texels, std::string& error);
};

/// Loads a module at its first use. Throws Error(unreadable_input) that names the files it looked for.
const OiioModule& oiio_module();
const OcioModule& ocio_module();

}  // namespace pbrbake::io

extern "C" {
using PbrbakeOiioEntry = const pbrbake::io::OiioModule*();
using PbrbakeOcioEntry = const pbrbake::io::OcioModule*();
}
