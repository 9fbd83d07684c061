// read_source: sniff, decode, repair, convert.

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <new>

#include "bakers/io/colour.hpp"
#include "bakers/io/decoded.hpp"
#include "bakers/io/foreign_claims.hpp"
#include "bakers/io/io.hpp"
#include "bakers/io/repair.hpp"
#include "bakers/unorm8.hpp"

namespace pbrbake::io {
namespace {

std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

std::string lower_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

Decoded decode_bytes(Bytes bytes, const ReadRequest& request, SourceImage& source) {
    const std::string where = request.path.string();
    source.hash = hash_bytes(bytes.data(), bytes.size());
    if (const auto format = foreign_format(bytes, lower_extension(request.path)))
        return decode_foreign(*format, bytes, where, request.limits, request.with_alpha, request.as_codes);
    throw unreadable(where,
                     "is none of the formats that are read: EXR, HDR (RGBE), PNG, TIFF, TGA (.tga), JPEG");
}

/// An EXR is read as it is decoded: stored uncompressed it is as large as its texels, and both together would
/// double what a bake takes.
Decoded decode(const ReadRequest& request, SourceImage& source) {
    using namespace std::string_view_literals;
    if (request.bytes) return decode_bytes(*request.bytes, request, source);
    // A file's bytes are at most as many as its decoded texels take, but for channels that aren't read.
    const File file(request.path, request.limits.max_decoded_bytes * 2);
    if (file.size() == 0) throw unreadable(file.where(), "is empty");
    if (begins_with(file.head(4), "\x76\x2f\x31\x01"sv)) {
        source.hash = hash_file(request.path);
        return decode_exr(file, request.limits, request.with_alpha);
    }
    return decode_bytes(file.head(file.size()), request, source);
}

/// The encoding that the request or the file states, else the file's type suggests. Nothing: numbers are
/// taken as is.
std::optional<Encoding> resolve_encoding(const ReadRequest& request, const Decoded& decoded,
                                         SourceImage& source) {
    if (request.colour_space == "auto") {
        source.colour_space = name_of(decoded.encoding);
        source.colour_space_assumed = decoded.encoding_assumed;
        return decoded.encoding;
    }
    source.colour_space = request.colour_space;
    if (request.colour_space == "raw") return {};
    if (auto named = encoding_named(request.colour_space)) return named;
    throw Error(ExitCode::invalid_job, request.path.string(),
                "unknown colour space '" + request.colour_space + "'; allowed: " + listed(colour_spaces()));
}

/// An embedded profile that says more than the encoding that is used, or one that colours rarely have.
std::string colour_doubt(const ReadRequest& request, const Decoded& decoded) {
    if (request.colour_space != "auto") return "";
    if (!decoded.icc_profile.empty())
        return "embeds the ICC profile \"" + decoded.icc_profile + "\", which isn't followed; taken as " +
               name_of(decoded.encoding) + " (state it with colour_space)";
    const bool is_stated_linear = decoded.encoding.curve == Curve::linear && !decoded.encoding_assumed;
    if (decoded.bits == 8 && is_stated_linear)
        return "says that its 8-bit codes are linear, which they rarely are of colours; taken as " +
               name_of(decoded.encoding) + " (state colour_space, srgb if that is wrong)";
    return "";
}

/// What the 256 codes stand for, unless channels mix.
std::optional<std::array<float, 256>> linear_of_codes(const std::optional<Encoding>& encoding, Gamut working,
                                                      const std::string& where) {
    if (encoding && encoding->gamut != working) return {};
    std::array<float, 256> linear{};
    for (std::size_t code = 0; code < 256; ++code)
        linear[code] = kUnorm8.linear(static_cast<std::uint8_t>(code));
    if (!encoding || encoding->curve == Curve::linear) return linear;
    if (encoding->curve == Curve::srgb) {
        for (std::size_t code = 0; code < 256; ++code)
            linear[code] = kUnorm8.srgb(static_cast<std::uint8_t>(code));
        return linear;
    }
    std::vector<float> rgb;
    for (const float value : linear) rgb.insert(rgb.end(), 3, value);
    convert(*encoding, working, rgb, where);
    for (std::size_t code = 0; code < 256; ++code) linear[code] = rgb[3 * code];
    return linear;
}

/// Codes to the floats that they would have been read as.
void expand_codes(Decoded& decoded) {
    const auto channels = static_cast<std::size_t>(decoded.code_channels);
    for (std::size_t i = 0; i < decoded.codes.size(); i += channels) {
        for (std::size_t c = 0; c < 3; ++c) decoded.rgb.push_back(kUnorm8.linear(decoded.codes[i + c]));
        if (channels == 4) decoded.alpha.push_back(kUnorm8.linear(decoded.codes[i + 3]));
    }
    decoded.codes = {};
}

/// R G B A of both. Alpha is a finite number from 0 on, as stored; NaN is 1.
std::vector<float> interleaved(const std::vector<float>& rgb, const std::vector<float>& alpha) {
    constexpr float kLargest = std::numeric_limits<float>::max();
    std::vector<float> rgba;
    rgba.reserve(alpha.size() * 4);
    for (std::size_t i = 0; i < alpha.size(); ++i) {
        rgba.insert(rgba.end(), &rgb[3 * i], &rgb[3 * i] + 3);
        rgba.push_back(std::isnan(alpha[i]) ? 1.f : std::clamp(alpha[i], 0.f, kLargest));
    }
    return rgba;
}

}  // namespace

SourceImage read_text_source(const std::filesystem::path& path) {
    SourceImage source;
    source.bytes = read_file(path, kMaxTextBytes);
    source.name = path.string();
    source.hash = hash_bytes(source.bytes.data(), source.bytes.size());
    return source;
}

std::vector<std::byte> read_part(const std::filesystem::path& path, std::uint64_t offset,
                                 std::uint64_t size) {
    const File file(path, std::numeric_limits<std::uint64_t>::max());
    const std::uint64_t left = file.size() - std::min(offset, file.size()), wanted = size == 0 ? left : size;
    if (wanted > left)
        throw unreadable(file.where(), "has " + std::to_string(file.size()) + " bytes, but " +
                                           std::to_string(wanted) + " from byte " + std::to_string(offset) +
                                           " on are asked for");
    std::vector<std::byte> bytes(static_cast<std::size_t>(wanted));
    file.read(offset, bytes);
    return bytes;
}

SourceImage read_source(const ReadRequest& request) {
    const std::string where = request.path.string();
    const auto working = working_gamut(request.working_space);
    if (!working)
        throw Error(ExitCode::invalid_job, where,
                    "unknown working space '" + request.working_space + "'; allowed: lin_rec709, acescg");
    try {
        SourceImage source;
        Decoded decoded = decode(request, source);
        source.units = decoded.units;

        const std::optional<Encoding> encoding = resolve_encoding(request, decoded, source);
        source.colour_doubt = colour_doubt(request, decoded);
        source.bits = decoded.bits;
        source.is_half = decoded.is_half;
        source.image.channels = {"R", "G", "B"};
        source.image.faces = decoded.faces;
        if (!decoded.codes.empty()) {
            if (const auto linear = linear_of_codes(encoding, *working, where)) {
                source.linear = *linear;
                source.codes = std::move(decoded.codes);
                if (decoded.code_channels == 4) source.image.channels.emplace_back("A");
                source.image.levels.push_back({decoded.width, decoded.height, {}});
                return source;
            }
            expand_codes(decoded);
        }
        repair_non_finite(decoded.rgb, source.repairs, request.infinity);
        if (encoding) convert(*encoding, *working, decoded.rgb, where);
        if (decoded.to_units != 1)
            for (float& value : decoded.rgb) value = static_cast<float>(value * decoded.to_units);
        repair_non_finite(decoded.rgb, source.repairs);  // a conversion can overflow
        repair_negative(decoded.rgb, source.repairs);

        if (!decoded.alpha.empty()) {
            source.image.channels.emplace_back("A");
            decoded.rgb = interleaved(decoded.rgb, decoded.alpha);
        }
        source.image.levels.push_back({decoded.width, decoded.height, std::move(decoded.rgb)});
        return source;
    } catch (const std::bad_alloc&) {
        throw unreadable(where, "doesn't fit into memory");
    } catch (const std::length_error&) {
        throw unreadable(where, "doesn't fit into memory");
    }
}

}  // namespace pbrbake::io
