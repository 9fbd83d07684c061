#include "bakers/io/unorm8.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace pbrbake::io {
namespace {

/// IEC 61966-2-1.
double srgb_to_linear(double encoded) {
    return encoded <= .04045 ? encoded / 12.92 : std::pow((encoded + .055) / 1.055, 2.4);
}

/// Values of the codes, and where each code ends. Rounded to float, they don't depend on the C library's pow.
struct SrgbTable {
    std::array<float, 256> values;
    std::array<float, 255> ends;
    SrgbTable() {
        for (int code = 0; code < 256; ++code) {
            values[code] = static_cast<float>(srgb_to_linear(code / 255.));
            if (code < 255) ends[code] = static_cast<float>(srgb_to_linear((code + .5) / 255));
        }
    }
};

const SrgbTable& srgb_table() {
    static const SrgbTable table;
    return table;
}

}  // namespace

std::uint8_t unorm8_of(float linear, Transfer transfer) {
    if (!(linear > 0)) return 0;
    if (transfer == Transfer::linear)
        return static_cast<std::uint8_t>(std::nearbyint(std::min(static_cast<double>(linear), 1.) * 255));
    const auto& ends = srgb_table().ends;
    return static_cast<std::uint8_t>(std::upper_bound(ends.begin(), ends.end(), linear) - ends.begin());
}

float from_unorm8(std::uint8_t code, Transfer transfer) {
    return transfer == Transfer::linear ? static_cast<float>(code / 255.) : srgb_table().values[code];
}

}  // namespace pbrbake::io
