// EXR products: 2D pictures, and cube maps as OpenEXR lays them out, through OpenEXR's own API.

#include <ImfChannelList.h>
#include <ImfEnvmapAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfTiledOutputFile.h>
#include <half.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <exception>

#include "bakers/io/codec.hpp"
#include "bakers/io/colour.hpp"
#include "bakers/io/exr_cube.hpp"
#include "bakers/io/exr_memory.hpp"
#include "bakers/io/keys.hpp"

namespace pbrbake::io {
namespace {

/// Measured on 256² cubes of a real HDRI in half: ZIP at 4 in tiles of 64 takes 27-33 ms and 7-11 % of the
/// raw bytes; tiles of 32 or PIZ are larger and slower, 6 saves another 3-7 % for half as much time again,
/// and no compression saves 20 ms for ten times the bytes.
constexpr int kTileSize = 64, kZipLevel = 4;

/// One level as the file has it: channels interleaved in the image's order.
struct Picture {
    int width = 0, height = 0;
    std::vector<float> texels;
};

Picture picture_of(const Image& image, std::size_t index) {
    const Level& level = image.levels[index];
    if (image.faces == 1) return {level.width, level.height, level.texels};
    const int size = level.width;
    const auto channels = static_cast<std::ptrdiff_t>(image.channels.size());
    Picture picture{size, 6 * size, std::vector<float>(level.texels.size())};
    auto texel = level.texels.begin();
    for (int face = 0; face < 6; ++face) {
        const ExrFace map = exr_face(face, size);
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x, texel += channels)
                std::copy_n(texel, channels,
                            picture.texels.begin() + static_cast<std::ptrdiff_t>(map.at(x, y)) * channels);
    }
    return picture;
}

/// The next level of OpenEXR's chain where the image has none: means over the texels that each new one
/// covers.
Picture filler_below(const Picture& above, std::size_t channels) {
    Picture below{std::max(1, above.width / 2), std::max(1, above.height / 2), {}};
    below.texels.resize(static_cast<std::size_t>(below.width) * below.height * channels);
    const auto first = [](int i, int full, int halved) {
        return static_cast<int>(std::int64_t{i} * full / halved);
    };
    float* out = below.texels.data();
    for (int y = 0; y < below.height; ++y)
        for (int x = 0; x < below.width; ++x, out += channels) {
            const int x0 = first(x, above.width, below.width), x1 = first(x + 1, above.width, below.width);
            const int y0 = first(y, above.height, below.height),
                      y1 = first(y + 1, above.height, below.height);
            for (std::size_t c = 0; c < channels; ++c) {
                double sum = 0;
                for (int yy = y0; yy < y1; ++yy)
                    for (int xx = x0; xx < x1; ++xx)
                        sum += static_cast<double>(
                            above.texels[(static_cast<std::size_t>(yy) * above.width + xx) * channels + c]);
                out[c] = static_cast<float>(sum / ((x1 - x0) * (y1 - y0)));
            }
        }
    return below;
}

/// Primaries for RGB pictures whose working space is known, and the cd/m² of (1, 1, 1) where units are
/// absolute.
void state_colour(const Image& image, const FileInfo& info, Imf::Header& header) {
    const auto find = [&](const char* key) {
        const auto entry = info.metadata.find(key);
        return entry == info.metadata.end() ? std::string() : entry->second;
    };
    const auto& names = image.channels;
    const auto has = [&](const char* name) { return std::ranges::find(names, name) != names.end(); };
    if (!has("R") || !has("G") || !has("B")) return;
    if (const auto gamut = working_gamut(find(kWorkingSpaceKey))) {
        const Chromaticities& c = chromaticities_of(*gamut);
        const auto xy = [](const std::array<double, 2>& v) {
            return Imath::V2f(static_cast<float>(v[0]), static_cast<float>(v[1]));
        };
        Imf::addChromaticities(header, {xy(c.red), xy(c.green), xy(c.blue), xy(c.white)});
    }
    if (find(kUnitsKey) == "cd/m^2") {
        const std::string text = find(kScaleKey);
        double scale = 1;
        std::from_chars(text.data(), text.data() + text.size(), scale);
        if (scale > 0) Imf::addWhiteLuminance(header, static_cast<float>(1 / scale));
    }
}

/// Everything but tiles. OpenEXR adds no date or host of its own.
Imf::Header header_of(const Image& image, const FileInfo& info) {
    const Level& base = image.levels.front();
    Imf::Header header(base.width, base.height * image.faces);
    header.compression() = Imf::ZIP_COMPRESSION;
    header.zipCompressionLevel() = kZipLevel;
    const Imf::PixelType type = info.pixel == PixelType::half ? Imf::HALF : Imf::FLOAT;
    for (const std::string& name : image.channels) header.channels().insert(name, Imf::Channel(type));
    if (image.faces == 6) Imf::addEnvmap(header, Imf::ENVMAP_CUBE);
    state_colour(image, info, header);
    const auto add = [&](const std::string& key, const std::string& value) {
        if (header.find(key) != header.end())
            throw unwritable("metadata '" + key + "' is an attribute of EXR's own");
        header.insert(key, Imf::StringAttribute(value));
    };
    for (const auto& [key, value] : info.metadata) add(key, value);
    add(kChannelsKey, join_channels(image.channels));
    return header;
}

/// A picture in the file's pixel type, and OpenEXR's view of it.
class Pixels {
  public:
    Pixels(const Picture& picture, const std::vector<std::string>& names, PixelType pixel) {
        const std::size_t channels = names.size();
        const bool is_half = pixel == PixelType::half;
        if (is_half) {
            halves_.reserve(picture.texels.size());
            for (const float value : picture.texels) halves_.push_back(half(value));
        }
        const std::size_t bytes = is_half ? sizeof(half) : sizeof(float);
        for (std::size_t c = 0; c < channels; ++c) {
            const void* first = is_half ? static_cast<const void*>(halves_.data() + c)
                                        : static_cast<const void*>(picture.texels.data() + c);
            frame_.insert(names[c],
                          Imf::Slice::Make(is_half ? Imf::HALF : Imf::FLOAT, first, Imath::V2i(0, 0),
                                           picture.width, picture.height, channels * bytes,
                                           channels * bytes * static_cast<std::size_t>(picture.width)));
        }
    }
    const Imf::FrameBuffer& frame() const { return frame_; }

