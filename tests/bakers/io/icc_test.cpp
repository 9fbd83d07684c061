// Which ICC profiles are sRGB's: by their numbers where they have them, else by their name.

#include "bakers/io/icc.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/bakers/io/fixtures.hpp"

namespace pbrbake::io::test {
namespace {

using Tags = std::map<std::string, Buffer>;

Buffer profile_of(const Tags& tags) {
    Buffer out(128), data;
    put_be(out, tags.size(), 4);
    for (const auto& [name, tag] : tags) {
        put_be(put_be(put_text(out, name), 132 + 12 * tags.size() + data.size(), 4), tag.size(), 4);
        data.insert(data.end(), tag.begin(), tag.end());
    }
    out.insert(out.end(), data.begin(), data.end());
    return out;
}

std::uint64_t fixed(double value) {
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::lround(value * 65536)));
}

Buffer numbers(const char* type, std::initializer_list<double> values) {
    Buffer out;
    put_be(put_text(out, type), 0, 4);
    for (const double value : values) put_be(out, fixed(value), 4);
    return out;
}

Buffer parametric(int kind, std::initializer_list<double> values) {
    Buffer out;
    put_be(put_be(put_be(put_text(out, "para"), 0, 4), static_cast<std::uint64_t>(kind), 2), 0, 2);
    for (const double value : values) put_be(out, fixed(value), 4);
    return out;
}

Buffer samples(const std::vector<int>& values) {
    Buffer out;
    put_be(put_be(put_text(out, "curv"), 0, 4), values.size(), 4);
    for (const int value : values) put_be(out, static_cast<std::uint64_t>(value), 2);
    return out;
}

const Buffer kCurve = parametric(3, {2.4, 1 / 1.055, .055 / 1.055, 1 / 12.92, .04045});

/// sRGB's primaries as profiles of several makers have them.
Tags srgb_primaries(const Buffer& curve) {
    return {{"rXYZ", numbers("XYZ ", {.43607, .22249, .01392})},
            {"gXYZ", numbers("XYZ ", {.38515, .71687, .09708})},
            {"bXYZ", numbers("XYZ ", {.14307, .06061, .7141})},
            {"rTRC", curve},
            {"gTRC", curve},
            {"bTRC", curve}};
}

TEST(IccProfile, IsSrgbByItsNumbers) {
    std::vector<int> table;
    for (int i = 0; i < 1024; ++i) {
        const double x = i / 1023.;
        table.push_back(static_cast<int>(
            std::lround(65535 * (x <= .04045 ? x / 12.92 : std::pow((x + .055) / 1.055, 2.4)))));
    }
    EXPECT_TRUE(is_srgb_profile(profile_of(srgb_primaries(kCurve)), "c2"));
    EXPECT_TRUE(is_srgb_profile(profile_of(srgb_primaries(samples(table))), "unnamed"));
    EXPECT_TRUE(is_srgb_profile(profile_of({{"kTRC", kCurve}}), "sGrey"));
}

TEST(IccProfile, IsNotSrgbByItsNameWhereNumbersSayElse) {
    for (const Buffer& curve : {samples({}), samples({0x0233}), parametric(0, {2.2}), parametric(9, {2.4})})
        EXPECT_FALSE(is_srgb_profile(profile_of(srgb_primaries(curve)), "linear sRGB"));
    Tags wide = srgb_primaries(kCurve);  // Display P3's red
    wide["rXYZ"] = numbers("XYZ ", {.5151, .2412, -.0011});
    EXPECT_FALSE(is_srgb_profile(profile_of(wide), "sRGB"));
    EXPECT_FALSE(is_srgb_profile(profile_of({{"kTRC", samples({0x0233})}}), "Grey Gamma 2.2"));
}

TEST(IccProfile, IsJudgedByItsNameWhereItHasNoNumbers) {
    EXPECT_TRUE(is_srgb_profile(icc_profile("sRGB IEC61966-2.1"), "sRGB IEC61966-2.1"));
    EXPECT_FALSE(is_srgb_profile(icc_profile("Display P3"), "Display P3"));
    EXPECT_FALSE(is_srgb_profile({}, "sRGB"));
}

TEST(IccProfile, EndsWhereItIsCut) {
    const Buffer whole = profile_of(srgb_primaries(samples({0, 30000, 65535})));
    for (std::size_t size = 0; size <= whole.size(); ++size)
        EXPECT_FALSE(is_srgb_profile(Bytes(whole).first(size), "unnamed")) << size;
    Buffer lying = whole;
    lying[128] = std::byte{0xFF};  // tags beyond its end
    EXPECT_FALSE(is_srgb_profile(lying, "unnamed"));
}

}  // namespace
}  // namespace pbrbake::io::test
