// EXR sources: RGB, grey, lat-long or cube, scanline or tiled, through OpenEXR's own API.

#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfEnvmapAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <exception>

#include "bakers/io/colour.hpp"
#include "bakers/io/decoded.hpp"
#include "bakers/io/exr_cube.hpp"
#include "bakers/io/exr_memory.hpp"
#include "bakers/io/exr_preflight.hpp"
#include "bakers/io/keys.hpp"

namespace pbrbake::io {
namespace {

using Imath::Box2i;
using Imath::V2i;

/// The file's names of R, G and B, one name of a grey picture; and of alpha, where it is read.
using ChannelNames = std::vector<std::string>;

/// R, G, B; else Y; else the first layer (by name) that has them.
ChannelNames find_channels(const Imf::ChannelList& channels, bool with_alpha, const std::string& where) {
    ChannelNames found;
    const auto has = [&](const std::string& name) { return channels.findChannel(name) != nullptr; };
    const auto take = [&](const std::string& prefix) {
        if (has(prefix + "R") && has(prefix + "G") && has(prefix + "B"))
            found = {prefix + "R", prefix + "G", prefix + "B"};
        else if (has(prefix + "Y") && !has(prefix + "RY") && !has(prefix + "BY"))
            found = {prefix + "Y"};
        if (with_alpha && !found.empty() && has(prefix + "A")) found.push_back(prefix + "A");
    };
    take("");
    std::string listed;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        const std::string name = channel.name();
        listed += (listed.empty() ? "" : ", ") + name;
        const auto dot = name.rfind('.');
        if (found.empty() && dot != std::string::npos) take(name.substr(0, dot + 1));
    }
    if (found.empty()) throw unreadable(where, "has neither R, G and B channels nor a Y; it has " + listed);
    for (const std::string& name : found) {
        const Imf::Channel& channel = channels[name];
        if (channel.xSampling != 1 || channel.ySampling != 1)
            throw unreadable(where, "channel '" + name + "' is subsampled, which is not read");
    }
    return found;
}

/// The window to read: a cube's data, else the picture as it is displayed, cut from what surrounds it.
Box2i picture_window(const Imf::Header& header, bool cube, const std::string& where) {
    const Box2i& data = header.dataWindow();
    if (cube) return data;
    const Box2i& display = header.displayWindow();
    const auto contains = [](const Box2i& a, const Box2i& b) {
        return a.min.x <= b.min.x && a.min.y <= b.min.y && a.max.x >= b.max.x && a.max.y >= b.max.y;
    };
    if (!contains(data, display) || display.isEmpty())
        throw unreadable(where,
                         "holds only a part of its display window (data window != display window); an "
                         "environment must be whole: write it uncropped");
    return display;
}

/// Reads rows in strips, so that memory is taken only as far as the file's bytes last.
void read_texels(Imf::InputPart& part, const ChannelNames& names, const Box2i& window, Decoded& decoded) {
    const Box2i& data = part.header().dataWindow();
    const std::int64_t data_width = std::int64_t{data.max.x} - data.min.x + 1;
    const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
    constexpr int kRows = 64;
    const std::size_t channels = names.size();
    std::vector<float> strip(static_cast<std::size_t>(data_width) * kRows * channels);
    const bool is_grey = channels < 3, has_alpha = channels % 2 == 0;
    const std::size_t texels = static_cast<std::size_t>(width) * height;
    decoded.rgb.reserve(texels * 3);
    if (has_alpha) decoded.alpha.reserve(texels);
    for (int y = window.min.y; y <= window.max.y; y += kRows) {
        const int last = std::min(y + kRows - 1, window.max.y);
        Imf::FrameBuffer frame;
        for (std::size_t c = 0; c < channels; ++c)
            frame.insert(names[c],
                         Imf::Slice::Make(Imf::FLOAT, strip.data() + c, V2i(data.min.x, y), data_width, kRows,
                                          channels * sizeof(float),
                                          channels * sizeof(float) * static_cast<std::size_t>(data_width)));
        part.setFrameBuffer(frame);
        part.readPixels(y, last);
        for (int row = 0; row <= last - y; ++row) {
            const float* texel = strip.data() + (static_cast<std::size_t>(row) * data_width +
                                                 static_cast<std::size_t>(window.min.x - data.min.x)) *
                                                    channels;
            for (int x = 0; x < width; ++x, texel += channels) {
                for (std::size_t c = 0; c < 3; ++c) decoded.rgb.push_back(texel[is_grey ? 0 : c]);
                if (has_alpha) decoded.alpha.push_back(texel[channels - 1]);
            }
        }
    }
}

/// From OpenEXR's n x 6n picture to six faces of ours.
void unfold_cube(Decoded& decoded, const std::string& where) {
    const int size = decoded.width;
    if (decoded.height != 6 * size)
        throw unreadable(where, "is marked as a cube map but is " + std::to_string(size) + " x " +
                                    std::to_string(decoded.height) + ", not n x 6n");
    std::vector<float> faces(decoded.rgb.size());
    float* out = faces.data();
    for (int face = 0; face < 6; ++face) {
        const ExrFace map = exr_face(face, size);
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x, out += 3)
                std::copy_n(decoded.rgb.data() + map.at(x, y) * 3, 3, out);
    }
    decoded.rgb = std::move(faces);
    decoded.height = size;
    decoded.faces = 6;
}

