// Products that are one 2D picture without metadata: PNG of 16 and 8 bits, and Radiance HDR. Both are read
// back through OpenImageIO, which also writes the PNG.

#include <algorithm>
#include <array>

#include "bakers/io/codec.hpp"
#include "bakers/io/component.hpp"
#include "bakers/io/decoded.hpp"
#include "bakers/io/foreign_claims.hpp"
#include "bakers/io/keys.hpp"
#include "bakers/io/module_api.hpp"
#include "bakers/io/rgbe.hpp"

namespace pbrbake::io {
namespace {

using Row = std::vector<std::uint8_t>;

/// Bytes in runs: a count above 128 and one byte stand for count - 128 of it, another count for as many
/// literal bytes (Radiance, "File formats", and its color.c).
void append_run_length(std::string& file, const Row& row) {
    const auto put = [&](std::size_t value) { file += static_cast<char>(value); };
    constexpr std::size_t kShortest = 4, kLongestRun = 127, kLongestLiteral = 128;
    const auto run_at = [&](std::size_t i) {
        std::size_t end = i + 1;
        while (end < row.size() && end - i < kLongestRun && row[end] == row[i]) ++end;
        return end - i;
    };
    for (std::size_t i = 0; i < row.size();) {
        if (const std::size_t run = run_at(i); run >= kShortest) {
            put(128 + run);
            put(row[i]);
            i += run;
            continue;
        }
        std::size_t end = i;
        while (end < row.size() && end - i < kLongestLiteral && run_at(end) < kShortest) ++end;
        put(end - i);
        for (; i < end; ++i) put(row[i]);
    }
}

void append_scanline(std::string& file, const std::vector<std::array<std::uint8_t, 4>>& pixels) {
    const std::size_t width = pixels.size();
    if (width < 8 || width > 0x7FFF) {  // the coded form has a 15-bit length
        for (const auto& pixel : pixels)
            for (const std::uint8_t byte : pixel) file += static_cast<char>(byte);
        return;
    }
    for (const std::size_t byte : {std::size_t{2}, std::size_t{2}, width >> 8, width & 0xFF})
        file += static_cast<char>(byte);
    for (std::size_t c = 0; c < 4; ++c) {
        Row row(width);
        for (std::size_t x = 0; x < width; ++x) row[x] = pixels[x][c];
        append_run_length(file, row);
    }
}

}  // namespace

std::vector<std::byte> encode_hdr(const Image& image, const FileInfo& info) {
    const Level& level = image.levels.front();
    const std::size_t channels = image.channels.size();
    std::string file = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n";
    // EXPOSURE is what the values were multiplied by.
    if (const auto scale = info.metadata.find(kScaleKey);
        scale != info.metadata.end() && scale->second != "1" && scale->second != "1.0")
        file.append("EXPOSURE=").append(scale->second).append("\n");
    file.append("\n-Y ")
        .append(std::to_string(level.height))
        .append(" +X ")
        .append(std::to_string(level.width))
        .append("\n");
    std::vector<std::array<std::uint8_t, 4>> pixels(static_cast<std::size_t>(level.width));
    const float* texel = level.texels.data();
    for (int y = 0; y < level.height; ++y) {
        for (auto& pixel : pixels) {
            pixel = rgbe_of(texel, channels);
            texel += channels;
        }
        append_scanline(file, pixels);
    }
    const auto* bytes = reinterpret_cast<const std::byte*>(file.data());
    return {bytes, bytes + file.size()};
}

std::vector<std::byte> encode_png16(const Image& image) {
    const Level& level = image.levels.front();
    const std::size_t channels = image.channels.size(), stored = channels == 2 ? 3 : channels;
    std::vector<std::uint16_t> texels;
    texels.reserve(level.texels.size() / channels * stored);
    for (std::size_t i = 0; i < level.texels.size(); i += channels)
        for (std::size_t c = 0; c < stored; ++c)
            texels.push_back(c < channels ? unorm16_of(level.texels[i + c]) : std::uint16_t{0});
    std::vector<std::byte> file;
    std::string error;
    if (!oiio_module().write_png16(level.width, level.height, static_cast<int>(stored), texels.data(), file,
                                   error))
        throw unwritable("PNG: " + error);
    return file;
}

std::vector<std::byte> encode_png8(const Image& image) {
    const Level& level = image.levels.front();
    const std::size_t channels = image.channels.size(), stored = channels == 2 ? 3 : channels;
    std::vector<std::uint8_t> made;
    const bool is_ready = !level.codes.empty() && stored == channels;
    if (!is_ready) made.reserve(level.numbers() / channels * stored);
    for (std::size_t i = 0; !is_ready && i < level.numbers(); i += channels)
        for (std::size_t c = 0; c < stored; ++c)
            made.push_back(c >= channels ? std::uint8_t{0}
                           : !level.codes.empty()
                               ? level.codes[i + c]
                               : unorm8_of(level.texels[i + c], channel_transfer(image, c)));
    const std::uint8_t* codes = is_ready ? level.codes.data() : made.data();
    std::vector<std::byte> file;
    std::string error;
    if (!oiio_module().write_png8(level.width, level.height, static_cast<int>(stored),
                                  image.transfer == Transfer::srgb, codes, file, error))
        throw unwritable("PNG: " + error);
    return file;
}

ReadBack read_flat_product(const char* format, PixelType pixel, Bytes file, const std::string& where) {
    std::string error;
    const auto reader = oiio_module().open(format, file, pixel == PixelType::unorm16, error);
    if (!reader) throw unreadable(where, error);
    const PictureSpec& spec = reader->spec();
    const int channels = reader->decoded_channels();
    check_limits(spec.width, spec.height, 4. * channels, where, {});
    ReadBack back;
    back.format = format;
    back.info.pixel = pixel == PixelType::unorm16 && spec.bytes_per_channel == 1 ? PixelType::unorm8 : pixel;
    static const std::array<std::vector<std::string>, 4> kNames{
        {{"R"}, {"R", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}}};
    back.image.channels = kNames[static_cast<std::size_t>(channels - 1)];
    Level level{spec.width, spec.height, {}};
    level.texels.resize(static_cast<std::size_t>(spec.width) * spec.height * channels);
    if (!reader->read_rows(0, spec.height, level.texels.data(), error)) throw unreadable(where, error);
    if (back.info.pixel == PixelType::unorm8) {
        const auto encoding = png_encoding(file, where);
        back.image.transfer = encoding && encoding->curve == Curve::srgb ? Transfer::srgb : Transfer::linear;
        for (std::size_t i = 0; i < level.texels.size(); ++i) {
            const auto code = static_cast<std::uint8_t>(std::lround(level.texels[i] * 255));
            level.texels[i] = from_unorm8(code, channel_transfer(back.image, i % back.image.channels.size()));
        }
    }
    back.image.levels.push_back(std::move(level));
    return back;
}

}  // namespace pbrbake::io
