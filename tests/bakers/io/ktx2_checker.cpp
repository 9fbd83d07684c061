#include "tests/bakers/io/ktx2_checker.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <numeric>
#include <set>

namespace pbrbake::io::test {
namespace {

/// VK_FORMAT_…_SFLOAT, and R16_UNORM, R16G16 and R16G16B16A16: channels and bits.
const std::map<std::uint32_t, std::pair<std::uint32_t, std::uint32_t>> kFormats{
    {9, {1, 8}},   {16, {2, 8}},  {37, {4, 8}},   {15, {1, 8}},   {22, {2, 8}},
    {43, {4, 8}},  {70, {1, 16}}, {77, {2, 16}},  {91, {4, 16}},  {76, {1, 16}},
    {83, {2, 16}}, {97, {4, 16}}, {100, {1, 32}}, {103, {2, 32}}, {109, {4, 32}}};

class Checker {
  public:
    explicit Checker(const std::vector<std::byte>& file) : file_(file) {}

    std::vector<std::string> run() {
        if (file_.size() < 80) return {"the file is shorter than its header"};
        check_identifier();
        check_header();
        if (!breaches_.empty()) return breaches_;
        check_index();
        if (!breaches_.empty()) return breaches_;
        check_descriptor();
        check_key_values();
        check_levels();
        return breaches_;
    }

  private:
    void expect(bool holds, const std::string& breach) {
        if (!holds) breaches_.push_back(breach);
    }
    std::uint64_t number(std::uint64_t at, int bytes) const {
        std::uint64_t value = 0;
        for (int i = bytes; i-- > 0;) value = value << 8 | std::to_integer<std::uint64_t>(file_.at(at + i));
        return value;
    }
    std::uint64_t u32(std::uint64_t at) const { return number(at, 4); }
    std::uint64_t u64(std::uint64_t at) const { return number(at, 8); }
    bool zeros(std::uint64_t begin, std::uint64_t end) const {
        for (std::uint64_t at = begin; at < end; ++at)
            if (file_.at(at) != std::byte{0}) return false;
        return true;
    }

    void check_identifier() {
        const unsigned char identifier[12] = {0xAB, 0x4B, 0x54, 0x58, 0x20, 0x32,
                                              0x30, 0xBB, 0x0D, 0x0A, 0x1A, 0x0A};
        expect(std::memcmp(file_.data(), identifier, 12) == 0, "identifier");
    }

    void check_header() {
        const auto format = kFormats.find(static_cast<std::uint32_t>(u32(12)));
        if (format == kFormats.end()) {
            breaches_.push_back("vkFormat " + std::to_string(u32(12)) + " is none that pbrbake writes");
            return;
        }
        is_unorm_ = u32(12) == 70 || u32(12) == 77 || u32(12) == 91 || u32(12) < 50;
        is_srgb_ = u32(12) == 15 || u32(12) == 22 || u32(12) == 43;
        channels_ = format->second.first;
        bits_ = format->second.second;
        width_ = u32(20);
        height_ = u32(24);
        depth_ = u32(28);
        faces_ = u32(36);
        level_count_ = u32(40);
        expect(u32(16) == bits_ / 8, "typeSize is not a component's size");
        expect(width_ > 0 && height_ > 0, "pixelWidth and pixelHeight must not be 0");
        expect(u32(32) == 0, "layerCount must be 0");
        expect(faces_ != 6 || depth_ == 0, "cube maps have no pixelDepth");
        expect(faces_ == 1 || faces_ == 6, "faceCount must be 1 or 6");
        expect(faces_ != 6 || width_ == height_, "cube map faces must be square");
        expect(u32(44) == 0, "supercompressionScheme");
        std::uint64_t most = 1;
        for (std::uint64_t side = std::max({width_, height_, depth_}); side > 1; side /= 2) ++most;
        expect(level_count_ >= 1 && level_count_ <= most, "levelCount");
    }

    void check_index() {
        dfd_ = {u32(48), u32(52)};
        kvd_ = {u32(56), u32(60)};
        const std::uint64_t index_end = 80 + 24 * level_count_;
        expect(u64(64) == 0 && u64(72) == 0, "sgdByteOffset and sgdByteLength must be 0");
        expect(dfd_.offset == index_end, "the data format descriptor must follow the level index");
        expect(dfd_.size >= 4 && dfd_.end() <= file_.size(),
               "the data format descriptor is outside the file");
        expect(kvd_.offset == dfd_.end(), "kvdByteOffset - dfdByteOffset must be dfdTotalSize");
        expect(kvd_.size > 0 && kvd_.end() <= file_.size(), "the key/value data are outside the file");
    }

    void check_descriptor() {
        const std::uint64_t at = dfd_.offset, block = 24 + 16 * channels_;
        expect(u32(at) == dfd_.size, "dfdTotalSize != dfdByteLength");
        expect(dfd_.size == 4 + block, "the descriptor's size doesn't fit the format's samples");
        if (dfd_.size != 4 + block) return;
        expect(u32(at + 4) == 0, "vendorId and descriptorType must be 0, Khronos' basic block");
        expect(number(at + 8, 2) == 2, "versionNumber must be 2, KDF 1.3");
        expect(number(at + 10, 2) == block, "descriptorBlockSize");
        expect(number(at + 12, 1) == 1, "colorModel must be RGBSDA");
        const std::uint64_t primaries = number(at + 13, 1);
        expect(primaries == 0 || primaries == 1 || primaries == 7,
               "colorPrimaries: unspecified, BT.709 or AP1");
        expect(number(at + 14, 1) == (is_srgb_ ? 2 : 1),
               "transferFunction must be the format's: linear or sRGB");
        expect(number(at + 15, 1) == 0, "flags must be 0");
        expect(u32(at + 16) == 0, "texelBlockDimension must be 1 x 1 x 1 x 1");
        expect(number(at + 20, 1) == channels_ * bits_ / 8, "bytesPlane0 must be a texel's size");
        expect(zeros(at + 21, at + 28), "bytesPlane1 to 7 must be 0");
        for (std::uint64_t i = 0; i < channels_; ++i) check_sample(i, at + 28 + 16 * i);
    }

