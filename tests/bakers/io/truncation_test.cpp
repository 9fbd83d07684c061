// A file cut anywhere is an Error with code 4, and a changed one never crashes.

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "tests/bakers/io/fixtures.hpp"

namespace pbrbake::io::test {
namespace {

struct Cut {
    std::string name;
    Buffer whole;
};

Buffer load_file(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    Buffer bytes;
    put_text(bytes, text);
    return bytes;
}

/// About a hundred cuts, each end in every byte.
std::vector<std::size_t> cuts_of(std::size_t size) {
    std::vector<std::size_t> cuts;
    const std::size_t step = std::max<std::size_t>(1, size / 70);
    for (std::size_t at = 0; at < size; at += at < 24 || at + 24 > size ? 1 : step) cuts.push_back(at);
    return cuts;
}

void expect_refused_when_cut(const Cut& cut) {
    TempDir dir;
    const auto path = dir / cut.name;
    write_file(path, cut.whole);
    EXPECT_NO_THROW(read_source({path}));
    for (const std::size_t size : cuts_of(cut.whole.size())) {
        write_file(path, Buffer(cut.whole.begin(), cut.whole.begin() + static_cast<std::ptrdiff_t>(size)));
        try {
            read_source({path});
            ADD_FAILURE() << cut.name << " cut to " << size << " was read";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::unreadable_input) << cut.name << " cut to " << size;
            EXPECT_NE(error.where().find(cut.name), std::string::npos);
        }
    }
}

Buffer exr(const ExrFixture& fixture) {
    TempDir dir;
    write_exr(dir / "a.exr", fixture);
    return load_file(dir / "a.exr");
}

float ramp(const std::string&, int x, int y) { return static_cast<float>(x * 37 % 11 + y); }

Buffer many_samples(int bytes_per_sample) {
    Buffer samples;
    for (int i = 0; i < 16 * 8 * 3; ++i) put_le(samples, static_cast<std::uint64_t>(i), bytes_per_sample);
    return samples;
}

Buffer noisy_png() {
    std::vector<std::uint8_t> rgb;
    for (int i = 0; i < 31 * 17 * 3; ++i) rgb.push_back(static_cast<std::uint8_t>(i * i % 251));
    return encode_png8(31, 17, rgb);
}

TEST(Truncation, FlatHdrIsRefused) { expect_refused_when_cut({"a.hdr", flat_hdr(4, 4, {9, 8, 7, 128})}); }
TEST(Truncation, CodedHdrIsRefused) { expect_refused_when_cut({"a.hdr", coded_hdr(32, 16, {9, 8, 7, 128})}); }
TEST(Truncation, IntegerTiffIsRefused) {
    expect_refused_when_cut({"a.tif", tiff(16, 8, 1, many_samples(1))});
}
TEST(Truncation, FloatTiffIsRefused) {
    expect_refused_when_cut({"a.tif", tiff(16, 8, 4, float_samples(std::vector<float>(16 * 8 * 3, .5f)))});
}
TEST(Truncation, PlainTargaIsRefused) { expect_refused_when_cut({"a.tga", targa(6, 5, {1, 2, 3}, false)}); }
TEST(Truncation, CodedTargaIsRefused) { expect_refused_when_cut({"a.tga", targa(6, 5, {1, 2, 3}, true)}); }
TEST(Truncation, JpegIsRefused) { expect_refused_when_cut({"a.jpg", grey_jpeg()}); }
TEST(Truncation, PngIsRefused) { expect_refused_when_cut({"a.png", noisy_png()}); }
TEST(Truncation, ScanlineExrIsRefused) {
    for (const char* compression : {"zip", "none", "piz", "dwab", "rle"}) {
        SCOPED_TRACE(compression);
        ExrFixture fixture{.width = 40, .height = 40, .compression = compression, .value = ramp};
        expect_refused_when_cut({"a.exr", exr(fixture)});
    }
}
TEST(Truncation, TiledExrIsRefused) {
    expect_refused_when_cut({"a.exr", exr({.width = 20, .height = 12, .tiled = true, .value = ramp})});
}

TEST(Truncation, ProductsAreRefused) {
    TempDir dir;
    for (const std::string format : {"exr", "ktx2"}) {
        const auto path = dir / ("a." + format);
        const Buffer whole = encode(format, marked_image(8, 3, 6, {"R", "G", "B"}), {});
        for (const std::size_t size : cuts_of(whole.size())) {
            write_file(path, Buffer(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)));
            try {
                // OpenEXR's filler levels lie behind the product's own and aren't read.
                read_product(path);
                EXPECT_TRUE(format == "exr" && size > whole.size() / 2) << format << " cut to " << size;
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ExitCode::unreadable_input) << format << " cut to " << size;
            }
        }
    }
}

TEST(Corruption, ChangedBytesNeverCrashAndAreToldInALine) {
    TempDir dir;
    const std::vector<Cut> files{{"a.hdr", coded_hdr(32, 16, {9, 8, 7, 128})},
                                 {"a.tif", tiff(16, 8, 1, many_samples(1))},
                                 {"a.tga", targa(6, 5, {1, 2, 3}, true)},
                                 {"a.jpg", grey_jpeg()},
                                 {"a.png", noisy_png()},
                                 {"a.exr", exr({.width = 20, .height = 12, .tiled = true, .value = ramp})}};
    ReadLimits limits;
    limits.max_decoded_bytes = 64 << 20;
    for (const Cut& file : files)
        for (std::size_t at = 0; at < std::min<std::size_t>(file.whole.size(), 400); ++at)
            for (const int value : {0, 0x7F, 0xFF}) {
                Buffer changed = file.whole;
                changed[at] = static_cast<std::byte>(value);
                write_file(dir / file.name, changed);
                ReadRequest request{dir / file.name};
                request.limits = limits;
                std::string message;
                const int code = code_of_reading(request, &message);
                EXPECT_TRUE(code == 0 || code == 4) << file.name << " byte " << at << " = " << value;
                EXPECT_EQ(message.find('\n'), std::string::npos) << message;
            }
}

}  // namespace
}  // namespace pbrbake::io::test
