#include "pbr/ibl/equirect_rows.hpp"

#include <algorithm>
#include <utility>

namespace pbr {

EquirectRows::EquirectRows(const EquirectView& source, const PicturePart& part) {
    for (int row = 0; row < source.height; ++row) rows_.push_back(source.texel(0, row));
    std::size_t copies = 0;
    int last = -1;
    for (const CubeTexel& texel : part.without) copies += std::exchange(last, texel.y) != texel.y;
    const std::size_t stride = static_cast<std::size_t>(source.width) * 3;
    copies_.reserve(copies * stride);
    for (const CubeTexel& texel : part.without) {
        const float*& row = rows_[static_cast<std::size_t>(texel.y)];
        if (row == source.texel(0, texel.y)) {
            copies_.insert(copies_.end(), row, row + stride);
            row = copies_.data() + (copies_.size() - stride);
        }
        std::ranges::copy(part.constant, copies_.begin() + (row - copies_.data()) + 3L * texel.x);
    }
}

}  // namespace pbr
