#pragma once
// Files for tests, made from numbers that a test can state.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/image.hpp"
#include "bakers/io/io.hpp"

namespace pbrbake::io::test {

/// A directory of its own, removed with all it holds.
class TempDir {
  public:
    TempDir();
    ~TempDir();
    TempDir(const TempDir&) = delete;
    TempDir& operator=(const TempDir&) = delete;
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  private:
    std::filesystem::path path_;
};

using Buffer = std::vector<std::byte>;

void write_file(const std::filesystem::path& path, const Buffer& bytes);

/// Appends little- or big-endian numbers and text.
Buffer& put_text(Buffer& out, std::string_view text);
Buffer& put_le(Buffer& out, std::uint64_t value, int bytes);
Buffer& put_be(Buffer& out, std::uint64_t value, int bytes);
Buffer& put_bytes(Buffer& out, std::initializer_list<int> values);

/// RGBE, flat (width < 8): every texel the same four bytes.
Buffer flat_hdr(int width, int height, std::initializer_list<int> rgbe);
/// A header alone.
Buffer hdr_header(long width, long height);
/// RGBE, run-length coded (width 8 to 127): every texel the same four bytes.
Buffer coded_hdr(int width, int height, const std::vector<int>& rgbe);

/// 24-bit TGA, top row first; `rgb` cycles. Coded: run packets of one row each (width <= 128).
Buffer targa(int width, int height, std::initializer_list<int> rgb, bool coded);

/// Little-endian TIFF, directory before pixels, one strip, uncompressed. `sample_bytes` 1, 2 (integers) or 4
/// (float).
Buffer tiff(int width, int height, int sample_bytes, const Buffer& samples, int orientation = 1);
Buffer float_samples(const std::vector<float>& values);

/// 8 x 8 grey baseline JPEG, every texel 192: one block with a DC of 8 at a quantiser of 64.
Buffer grey_jpeg();

/// A PNG of 8-bit samples: colour type 0 grey, 2 RGB, 3 indices into `palette` (R G B each), 4 grey and
/// alpha, 6 RGBA; 16 bits where samples are twice as many, big-endian.
Buffer png(int width, int height, int colour_type, const Buffer& samples, const Buffer& palette = {});

/// An ICC profile that holds a description and nothing else.
Buffer icc_profile(std::string_view description);
/// A JPEG with a profile in an APP2 segment.
Buffer jpeg_with_icc(const Buffer& jpeg, const Buffer& profile);

/// A PNG with a chunk put before its pixels; `alone`: its other colour chunks are taken out.
Buffer png_with(const Buffer& png, std::string_view type, const Buffer& data, bool alone = true);

/// What an EXR fixture holds. Channels are filled by value(channel name, x, y).
struct ExrFixture {
    int width = 8, height = 4;
    std::vector<std::string> channels{"R", "G", "B"};
    std::string type = "half";  ///< half | float | uint
    bool tiled = false;
    int overscan = 0;  ///< texels of data around the display window; negative: cropped
    std::string compression = "zip";
    std::vector<double> chromaticities = {};  ///< rx ry gx gy bx by wx wy
    double white_luminance = 0;
    bool cube = false;
    std::function<float(const std::string& channel, int x, int y)> value = {};
};
void write_exr(const std::filesystem::path& path, const ExrFixture& fixture);
/// Two scanline parts; channels, size and type are the first's for both.
void write_two_part_exr(const std::filesystem::path& path, const ExrFixture& first, float second_value);

/// Runs read_source and returns the exit code of what it throws, 0 when it reads.
int code_of_reading(const ReadRequest& request, std::string* message = nullptr);

/// An image of distinct, half-representable values: level, face, row, column and channel can be told from
/// each.
Image marked_image(int size, int levels, int faces, const std::vector<std::string>& channels);

/// The folder of real assets, empty where it is absent.
std::filesystem::path shared_data();

/// Runs a program, arguments quoted by the caller; returns its output, and its status in `status`.
std::string run_program(const std::string& command, int& status);
/// Whether the shell finds a program.
bool have_program(const std::string& name);

}  // namespace pbrbake::io::test
