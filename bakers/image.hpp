#pragma once
// Images in memory: what io decodes, bakers make, and io encodes.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pbrbake {

/// How a channel is stored in a file. rgbe: three 8-bit mantissas that
/// share an exponent (Ward 1991, "Real pixels").
enum class PixelType { half, float32, unorm16, unorm8, rgbe };

/// What the codes of unorm8 stand for. Floats in memory are linear; other pixel types store them so.
enum class Transfer {
    linear,
    srgb  ///< IEC 61966-2-1 in the first three channels; a fourth stays linear
};

/// One mip level: `faces` pictures of height x width texels, channels interleaved, row 0 at the top.
/// numbers() == faces * height * width * channels; the face index runs slowest.
struct Level {
    int width = 0;
    int height = 0;
    std::vector<float> texels;
    std::vector<std::uint8_t> codes = {};  ///< in place of texels, of an image that is for unorm8 alone

    std::size_t numbers() const { return codes.empty() ? texels.size() : codes.size(); }
};

/// A 2D picture (faces == 1), a cube map (faces == 6) or a volume, with one or more mip levels, level 0 the
/// largest. A volume's slices are its faces, and it has one level.
///
/// Cube maps use the project's own orientation: right-handed, y up, faces in the order +X -X +Y -Y +Z -Z,
/// each as OpenGL samples it (texel (0,0) is at s = t = 0; see libpbr's ibl/cubemap.hpp). Other orientations
/// exist only inside a codec.
struct Image {
    std::string name;                   ///< "" for a product's only image
    std::vector<std::string> channels;  ///< EXR channel names, in memory order: {"R","G","B"}
    int faces = 1;                      ///< of a volume: its slices
    std::vector<Level> levels;
    Transfer transfer = Transfer::linear;
    bool is_volume = false;  ///< faces are slices of a 3D texture

    bool is_cube() const { return faces == 6 && !is_volume; }
    int channel_count() const { return static_cast<int>(channels.size()); }
    const float* texel(int level, int face, int y, int x) const {
        const Level& l = levels[static_cast<std::size_t>(level)];
        return l.texels.data() +
               ((static_cast<std::size_t>(face) * l.height + y) * l.width + x) * channels.size();
    }
    float* texel(int level, int face, int y, int x) {
        return const_cast<float*>(static_cast<const Image*>(this)->texel(level, face, y, x));
    }
};

/// What becomes of +Inf: of light, the largest finite value of its channel in the image; of numbers that mean
/// it, as a mirror's exponent does, the largest float.
enum class Infinity { peak, largest_float };

/// Texels changed while reading, because light is neither negative nor infinite.
/// The rule: NaN, -Inf and negative channels become 0; +Inf becomes what Infinity says.
struct Repairs {
    std::uint64_t non_finite = 0;  ///< texels with a NaN or Inf in any channel
    std::uint64_t negative = 0;    ///< texels with a negative channel
    double lowest = 0;             ///< the lowest finite value found, 0 if none was negative
};

/// A decoded source: linear light, in the working space that was asked for, repaired.
struct SourceImage {
    Image image;  ///< channels R G B, and A where it was asked for; faces 6 for a cube map, 1 for an equirect
                  ///< or a texture
    std::string colour_space;  ///< of the file: stated by the job, else told by the file, else assumed
    bool colour_space_assumed = false;
    std::string units = "relative";  ///< "cd/m^2" only where the source says so
    int bits = 0;                    ///< of an integer channel in the file; 0: float
    bool is_half = false;            ///< of floats, whether the file's have 16 bits
    /// A picture of 8-bit codes as the file has them, a quarter of its floats, where a reader asked for them:
    /// laid out as the texels of image's one level, which then is empty but for its size.
    std::vector<std::uint8_t> codes;
    std::array<float, 256> linear{};  ///< what codes of R G B stand for; one of A is code / 255
    std::string colour_doubt;  ///< what the file says of its colours that wasn't followed, for a warning
    Repairs repairs;
    std::vector<std::byte> bytes;  ///< the whole file, where it was read as a text; then there is no image
    std::string name;              ///< of such a file, for messages
    std::string hash;              ///< XXH3-128 of the file's bytes, 32 hex digits
};

}  // namespace pbrbake