    void check_sample(std::uint64_t i, std::uint64_t at) {
        const std::string which = "sample " + std::to_string(i) + ": ";
        expect(number(at, 2) == i * bits_, which + "bitOffset");
        expect(number(at + 2, 1) == bits_ - 1, which + "bitLength must be a component's bits less one");
        const std::uint64_t type = number(at + 3, 1);
        expect((type & 15) == (i == 3 ? 15 : i), which + "channelId");
        expect((type & 0xF0) == (is_srgb_ && i == 3 ? 0x10
                                 : is_unorm_        ? 0
                                                    : 0xC0),
               which + "qualifiers must be float and signed, or none");
        expect(u32(at + 4) == 0, which + "samplePosition must be 0");
        expect(u32(at + 8) == (is_unorm_ ? 0 : 0xBF800000u), which + "sampleLower must be -1.0f, or 0");
        expect(u32(at + 12) == (is_unorm_ ? (1u << bits_) - 1 : 0x3F800000u),
               which + "sampleUpper must be 1.0f, or all bits");
    }

    void check_key_values() {
        std::string previous;
        bool has_writer = false;
        std::uint64_t at = kvd_.offset;
        while (at < kvd_.end()) {
            expect(at % 4 == 0, "keyAndValueByteLength must be 4-byte aligned");
            if (kvd_.end() - at < 4) break;
            const std::uint64_t size = u32(at);
            if (size < 2 || at + 4 + size > kvd_.end()) {
                breaches_.push_back("keyAndValueByteLength " + std::to_string(size));
                return;
            }
            const std::string pair(reinterpret_cast<const char*>(file_.data()) + at + 4, size);
            const auto nul = pair.find('\0');
            if (nul == std::string::npos || nul == 0) {
                breaches_.push_back("a key must have at least a byte and end with NUL");
                return;
            }
            const std::string key = pair.substr(0, nul), value = pair.substr(nul + 1);
            expect(previous < key, "keys must be sorted and single: '" + previous + "', '" + key + "'");
            previous = key;
            expect(!value.empty() && value.back() == '\0', key + ": string values must end with NUL");
            check_reserved(key, value.c_str());
            has_writer = has_writer || key == "KTXwriter";
            const std::uint64_t padded = (size + 3) / 4 * 4;
            expect(at + 4 + padded <= kvd_.end(), key + ": valuePadding is missing");
            if (at + 4 + padded <= kvd_.end())
                expect(zeros(at + 4 + size, at + 4 + padded), key + ": valuePadding must be 0");
            at += 4 + padded;
        }
        expect(at == kvd_.end(), "kvdByteLength must be the sum of its entries");
        expect(has_writer, "KTXwriter is missing");
    }

    void check_reserved(const std::string& key, const std::string& value) {
        if (key == "KTXorientation")
            expect(
                value == (depth_ > 0 ? "rdi" : "rd"),
                "KTXorientation must be rd for cube maps, and is for pictures whose row 0 is on top; rdi for "
                "volumes");
        else if (key == "KTXwriter")
            expect(!value.empty(), "KTXwriter must name its writer");
        else
            expect(key.compare(0, 3, "KTX") != 0 && key.compare(0, 3, "ktx") != 0, key + " is reserved");
    }

    void check_levels() {
        const std::uint64_t texel = channels_ * bits_ / 8, alignment = std::lcm(texel, std::uint64_t{4});
        std::uint64_t expected = kvd_.end();  // smallest level first, each at the next aligned byte
        for (std::uint64_t level = level_count_; level-- > 0;) {
            const std::string which = "level " + std::to_string(level) + ": ";
            const std::uint64_t at = 80 + 24 * level;
            const std::uint64_t offset = u64(at), size = u64(at + 8);
            const std::uint64_t texels = faces_ * std::max<std::uint64_t>(1, width_ >> level) *
                                         std::max<std::uint64_t>(1, height_ >> level) *
                                         std::max<std::uint64_t>(1, depth_ >> level);
            expect(size == texels * texel, which + "byteLength");
            expect(u64(at + 16) == size, which + "uncompressedByteLength");
            expect(offset % alignment == 0, which + "alignment");
            const std::uint64_t padded = (expected + alignment - 1) / alignment * alignment;
            expect(offset == padded, which + "doesn't follow what is before it");
            if (offset != padded || offset + size > file_.size()) {
                breaches_.push_back(which + "lies elsewhere or outside the file");
                return;
            }
            expect(zeros(expected, padded), which + "mipPadding must be 0");
            expected = offset + size;
        }
        expect(expected == file_.size(), "there are bytes after the last level");
    }

    struct Section {
        std::uint64_t offset = 0, size = 0;
        std::uint64_t end() const { return offset + size; }
    };
    const std::vector<std::byte>& file_;
    std::vector<std::string> breaches_;
    bool is_unorm_ = false;
    bool is_srgb_ = false;
    std::uint64_t channels_ = 0, bits_ = 0, width_ = 0, height_ = 0, depth_ = 0, faces_ = 0, level_count_ = 0;
    Section dfd_, kvd_;
};

}  // namespace

std::vector<std::string> check_ktx2(const std::vector<std::byte>& file) { return Checker(file).run(); }

}  // namespace pbrbake::io::test
