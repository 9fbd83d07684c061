#include "bakers/io/repair.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pbrbake::io {

void repair_non_finite(std::span<float> rgb, Repairs& repairs, Infinity infinity) {
    std::array<float, 3> largest{};
    std::uint64_t broken = 0;
    for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) {
        bool finite = true;
        for (std::size_t c = 0; c < 3; ++c) {
            const float value = rgb[i + c];
            if (std::isfinite(value))
                largest[c] = std::max(largest[c], value);
            else
                finite = false;
        }
        broken += !finite;
    }
    repairs.non_finite += broken;
    if (broken == 0) return;
    if (infinity == Infinity::largest_float) largest.fill(std::numeric_limits<float>::max());
    for (std::size_t i = 0; i < rgb.size(); ++i)
        if (!std::isfinite(rgb[i])) rgb[i] = rgb[i] > 0 ? largest[i % 3] : 0.f;
}

void repair_negative(std::span<float> rgb, Repairs& repairs) {
    for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) {
        bool negative = false;
        for (float& value : rgb.subspan(i, 3)) {
            if (!(value < 0)) continue;
            negative = true;
            repairs.lowest = std::min(repairs.lowest, static_cast<double>(value));
            value = 0;
        }
        repairs.negative += negative;
    }
}

}  // namespace pbrbake::io
