#pragma once
// How a file's numbers become light: a transfer curve, then a gamut. Plain data, shared with the colour
// module.

#include <array>

namespace pbrbake::io {

/// CIE 1931 xy of a gamut's primaries and white.
struct Chromaticities {
    std::array<double, 2> red, green, blue, white;
};

enum class Gamut { rec709, ap1, ap0, rec2020, p3_d65, adobe_rgb, custom };

enum class Curve { linear, srgb, power };

/// `gamma` is read for Curve::power, `primaries` for Gamut::custom.
struct Encoding {
    Curve curve = Curve::linear;
    Gamut gamut = Gamut::rec709;
    double gamma = 1;
    Chromaticities primaries{};
};

inline constexpr std::array<double, 2> kD65{.3127, .3290};
inline constexpr std::array<double, 2> kAcesWhite{.32168, .33767};

/// ITU-R BT.709-6, BT.2020-2; SMPTE RP 431-2 primaries with D65; Adobe RGB (1998); SMPTE ST 2065-1 (AP0);
/// Academy S-2014-004 (AP1).
inline constexpr Chromaticities kRec709{{.64, .33}, {.30, .60}, {.15, .06}, kD65};
inline constexpr Chromaticities kRec2020{{.708, .292}, {.170, .797}, {.131, .046}, kD65};
inline constexpr Chromaticities kP3D65{{.680, .320}, {.265, .690}, {.150, .060}, kD65};
inline constexpr Chromaticities kAdobeRgb{{.64, .33}, {.21, .71}, {.15, .06}, kD65};
inline constexpr Chromaticities kAp0{{.7347, .2653}, {0, 1}, {.0001, -.0770}, kAcesWhite};
inline constexpr Chromaticities kAp1{{.713, .293}, {.165, .830}, {.128, .044}, kAcesWhite};

}  // namespace pbrbake::io
