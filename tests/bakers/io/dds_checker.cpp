#include "tests/bakers/io/dds_checker.hpp"

#include <algorithm>
#include <cstdint>
#include <map>

namespace pbrbake::io::test {
namespace {

/// DXGI_FORMAT: bytes a texel. R32G32B32A32_FLOAT, R16G16B16A16_FLOAT and _UNORM, R32G32_FLOAT, R16G16_FLOAT
/// and _UNORM, R32_FLOAT, R16_FLOAT and _UNORM; R8, R8G8 and R8G8B8A8_UNORM, the last as _SRGB too.
const std::map<std::uint32_t, std::uint32_t> kTexelBytes{{2, 16}, {10, 8}, {11, 8}, {16, 8}, {34, 4},
                                                         {35, 4}, {41, 4}, {54, 2}, {56, 2}, {61, 1},
                                                         {49, 2}, {28, 4}, {29, 4}};

class Checker {
  public:
    explicit Checker(const std::vector<std::byte>& file) : file_(file) {}

    std::vector<std::string> run() {
        if (file_.size() < 148) return {"the file is shorter than its headers"};
        expect(u32(0) == 0x20534444, "dwMagic must be 'DDS '");
        expect(u32(4) == 124, "dwSize must be 124");
        const std::uint32_t flags = u32(8), height = u32(12), width = u32(16), levels = u32(28);
        expect((flags & 0x1007) == 0x1007, "dwFlags must hold CAPS, HEIGHT, WIDTH and PIXELFORMAT");
        expect((flags & ~std::uint32_t{0x2100F}) == 0, "dwFlags holds what isn't there");
        expect(width > 0 && height > 0, "dwWidth and dwHeight must not be 0");
        expect(u32(24) == 0, "dwDepth must be 0");
        for (std::size_t at = 32; at < 76; at += 4) expect(u32(at) == 0, "dwReserved1 must be 0");
        expect(u32(76) == 32 && u32(80) == 4 && u32(84) == 0x30315844,
               "ddspf must be 32 bytes with FOURCC 'DX10'");
        for (std::size_t at = 88; at < 108; at += 4) expect(u32(at) == 0, "ddspf has no masks with a FOURCC");
        const std::uint32_t caps = u32(108), caps2 = u32(112);
        const bool is_cube = (u32(136) & 4) != 0, has_levels = levels > 1;
        expect((caps & 0x1000) != 0, "dwCaps must hold TEXTURE");
        expect(((caps & 8) != 0) == (is_cube || has_levels),
               "dwCaps holds COMPLEX for cubes and mip levels alone");
        expect(((caps & 0x400000) != 0) == has_levels && ((flags & 0x20000) != 0) == has_levels,
               "MIPMAP and MIPMAPCOUNT go with levels");
        expect((caps & ~std::uint32_t{0x401008}) == 0, "dwCaps holds what isn't there");
        expect(caps2 == (is_cube ? 0xFE00u : 0u), "dwCaps2 must name all six faces of a cube, or nothing");
        expect(u32(116) == 0 && u32(120) == 0 && u32(124) == 0, "dwCaps3, dwCaps4 and dwReserved2 must be 0");
        check_dx10(width, height, levels, is_cube, (flags & 8) != 0);
        return breaches_;
    }

  private:
    void expect(bool holds, const std::string& breach) {
        if (!holds) breaches_.push_back(breach);
    }
    std::uint32_t u32(std::size_t at) const {
        std::uint32_t value = 0;
        for (std::size_t i = 4; i-- > 0;) value = value << 8 | std::to_integer<std::uint32_t>(file_[at + i]);
        return value;
    }

    void check_dx10(std::uint32_t width, std::uint32_t height, std::uint32_t levels, bool is_cube,
                    bool has_pitch) {
        const auto format = kTexelBytes.find(u32(128));
        if (format == kTexelBytes.end()) {
            breaches_.push_back("dxgiFormat is none that pbrbake writes");
            return;
        }
        expect(!has_pitch || u32(20) == width * format->second, "dwPitchOrLinearSize must be a row's bytes");
        expect(u32(132) == 3, "resourceDimension must be TEXTURE2D");
        expect((u32(136) & ~4u) == 0, "miscFlag holds TEXTURECUBE or nothing");
        expect(u32(140) == 1, "arraySize must be 1");
        expect(u32(144) == 0, "miscFlags2: alpha mode unknown");
        expect(!is_cube || width == height, "faces must be square");
        std::uint64_t texels = 0;
        std::uint32_t most = 1;
        for (std::uint32_t side = std::max(width, height); side > 1; side /= 2) ++most;
        expect(levels >= 1 && levels <= most, "dwMipMapCount");
        for (std::uint32_t l = 0; l < std::min(levels, 32u); ++l)
            texels += std::uint64_t{std::max(1u, width >> l)} * std::max(1u, height >> l);
        expect(file_.size() == 148 + texels * (is_cube ? 6 : 1) * format->second,
               "the file's size is not its texels'");
    }

    const std::vector<std::byte>& file_;
    std::vector<std::string> breaches_;
};

}  // namespace

std::vector<std::string> check_dds(const std::vector<std::byte>& file) { return Checker(file).run(); }

}  // namespace pbrbake::io::test
