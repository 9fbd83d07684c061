#pragma once
// Pictures without some of their texels.

#include <array>
#include <span>
#include <vector>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/environment.hpp"

namespace pbr {

/// What is taken from all texels before a sum over them and put back after it: of a picture of that value
/// nothing is left to err; best is a mean. And which texels are left out (face 0 of an equirect, rows
/// ascending): they count as that constant, so that no holes are left to ring.
struct PicturePart {
    std::span<const CubeTexel> without;
    std::array<float, 3> constant{};
};

/// The rows of an equirect, the texels that a part is without being its constant. Rows that hold any are
/// copies, the others the picture's own: it must outlive this.
class EquirectRows {
  public:
    /// Copies what it must.
    EquirectRows(const EquirectView& source, const PicturePart& part);
    EquirectRows(const EquirectRows&) = delete;  // rows_ points into copies_
    EquirectRows(EquirectRows&&) = default;

    /// RGB of row y's texels.
    const float* row(int y) const { return rows_[static_cast<std::size_t>(y)]; }

    /// All rows, from the top.
    std::span<const float* const> all() const { return rows_; }

  private:
    std::vector<float> copies_;
    std::vector<const float*> rows_;
};

}  // namespace pbr
