// EXR products read back: every channel, face and own level.

#include <ImfChannelList.h>
#include <ImfEnvmapAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfTiledInputPart.h>

#include <algorithm>
#include <charconv>
#include <exception>
#include <new>

#include "bakers/io/codec.hpp"
#include "bakers/io/decoded.hpp"
#include "bakers/io/exr_cube.hpp"
#include "bakers/io/exr_memory.hpp"
#include "bakers/io/exr_preflight.hpp"
#include "bakers/io/keys.hpp"

namespace pbrbake::io {
namespace {

/// Channel names in memory order: as kChannelsKey says, else R G B A first and the others by name.
std::vector<std::string> channel_order(const Imf::Header& header, const std::string& where) {
    std::vector<std::string> names;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
        if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1)
            throw unreadable(
                where, std::string("channel '") + channel.name() + "' is subsampled, which is not read");
        names.emplace_back(channel.name());
    }
    if (names.empty()) throw unreadable(where, "has no channels");
    if (const auto* stated = header.findTypedAttribute<Imf::StringAttribute>(kChannelsKey)) {
        const std::vector<std::string> order = split_channels(stated->value());
        if (!std::ranges::is_permutation(order, names))
            throw unreadable(
                where, std::string(kChannelsKey) + " '" + stated->value() + "' doesn't name its channels");
        return order;
    }
    const auto rank = [](const std::string& name) {
        const auto position = std::string("RGBA").find(name);
        return name.size() == 1 && position != std::string::npos ? position : 4;
    };
    std::ranges::stable_sort(names, {}, rank);
    return names;
}

FileInfo info_of(const Imf::Header& header) {
    FileInfo info;
    info.pixel = PixelType::half;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
        if (channel.channel().type != Imf::HALF) info.pixel = PixelType::float32;
    for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
        const std::string key = attribute.name();
        const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute());
        if (text && key != kLevelsKey && key != kChannelsKey && key != "type" && key != "name")
            info.metadata[key] = text->value();
    }
    return info;
}

/// How many levels are the product's own.
int own_levels(const Imf::Header& header, int file_levels, const std::string& where) {
    const auto* stated = header.findTypedAttribute<Imf::StringAttribute>(kLevelsKey);
    if (!stated) return file_levels;
    const std::string& text = stated->value();
    int levels = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), levels);
    if (error != std::errc() || end != text.data() + text.size() || levels < 1 || levels > file_levels)
        throw unreadable(where, std::string(kLevelsKey) + " is '" + text + "'; the file has " +
                                    std::to_string(file_levels) + " levels");
    return levels;
}

Imf::FrameBuffer frame_over(std::vector<float>& texels, const std::vector<std::string>& names,
                            const Imath::Box2i& window) {
    const std::size_t channels = names.size();
    const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
    const auto height = static_cast<std::size_t>(window.max.y - window.min.y + 1);
    texels.assign(width * height * channels, 0.f);
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < channels; ++c)
        frame.insert(names[c], Imf::Slice::Make(Imf::FLOAT, texels.data() + c, window.min,
                                                static_cast<int64_t>(width), static_cast<int64_t>(height),
                                                channels * sizeof(float), channels * sizeof(float) * width));
    return frame;
}

/// A level of the file's picture to one of ours.
Level level_of(std::vector<float> picture, int width, int height, bool cube, std::size_t channels,
               const std::string& where) {
    if (!cube) return {width, height, std::move(picture)};
    if (height != 6 * width) throw unreadable(where, "is marked as a cube map, but a level is not n x 6n");
    Level level{width, width, std::vector<float>(picture.size())};
    float* out = level.texels.data();
    for (int face = 0; face < 6; ++face) {
        const ExrFace map = exr_face(face, width);
        for (int y = 0; y < width; ++y)
            for (int x = 0; x < width; ++x, out += channels)
                std::copy_n(picture.data() + map.at(x, y) * channels, channels, out);
    }
    return level;
}

void read_levels(Imf::MultiPartInputFile& input, bool cube, const std::string& where, Image& image) {
    const Imf::Header& header = input.header(0);
    const auto add = [&](const Imath::Box2i& window, std::vector<float> texels) {
        image.levels.push_back(level_of(std::move(texels), window.max.x - window.min.x + 1,
                                        window.max.y - window.min.y + 1, cube, image.channels.size(), where));
    };
    std::vector<float> texels;
    if (header.hasTileDescription() && header.tileDescription().mode == Imf::MIPMAP_LEVELS) {
        Imf::TiledInputPart part(input, 0);
        const int levels = own_levels(header, part.numLevels(), where);
        for (int l = 0; l < levels; ++l) {
            const Imath::Box2i window = part.dataWindowForLevel(l);
            part.setFrameBuffer(frame_over(texels, image.channels, window));
            part.readTiles(0, part.numXTiles(l) - 1, 0, part.numYTiles(l) - 1, l);
            add(window, std::move(texels));
        }
        return;
    }
    Imf::InputPart part(input, 0);
    const Imath::Box2i window = header.dataWindow();
    part.setFrameBuffer(frame_over(texels, image.channels, window));
    part.readPixels(window.min.y, window.max.y);
    add(window, std::move(texels));
}

}  // namespace

ReadBack read_exr_product(Bytes file, const std::string& where) {
    const ReadLimits limits;
    preflight_exr(file, file.size(), where, limits);
    try {
        ExrInput stream(file, where);
        Imf::MultiPartInputFile input(stream, 0, false);
        const Imf::Header& header = input.header(0);
        ReadBack back;
        back.format = "exr";
        back.image.channels = channel_order(header, where);
        back.info = info_of(header);
        const Imath::Box2i window = header.dataWindow();
        check_limits(std::int64_t{window.max.x} - window.min.x + 1,
                     std::int64_t{window.max.y} - window.min.y + 1,
                     static_cast<double>(back.image.channels.size() * sizeof(float)), where, limits);
        const bool cube = Imf::hasEnvmap(header) && Imf::envmap(header) == Imf::ENVMAP_CUBE;
        back.image.faces = cube ? 6 : 1;
        read_levels(input, cube, where, back.image);
        return back;
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw unreadable(where, "doesn't fit into memory");
    } catch (const std::exception& failure) {
        throw unreadable(where, std::string("is truncated or malformed: ") + failure.what());
    }
}

}  // namespace pbrbake::io