  private:
    std::vector<half> halves_;
    Imf::FrameBuffer frame_;
};

void write_flat(const Image& image, const FileInfo& info, const Imf::Header& header, ExrOutput& stream) {
    const Picture picture = picture_of(image, 0);
    const Pixels pixels(picture, image.channels, info.pixel);
    Imf::OutputFile output(stream, header, 0);
    output.setFrameBuffer(pixels.frame());
    output.writePixels(picture.height);
}

/// Tiled, with the whole chain of levels that OpenEXR demands.
void write_mipmap(const Image& image, const FileInfo& info, Imf::Header& header, ExrOutput& stream) {
    header.setTileDescription(
        Imf::TileDescription(kTileSize, kTileSize, Imf::MIPMAP_LEVELS, Imf::ROUND_DOWN));
    header.insert(kLevelsKey, Imf::StringAttribute(std::to_string(image.levels.size())));
    Imf::TiledOutputFile output(stream, header, 0);
    Picture picture;
    for (int level = 0; level < output.numLevels(); ++level) {
        const auto index = static_cast<std::size_t>(level);
        picture = index < image.levels.size() ? picture_of(image, index)
                                              : filler_below(picture, image.channels.size());
        const Pixels pixels(picture, image.channels, info.pixel);
        output.setFrameBuffer(pixels.frame());
        output.writeTiles(0, output.numXTiles(level) - 1, 0, output.numYTiles(level) - 1, level);
    }
}

/// A level of the n x 6n picture is our level only while faces halve without remainder.
void check_cube_levels(const Image& image) {
    const std::size_t levels = image.levels.size();
    const int size = image.levels.front().width;
    if (image.faces == 6 && size % (1 << (levels - 1)) != 0)
        throw unwritable("an EXR cube map with " + std::to_string(levels) +
                         " levels needs a size divisible by " + std::to_string(1 << (levels - 1)) +
                         "; it is " + std::to_string(size) + ": use ktx2, or fewer levels");
}

}  // namespace

std::vector<std::byte> encode_exr(const Image& image, const FileInfo& info) {
    check_cube_levels(image);
    try {
        Imf::Header header = header_of(image, info);
        ExrOutput stream;
        if (image.faces == 1 && image.levels.size() == 1)
            write_flat(image, info, header, stream);
        else
            write_mipmap(image, info, header, stream);
        return stream.take();
    } catch (const Error&) {
        throw;
    } catch (const std::exception& failure) {
        throw unwritable(std::string("EXR: ") + failure.what());
    }
}

}  // namespace pbrbake::io
