#pragma once
// Rows of an equirect without some of its texels.

#include <span>
#include <vector>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/environment.hpp"

namespace pbr {

/// An equirect in which some texels are black. Rows that hold any are copies, the others the picture's own:
/// it must outlive this.
class EquirectRows {
  public:
    /// `black` are of face 0, rows ascending.
    EquirectRows(const EquirectView& source, std::span<const CubeTexel> black);
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
