// HDR, PNG, TIFF, TGA and JPEG through the OpenImageIO module.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "bakers/io/colour.hpp"
#include "bakers/io/decoded.hpp"
#include "bakers/io/foreign_claims.hpp"
#include "bakers/io/icc.hpp"
#include "bakers/io/module_api.hpp"

namespace pbrbake::io {
namespace {

const char* oiio_name(ForeignFormat format) {
    switch (format) {
        case ForeignFormat::hdr:
            return "hdr";
        case ForeignFormat::png:
            return "png";
        case ForeignFormat::tiff:
            return "tiff";
        case ForeignFormat::targa:
            return "targa";
        case ForeignFormat::jpeg:
            return "jpeg";
    }
    return "";
}

/// What the file says of its encoding: an ICC profile of sRGB, which others yield to (PNG 3rd ed., 4.3); a
/// PNG's chunks, Exif's ColorSpace, a TGA's gamma.
std::optional<Encoding> stated_encoding(ForeignFormat format, Bytes file, const std::string& where,
                                        const PictureSpec& spec) {
    if (is_srgb_profile(spec.icc_bytes, spec.icc_profile)) return Encoding{Curve::srgb, Gamut::rec709, 1, {}};
    if (format == ForeignFormat::png) return png_encoding(file, where);
    if (spec.exif_srgb) return Encoding{Curve::srgb, Gamut::rec709, 1, {}};
    if (format == ForeignFormat::targa && std::abs(spec.gamma - 1) < .01) return Encoding{};
    if (format == ForeignFormat::targa && spec.gamma >= 1 && spec.gamma <= 10)
        return Encoding{Curve::power, Gamut::rec709, spec.gamma, {}};
    return {};
}

/// Float pixels are taken for linear Rec. 709, integers for sRGB, unless the file has its say.
void find_encoding(ForeignFormat format, Bytes file, const std::string& where, const PictureSpec& spec,
                   Decoded& decoded) {
    decoded.encoding.curve = spec.is_float ? Curve::linear : Curve::srgb;
    if (spec.is_float) return;
    if (const auto stated = stated_encoding(format, file, where, spec)) {
        decoded.encoding = *stated;
        decoded.encoding_assumed = false;
    }
}

void check_claims(ForeignFormat format, Bytes file, const std::string& where, const PictureSpec& spec,
                  const ReadLimits& limits) {
    check_limits(spec.width, spec.height, kRgbBytes, where, limits);
    if (spec.channels < 1 || spec.bytes_per_channel < 1) throw unreadable(where, "has no channels");
    const double least = least_bytes(format, file, spec);
    if (least > static_cast<double>(file.size()))
        throw unreadable(where, "claims " + std::to_string(spec.width) + " x " + std::to_string(spec.height) +
                                    " texels, which its format can't hold in the file's " +
                                    std::to_string(file.size()) + " bytes: it is truncated or malformed");
}

/// Appends one decoded strip: grey is spread to RGB, alpha goes apart.
void append_codes(const std::vector<float>& strip, std::size_t count, int channels, Decoded& decoded) {
    const auto step = static_cast<std::size_t>(channels);
    const auto code = [](float value) { return static_cast<std::uint8_t>(value * 255 + .5f); };
    for (std::size_t i = 0; i < count; i += step) {
        for (std::size_t c = 0; c < 3; ++c) decoded.codes.push_back(code(strip[i + (step >= 3 ? c : 0)]));
        if (decoded.code_channels == 4) decoded.codes.push_back(code(strip[i + step - 1]));
    }
}

void append_strip(const std::vector<float>& strip, std::size_t count, int channels, Decoded& decoded) {
    std::vector<float>& rgb = decoded.rgb;
    if (channels == 3) {
        rgb.insert(rgb.end(), strip.begin(), strip.begin() + static_cast<std::ptrdiff_t>(count));
        return;
    }
    const auto step = static_cast<std::size_t>(channels);
    for (std::size_t i = 0; i < count; i += step) {
        if (channels == 4)
            rgb.insert(rgb.end(), &strip[i], &strip[i] + 3);
        else
            rgb.insert(rgb.end(), 3, strip[i]);
        if (channels == 2 || channels == 4) decoded.alpha.push_back(strip[i + step - 1]);
    }
}

/// Row by row, so that memory is taken only as far as the file's bytes last.
void read_texels(PictureReader& reader, const std::string& where, bool as_codes, Decoded& decoded) {
    const PictureSpec& spec = reader.spec();
    const int channels = reader.decoded_channels();
    const std::size_t texels = static_cast<std::size_t>(spec.width) * spec.height;
    decoded.code_channels = channels % 2 == 0 ? 4 : 3;
    constexpr int kRows = 64;
    const int step = (kRows + reader.row_quantum() - 1) / reader.row_quantum() * reader.row_quantum();
    const std::size_t row = static_cast<std::size_t>(spec.width) * channels;
    std::vector<float> strip(row * static_cast<std::size_t>(std::min(step, spec.height)));
    if (as_codes)
        decoded.codes.reserve(texels * static_cast<std::size_t>(decoded.code_channels));
    else
        decoded.rgb.reserve(texels * 3);
    for (int begin = 0; begin < spec.height; begin += step) {
        const int end = std::min(begin + step, spec.height);
        std::string error;
        if (!reader.read_rows(begin, end, strip.data(), error))
            throw unreadable(where, "is truncated or malformed: " + error);
        const std::size_t count = row * static_cast<std::size_t>(end - begin);
        as_codes ? append_codes(strip, count, channels, decoded)
                 : append_strip(strip, count, channels, decoded);
    }
}

/// Texels of `channels` numbers in the order of an upright picture, for an Exif orientation of 2 to 8.
template <class T>
std::vector<T> upright(int orientation, int w, int h, std::size_t channels, const std::vector<T>& stored) {
    const bool transposed = orientation >= 5;
    const bool flip_x = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
    const bool flip_y = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
    std::vector<T> result(stored.size());
    if (stored.empty()) return result;
    const int out_w = transposed ? h : w, out_h = transposed ? w : h;
    for (int y = 0; y < out_h; ++y)
        for (int x = 0; x < out_w; ++x) {
            // Stored coordinates before the flips: Exif 2.32, 4.6.4 A, "Orientation".
            int sx = transposed ? y : x, sy = transposed ? x : y;
            if (flip_x) sx = w - 1 - sx;
            if (flip_y) sy = h - 1 - sy;
            const T* from = stored.data() + (static_cast<std::size_t>(sy) * w + sx) * channels;
            std::copy_n(from, channels, result.data() + (static_cast<std::size_t>(y) * out_w + x) * channels);
        }
    return result;
}

/// Applies an Exif orientation (2-8), so that row 0 is the top of the picture.
void turn_upright(int orientation, Decoded& decoded) {
    if (orientation <= 1 || orientation > 8) return;
    const int w = decoded.width, h = decoded.height;
    decoded.rgb = upright(orientation, w, h, 3, decoded.rgb);
    decoded.alpha = upright(orientation, w, h, 1, decoded.alpha);
    decoded.codes =
        upright(orientation, w, h, static_cast<std::size_t>(decoded.code_channels), decoded.codes);
    if (orientation >= 5) std::swap(decoded.width, decoded.height);
}

}  // namespace

void check_limits(std::int64_t width, std::int64_t height, double bytes_per_texel, const std::string& where,
                  const ReadLimits& limits) {
    const std::string size = std::to_string(width) + " x " + std::to_string(height) + " texels";
    if (width < 1 || height < 1) throw unreadable(where, "claims " + size);
    if (width > limits.max_side || height > limits.max_side)
        throw unreadable(where,
                         "claims " + size + "; the limit is " + std::to_string(limits.max_side) + " a side");
    const double bytes = static_cast<double>(width) * static_cast<double>(height) * bytes_per_texel;
    if (bytes > static_cast<double>(limits.max_decoded_bytes))
        throw unreadable(where, "claims " + size + ", which take " +
                                    std::to_string(static_cast<std::uint64_t>(bytes)) +
                                    " bytes; the limit is " + std::to_string(limits.max_decoded_bytes));
}

Decoded decode_foreign(ForeignFormat format, Bytes file, const std::string& where, const ReadLimits& limits,
                       bool with_alpha, bool as_codes) {
    if (format == ForeignFormat::png && !png_is_complete(file))
        throw unreadable(where, "is truncated: its chunks don't run to IEND");
    if (format == ForeignFormat::jpeg && !jpeg_is_complete(file))
        throw unreadable(where, "is truncated: it has no end-of-image marker");
    std::string error;
    const auto reader = oiio_module().open(oiio_name(format), file, with_alpha, error);
    if (!reader) throw unreadable(where, "is truncated or malformed: " + error);
    const PictureSpec& spec = reader->spec();
    check_claims(format, file, where, spec, limits);

    Decoded decoded;
    decoded.width = spec.width;
    decoded.height = spec.height;
    find_encoding(format, file, where, spec, decoded);
    decoded.bits = spec.is_float ? 0 : 8 * spec.bytes_per_channel;
    if (!is_srgb_profile(spec.icc_bytes, spec.icc_profile)) decoded.icc_profile = spec.icc_profile;
    read_texels(*reader, where, as_codes && decoded.bits == 8, decoded);
    turn_upright(spec.orientation, decoded);
    return decoded;
}

}  // namespace pbrbake::io
