// encode, read_product and encode_png8: checks, then the codec.

#include "bakers/io/codec.hpp"

#include <algorithm>
#include <set>

#include "bakers/formats.hpp"
#include "bakers/io/keys.hpp"
#include "bakers/io/module_api.hpp"

namespace pbrbake::io {
namespace {

void check_channels(const Image& image) {
    if (image.channels.empty()) throw unwritable("the image has no channels");
    std::set<std::string> names;
    for (const std::string& name : image.channels) {
        if (name.empty() || name.find(',') != std::string::npos || name.find('\0') != std::string::npos)
            throw unwritable("channel name '" + name +
                             "' can't be written: it is empty or holds a comma or NUL");
        if (!names.insert(name).second) throw unwritable("channel name '" + name + "' is there twice");
    }
}

void check_shape(const Image& image) {
    if (image.is_volume ? image.faces < 1 || image.levels.size() > 1 : image.faces != 1 && image.faces != 6)
        throw unwritable("the image has " + std::to_string(image.faces) +
                         " faces; 1 or 6 can be written, and volumes of one level");
    if (image.levels.empty()) throw unwritable("the image has no levels");
    const Level& base = image.levels.front();
    if (base.width < 1 || base.height < 1) throw unwritable("the image has no texels");
    if (image.is_cube() && base.width != base.height) throw unwritable("cube map faces must be square");
    for (std::size_t l = 0; l < image.levels.size(); ++l) {
        const Level& level = image.levels[l];
        const std::string which = "level " + std::to_string(l);
        if (l > 30 || (l > 0 && (std::max(base.width, base.height) >> l) == 0))
            throw unwritable(which + " is beyond 1 x 1");
        if (level.width != std::max(1, base.width >> l) || level.height != std::max(1, base.height >> l))
            throw unwritable(which + " is " + std::to_string(level.width) + " x " +
                             std::to_string(level.height) + "; levels halve, rounding down");
        const std::size_t count = static_cast<std::size_t>(image.faces) * level.width * level.height;
        if (level.numbers() != count * image.channels.size())
            throw unwritable(which + " holds " + std::to_string(level.numbers()) + " numbers instead of " +
                             std::to_string(count * image.channels.size()));
    }
}

/// What a format can't hold, said before its codec runs.
void check_fits(const Format& format, const Image& image, PixelType pixel) {
    const std::string name(format.name);
    if (image.channel_count() > format.max_channels)
        throw unwritable(name + " holds up to " + std::to_string(format.max_channels) +
                         " channels; the image has " + std::to_string(image.channel_count()) + ": use exr");
    if (image.is_volume && !format.is_volume)
        throw unwritable(name + " holds no volumes: use ktx2, dds or h");
    const bool has_codes =
        std::ranges::any_of(image.levels, [](const Level& level) { return !level.codes.empty(); });
    if (has_codes && pixel != PixelType::unorm8)
        throw unwritable("8-bit codes can't be written with pixel type " + std::string(pixel_name(pixel)));
    if (!format.is_chain && !image.is_volume && (image.faces != 1 || image.levels.size() != 1))
        throw unwritable(name + " holds neither cube maps nor mip levels: use exr, ktx2 or dds");
}

void check_info(const Format& format, const FileInfo& info) {
    if (std::ranges::find(format.pixels, info.pixel) == format.pixels.end())
        throw unwritable(std::string(format.name) + " isn't written with pixel type " +
                         std::string(pixel_name(info.pixel)));
    for (const auto& [key, value] : info.metadata) {
        if (key.empty() || key.size() > 255 || key.find('\0') != std::string::npos ||
            value.find('\0') != std::string::npos)
            throw unwritable("metadata '" + key +
                             "' can't be written: keys have 1 to 255 bytes, and nothing holds NUL");
        if (key == kLevelsKey || key == kChannelsKey) throw unwritable("metadata '" + key + "' is io's own");
    }
}

}  // namespace

const std::vector<std::string>& output_formats() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> list;
        for (const Format& format : formats())
            if (!format.is_document()) list.emplace_back(format.name);
        return list;
    }();
    return names;
}

std::vector<std::byte> encode(std::string_view format, const Image& image, const FileInfo& info) {
    const Format* container = find_format(format);
    if (!container) {
        std::string names;
        for (const std::string& name : output_formats()) names.append(names.empty() ? "" : ", ").append(name);
        throw unwritable("unknown format '" + std::string(format) + "'; allowed: " + names);
    }
    check_channels(image);
    check_shape(image);
    check_fits(*container, image, info.pixel);
    check_info(*container, info);
    if (format == "exr") return encode_exr(image, info);
    if (format == "ktx2") return encode_ktx2(image, info);
    if (format == "dds") return encode_dds(image, info);
    if (format == "h") return encode_c_header(image, info);
    if (format == "hdr") return encode_hdr(image, info);
    return info.pixel == PixelType::unorm8 ? encode_png8(image) : encode_png16(image);
}

ReadBack read_product(const std::filesystem::path& path) {
    using namespace std::string_view_literals;
    const std::string where = path.string();
    const std::vector<std::byte> file = read_file(path, ReadLimits{}.max_decoded_bytes * 2);
    if (begins_with(file, "\x76\x2f\x31\x01"sv)) return read_exr_product(file, where);
    if (begins_with(file, "\xABKTX 20\xBB\r\n\x1A\n"sv)) return read_ktx2_product(file, where);
    if (begins_with(file, "DDS "sv)) return read_dds_product(file, where);
    if (begins_with(file, "\x89PNG\r\n\x1A\n"sv))
        return read_flat_product("png", PixelType::unorm16, file, where);
    if (begins_with(file, "#?"sv)) return read_flat_product("hdr", PixelType::rgbe, file, where);
    throw unreadable(where, "is no EXR, KTX2, DDS, PNG or HDR");
}

std::vector<std::byte> encode_png8(int width, int height, const std::vector<std::uint8_t>& rgb) {
    if (width < 1 || height < 1 || rgb.size() != static_cast<std::size_t>(width) * height * 3)
        throw unwritable("a PNG of " + std::to_string(width) + " x " + std::to_string(height) +
                         " can't be made of " + std::to_string(rgb.size()) + " bytes");
    std::vector<std::byte> file;
    std::string error;
    if (!oiio_module().write_png8(width, height, 3, true, rgb.data(), file, error))
        throw unwritable("PNG: " + error);
    return file;
}

}  // namespace pbrbake::io
