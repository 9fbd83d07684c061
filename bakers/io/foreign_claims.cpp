#include "bakers/io/foreign_claims.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "bakers/io/colour.hpp"

namespace pbrbake::io {
namespace {

using namespace std::string_view_literals;

/// A deflate stream's 258-byte match takes at least 2 bits (RFC 1951, 3.2.5 and 3.2.7): 1032 bytes a byte.
constexpr double kDeflateRatio = 1032;
/// An LZW code of 12 bits stands for a string of at most 4096 - 258 bytes (TIFF 6.0, section 13).
constexpr double kLzwRatio = 3838 * 8 / 12.;
/// A PackBits run of 128 bytes takes 2 (TIFF 6.0, section 9).
constexpr double kPackBitsRatio = 64;

std::uint32_t big_endian(Bytes file, std::size_t offset, int bytes) {
    std::uint32_t value = 0;
    for (int i = 0; i < bytes; ++i) value = value << 8 | std::to_integer<std::uint32_t>(file[offset + i]);
    return value;
}

int byte_at(Bytes file, std::size_t offset) {
    return offset < file.size() ? std::to_integer<int>(file[offset]) : 0;
}

/// Flat RGBE is 4 bytes a texel. Run-length coding, of widths 8 to 32,767 only, takes 4 bytes a row and 2
/// bytes a run of up to 127 in each of four channels (Ward, "Real Pixels", Graphics Gems II, 1991; Radiance's
/// color.c).
double least_hdr_bytes(const PictureSpec& spec) {
    const double flat = 4. * spec.width;
    const double coded = 4 + 4 * 2 * std::ceil(spec.width / 127.);
    const bool may_be_coded = spec.width >= 8 && spec.width <= 32767;
    return spec.height * (may_be_coded ? std::min(flat, coded) : flat);
}

/// Image types 9-11 are run-length coded: a packet of up to 128 texels takes one byte and one texel (TGA 2.0,
/// p. 24).
double least_targa_bytes(Bytes file, double texels) {
    const double texel_bytes = std::max(1., std::ceil(byte_at(file, 16) / 8.));
    const bool coded = byte_at(file, 2) >= 9;
    return coded ? std::ceil(texels / 128) * (1 + texel_bytes) : texels * texel_bytes;
}

double least_tiff_bytes(const PictureSpec& spec, double raw_bytes) {
    if (spec.compression == "none")
        return raw_bytes / 16;  // samples of 1, 2 or 4 bits are reported as bytes or words
    if (spec.compression == "zip") return raw_bytes / 16 / kDeflateRatio;
    if (spec.compression == "lzw") return raw_bytes / 16 / kLzwRatio;
    if (spec.compression == "packbits") return raw_bytes / 16 / kPackBitsRatio;
    return 0;
}

/// Every 8x8 block of the full-resolution component takes at least one bit when Huffman-coded (ITU-T T.81,
/// F.1.2 and G.1.2); arithmetic coding (SOF9 and up) has no such bound.
double least_jpeg_bytes(Bytes file, double texels) {
    for (std::size_t at = 2; at + 4 <= file.size();) {
        const int marker = byte_at(file, at + 1);
        if (byte_at(file, at) != 0xFF || marker == 0xDA) break;
        if (marker >= 0xC9 && marker <= 0xCF && marker != 0xCC) return 0;
        at += 2 + big_endian(file, at + 2, 2);
    }
    return texels / 64 / 8;
}

}  // namespace

std::optional<ForeignFormat> foreign_format(Bytes file, const std::string& extension) {
    if (begins_with(file, "#?RADIANCE"sv) || begins_with(file, "#?RGBE"sv)) return ForeignFormat::hdr;
    if (begins_with(file, "\x89PNG\r\n\x1A\n"sv)) return ForeignFormat::png;
    if (begins_with(file, "II*\0"sv) || begins_with(file, "MM\0*"sv) || begins_with(file, "II+\0"sv) ||
        begins_with(file, "MM\0+"sv))
        return ForeignFormat::tiff;
    if (begins_with(file, "\xFF\xD8\xFF"sv)) return ForeignFormat::jpeg;
    if (extension == ".tga") return ForeignFormat::targa;
    return {};
}

double least_bytes(ForeignFormat format, Bytes file, const PictureSpec& spec) {
    const double texels = static_cast<double>(spec.width) * spec.height;
    const double raw_bytes = texels * spec.channels * spec.bytes_per_channel;
    switch (format) {
        case ForeignFormat::hdr:
            return least_hdr_bytes(spec);
        // A PNG's samples are of at least 1 bit where OpenImageIO reports a byte.
        case ForeignFormat::png:
            return texels / 8 / kDeflateRatio;
        case ForeignFormat::tiff:
            return least_tiff_bytes(spec, raw_bytes);
        case ForeignFormat::targa:
            return least_targa_bytes(file, texels);
        case ForeignFormat::jpeg:
            return least_jpeg_bytes(file, texels);
    }
    return 0;
}

std::optional<Encoding> png_encoding(Bytes file, const std::string& where) {
    constexpr double kUnit = 100000;  // of gAMA and cHRM
    bool srgb = false;
    double gamma = 0;
    std::optional<Chromaticities> primaries;
    for (std::size_t at = 8; at + 12 <= file.size();) {
        const std::size_t size = big_endian(file, at, 4);
        const std::string type = text_at(file, at + 4, 4);
        if (type == "IDAT" || size > file.size() - at - 12) break;
        const auto field = [&](std::size_t i) { return big_endian(file, at + 8 + 4 * i, 4) / kUnit; };
        if (type == "sRGB") srgb = true;
        if (type == "gAMA" && size == 4 && field(0) > 0) gamma = 1 / field(0);
        if (type == "cHRM" && size == 32)
            primaries = {
                {field(2), field(3)}, {field(4), field(5)}, {field(6), field(7)}, {field(0), field(1)}};
        at += 12 + size;
    }
    if (srgb) return Encoding{Curve::srgb, Gamut::rec709, 1, {}};
    if (gamma < 1e-3 || gamma > 10) return {};  // none, or beyond what a power curve is made for
    Encoding encoding = primaries ? linear_with(*primaries, where) : Encoding{};
    if (std::abs(gamma - 1) > .01) {
        encoding.curve = Curve::power;
        encoding.gamma = gamma;
    }
    return encoding;
}

bool png_is_complete(Bytes file) {
    for (std::size_t at = 8; at + 12 <= file.size();) {
        const std::size_t size = big_endian(file, at, 4);
        if (size > file.size() - at - 12) return false;
        if (text_at(file, at + 4, 4) == "IEND") return true;
        at += 12 + size;
    }
    return false;
}

bool jpeg_is_complete(Bytes file) {
    std::size_t at = 2;
    while (at + 2 <= file.size()) {
        if (byte_at(file, at) != 0xFF) {  // entropy-coded data runs to the next marker
            ++at;
            continue;
        }
        const int marker = byte_at(file, at + 1);
        if (marker == 0xD9) return true;
        const bool stuffed_or_restart = marker == 0 || marker == 1 || (marker >= 0xD0 && marker <= 0xD7);
        if (marker == 0xFF)
            at += 1;
        else if (stuffed_or_restart)
            at += 2;
        else if (at + 4 <= file.size())
            at += 2 + big_endian(file, at + 2, 2);
        else
            return false;
    }
    return false;
}

}  // namespace pbrbake::io
