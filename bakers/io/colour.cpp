#include "bakers/io/colour.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "bakers/io/file_bytes.hpp"
#include "bakers/io/io.hpp"
#include "bakers/io/matrix3.hpp"
#include "bakers/io/module_api.hpp"

namespace pbrbake::io {
namespace {

struct Named {
    const char* name;
    Curve curve;
    Gamut gamut;
    double gamma = 1;
};

constexpr std::array kNamed{
    Named{"lin_rec709", Curve::linear, Gamut::rec709},
    Named{"srgb", Curve::srgb, Gamut::rec709},
    Named{"g18_rec709", Curve::power, Gamut::rec709, 1.8},
    Named{"g22_rec709", Curve::power, Gamut::rec709, 2.2},
    Named{"acescg", Curve::linear, Gamut::ap1},
    Named{"aces2065_1", Curve::linear, Gamut::ap0},
    Named{"lin_rec2020", Curve::linear, Gamut::rec2020},
    Named{"lin_p3d65", Curve::linear, Gamut::p3_d65},
    Named{"srgb_p3d65", Curve::srgb, Gamut::p3_d65},
    Named{"lin_adobergb", Curve::linear, Gamut::adobe_rgb},
    // Adobe RGB (1998), 4.3.1.2: gamma 2.19921875 = 2 + 51/256.
    Named{"adobergb", Curve::power, Gamut::adobe_rgb, 2.19921875},
};

constexpr std::array kGamuts{Gamut::rec709,  Gamut::ap1,    Gamut::ap0,
                             Gamut::rec2020, Gamut::p3_d65, Gamut::adobe_rgb};

double distance(const std::array<double, 2>& a, const std::array<double, 2>& b) {
    return std::max(std::abs(a[0] - b[0]), std::abs(a[1] - b[1]));
}

/// The largest difference of two sets of chromaticities in any coordinate.
double distance(const Chromaticities& a, const Chromaticities& b) {
    return std::max({distance(a.red, b.red), distance(a.green, b.green), distance(a.blue, b.blue),
                     distance(a.white, b.white)});
}

}  // namespace

const Chromaticities& chromaticities_of(Gamut gamut) {
    switch (gamut) {
        case Gamut::ap1:
            return kAp1;
        case Gamut::ap0:
            return kAp0;
        case Gamut::rec2020:
            return kRec2020;
        case Gamut::p3_d65:
            return kP3D65;
        case Gamut::adobe_rgb:
            return kAdobeRgb;
        case Gamut::rec709:
        case Gamut::custom:
            break;
    }
    return kRec709;
}

const std::vector<std::string>& colour_spaces() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> list{"auto"};
        for (const Named& named : kNamed) list.emplace_back(named.name);
        list.emplace_back("raw");
        return list;
    }();
    return names;
}

std::optional<Encoding> encoding_named(std::string_view name) {
    for (const Named& named : kNamed)
        if (name == named.name) return Encoding{named.curve, named.gamut, named.gamma, {}};
    return {};
}

std::string name_of(const Encoding& encoding) {
    for (const Named& named : kNamed)
        if (encoding.curve == named.curve && encoding.gamut == named.gamut &&
            (encoding.curve != Curve::power || std::abs(encoding.gamma - named.gamma) < .01))
            return named.name;
    // Only files state what has no name here: custom primaries, or a power curve of another exponent.
    if (encoding.gamut == Gamut::custom) return "chromaticities";
    std::string gamut;
    for (const Named& named : kNamed)
        if (named.curve == Curve::linear && named.gamut == encoding.gamut) gamut = named.name;
    if (gamut.starts_with("lin_")) gamut.erase(0, 4);
    char text[16];
    std::snprintf(text, sizeof text, "g%.3g_", encoding.gamma);
    return text + gamut;
}

Encoding linear_with(const Chromaticities& primaries, const std::string& where) {
    constexpr double kSame = 5e-4;  // files round white points to three or four digits
    for (const Gamut gamut : kGamuts)
        if (distance(primaries, chromaticities_of(gamut)) < kSame) return {Curve::linear, gamut, 1, {}};

    bool usable = true;
    for (const auto* xy : {&primaries.red, &primaries.green, &primaries.blue, &primaries.white})
        usable = usable && std::abs((*xy)[0]) < 8 && std::abs((*xy)[1]) < 8;  // false for NaN
    usable = usable && primaries.white[0] > 0 && primaries.white[1] > 0 &&
             primaries.white[0] + primaries.white[1] < 1;
    if (usable) {
        const double area = (primaries.green[0] - primaries.red[0]) * (primaries.blue[1] - primaries.red[1]) -
                            (primaries.green[1] - primaries.red[1]) * (primaries.blue[0] - primaries.red[0]);
        usable = std::abs(area) > 1e-6;
    }
    if (!usable)
        throw unreadable(where,
                         "its chromaticities span no gamut; state the bake's colour_space to overrule them");
    return {Curve::linear, Gamut::custom, 1, primaries};
}

std::optional<Gamut> working_gamut(std::string_view name) {
    if (name == "lin_rec709") return Gamut::rec709;
    if (name == "acescg") return Gamut::ap1;
    return {};
}

void convert(const Encoding& from, Gamut working, std::span<float> rgb, const std::string& where) {
    if (from.curve == Curve::linear && from.gamut == working) return;
    std::string error;
    if (!ocio_module().convert(from, working, rgb.data(), rgb.size() / 3, error))
        throw unreadable(where, "colours could not be converted from " + name_of(from) + ": " + error);
}

}  // namespace pbrbake::io
