#include "tests/bakers/io/fixtures.hpp"

#include <ImfChannelList.h>
#include <ImfEnvmapAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfTiledOutputFile.h>
#include <half.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace pbrbake::io::test {

TempDir::TempDir() {
    std::string pattern = (std::filesystem::temp_directory_path() / "pbrbake_io_XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw std::runtime_error("no temporary directory");
    path_ = pattern;
}
TempDir::~TempDir() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
}

void write_file(const std::filesystem::path& path, const Buffer& bytes) {
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!file) throw std::runtime_error("can't write " + path.string());
}

Buffer& put_text(Buffer& out, std::string_view text) {
    for (const char c : text) out.push_back(static_cast<std::byte>(c));
    return out;
}
Buffer& put_le(Buffer& out, std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) out.push_back(static_cast<std::byte>(value >> 8 * i));
    return out;
}
Buffer& put_be(Buffer& out, std::uint64_t value, int bytes) {
    for (int i = bytes; i-- > 0;) out.push_back(static_cast<std::byte>(value >> 8 * i));
    return out;
}
Buffer& put_bytes(Buffer& out, std::initializer_list<int> values) {
    for (const int value : values) out.push_back(static_cast<std::byte>(value));
    return out;
}

Buffer hdr_header(long width, long height) {
    Buffer out;
    return put_text(out, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " +
                             std::to_string(width) + "\n");
}

Buffer flat_hdr(int width, int height, std::initializer_list<int> rgbe) {
    Buffer out = hdr_header(width, height);
    for (int i = 0; i < width * height; ++i) put_bytes(out, rgbe);
    return out;
}

Buffer coded_hdr(int width, int height, const std::vector<int>& rgbe) {
    Buffer out = hdr_header(width, height);
    for (int y = 0; y < height; ++y) {
        put_bytes(out, {2, 2, width >> 8, width & 255});
        for (const int value : rgbe) put_bytes(out, {128 + width, value});
    }
    return out;
}

