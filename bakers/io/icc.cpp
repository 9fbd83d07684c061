#include "bakers/io/icc.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "bakers/unorm8.hpp"

namespace pbrbake::io {
namespace {

/// A tag's bytes: a type of 4 letters, 4 bytes of 0, and data. Reads 0 beyond them.
class Tag {
  public:
    explicit Tag(Bytes bytes) : bytes_(bytes) {}
    std::string type() const { return has(4) ? text_at(bytes_, 0, 4) : ""; }
    bool has(std::size_t size) const { return size <= bytes_.size(); }
    std::uint32_t number(std::size_t at, int bytes) const {
        std::uint32_t value = 0;
        for (std::size_t i = at; i < at + static_cast<std::size_t>(bytes); ++i)
            value = value << 8 | (i < bytes_.size() ? std::to_integer<std::uint32_t>(bytes_[i]) : 0);
        return value;
    }
    /// s15Fixed16Number (4.6).
    double fixed(std::size_t at) const { return static_cast<std::int32_t>(number(at, 4)) / 65536.; }

  private:
    Bytes bytes_;
};

/// From the table of tags (7.3).
std::optional<Tag> find_tag(Bytes profile, std::string_view signature) {
    constexpr std::size_t kHeader = 128, kEntry = 12;
    const Tag whole(profile);
    const std::size_t count = whole.number(kHeader, 4);
    for (std::size_t i = 0, entry = kHeader + 4; i < count && whole.has(entry + kEntry);
         ++i, entry += kEntry) {
        if (text_at(profile, entry, 4) != signature) continue;
        const std::uint64_t at = whole.number(entry + 4, 4), size = whole.number(entry + 8, 4);
        if (at + size <= profile.size()) return Tag(profile.subspan(at, size));
    }
    return {};
}

/// A parametricCurveType's value (10.18); NaN of a kind that isn't known.
double parametric(const Tag& curve, double x) {
    const auto parameter = [&](std::size_t i) { return curve.fixed(12 + 4 * i); };
    const double g = parameter(0), a = parameter(1), b = parameter(2), c = parameter(3), d = parameter(4);
    switch (curve.number(8, 2)) {
        case 0:
            return std::pow(x, g);
        case 3:
            return x >= d ? std::pow(a * x + b, g) : c * x;
        case 4:
            return x >= d ? std::pow(a * x + b, g) + parameter(5) : c * x + parameter(6);
        default:
            return std::nan("");
    }
}

/// A curveType's (10.6): linear, a power, or samples with lines between.
double sampled(const Tag& curve, double x) {
    const std::uint32_t count = curve.number(8, 4);
    if (count == 0) return x;
    if (count == 1) return std::pow(x, curve.number(12, 2) / 256.);
    if (!curve.has(12 + std::size_t{2} * count)) return std::nan("");
    const double at = x * (count - 1);
    const auto below = std::min(static_cast<std::uint32_t>(at), count - 2);
    const auto sample = [&](std::uint32_t i) { return curve.number(12 + std::size_t{2} * i, 2) / 65535.; };
    return sample(below) + (sample(below + 1) - sample(below)) * (at - below);
}

bool is_srgb_curve(const Tag& curve) {
    constexpr double kSame = .004;  // a power of 2.2 is off by .008
    constexpr int kSteps = 64;
    const bool is_parametric = curve.type() == "para";
    if (!is_parametric && curve.type() != "curv") return false;
    for (int i = 0; i <= kSteps; ++i) {
        const double x = static_cast<double>(i) / kSteps;
        const double y = is_parametric ? parametric(curve, x) : sampled(curve, x);
        if (!(std::abs(y - srgb_to_linear(x)) <= kSame)) return false;
    }
    return true;
}

struct Colourant {
    const char* primary;
    const char* curve;
    std::array<double, 3> xyz;
};
/// IEC 61966-2-1's primaries, adapted to D50 as ICC profiles are (Bradford).
constexpr std::array kSrgb{Colourant{"rXYZ", "rTRC", {.4361, .2225, .0139}},
                           Colourant{"gXYZ", "gTRC", {.3851, .7169, .0971}},
                           Colourant{"bXYZ", "bTRC", {.1431, .0606, .7141}}};

bool is_srgb_colourant(const Colourant& srgb, const Tag& primary, const Tag& curve) {
    constexpr double kSame = .002;  // profiles round differently
    for (std::size_t i = 0; i < 3; ++i)
        if (std::abs(primary.fixed(8 + 4 * i) - srgb.xyz[i]) > kSame) return false;
    return is_srgb_curve(curve);
}

}  // namespace

bool is_srgb_profile(Bytes profile, const std::string& description) {
    if (profile.empty()) return false;
    if (const auto grey = find_tag(profile, "kTRC")) return is_srgb_curve(*grey);
    bool is_srgb = true, has_all = true;
    for (const Colourant& colourant : kSrgb) {
        const auto primary = find_tag(profile, colourant.primary), curve = find_tag(profile, colourant.curve);
        has_all = has_all && primary && curve;
        is_srgb = is_srgb && has_all && is_srgb_colourant(colourant, *primary, *curve);
    }
    return has_all ? is_srgb : description.find("sRGB") != std::string::npos;
}

}  // namespace pbrbake::io
