#include "bakers/texture/sized_map.hpp"

#include <algorithm>
#include <cmath>

namespace pbrbake::texture {

SizedMap::SizedMap(const Picture& picture, int channel, int step, int width, int height, Wrap wrap)
    : picture_(picture), channel_(channel), step_(step) {
    if (picture.width() == width && picture.height() == height) return;
    columns_ = places(picture.width(), width, wrap);
    rows_ = places(picture.height(), height, wrap);
}

std::vector<SizedMap::Place> SizedMap::places(int size, int set_size, Wrap wrap) {
    const auto inside = [&](int i) {
        return wrap == Wrap::repeat ? (i % size + size) % size : std::clamp(i, 0, size - 1);
    };
    std::vector<Place> places;
    for (int i = 0; i < set_size; ++i) {
        const double at = (i + .5) * size / set_size - .5, first = std::floor(at);
        places.push_back({inside(static_cast<int>(first)), inside(static_cast<int>(first) + 1),
                          static_cast<float>(at - first)});
    }
    return places;
}

void SizedMap::read(int c, int x, int y, std::span<float> values) const {
    const int channel = this->channel(c);
    if (rows_.empty()) return picture_.read(x, y, channel, values);
    const Place& row = rows_[static_cast<std::size_t>(y)];
    const auto between = [](float first, float second, float share) {
        return first + (second - first) * share;
    };
    const Place* column = columns_.data() + x;
    for (float& value : values) {
        const auto along = [&](int from) {
            return between(picture_.value(column->first, from, channel),
                           picture_.value(column->second, from, channel), column->share);
        };
        value = between(along(row.first), along(row.second), row.share);
        ++column;
    }
}

const std::uint8_t* SizedMap::codes(int c, int x, int y) const {
    const std::uint8_t* codes = rows_.empty() ? picture_.codes(x, y) : nullptr;
    return codes ? codes + channel(c) : nullptr;
}

}  // namespace pbrbake::texture