Buffer targa(int width, int height, std::initializer_list<int> rgb, bool coded) {
    Buffer out;
    put_bytes(out, {0, 0, coded ? 10 : 2, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    put_le(out, static_cast<std::uint64_t>(width), 2);
    put_le(out, static_cast<std::uint64_t>(height), 2);
    put_bytes(out, {24, 0x20});
    const std::vector<int> values(rgb);
    std::size_t next = 0;
    const auto texel = [&] {
        put_bytes(out, {values[next + 2], values[next + 1], values[next]});
        next = (next + 3) % values.size();
    };
    for (int y = 0; y < height; ++y) {
        if (coded) put_bytes(out, {127 + width});
        for (int x = 0; x < (coded ? 1 : width); ++x) texel();
    }
    return out;
}

Buffer float_samples(const std::vector<float>& values) {
    Buffer out;
    for (const float value : values) put_le(out, std::bit_cast<std::uint32_t>(value), 4);
    return out;
}

Buffer tiff(int width, int height, int sample_bytes, const Buffer& samples, int orientation) {
    constexpr int kEntries = 12;
    constexpr std::uint64_t kIfd = 8, kExtra = kIfd + 2 + kEntries * 12 + 4;
    constexpr std::uint64_t kBits = kExtra, kFormats = kExtra + 6, kPixels = kExtra + 12;
    Buffer out;
    put_text(out, "II*");
    put_le(out, 0, 1);
    put_le(out, kIfd, 4);
    put_le(out, kEntries, 2);
    const auto entry = [&](int tag, int type, std::uint64_t count, std::uint64_t value) {
        put_le(put_le(put_le(put_le(out, static_cast<std::uint64_t>(tag), 2),
                             static_cast<std::uint64_t>(type), 2),
                      count, 4),
               value, 4);
    };
    constexpr int kShort = 3, kLong = 4;
    entry(256, kLong, 1, static_cast<std::uint64_t>(width));
    entry(257, kLong, 1, static_cast<std::uint64_t>(height));
    entry(258, kShort, 3, kBits);
    entry(259, kShort, 1, 1);  // not compressed
    entry(262, kShort, 1, 2);  // RGB
    entry(273, kLong, 1, kPixels);
    entry(274, kShort, 1, static_cast<std::uint64_t>(orientation));
    entry(277, kShort, 1, 3);
    entry(278, kLong, 1, static_cast<std::uint64_t>(height));
    entry(279, kLong, 1, samples.size());
    entry(284, kShort, 1, 1);  // interleaved
    entry(339, kShort, 3, kFormats);
    put_le(out, 0, 4);
    for (int i = 0; i < 3; ++i) put_le(out, static_cast<std::uint64_t>(8 * sample_bytes), 2);
    for (int i = 0; i < 3; ++i) put_le(out, sample_bytes == 4 ? 3 : 1, 2);
    out.insert(out.end(), samples.begin(), samples.end());
    return out;
}

Buffer grey_jpeg() {
    Buffer out;
    put_bytes(out, {0xFF, 0xD8, 0xFF, 0xDB, 0, 67, 0, 64});
    out.resize(out.size() + 63, std::byte{1});
    put_bytes(out, {0xFF, 0xC0, 0, 11, 8, 0, 8, 0, 8, 1, 1, 0x11, 0});
    put_bytes(out, {0xFF, 0xC4, 0, 20, 0x00, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 4});
    put_bytes(out, {0xFF, 0xC4, 0, 20, 0x10, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    put_bytes(out, {0xFF, 0xDA, 0, 8, 1, 1, 0x00, 0, 63, 0});
    put_bytes(out, {0b01000011});  // category 4, value 8, end of block, filler
    return put_bytes(out, {0xFF, 0xD9});
}

namespace {

/// CRC-32 as PNG counts it (ISO 3309).
std::uint32_t crc32(const std::byte* data, std::size_t size) {
    std::uint32_t crc = 0xFFFFFFFFu;
    for (std::size_t i = 0; i < size; ++i) {
        crc ^= std::to_integer<std::uint32_t>(data[i]);
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xEDB88320u : 0u);
    }
    return ~crc;
}

Imf::PixelType exr_type(const std::string& type) {
    return type == "half" ? Imf::HALF : type == "uint" ? Imf::UINT : Imf::FLOAT;
}

Imf::Compression exr_compression(const std::string& name) {
    if (name == "none") return Imf::NO_COMPRESSION;
    if (name == "piz") return Imf::PIZ_COMPRESSION;
    if (name == "rle") return Imf::RLE_COMPRESSION;
    if (name == "dwab") return Imf::DWAB_COMPRESSION;
    return Imf::ZIP_COMPRESSION;
}

}  // namespace

Buffer png(int width, int height, int colour_type, const Buffer& samples, const Buffer& palette) {
    constexpr std::array kChannels{1, 0, 3, 1, 2, 0, 4};
    const std::size_t texels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                      channels = static_cast<std::size_t>(kChannels[static_cast<std::size_t>(colour_type)]),
                      depth = samples.size() / (texels * channels), row = samples.size() / height;
    Buffer out;
    put_text(out, std::string_view("\x89PNG\r\n\x1A\n", 8));
    const auto chunk = [&](std::string_view type, const Buffer& data) {
        Buffer body;
        put_text(body, type).insert(body.end(), data.begin(), data.end());
        put_be(out, data.size(), 4).insert(out.end(), body.begin(), body.end());
        put_be(out, crc32(body.data(), body.size()), 4);
    };
    Buffer header;
    put_be(put_be(header, static_cast<std::uint64_t>(width), 4), static_cast<std::uint64_t>(height), 4);
    put_bytes(header, {static_cast<int>(8 * depth), colour_type, 0, 0, 0});
    chunk("IHDR", header);
    if (!palette.empty()) chunk("PLTE", palette);
    // zlib of one stored block (RFC 1950, RFC 1951 3.2.4); each row has filter 0.
    Buffer rows;
    std::uint32_t a = 1, b = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (i % row == 0) rows.push_back(std::byte{0});
        rows.push_back(samples[i]);
    }
    for (const std::byte value : rows) {
        a = (a + std::to_integer<std::uint32_t>(value)) % 65521;
        b = (b + a) % 65521;
    }
    Buffer data;
    put_bytes(data, {0x78, 0x01, 0x01});
    put_le(put_le(data, rows.size(), 2), ~rows.size() & 0xffff, 2)
        .insert(data.end(), rows.begin(), rows.end());
    put_be(data, b << 16 | a, 4);
    chunk("IDAT", data);
    chunk("IEND", {});
    return out;
}

/// ICC.1:2001-04, 6.1 and 6.5.17: header, one tag, textDescriptionType.
Buffer icc_profile(std::string_view description) {
    Buffer tag;
    put_be(put_text(tag, "desc"), 0, 4);
    put_text(put_be(tag, description.size() + 1, 4), description);
    tag.resize(tag.size() + 1 + 4 + 4 + 2 + 1 + 67);
    Buffer out;
    put_be(out, 128 + 4 + 12 + tag.size(), 4);
    put_be(put_text(out, "test"), 0x02400000, 4);
    put_text(out, "mntrRGB XYZ ");
    out.resize(36);
    put_text(out, "acsp").resize(128);
    put_be(out, 1, 4);
    put_be(put_be(put_text(out, "desc"), 144, 4), tag.size(), 4);
    out.insert(out.end(), tag.begin(), tag.end());
    return out;
}

Buffer jpeg_with_icc(const Buffer& jpeg, const Buffer& profile) {
    Buffer out(jpeg.begin(), jpeg.begin() + 2);
    put_bytes(out, {0xFF, 0xE2});
    put_be(out, 2 + 14 + profile.size(), 2);
    put_text(out, std::string_view("ICC_PROFILE\0\1\1", 14));
    out.insert(out.end(), profile.begin(), profile.end());
    out.insert(out.end(), jpeg.begin() + 2, jpeg.end());
    return out;
}

Buffer png_with(const Buffer& png, std::string_view type, const Buffer& data, bool alone) {
    Buffer out(png.begin(), png.begin() + 8);
    std::size_t at = 8;
    while (at + 12 <= png.size()) {
        std::size_t size = 0;
        for (std::size_t i = 0; i < 4; ++i) size = size << 8 | std::to_integer<std::size_t>(png[at + i]);
        const std::string_view name(reinterpret_cast<const char*>(png.data()) + at + 4, 4);
        if (!alone || (name != "sRGB" && name != "gAMA" && name != "iCCP" && name != "cHRM"))
            out.insert(out.end(), png.begin() + static_cast<std::ptrdiff_t>(at),
                       png.begin() + static_cast<std::ptrdiff_t>(at + 12 + size));
        if (name == "IHDR" && !type.empty()) {
            Buffer body;
            put_text(body, type);
            body.insert(body.end(), data.begin(), data.end());
            put_be(out, data.size(), 4);
            out.insert(out.end(), body.begin(), body.end());
            put_be(out, crc32(body.data(), body.size()), 4);
        }
        at += 12 + size;
    }
    return out;
}

void write_exr(const std::filesystem::path& path, const ExrFixture& fixture) {
    const int o = fixture.overscan;
    const Imath::Box2i display({0, 0}, {fixture.width - 1, fixture.height - 1});
    const Imath::Box2i data({-o, -o}, {fixture.width - 1 + o, fixture.height - 1 + o});
    Imf::Header header(display, data);
    header.compression() = exr_compression(fixture.compression);
    const Imf::PixelType type = exr_type(fixture.type);
    if (fixture.cube) Imf::addEnvmap(header, Imf::ENVMAP_CUBE);
    if (const auto& c = fixture.chromaticities; !c.empty()) {
        const auto xy = [&](std::size_t i) {
            return Imath::V2f(static_cast<float>(c[2 * i]), static_cast<float>(c[2 * i + 1]));
        };
        Imf::addChromaticities(header, {xy(0), xy(1), xy(2), xy(3)});
    }
    if (fixture.white_luminance > 0)
        Imf::addWhiteLuminance(header, static_cast<float>(fixture.white_luminance));

    const int width = data.max.x - data.min.x + 1, height = data.max.y - data.min.y + 1;
    const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    std::vector<std::vector<std::uint32_t>> storage;
    Imf::FrameBuffer frame;
    for (const std::string& name : fixture.channels) {
        header.channels().insert(name, Imf::Channel(type));
        std::vector<std::uint32_t>& texels = storage.emplace_back(count);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const float value = fixture.value ? fixture.value(name, x - o, y - o) : .5f;
                std::uint32_t& bits = texels[static_cast<std::size_t>(y) * width + x];
                bits = type == Imf::HALF   ? half(value).bits()
                       : type == Imf::UINT ? static_cast<std::uint32_t>(value)
                                           : std::bit_cast<std::uint32_t>(value);
            }
    }
    for (std::size_t c = 0; c < storage.size(); ++c)
        frame.insert(fixture.channels[c],
                     Imf::Slice::Make(type, storage[c].data(), data, 4, 4 * static_cast<std::size_t>(width)));
    if (fixture.tiled) {
        header.setTileDescription(Imf::TileDescription(4, 4, Imf::ONE_LEVEL));
        Imf::TiledOutputFile output(path.c_str(), header, 0);
        output.setFrameBuffer(frame);
        output.writeTiles(0, output.numXTiles() - 1, 0, output.numYTiles() - 1);
    } else {
        Imf::OutputFile output(path.c_str(), header, 0);
        output.setFrameBuffer(frame);
        output.writePixels(height);
    }
}

void write_two_part_exr(const std::filesystem::path& path, const ExrFixture& first, float second_value) {
    const auto count = static_cast<std::size_t>(first.width) * static_cast<std::size_t>(first.height);
    std::vector<Imf::Header> headers;
    for (const char* name : {"first", "second"}) {
        Imf::Header header(first.width, first.height);
        header.setName(name);
        header.setType(Imf::SCANLINEIMAGE);
        for (const std::string& channel : first.channels)
            header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
        headers.push_back(header);
    }
    Imf::MultiPartOutputFile output(path.c_str(), headers.data(), 2, false, 0);
    for (int part = 0; part < 2; ++part) {
        std::vector<std::vector<float>> storage(first.channels.size(),
                                                std::vector<float>(count, second_value));
        Imf::FrameBuffer frame;
        for (std::size_t c = 0; c < storage.size(); ++c) {
            for (std::size_t i = 0; i < count && part == 0; ++i)
                storage[c][i] = first.value(first.channels[c], static_cast<int>(i) % first.width,
                                            static_cast<int>(i) / first.width);
            frame.insert(first.channels[c],
                         Imf::Slice::Make(Imf::FLOAT, storage[c].data(), headers[0].dataWindow()));
        }
        Imf::OutputPart out(output, part);
        out.setFrameBuffer(frame);
        out.writePixels(first.height);
    }
}

int code_of_reading(const ReadRequest& request, std::string* message) {
    try {
        read_source(request);
    } catch (const Error& error) {
        if (message) *message = error.what();
        return static_cast<int>(error.code());
    }
    return 0;
}

Image marked_image(int size, int levels, int faces, const std::vector<std::string>& channels) {
    Image image;
    image.channels = channels;
    image.faces = faces;
    for (int l = 0; l < levels; ++l) {
        Level level{std::max(1, size >> l), std::max(1, size >> l), {}};
        for (int f = 0; f < faces; ++f)
            for (int y = 0; y < level.height; ++y)
                for (int x = 0; x < level.width; ++x)
                    for (std::size_t c = 0; c < channels.size(); ++c)
                        level.texels.push_back(
                            static_cast<float>(half(static_cast<float>(l * 7 + f * 5 + y * 3 + x * 2) +
                                                    .25f * static_cast<float>(c))));
        image.levels.push_back(std::move(level));
    }
    return image;
}

std::filesystem::path shared_data() {
    const char* stated = std::getenv("PBRBAKE_SHARED_DATA");
    const std::filesystem::path path =
        stated ? std::filesystem::path(stated)
               : std::filesystem::path(PBRBAKE_SOURCE_DIR) / ".." / "shared" / "data";
    return std::filesystem::is_directory(path) ? path : std::filesystem::path();
}

std::string run_program(const std::string& command, int& status) {
    std::string output;
    std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    if (!pipe) throw std::runtime_error("can't run " + command);
    std::array<char, 4096> chunk;
    while (const std::size_t count = std::fread(chunk.data(), 1, chunk.size(), pipe))
        output.append(chunk.data(), count);
    const int result = pclose(pipe);
    status = WIFEXITED(result) ? WEXITSTATUS(result) : -1;
    return output;
}

bool have_program(const std::string& name) {
    int status = 0;
    run_program("command -v " + name, status);
    return status == 0;
}

}  // namespace pbrbake::io::test
