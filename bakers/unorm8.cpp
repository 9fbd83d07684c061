#include "bakers/unorm8.hpp"

#include <algorithm>
#include <cmath>

namespace pbrbake {

double srgb_to_linear(double encoded) {
    return encoded <= .04045 ? encoded / 12.92 : std::pow((encoded + .055) / 1.055, 2.4);
}

Unorm8Table::Unorm8Table() {
    for (std::size_t code = 0; code < 256; ++code) {
        const auto number = static_cast<double>(code);
        linear_[code] = static_cast<float>(number / 255);
        srgb_[code] = static_cast<float>(srgb_to_linear(number / 255));
        ends_[code] = code < 255 ? static_cast<float>(srgb_to_linear((number + .5) / 255)) : HUGE_VALF;
    }
    for (std::uint32_t i = 0; i < first_codes_.size(); ++i) {
        const auto first = std::bit_cast<float>(kLeastBits + (i << kStretchBits));
        first_codes_[i] = static_cast<std::uint8_t>(std::ranges::upper_bound(ends_, first) - ends_.begin());
    }
}

const Unorm8Table kUnorm8;

}  // namespace pbrbake