/// Primaries, and what the numbers count: whiteLuminance is the cd/m² of (1, 1, 1); a product of ours that
/// was scaled to fit its pixel type says so.
void read_statements(const Imf::Header& header, const std::string& where, Decoded& decoded) {
    if (Imf::hasChromaticities(header)) {
        const Imf::Chromaticities& c = Imf::chromaticities(header);
        const auto xy = [](const Imath::V2f& v) { return std::array<double, 2>{v.x, v.y}; };
        decoded.encoding = linear_with({xy(c.red), xy(c.green), xy(c.blue), xy(c.white)}, where);
        decoded.encoding_assumed = false;
    }
    if (Imf::hasWhiteLuminance(header)) {
        const double white = static_cast<double>(Imf::whiteLuminance(header));
        if (std::isfinite(white) && white > 0) {
            decoded.to_units = white;
            decoded.units = "cd/m^2";
        }
    } else if (const auto* scale = header.findTypedAttribute<Imf::StringAttribute>(kScaleKey)) {
        const std::string& text = scale->value();
        double value = 0;
        std::from_chars(text.data(), text.data() + text.size(), value);
        if (std::isfinite(value) && value > 0) decoded.to_units = 1 / value;
    }
}

}  // namespace

Decoded decode_exr(const File& file, const ReadLimits& limits, bool with_alpha) {
    const std::string& where = file.where();
    preflight_exr(file.head(kMostHeaderBytes), file.size(), where, limits);
    try {
        ExrFileInput stream(file);
        Imf::MultiPartInputFile input(stream, 0, false);
        const Imf::Header& header = input.header(0);
        const bool cube = Imf::hasEnvmap(header) && Imf::envmap(header) == Imf::ENVMAP_CUBE;
        const ChannelNames names = find_channels(header.channels(), with_alpha && !cube, where);
        const Box2i window = picture_window(header, cube, where);

        Imf::InputPart part(input, 0);
        if (!part.isComplete()) throw unreadable(where, "is truncated: pixels are missing");
        Decoded decoded;
        decoded.width = window.max.x - window.min.x + 1;
        decoded.height = window.max.y - window.min.y + 1;
        read_statements(header, where, decoded);
        decoded.is_half = header.channels()[names.front()].type == Imf::HALF;
        read_texels(part, names, window, decoded);
        if (cube) unfold_cube(decoded, where);
        return decoded;
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& failure) {
        throw unreadable(where, std::string("is truncated or malformed: ") + failure.what());
    }
}

}  // namespace pbrbake::io
