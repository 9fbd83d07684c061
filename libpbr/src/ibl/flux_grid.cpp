#include "src/ibl/flux_grid.hpp"

#include <numbers>
#include <utility>

namespace pbr {

FluxGrid::FluxGrid(int rows, int columns)
    : rows_(rows), columns_(columns), flux_(static_cast<std::size_t>(rows) * columns * 3) {}

RingSource FluxGrid::rings(std::vector<std::complex<double>> factors) const {
    RingSource rings{columns_, rows_, {}, std::move(factors)};
    rings.read = [this](int y, int channel, double* out) {
        const double* flux = &flux_[static_cast<std::size_t>(y) * columns_ * 3] + channel;
        for (int x = 0; x < columns_; ++x) out[x * 2 * kFourierLanes] = flux[x * 3];
    };
    return rings;
}

std::vector<double> FluxGrid::colatitudes_rad() const {
    std::vector<double> result;
    for (int y = 0; y < rows_ / 2; ++y) result.push_back((y + 0.5) / rows_ * std::numbers::pi);
    return result;
}

}  // namespace pbr
